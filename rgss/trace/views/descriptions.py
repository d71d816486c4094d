"""Description of an element in reports: its text and its evidence."""

from __future__ import annotations

from collections.abc import Mapping

from rgss.evidence.records import Metric
from rgss.measures import Estimate, MeasureSet
from rgss.requirements import Behaviour, Block
from rgss.trace.evidence import TraceEvidence, TrialEvidence, success_criterion
from rgss.trace.model import TraceModel
from rgss.trace.views.figures import (
    UNKNOWN,
    end_in_words,
    estimate_in_words,
    metric_in_words,
    record_in_words,
    value_in_words,
    verdict_in_words,
)
from rgss.trace.views.neighbours import ThingKind, record_name


class Descriptions:
    """Texts and notes of all elements of a project.

    Args:
        model: The project's requirements, architecture and measures.
        evidence: Evidence of the project.
        definitions: The definitions of the measures; without them a measure has no name.
    """

    def __init__(self, model: TraceModel, evidence: TraceEvidence, definitions: MeasureSet | None) -> None:
        self._requirements = model.requirements
        self._evidence = evidence
        self._definitions = definitions
        self._texts = {} if definitions is None else _texts(definitions)
        shown = evidence.shown
        self._trials: Mapping[str, TrialEvidence] = (
            {} if shown is None else {trial.key: trial for trial in shown.trials}
        )
        self._tests = evidence.all_tests()
        self._records = {record_name(name): one for name, one in evidence.state.records.items()}

    def text(self, name: str, kind: ThingKind) -> str:
        """Text of an element, or its name."""
        if kind is ThingKind.TRIAL:
            trial = self._trials[name]
            return f"variant {trial.variant}, seed {trial.seed}, {trial.fidelity}: {trial.outcome}"
        if kind in (ThingKind.TEST, ThingKind.RECORD):
            return ""
        if kind in _OF_REQUIREMENTS:
            element = self._requirements.element(name)
            return f"{element.name}: {element.text}" if isinstance(element, (Block, Behaviour)) else element.text
        return self._texts.get(name, "")

    def note(self, name: str, kind: ThingKind, *, measure: str = "") -> str:
        """Text of an element's evidence.

        Args:
            name: Its id.
            kind: Its kind.
            measure: For a trial, the shown measure.
        """
        if kind is ThingKind.REQUIREMENT:
            return self._verdict(name)
        if kind is ThingKind.MEASURE:
            estimate = self._estimate(name)
            return "" if estimate is None else estimate_in_words(estimate)
        if kind is ThingKind.TRIAL:
            return self._observation(name, measure)
        if kind is ThingKind.TEST:
            return end_in_words(self._tests[name])
        if kind is ThingKind.RECORD:
            return record_in_words(self._records[name])
        return ""

    def _verdict(self, name: str) -> str:
        requirement = self._requirements.requirement(name)
        words = verdict_in_words(self._evidence.verdict(requirement), self._evidence.causes(requirement))
        if requirement.criterion is not None and self._evidence.shown is not None:
            words += f" by variant {self._evidence.shown.variant}"
        success = success_criterion(requirement)
        return f"{words}; asked for: {success}" if success else words

    def _estimate(self, measure: str) -> Estimate | None:
        shown = self._evidence.shown
        return None if shown is None else shown.estimates.get(measure)

    def _observation(self, key: str, measure: str) -> str:
        trial = self._trials[key]
        estimate = self._estimate(measure)
        if estimate is None:
            return trial.replay_command
        value = trial.values.get(measure)
        words = UNKNOWN if value is None else value_in_words(value, estimate.unit)
        observed = "".join(f"; {name} = {metric_in_words(metric)}" for name, metric in self._metrics(trial, measure))
        return f"{measure} = {words}; {trial.replay_command}{observed}"

    def _metrics(self, trial: TrialEvidence, measure: str) -> list[tuple[str, Metric]]:
        """Observations of a trial on which a measure depends."""
        if self._definitions is None or measure not in self._definitions.used:
            return []
        names = [source.partition(".") for source in self._definitions.sources(measure)]
        return [(name, trial.metrics[name]) for kind, _, name in names if kind == "trial" and name in trial.metrics]


_OF_REQUIREMENTS = frozenset({ThingKind.NEED, ThingKind.REQUIREMENT, ThingKind.BLOCK, ThingKind.BEHAVIOUR})


def _texts(definitions: MeasureSet) -> dict[str, str]:
    texts = {assumption.id: assumption.statement for assumption in definitions.assumptions}
    texts |= {equation.id: equation.relation for equation in definitions.equations}
    texts |= {symbol.source: symbol.definition for symbol in reversed(definitions.inputs)}
    texts |= {symbol.id: f"{symbol.definition} ({symbol.source})" for symbol in definitions.inputs}
    texts |= {constant.id: constant.definition for constant in definitions.constants}
    texts |= {measure.id: measure.name for measure in definitions.measures}
    return texts
