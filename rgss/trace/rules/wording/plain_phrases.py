"""Rules that look for phrases or signs and nothing else; a further one is an entry here.

Numbers are those of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, listed, phrases

# Between numbers an ellipsis is a range.
_ELLIPSIS = re.compile(r"(?:\.{3}|…)(?!\.*\s?[+\-\u2212]?\d)")


def _phrase_rule(
    *, flaw: str, hint: str, in_response: bool = False, signs: re.Pattern[str] | None = None, **entry: Any
) -> SentenceRule:
    """Rule violated by each sentence with one of its terms.

    Args:
        flaw: The problem, as a text after "says" and the terms found.
        hint: How to resolve it.
        in_response: Look after 'shall' only.
        signs: Signs that violate it too.
        entry: The other attributes of the rule.
    """

    def find(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
        sign = None if signs is None else signs.search(sentence.text)
        found = listed(terms.find(sentence, start=sentence.response_start if in_response else 0))
        if found or sign is not None:
            yield Flaw(message=f"says {found or repr(sign and sign[0])}{flaw}", hint=hint)

    return SentenceRule(find=find, **entry)


RULES: tuple[SentenceRule, ...] = (
    _phrase_rule(
        id="wording.R9",
        severity=Severity.ERROR,
        explanation="A requirement has no open end; what is not named cannot be verified.",
        meaning="open ends",
        flaw=", which has no end",
        hint="name each of them, or make requirements of them",
        signs=_ELLIPSIS,
        terms=phrases("""
            among other things, among others, and more besides, and others, and similar, and so forth, and so
            on, and the like, and the rest, and what not, but not limited to, e.g, et al, et cetera, etc, for
            example, for instance, inter alia, or similar, or the like, or whatever, such as, things like, to
            name a few
        """),
        breaking=(
            "The gripper shall hold cups, plates, etc.",
            "The cell shall serve cups, plates, etc.",
            "The cell shall serve cups and so on.",
            "The cell shall serve tableware, including but not limited to cups.",
            "The cell shall serve tableware such as cups.",
            "The cell shall serve tableware, e.g. cups.",
            "The script shall write PDF, PNG, ...",
            "The script shall write PDF, PNG, … files.",
        ),
        passing=(
            "The sensor shall accept between 1 ... 5 V.",
            'The script shall end the search with the outcome "budget spent, and so on".',
        ),
    ),
    _phrase_rule(
        id="wording.R10",
        severity=Severity.ERROR,
        explanation=(
            "A requirement asks for what is done, and not that somebody is able or designed to do it: an ability "
            "that is never used would meet it."
        ),
        meaning="superfluous infinitives",
        flaw=", which asks for an ability and not for its use",
        hint="say what it shall do",
        in_response=True,
        terms=phrases("""
            allow the ability to, be able to, be allowed to, be capable of, be designed to, be enabled to, be
            expected to, be in a position to, be in the position to, be intended to, be meant to, be permitted
            to, be required to, be suited to, be supposed to, have the ability to, have the capability of, have
            the capability to, have the capacity to, have the means to, have the possibility to, offer the
            ability to, offer the possibility to, provide a capability to, provide a means to, provide means to,
            provide the ability to, provide the capability to, provide the facility to, provide the means to,
            provide the possibility to, support the ability to, support the capability to, with the ability to,
            with the capability to, with the capacity to, with the means to
        """),
        breaking=(
            "The gripper shall be able to hold the cup.",
            "The gripper shall be capable of holding the cup.",
            "The arm shall be designed to stop.",
            "The cell shall provide the capability to stop.",
        ),
        passing=("The mount shall allow the exchange of fingers.",),
    ),
    _phrase_rule(
        id="wording.R32",
        severity=Severity.ERROR,
        explanation="A requirement says 'each' where 'all', 'any' or 'both' leave open whether singly or together.",
        meaning="quantifiers that leave this open",
        flaw=": of each, or of them together?",
        hint="say 'each', or name them",
        terms=phrases("""
            all, any, both
        """),
        breaking=(
            "The gripper shall hold all cups.",
            "The gripper shall hold any cup.",
            "The gripper shall close both fingers.",
        ),
        passing=(
            "The all-terrain base shall carry the arm.",
            "The brakes shall hold the arm at each pose.",
        ),
    ),
)
