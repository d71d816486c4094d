"""Characters that steer who shows a text: all of them are found, and escaping keeps what a document says."""

from __future__ import annotations

import json
import sys
import unicodedata
from xml.etree import ElementTree as ET

import pytest

from rgss.documents.steering import escaped_for_json, escaped_for_xml, has_control_characters

BIDIRECTIONAL = {"LRE", "RLE", "PDF", "LRO", "RLO", "LRI", "RLI", "FSI", "PDI"}


def test_every_control_and_every_control_of_direction_is_found():
    """By the Unicode database, which is no list of ours."""
    for number in range(sys.maxunicode + 1):
        sign = chr(number)
        dangerous = unicodedata.category(sign) in {"Cc", "Cs", "Zl", "Zp"}
        dangerous |= unicodedata.bidirectional(sign) in BIDIRECTIONAL
        if dangerous and sign not in "\n\t":
            assert has_control_characters(sign), hex(number)
        # What has a shape of its own is left alone, and so is what joins letters in Persian or Hindi.
        if sign.isprintable() or sign in "\u200c\u200d\u00ad\u00a0\n\t":
            assert not has_control_characters(sign), hex(number)


@pytest.mark.parametrize(
    "text", ["plain\n", "\x1b[2J\u202e\u2066abc\u2069", "\u061c\u200f🤖\U000e0041 \x7f\x9b31m", "é\u2028", "\r\b\x00"]
)
def test_json_says_the_same(text):
    document = json.dumps({"text": text}, ensure_ascii=False)
    escaped = escaped_for_json(document)
    assert json.loads(escaped) == {"text": text}
    assert not has_control_characters(escaped)


@pytest.mark.parametrize("text", ["plain", "\u202e\u2066abc\u2069", "\u200f🤖\U000e0041 \x9b31m", "é\u2028"])
def test_xml_says_the_same(text):
    element = ET.Element("case", name=text)
    element.text = text
    escaped = escaped_for_xml(ET.tostring(element, encoding="unicode"))
    again = ET.fromstring(escaped)  # noqa: S314 - our own text
    assert (again.text, again.get("name")) == (text, text)
    assert not has_control_characters(escaped)
