"""Passive voice after 'shall' (R2).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList, words_of

# "shall be", "shall get" or "shall have been" with a participle, and an adverb before or between them.
_BE = re.compile(
    r"(?:not\s+)?(?:\w+ly\s+)?(?P<verb>be|get|have\s+(?:\w+ly\s+)?been)\s+(?:not\s+)?(?:\w+ly\s+)?(?P<word>[a-z]+)\b",
    re.IGNORECASE,
)


_PARTICIPLES = frozenset(
    words_of(
        "begun bent bound bought broken brought built caught chosen cut dealt done drawn driven fed felt found "
        "frozen given ground held hidden hit hung kept known laid led left lent lit lost made met paid put read "
        "rewritten run said seen sent set shown shut sold spent spun stuck stood struck swept taken taught thrown "
        "told understood withdrawn withheld won worn written"
    )
)


# "be red" and "be able to" are no passive; the second has a rule of its own.
_NO_PARTICIPLES = frozenset(words_of("designed intended required allowed permitted expected supposed red rated"))

# "get stuck" is what an arm does by itself.
_BY_ITSELF = frozenset({"lost", "stuck"})


def _passive(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    match = _BE.match(sentence.response)
    if match is None:
        return
    word, verb = match["word"].lower(), " ".join(match["verb"].lower().split())
    if verb == "get" and word in _BY_ITSELF:
        return
    is_participle = word in _PARTICIPLES or (len(word) > 4 and word.endswith("ed"))
    if is_participle and word not in _NO_PARTICIPLES and word not in terms.terms:
        yield Flaw(
            message=f"says 'shall {verb} {word}', which leaves open who does it",
            hint="make the one who acts the subject, with a verb in the active voice",
        )


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R2",
        severity=Severity.ERROR,
        explanation="The verb after 'shall' is in the active voice, so that the requirement names who is responsible.",
        find=_passive,
        meaning="participles that are taken for adjectives",
        breaking=(
            "The cup shall be lifted by the gripper.",
            "The cup shall be moved to the table.",
            "The cup shall be safely held by the gripper.",
            "When an order arrives, the cup shall be automatically moved to the table.",
            "The record shall be written to the store.",
            "The arm shall be kept clear of the table.",
            "The cup shall get cleaned.",
            "The model shall have been validated.",
            "The model shall have automatically been checked.",
        ),
        passing=(
            "The scene shall be red.",
            "The finger shall get wet.",
            "The arm shall have a red mark.",
            "The arm shall be parallel to the table within 0.1 deg.",
            "The manual shall be in English.",
            "The person shall press the stop button.",
        ),
    ),
)
