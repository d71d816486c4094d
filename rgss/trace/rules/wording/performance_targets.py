"""Words of performance without a number (R34).

The number is that of the INCOSE *Guide to Writing Requirements*, version 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Severity
from rgss.requirements import Requirement
from rgss.trace.rules.rule import Flaw, SentenceRule, Worded
from rgss.trace.sentences import Match, Sentence, TermList, listed, phrases

_UNMEASURED = phrases("""
    accurate, accurately, best, better, brisk, briskly, cheap, cheaper, cheaply, compact, cost-effective,
    durable, easily, easy, economical, economically, energy-efficient, enhance, enhanced, fast, faster, fastest,
    gentle, gently, high-accuracy, high-availability, high-capacity, high-performance, high-precision,
    high-reliability, high-resolution, high-speed, improve, improved, inexpensive, light-weight, lightweight,
    long-lasting, low-cost, low-maintenance, low-noise, low-power, maximal, maximise, maximised, maximize,
    maximized, maximum, minimal, minimise, minimised, minimize, minimized, minimum, more accurate, optimal,
    optimally, optimise, optimised, optimize, optimized, optimum, powerful, precise, precisely, quick, quicker,
    quickest, quickly, quiet, quietly, rapid, rapidly, reliable, reliably, responsive, robust, safe, safely,
    scalable, securely, silent, slow, slower, slowly, smooth, smoothly, space-saving, speedy, stable, strong,
    sturdy, swift, swiftly, time-saving
""")
# Without a target only behind one of the second words, as in 'have maximum uptime'; 'the maximum rate' is a name.
_EXTREMES = phrases("""
    maximal, maximum, minimal, minimum
""")
_EXTREMES_AFTER = phrases("""
    a, achieve, at, by, deliver, ensure, guarantee, has, have, maintain, offer, provide, reach, with
""")


def _without_target(sentence: Sentence, terms: TermList, element: Worded) -> Iterator[Flaw]:
    if isinstance(element, Requirement) and element.criterion is not None:
        return
    if terms.is_absent(sentence):
        return
    matches = terms.find(sentence, start=sentence.response_start)
    found = listed(match for match in matches if not _is_named(sentence, match))
    if found and not any(quantity.start >= sentence.response_start for quantity in sentence.quantities):
        yield Flaw(message=f"says {found}, but sets no target", hint="give a number to measure by, or a criterion")


def _is_named(sentence: Sentence, match: Match) -> bool:
    """'the maximum rate' is the name of a quantity; 'maximum uptime' is as much of it as there can be.

    Of 'IP54 or better' the class before it is the target.
    """
    tokens = sentence.tokens
    if match.term == "better":
        return match.first > 0 and tokens[match.first - 1].word == "or"
    if match.term not in _EXTREMES:
        return False
    is_bound = match.after < len(tokens) and tokens[match.after].word == "of"
    return is_bound or match.first == 0 or tokens[match.first - 1].word not in _EXTREMES_AFTER


RULES: tuple[SentenceRule, ...] = (
    SentenceRule(
        id="wording.R34",
        severity=Severity.WARNING,
        explanation=(
            "A requirement on performance has a target that can be measured: a number in its response, or a criterion."
        ),
        find=_without_target,
        terms=_UNMEASURED,
        meaning="words of performance that need a number",
        breaking=(
            "The gripper shall close quickly.",
            "The arm shall move quickly.",
            "The arm shall be fast.",
            "The arm shall be Fast.",
            "The cell shall have a maximum uptime.",
            "The cell shall provide maximum uptime.",
            "The arm shall move with minimal noise.",
            "The gripper shall be light weight.",
            "The path shall be Optimised.",
            "The cell shall minimise the cost of a task.",
            "The gripper shall close smoothly.",
            "The planner shall find the optimal path.",
            "The planner shall find better paths.",
        ),
        passing=(
            "The message shall include the maximum number of resets.",
            "The arm shall have a maximum speed of 2 m/s.",
            "The cell shall have a protection class of IP54 or better.",
            "The script shall accept a maximum of 3 studies.",
        ),
    ),
)
