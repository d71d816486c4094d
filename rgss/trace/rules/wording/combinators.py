"""Words that join two actions in one requirement (R19).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Match, Sentence, TermList, listed, phrases, words_of

_COMBINATORS = phrases("""
    and, as well as, but, but also, however, meanwhile, on the other hand, or, otherwise, then, unless, whereas,
    whether
""")
# Before nouns these join things; only before a verb they join actions.
_BETWEEN_THINGS = ("and", "or")
# Verbs that are hardly ever nouns behind 'and'.
_VERBS = frozenset(
    words_of("""
    accelerate accept achieve activate adapt adjust advance align allow analyse announce apply approach assign
    avoid begin bring calculate calibrate carry choose clear close collect command communicate compare
    compensate complete compute confirm connect continue convert correct create deactivate decelerate decide
    deliver detect determine disable disconnect display distinguish eject enable end enforce ensure enter
    establish evaluate execute expand explain extend fail find follow generate give grip guide handle identify
    ignore illuminate include indicate inform inhibit initialise initialize inspect install issue keep launch
    leave let lift lower maintain make measure meet notify obtain open operate perform permit pick predict
    prepare present preserve prevent proceed protect provide pull push raise reach read receive recognise
    recognize recover refuse reject release remain remove render repeat replace reproduce resist respond
    restart restore resume retract retrieve return rotate satisfy save select send separate serve settle shut
    simulate slide stay store supply suspend switch synchronise synchronize take tell terminate throw transfer
    transmit turn unload update validate verify wait warn withdraw withstand write
    """)
)
# Verbs that are nouns as well; a verb only where an article or a preposition follows.
_AMBIGUOUS_VERBS = frozenset(
    words_of("""
    alarm alert archive balance block brake bound buffer call change charge check clamp clean contact control
    copy count cover cut delay delete display document drive drop fill filter fix force grasp group halt heat
    hold label limit link list load lock log mark match monitor mount move name order park pass pause place
    plan plot power press print process queue record reduce refresh register report request require reset
    retry reverse route run sample scale scan schedule seal search secure sense set share shift show signal
    sort start state step stop store support test time trace track trade transport trigger use view vent
    """)
)
_DETERMINERS = frozenset(words_of("a an the each its their this that these those no at in on to from with by within"))


def _combinator(sentence: Sentence, terms: TermList, _: Worded) -> Iterator[Flaw]:
    if terms.is_absent(sentence):
        return
    found = listed(
        match
        for match in terms.find(sentence, start=sentence.response_start)
        if _joins_actions(sentence, match, always=match.term in terms.added)
    )
    if found:
        yield Flaw(message=f"joins clauses by {found}", hint="make a requirement of each, or move a condition forward")


def _joins_actions(sentence: Sentence, match: Match, *, always: bool) -> bool:
    """'and' and 'or' join things more often than actions; only before a verb they join actions."""
    text, tokens = sentence.text, sentence.tokens
    if "/" in text[tokens[match.first].start - 1 : tokens[match.after - 1].end + 1]:
        return False
    if match.term not in _BETWEEN_THINGS or always:
        return True
    index = match.after
    while index < len(tokens) and (tokens[index].word.endswith("ly") or tokens[index].word == "then"):
        index += 1
    if index >= len(tokens):
        return False
    word = tokens[index].word
    if word in _VERBS:
        return True
    # "and record the end" joins actions, "and record length" does not.
    is_last = index + 1 == len(tokens)
    return word in _AMBIGUOUS_VERBS and not is_last and tokens[index + 1].word in _DETERMINERS


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R19",
        severity=Severity.WARNING,
        explanation=(
            "The response joins no clauses: what joins them usually makes one requirement of two. 'and' and 'or' "
            "between things are allowed, and count only before a verb; added as terms they always count."
        ),
        find=_combinator,
        terms=_COMBINATORS,
        meaning="combinators",
        widened_by=_BETWEEN_THINGS,
        breaking=(
            "The gripper shall lift and place the cup.",
            "The gripper shall open and close.",
            "The script shall run the trial and record the outcome.",
            "The arm shall stop unless a person confirms.",
            "The arm shall stop, but the gripper stays closed.",
            "The arm shall stop, otherwise a person may be hit.",
            "The gripper shall open or quickly release the cup within 1 s.",
        ),
        passing=(
            "The gripper shall record the position and the velocity.",
            "The gripper shall report position and velocity.",
            "The planner shall offer RRT, TRRT and STRIDE.",
            "The record shall list outcome, durations, contacts and forces.",
            "The vehicle shall display the charge of the battery to the driver.",
        ),
    ),
)
