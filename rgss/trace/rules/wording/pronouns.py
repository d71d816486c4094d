"""Pronouns (R24).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Match, Sentence, TermList, listed, phrases

# Pronouns where no noun follows.
_DEMONSTRATIVES = phrases("""
    this, that, these, those
""")
_PRONOUNS = phrases("""
    anybody, anyone, anything, everybody, everyone, everything, he, her, hers, herself, him, himself, his, it,
    its, itself, my, nobody, nothing, our, ours, she, somebody, someone, something, their, theirs, them,
    themselves, they, us, we, you, your
""")
# What a demonstrative stands before when it stands for a thing by itself.
_VERBS_NEXT = re.compile(
    r"\s+(?:is|are|was|were|has|have|had|shall|will|can|may|must|should|does|do|of)\b|\s*[.,;:]|\s*$"
)
_END_NEXT = re.compile(r"\s+of\b|\s*[.,;:]|\s*$")


def _pronoun(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = listed(match for match in terms.find(sentence) if _is_pronoun(sentence, match))
    if found:
        yield Flaw(message=f"says {found}, which points outside of it", hint="repeat the noun")


def _is_pronoun(sentence: Sentence, match: Match) -> bool:
    if match.term not in _DEMONSTRATIVES:
        return True
    # "the cup that is held" has 'that' for its noun's sake.
    nexts = _END_NEXT if match.term == "that" else _VERBS_NEXT
    return nexts.match(sentence.text, sentence.tokens[match.after - 1].end) is not None


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R24",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has no pronoun: it is read, allocated and verified alone, where nothing stands that a "
            "pronoun could point at."
        ),
        find=_pronoun,
        terms=(*_DEMONSTRATIVES, *_PRONOUNS),
        meaning="pronouns",
        breaking=(
            "When a cup stands upright, the gripper shall hold it.",
            "When a cup stands, the gripper shall hold it.",
            "The arm shall keep its pose.",
            "When fingers close, they shall stop.",
            "The gripper shall hold this.",
            "When this is done, the gripper shall open.",
            "The stroke of one finger shall match that of the next finger.",
            "The arm shall touch nothing.",
        ),
        passing=(
            "The arm shall hold the gripper that carries the cup.",
            "The arm shall hold the cup that is on the table.",
            "The arm shall follow this path.",
            "The arm shall use the IT network of the house.",
        ),
    ),
)
