"""Rich text of other tools: what it means in plain text, and what of it is lost."""

from __future__ import annotations

import pytest
from lxml import etree

from rgss.exchange.reqif.prose import from_xhtml

X = 'xmlns="http://www.w3.org/1999/xhtml"'


def plain(markup, *, exact=False):
    return from_xhtml(etree.fromstring(f"<THE-VALUE><div {X}>{markup}</div></THE-VALUE>"), exact=exact)


@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize(
    ("markup", "text"),
    [
        ("10<sup>3</sup> N/m<sup>2</sup>", "10^3 N/m^2"),
        ("10<sup>-3</sup>", "10^-3"),
        ("10<sup>\u22123</sup> m", "10^-3 m"),
        ("e<sup>a + b</sup>", "e^(a + b)"),
        ("x<sup>n<sub>1</sub></sup>", "x^(n₁)"),
        ("1<sup>st</sup> joint, Name<sup>®</sup>", "1st joint, Name®"),
        ("H<sub>2</sub>O", "H₂O"),
        ("v<sub>max</sub> and F<sub>N,Z</sub>", "vₘₐₓ and F_(N,Z)"),
        ("F<sub>N</sub>", "F_N"),
        ('10<span style="vertical-align: super; color: red">3</span>', "10^3"),
        ('a<span style="vertical-align:sub">i</span>', "aᵢ"),
        ("<b>The</b> <i>arm</i> <u>shall</u> stop.", "The arm shall stop."),
        ("<ul><li>one</li><li>two</li></ul>", "- one\n- two"),
        ("<ul><li><p>p1</p><p>p2</p></li><li><div>q</div></li></ul>", "- p1\np2\n- q"),
        ("<ol>\n<li>\n<p>one</p>\n</li>\n<li><p></p>two</li></ol>end", "1. one\n2. two\nend"),
        ("<ul><li></li><li><ul><li>inner</li></ul></li></ul>end", "-\n-\n  - inner\nend"),
        ("<ul><li><table><tr><td>a</td><td>b</td></tr></table></li></ul>", "- a | b"),
        (
            "of:<ol><li>one</li><li>two<ul><li>inner</li></ul></li><li>three</li></ol>",
            "of:\n1. one\n2. two\n  - inner\n3. three",
        ),
        ('<ol start="3"><li>c</li></ol>', "3. c"),
        ('<ol><li>a</li><li value="7">b</li><li>c</li></ol>', "1. a\n7. b\n8. c"),
        ('<ol type="a"><li>x<ol><li>y</li></ol></li><li>z</li></ol>', "a. x\n  1. y\nb. z"),
        ('<ol style="list-style-type: upper-alpha"><li>x</li></ol>', "A. x"),
        (
            "<table><tr><th>mass</th><th>speed</th></tr><tr><td>1 kg</td><td>2 m/s</td></tr></table>",
            "mass | speed\n1 kg | 2 m/s",
        ),
        ("a<br/>b", "a\nb"),
        ("<p>a</p><p>b</p>", "a\nb"),
        ("<pre>a  b\n  c</pre>", "a  b\n  c"),
        ('see <a href="https://example.org/x">the norm</a>', "see the norm (https://example.org/x)"),
        ('<a href="https://example.org">https://example.org</a>', "https://example.org"),
        ("<q>go</q>", "“go”"),
        ("<ins>new</ins> text", "new text"),
    ],
)
def test_what_can_be_kept_is_kept(markup, text, exact):
    found = plain(markup, exact=exact)

    assert found.text == text
    assert found.losses == ()


@pytest.mark.parametrize(
    ("markup", "text", "losses"),
    [
        ("at <del>5</del><ins>6</ins> s", "at 6 s", ["the struck-out text '5' is omitted"]),
        ("at <s>5 <b>s</b></s> 6 s", "at 6 s", ["the struck-out text '5 s' is omitted"]),
        (
            'at <span style="color:red;text-decoration: line-through;">5</span> 6 s',
            "at 6 s",
            ["the struck-out text '5' is omitted"],
        ),
        ('<span style="display:none">secret</span>x', "x", ["the hidden text 'secret' is omitted"]),
        (
            'See <object data="files/a.png" type="image/png">figure 1</object>.',
            "See figure 1.",
            ["the attachment 'files/a.png' is omitted"],
        ),
        (
            '<object data="a.ole"><object data="a.png"/></object>',
            "",
            ["the attachment 'a.ole' is omitted", "the attachment 'a.png' is omitted"],
        ),
        ('<img src="b.png"/>x', "x", ["the element 'img' 'b.png' is omitted"]),
        (
            '<table><tr><td colspan="2">a</td></tr></table>',
            "a",
            ["the table has merged cells, whose text occurs once"],
        ),
        ("<script>x</script>y", "y", []),
    ],
)
def test_what_cannot_be_kept_is_named(markup, text, losses):
    found = plain(markup)

    assert (found.text, list(found.losses)) == (text, losses)


def test_a_table_in_a_cell_is_said_once():
    markup = "<table><tr><td>a<table><tr><td>b</td><td>c</td></tr></table></td><td>d</td></tr></table>"
    assert plain(markup).text == "a; b | c | d"


def test_our_own_texts_come_back_as_they_were():
    assert plain("a  b <br/>  c &lt;sup&gt;", exact=True).text == "a  b \n  c <sup>"


def test_a_text_of_ours_that_another_tool_struck_out_is_omitted():
    found = plain('<div style="text-decoration: line-through">old</div>new', exact=True)

    assert (found.text, found.losses) == ("new", ("the struck-out text 'old' is omitted",))
