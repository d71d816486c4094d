"""Comparison of behaviour, completeness and decision with the baseline, without statistics."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rgss.regression.baseline import Baseline, BaselineRun, DecisionState
from rgss.regression.comparing import WHOLE_TRIAL, Candidate, Subject
from rgss.regression.observing import first_difference
from rgss.regression.report import ChangedTrial, Failing, FailureCause


def schema_failings(baseline: Baseline, units: Mapping[str, str]) -> Iterator[Failing]:
    """Changes of the guarded metrics, which make old values and new ones incomparable.

    Args:
        baseline: The baseline.
        units: The unit of each guarded metric now.
    """
    for name, unit in sorted(baseline.units.items()):
        if name not in units:
            yield Failing(
                trouble=FailureCause.MISSING_METRIC, text=f"the baseline guards {name}, the study no longer does"
            )
        elif units[name] != unit:
            yield Failing(trouble=FailureCause.CHANGED_SCHEMA, text=f"{name} was in {unit} and is in {units[name]}")
    for name in sorted(units.keys() - baseline.units.keys()):
        yield Failing(trouble=FailureCause.CHANGED_SCHEMA, text=f"the study guards {name}, the baseline does not")


def schema_notes(baseline: Baseline, record: Mapping[str, str]) -> Iterator[str]:
    """Changes of the metrics of records that are not guarded.

    A new metric fails nothing and changes no fingerprint. One that is gone or has another unit leaves its trace in
    the fingerprints, where it is a change of behaviour.

    Args:
        baseline: The baseline.
        record: Name and unit of every metric that a trial's record has now.
    """
    before = {name: unit for name, unit in baseline.record.items() if name not in baseline.units}
    gone = sorted(before.keys() - record.keys())
    new = sorted(record.keys() - baseline.record.keys())
    other = sorted(name for name in record.keys() & before.keys() if record[name] != before[name])
    for names, change in ((gone, "no longer have"), (new, "newly have"), (other, "have another unit for")):
        if names:
            yield f"trials {change} {', '.join(names)}, which the baseline does not guard"


def run_failings(
    name: str,
    before: BaselineRun | None,
    *,
    fidelity: str,
    variants: Sequence[int],
    seeds: Sequence[int],
    first_look: int,
) -> Iterator[Failing]:
    """Failures of a run that is incomplete compared with its baseline.

    Args:
        name: The run.
        before: Its baseline; None if there is none.
        fidelity: Its present fidelity.
        variants: Its present variants.
        seeds: All its present seeds.
        first_look: Number of its present seeds at the first look.
    """
    if before is None:
        yield Failing(trouble=FailureCause.CHANGED_SCHEMA, text=f"run {name} is not in the baseline")
        return
    if before.fidelity != fidelity:
        text = f"run {name} was {before.fidelity} and is {fidelity}"
        yield Failing(trouble=FailureCause.CHANGED_SCHEMA, text=text)
    gone = sorted(set(before.variants) - set(variants))
    new = sorted(set(variants) - set(before.variants))
    for which, said in ((gone, "no longer tries"), (new, "newly tries")):
        if which:
            numbers = ", ".join(map(_number, which))
            trouble = FailureCause.FEWER_REPLICATES if which is gone else FailureCause.CHANGED_SCHEMA
            yield Failing(trouble=trouble, text=f"run {name} {said} variant{'s' if len(which) > 1 else ''} {numbers}")
    if len(seeds) < len(before.seeds):
        text = f"run {name} takes up to {len(seeds)} seeds; the baseline has {len(before.seeds)}"
        yield Failing(trouble=FailureCause.FEWER_REPLICATES, text=text)
    elif first_look < before.first_look:
        text = f"run {name} takes {first_look} seeds at the first look; the baseline took {before.first_look}"
        yield Failing(trouble=FailureCause.FEWER_REPLICATES, text=text)
    if len(seeds) >= len(before.seeds) and tuple(seeds) != before.seeds:
        text = f"run {name} takes other seeds than the baseline, which has {len(before.seeds)}"
        yield Failing(trouble=FailureCause.CHANGED_SCHEMA, text=text)


def changed_trials(
    name: str,
    before: BaselineRun,
    now: Mapping[int, Mapping[int, str]],
    seeds: Sequence[int],
    phases: Sequence[str],
) -> Iterator[ChangedTrial]:
    """Trials with changed records.

    Args:
        name: The run.
        before: Its baseline.
        now: The fingerprint of each record by variant and seed.
        seeds: The seeds that were run.
        phases: The phases in their order.
    """
    for variant in before.variants:
        was = dict(zip(before.seeds, before.fingerprints[str(variant)], strict=True))
        for seed in seeds:
            found = now.get(variant, {}).get(seed)
            if found is not None and found != was.get(seed, found):
                phase = first_difference(was[seed], found, phases)
                yield ChangedTrial(run=name, variant=variant, seed=seed, phase=phase)


def unchanged_phases(
    before: BaselineRun, now: Mapping[int, Mapping[int, str]], seeds: Sequence[int], phases: Sequence[str]
) -> frozenset[str]:
    """Phases, and ``trial``, with unchanged records in every trial.

    Args:
        before: The run's baseline.
        now: The fingerprint of each record by variant and seed.
        seeds: The seeds that were run.
        phases: The phases in their order.
    """
    names = (WHOLE_TRIAL, *phases)
    same = set(names)
    for variant in before.variants:
        was = dict(zip(before.seeds, before.fingerprints[str(variant)], strict=True))
        for seed in seeds:
            old, new = was.get(seed, "").split(), now.get(variant, {}).get(seed, "").split()
            if len(old) != len(names) or len(new) != len(names):
                return frozenset()
            same -= {name for name, one, other in zip(names, old, new, strict=True) if one != other}
    return frozenset(same)


def contradictions(candidate: Candidate) -> dict[Subject, Failing]:
    """The failure of a baseline whose values are not those of its own records; none if they are.

    Where the records are the same bit for bit, so are their values. A text merge, or an edit by hand, can leave the
    digests of one state of the trials beside the values of another.
    """
    if not candidate.identical:
        return {}
    subject = candidate.subject
    for variant, row in candidate.current.items():
        was = candidate.baseline.get(variant, {})
        for seed in candidate.seeds:
            if seed in was and seed in row and was[seed] != row[seed]:
                text = (
                    f"run {subject.run}: {subject.metric} at {subject.phase} of variant {variant} with seed {seed} is "
                    f"{was[seed]} in the baseline and {row[seed]} in the same record (was the file merged or edited?)"
                )
                return {subject: Failing(trouble=FailureCause.INCONSISTENT_BASELINE, text=text)}
    return {}


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionChanges:
    """Changes of the decision.

    Attributes:
        failing: What is unstable.
        undecided: Another choice and lost verdicts that the seeds neither show nor exclude to be more than chance.
        notes: What is only reported.
    """

    failing: tuple[Failing, ...] = ()
    undecided: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def decision_changes(
    before: DecisionState,
    now: DecisionState,
    *,
    explained: Mapping[str, float],
    error_rate: float,
    by_luck: Mapping[str, float] | None = None,
    unmoved: Collection[str] = (),
) -> DecisionChanges:
    """Changes of the decision.

    A choice, a place on the Pareto front or a verdict that is gone is unstable. It may be chance if what it rests on
    has not been shown to differ from the baseline by more than the luck of the seeds, or if the present
    evidence's own noise puts it back in more than the error rate's share of its resamples: then the choice or the
    verdict is undecided, and the place on the front is only reported. A verdict may become met.

    Args:
        before: The decision of the baseline.
        now: The decision now.
        explained: How probable, over the noise of the present evidence, ``chosen`` as it was is,
            and of each ``pareto N`` and ``verdict N REQUIREMENT`` that changed that it is as it was.
        error_rate: The share below which noise explains nothing; also of false alarms, if there are p-values.
        by_luck: P-values of what ``chosen``, ``pareto`` and each ``verdict N REQUIREMENT`` rests on, adjusted for
            there being many; without one, what moved is taken to have moved.
        unmoved: Those of them of which every value is that of the baseline. No seed explains that they changed: a
            requirement, a weight or the code that decides did.
    """
    failing: list[Failing] = []
    undecided: list[str] = []
    notes: list[str] = []
    moves: list[tuple[str, str]] = []
    if before.chosen != now.chosen:
        moves.append(("chosen", f"{_variant(before.chosen)} was chosen, now {_variant(now.chosen)}"))
    moves += [
        (f"pareto {one}", f"{_variant(one)} left the Pareto front") for one in before.pareto if one not in now.pareto
    ]
    moves += [
        (f"pareto {one}", f"variant {one} joined the Pareto front") for one in now.pareto if one not in before.pareto
    ]
    moves = [(what, f"decision: {text}") for what, text in moves]
    # That a design is tried no longer, or is new, is told of the run.
    for variant in sorted(before.verdicts.keys() & now.verdicts.keys(), key=int):
        was, is_now = before.verdicts[variant], now.verdicts[variant]
        for requirement in sorted(was.keys() | is_now.keys()):
            old, new = was.get(requirement, "none"), is_now.get(requirement, "none")
            if old == new:
                continue
            text = f"variant {variant}: the verdict on {requirement} was {old} and is {new}"
            if new == "met":
                notes.append(text)
            else:
                moves.append((f"verdict {variant} {requirement}", text))
    for what, text in moves:
        rests_on = "pareto" if what.startswith("pareto ") else what
        # A place on the front is not a loss by itself, and most changes move one.
        of_chance = notes if rests_on == "pareto" else undecided
        p_value = (by_luck or {}).get(rests_on, 0.0)
        share = explained.get(what, 0.0)
        if rests_on in unmoved:
            why = "every value is that of the baseline, so that a requirement, a weight or what decides has changed"
            failing.append(Failing(trouble=FailureCause.UNSTABLE, text=f"{text}; {why}"))
        elif p_value > error_rate:
            of_chance.append(f"{text}; the seeds neither show nor exclude more than chance (p = {p_value:.2f})")
        elif share > error_rate:
            of_chance.append(f"{text}; within the noise, which has it as it was in {100.0 * share:.0f} % of resamples")
        else:
            failing.append(Failing(trouble=FailureCause.UNSTABLE, text=text))
    return DecisionChanges(failing=tuple(failing), undecided=tuple(undecided), notes=tuple(notes))


def _variant(number: int | None) -> str:
    return "no variant" if number is None else f"variant {_number(number)}"


def _number(variant: int) -> str:
    return str(variant) if variant > 0 else f"{-variant} of the baseline"
