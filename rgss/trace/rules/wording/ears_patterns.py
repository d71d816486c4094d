"""Pattern of a sentence: the Easy Approach to Requirements Syntax (R1).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Sentence, TermList

_PATTERNS = "write 'The SYSTEM shall …', or one of 'While …,', 'When …,', 'Where …,', 'If …, then' before it"


def _pattern(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if sentence.flaw:
        yield Flaw(message=sentence.flaw, hint=_PATTERNS)


def _departure(sentence: Sentence, _: TermList, __: Worded) -> Iterator[Flaw]:
    if sentence.departure and not sentence.flaw:
        yield Flaw(message=sentence.departure, hint=_PATTERNS)


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R1",
        severity=Severity.ERROR,
        explanation=(
            "A requirement has a pattern of EARS: it says who shall do what, after the conditions under which "
            "that holds, each with a comma or 'then' behind it. A reader then finds the same part at the same place "
            "in every requirement. Words that mean the same as a keyword of EARS, such as 'Upon', count as it."
        ),
        find=_pattern,
        breaking=(
            "When a move ends the gripper shall stay open.",
            "The gripper must close.",
            "If the cup slips the gripper shall close.",
            "When the cup slips the gripper shall close.",
            "There shall be three fingers.",
            "The shall stop.",
            "When a cup is seen, the shall stop.",
        ),
        passing=(
            "When a cup is ordered, the RGSS shall serve the cup within 25 s.",
            "When the order is not complete, the cell shall show the missing cup.",
            "While the arm moves, when a person enters the zone, the arm shall stop within 0.5 s.",
            "Where a camera is fitted, the cell shall record images at 10 Hz or more.",
            "If the planning time reaches the limit, then the planner shall end the search.",
            "When the door opens, the controller shall cut the power of the heater.",
            "On a stop command, the controller shall enter the SAFE state.",
        ),
    ),
    SentenceRule(
        id="wording.ears-keyword",
        severity=Severity.INFO,
        explanation=(
            "Conditions begin with the keywords of EARS: While a state, When an event, Where an option, If "
            "something unwanted, then; and they come before the subject. A condition with 'where' behind the response "
            "is not noted, since it may refer to a noun. A project that wants nothing else raises this rule's severity."
        ),
        find=_departure,
        breaking=(
            "During a move, the gripper shall stay open.",
            "Upon arrival, the gripper shall close.",
            "If the cup slips, the gripper shall close.",
            "For each cup, the gripper shall close.",
            "Unless the cup slips, the gripper shall close.",
            "The gripper shall open when the cup is placed.",
            "The gripper shall open only if the cup is placed.",
            "The arm shall keep the cup upright while it moves.",
        ),
        passing=(
            "If the cup slips then the gripper shall close.",
            "The cell shall record when the door opens.",
            "The display shall indicate if the door is open.",
            "The arm shall reach the place where the cup is.",
            "While the aircraft is on the ground, the control unit shall inhibit the thrust reverser lock.",
        ),
    ),
)
