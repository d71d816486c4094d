"""Clauses to escape by (R8).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.rules.wording.indefinite_times import INDEFINITE_TIMES
from rgss.trace.sentences import Sentence, TermList, listed, phrases

_ESCAPES = phrases("""
    as * * as possible, as * as feasible, as * as possible, as * as practicable, as * as practical, as * as
    reasonably achievable, as * as reasonably possible, as * as reasonably practicable, as a goal, as
    applicable, as appropriate, as desired, as far as possible, as far as practicable, as feasible, as little as
    possible, as much as possible, as necessary, as needed, as required, best effort, best efforts, hopefully,
    ideally, if applicable, if appropriate, if at all possible, if available, if desirable, if desired, if
    feasible, if necessary, if needed, if possible, if practicable, if practical, if relevant, if required, in
    general, in most cases, in most circumstances, insofar as, preferably, so far as is possible, so far as
    possible, to the degree possible, to the extent feasible, to the extent necessary, to the extent possible,
    to the extent practicable, to the extent practical, to the greatest extent possible, to the maximum extent
    feasible, to the maximum extent possible, to the maximum extent practicable, to the maximum extent
    practical, unless impracticable, unless impractical, unless not possible, when applicable, when appropriate,
    when feasible, when necessary, when needed, when possible, when practicable, when practical, when required,
    whenever necessary, whenever needed, whenever possible, whenever practicable, where applicable, where
    appropriate, where available, where desirable, where feasible, where necessary, where needed, where
    possible, where practicable, where practical, where relevant, where required, wherever appropriate, wherever
    necessary, wherever possible, wherever practicable, wherever practical, within reason
""")


def _escape(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    # "as required by the standard" names the one who requires.
    tokens = sentence.tokens
    found = listed(
        match
        for match in terms.find(sentence)
        if not (match.after < len(tokens) and tokens[match.after].word in ("by", "for", "in"))
        and match.term not in INDEFINITE_TIMES
    )
    if found:
        yield Flaw(
            message=f"says {found}, which lets it be escaped",
            hint="say under which condition it holds, or leave the clause out",
        )


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R8",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has no escape clause, such as one that leaves it to somebody's judgement whether it holds."
        ),
        find=_escape,
        terms=_ESCAPES,
        meaning="clauses to escape by",
        breaking=(
            "Where possible, the gripper shall hold the cup.",
            "Where possible, the gripper shall close.",
            "The gripper shall close if necessary.",
            "The gripper shall, to the extent practical, close.",
            "The arm shall stop as appropriate.",
            "The arm shall stop as required.",
            "The gripper shall be as light as possible.",
            "The gripper shall carry as many cups as possible.",
            "The risk shall be as low as reasonably practicable.",
            "Wherever practical, the gripper shall close.",
        ),
        passing=("The arm shall stop as required by the stop category 1.",),
    ),
)
