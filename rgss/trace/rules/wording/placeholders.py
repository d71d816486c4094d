"""Placeholders of values that are still to be determined."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, is_unit, listed, phrases

_TERMS = phrases("""
    FIXME, TBA, TBC, TBD, TBR, TBS, TODO, XXX, fixme, t.b.a, t.b.c, t.b.d, tba, tbc, tbd, tbr, tbs, to
    be agreed, to be announced, to be clarified, to be confirmed, to be decided, to be defined, to be
    determined, to be resolved, to be specified, yet to be *
""")
_NUMBERED = r"\b(?:TB[ACDRS]|tb[acdrs]|TODO|FIXME)(?:[-_#.]?\d+|[-_]\w+)\b"
_BRACKETED = (
    r"[\[<{]\s*(?:(?:insert|enter|fill|specify)\b[^\]>}]{0,40}"
    r"|(?:value|number|amount|quantity|threshold|limit|unit|[xXnN?_.…]+))\s*[\]>}]"
)
_SIGN = re.compile(rf"{_NUMBERED}|{_BRACKETED}|\?{{2,}}|(?<=\s)\?(?=\s)|(?<!\w)_{{2,}}(?!\w)")
# "XX kg" has no value, and "class XX" a name.
_LETTERS = re.compile(r"(?<![\w.-])(?P<letters>[Xx]{2,}|[Nn]{2}|[Xx]+[.,][Xx]+)\s?(?P<unit>[^\W\d_][\w/^²³·*]*|%|°C)")


def _placeholders(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    found = listed(terms.find(sentence))
    if not found:
        sign = _SIGN.search(sentence.text)
        value = next((each for each in _LETTERS.finditer(sentence.text) if is_unit(each["unit"])), None)
        found = repr(sign[0]) if sign is not None else repr(value["letters"]) if value is not None else ""
    if found:
        yield Flaw(message=f"says {found}", hint="decide it, or keep the requirement out until it is decided")


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.TBD",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has nothing that is still to be determined, resolved or confirmed, and no placeholder."
        ),
        find=_placeholders,
        terms=_TERMS,
        meaning="marks of unresolved values",
        breaking=(
            "The gripper shall hold TBD cups.",
            "The gripper shall hold TBD kg.",
            "The gripper shall hold a mass to be determined.",
            "The gripper shall hold 3 kg (TBC).",
            "The gripper shall hold tbd kg.",
            "The gripper shall hold T.B.D. kg.",
            "The gripper shall hold a mass yet to be agreed.",
            "The gripper shall hold at least TBD-3 kg.",
            "The gripper shall hold at least TBD_MASS kg.",
            "The gripper shall hold at least ??? kg.",
            "The gripper shall hold at least ? kg.",
            "The gripper shall hold at least [value] kg.",
            "The gripper shall hold at least <insert the mass> kg.",
            "The gripper shall hold at least ___ kg.",
            "The gripper shall hold at least XX kg.",
            "The gripper shall hold at least x.xx kg.",
        ),
        passing=(
            'The page shall mark a missing value by "TBD".',
            "The gripper shall comply with class XX of the norm.",
            "The script shall read the value [4] of the table.",
            "The script shall read the file named run_1.",
            "The gripper shall hold at least 3 kg.",
        ),
    ),
)
