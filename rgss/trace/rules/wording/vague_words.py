"""Vague words (R7).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Match, Sentence, TermList, listed, phrases

# Vague where a number follows; otherwise about an axis, around a table, close to a grasp.
_BEFORE_NUMBERS = phrases("""
    about, approx, around, ca, circa, close to, roughly
""")
# Not vague where one of these words follows.
_CLEAR_BEFORE = {"rather": ("than",), "normally": ("open", "closed")}
_VAGUE = phrases("""
    a couple of, a few, a lot of, a number of, acceptable, adequate, adequately, allowable, almost, almost
    always, ample, ancillary, applicable codes, applicable directives, applicable laws, applicable legislation,
    applicable norms, applicable regulations, applicable rules, applicable standards, appropriate,
    appropriately, approximate, approximately, as usual, as well as possible, clear and concise, clear and
    understandable, clear indication, clear instructions, clear message, clear messages, clearly, comfortable,
    comfortably, commonly, considerable, considerably, convenient, conveniently, customary, cutting-edge,
    decent, desirable, easy to *, effective, effectively, efficient, efficiently, effortless, effortlessly,
    elegant, elegantly, environmentally friendly, ergonomic, ergonomically, excessive, excessively, existing
    equipment, existing infrastructure, existing interfaces, existing software, existing systems, existing
    tools, expandable, extremely, fairly, flexible, flexibly, frequently, generally, generic, good enough,
    good-quality, graceful, gracefully, high-quality, ideal, in most cases, inadequate, infrequently,
    insignificant, insufficient, intuitive, intuitively, largely, legible, legibly, lots of, maintainable, many,
    meaningful, moderate, modern, more or less, most of the time, mostly, nearly, negligible, normally,
    numerous, occasionally, often, operator-friendly, plenty of, proficient, properly, quite, rarely, rather,
    realistic, realistically, reasonable, reasonably, relevant, routine, routinely, satisfactory, seamless,
    seamlessly, seldom, sensible, sensibly, several, significant, significantly, simple to *, some, somewhat,
    state of the art, substantial, substantially, sufficient, sufficiently, suitable, suitably, timely,
    tolerable, typical, typically, undue, unduly, unreasonable, unreasonably, user-friendly, usual, usually,
    various, versatile, very, with ease, without difficulty, world-class
""")
_NUMBER_NEXT = re.compile(r"\.?\s*[~±]?[$€£¥]?\d")
# Behind a number it is the sign of a range.
_ABOUT = re.compile(r"(?<![\w%°])(?<!\d\s)[~∼≈≃≅]\s?[$€£¥]?\d")


def _vague(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    found = listed(match for match in terms.find(sentence) if _is_vague(sentence, match))
    sign = None if found else _ABOUT.search(sentence.text)
    if sign is not None:
        found = repr(sign[0][0])
    if found:
        yield Flaw(message=f"says {found}, which is vague", hint="say how much, how many, or which")


def _is_vague(sentence: Sentence, match: Match) -> bool:
    """Some words are vague only as an adverb of a number: 'about 3 s', but not 'about an axis'."""
    after = sentence.tokens[match.after].word if match.after < len(sentence.tokens) else ""
    if after in _CLEAR_BEFORE.get(match.term, ()):
        return False
    if match.term not in _BEFORE_NUMBERS:
        return True
    return _NUMBER_NEXT.match(sentence.text, sentence.tokens[match.after - 1].end) is not None


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R7",
        severity=Severity.ERROR,
        explanation="A requirement has no vague word, which each reader would understand differently.",
        find=_vague,
        terms=(*_BEFORE_NUMBERS, *_VAGUE),
        meaning="vague words",
        breaking=(
            "The gripper shall hold several cups.",
            "The gripper shall hold many cups.",
            "The gripper shall weigh about 3 kg.",
            "The gripper shall weigh approx. 3 kg.",
            "The gripper shall weigh ca. 3 kg.",
            "The gripper shall weigh at most ~3 kg.",
            "The gripper shall weigh ≈ 3 kg.",
            "The arm shall stop around 5 mm before the table.",
            "The cell shall have adequate light.",
            "The arm shall move some cups.",
            "The gripper shall hold close to 3 kg.",
            "The arm shall usually stop within 1 s.",
            "The tool shall have a suitable colour.",
            "The panel shall be user friendly.",
            "The panel shall be User-Friendly.",
            "The panel shall be easy to use.",
            "The panel shall be easy-to-use.",
            "The panel shall be Simple to Learn.",
            "The cell shall use STATE OF THE ART sensors.",
            "The gripper shall hold SEVERAL cups.",
            "The cell shall comply with all applicable standards.",
            "The cell shall connect to existing systems.",
            "The panel shall clearly show the state of the arm.",
            "The panel shall give a clear indication of the fault.",
        ),
        passing=(
            "The gripper shall close to a firm grasp.",
            "The pump shall deliver between 2~3 l/min.",
            "The gripper shall close around the cup.",
            "The joint shall rotate about the vertical axis.",
            "The arm shall use a finger rather than a hook.",
            "The cell shall use a normally closed valve.",
            "The arm shall keep clear of the shelf.",
            "The hand shall have a clear opening of at least 90 mm.",
        ),
    ),
)
