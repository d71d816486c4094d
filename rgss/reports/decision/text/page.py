"""Decision of a study as a page for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.counted import counted
from rgss.decision.study_decision import StudyDecision
from rgss.reports.decision.answers_in_words import elicitation_sentences
from rgss.reports.decision.conclusion import seeds_sentences
from rgss.reports.decision.model_sentences import model_cautions
from rgss.reports.decision.sentences import cautions, reading_lines
from rgss.reports.decision.text.decision import certificate_lines, choice_lines, portfolio_lines
from rgss.reports.decision.text.effects import effects_lines
from rgss.reports.decision.text.modelling import drivers_lines, modelling_lines
from rgss.reports.decision.text.robustness import robustness_lines
from rgss.reports.decision.text.screening import reopened_lines, screening_lines
from rgss.reports.decision.text.sensitivity import sensitivity_lines
from rgss.reports.decision.text.what_if import what_if_lines


def decision_lines(made: StudyDecision, *, effects: bool = False) -> Iterator[str]:
    """The lines of the page.

    Args:
        made: The decision.
        effects: True to show the effects of each level on the measures of effectiveness too.
    """
    counts = f"{counted(made.variants, 'variant')}, {counted(made.trials, 'trial')}"
    yield from (f"Study {made.study}: {counts}", *seeds_sentences(made.seeds), "")
    if made.what_if is not None:
        yield from what_if_lines(made.what_if)
        yield from ("", "The decision under these suppositions", "")
    yield from choice_lines(made)
    if made.robustness is not None:
        yield from robustness_lines(made)
        if made.sensitivity is not None and made.decision.chosen is not None:
            yield from sensitivity_lines(made.sensitivity)
        if effects:
            yield from effects_lines(made.robustness.effects)
    if made.assumptions:
        yield from modelling_lines(made)
    elif made.readings:
        yield from ("", "Readings of the source (--what-if)")
        yield from (f"  {line}" for line in reading_lines(made))
    yield from drivers_lines(made)
    if made.portfolio is not None:
        yield from portfolio_lines(made.portfolio)
    yield ""
    found = model_cautions(made) if made.decision.chosen is None else cautions(made)
    yield from (f"Caution: {caution}" for caution in found)
    yield from certificate_lines(made.decision.certificate)
    yield from elicitation_sentences(made.elicited, made.elicited_by)
    yield f"Evidence: {made.evidence}"
    if made.screened is not None:
        yield ""
        yield from screening_lines(made.screened)
        yield from reopened_lines(made.what_if.reopened if made.what_if is not None else ())
