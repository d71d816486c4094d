"""Result of a confirmation in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.confirmation import Aspect, Confirmation, ConfirmedTrial
from rgss.measures import Verdict

_WORDS = {
    Aspect.STUDY: "the study's own setting",
    Aspect.STEP: "the step",
    Aspect.ITERATIONS: "the solver's iterations",
    Aspect.ENGINE: "the engine",
}
ARM_IN_PYBULLET = (
    "The arm moves by its dynamics under its controller (control.in_contact), which PyBullet simulates under every "
    "setting: tracking error, joint speeds, torques and their failures say nothing of the engine."
)
_NUMBERS = ("no", "one", "two", "three", "four")


def summary_sentences(confirmation: Confirmation) -> Iterator[str]:
    """The decision, the verdicts and the outcomes in a sentence each, and what was not confirmed.

    Of several trials with another outcome each has a line of its own.
    """
    yield decision_sentence(confirmation)
    choice = choice_sentence(confirmation)
    if choice:
        yield choice
    yield verdict_sentence(confirmation)
    differing = confirmation.differing_trials
    if len(differing) > 1:
        yield f"{len(differing)} of {len(confirmation.trials)} trials end otherwise:"
        yield from (f"  {trial_sentence(confirmation, trial)}." for trial in differing)
    else:
        yield outcome_sentence(confirmation)
    if confirmation.before_physics:
        yield _before_physics_sentence(confirmation)
    if confirmation.arm_is_pybullet and Aspect.ENGINE in confirmation.aspects:
        yield ARM_IN_PYBULLET
    selection = confirmation.selection
    if selection.left_out:
        ids = ", ".join(map(str, selection.left_out))
        yield f"Rivals that were not confirmed: {ids} (name them with --variants)."
    if selection.planned_failures or selection.physical_failures:
        planned, physical = selection.planned_failures, selection.physical_failures
        sampled = len(selection.sample)
        yield (
            f"Failures of the study: {planned} before physics, which no engine changes, and {physical} in physics, "
            f"of which {sampled} of designs that are not confirmed {'was' if sampled == 1 else 'were'} run again."
        )


def decision_sentence(confirmation: Confirmation) -> str:
    """Sentence on the dependence of the decision on the setting, among the confirmed designs."""
    results, differing, first = confirmation.results, confirmation.differing_decisions, confirmation.reference
    confirmed = len(confirmation.selection.variants)
    is_partial = confirmed < confirmation.designs
    decision = f"Among {confirmed} of {confirmation.designs} designs the decision" if is_partial else "The decision"
    if not differing:
        what = _listed([_WORDS[aspect] for aspect in confirmation.aspects], "or")
        every = f"all {_number(len(results))} settings" if len(results) > 2 else "both settings"
        if first is None:
            return f"{decision} does not depend on {what}: no design meets every requirement under {every}."
        others = {result.first for result in results if result.first is not None} - {first}
        as_good = "equally good" if others <= set(results[0].ties) else "better within the practical margin"
        tied = f" (or {_listed([str(one) for one in sorted(others)], 'or')}, {as_good})" if others else ""
        return f"{decision} does not depend on {what}: variant {first}{tied} is first under {every}."
    what = _listed([_WORDS[results[index].setting.aspect] for index in differing], "and")
    under: dict[int | None, list[str]] = {}
    for result in results:
        shown = first if confirmation.is_as_good(first, result) else result.first
        under.setdefault(shown, []).append(result.setting.label)
    found = "; ".join(
        f"{'no design' if variant is None else f'variant {variant}'} is first under {_listed(labels, 'and')}"
        for variant, labels in under.items()
    )
    return f"{decision} depends on {what}: {found}."


def choice_sentence(confirmation: Confirmation) -> str:
    """Sentence on a choice of the study that does not come first by the seeds of the confirmation; empty otherwise."""
    chosen, own = confirmation.selection.chosen, confirmation.results[0]
    if chosen is None or chosen == own.first:
        return ""
    count = len(confirmation.seeds)
    first = "no design" if own.first is None else f"variant {own.first}"
    by = f"the {count} seeds" if count > 1 else "the one seed"
    as_good = f", and variant {chosen} is as good" if confirmation.reference == chosen else ""
    return f"The study chooses variant {chosen}; by {by} of this confirmation {first} is first in it{as_good}."


def _before_physics_sentence(confirmation: Confirmation) -> str:
    """Sentence on trials of the confirmed designs of which no setting can say anything."""
    total = sum(not trial.is_sample for trial in confirmation.trials)
    ended = confirmation.before_physics
    if ended == total:
        return "No trial of these designs reaches physics, so that nothing of it is confirmed."
    verb = "ends" if ended == 1 else "end"
    return f"{ended} of {total} trials of these designs {verb} before physics, which no setting changes."


def verdict_sentence(confirmation: Confirmation) -> str:
    """Sentence on the verdicts that depend on the setting."""
    study = confirmation.results[0].verdicts
    total = sum(map(len, study.values()))
    designs = f"{len(study)} design{'' if len(study) == 1 else 's'}"
    differing = confirmation.differing_verdicts
    if not total:
        return "No requirement has a criterion, so that there are no verdicts."
    if not differing:
        same = f"All {total} verdicts on {designs} are the same under every setting"
        open_ = sum(verdict is Verdict.INCONCLUSIVE for found in study.values() for verdict in found.values())
        left = f", but {open_} of them {'is' if open_ == 1 else 'are'} inconclusive by so few seeds" if open_ else ""
        return f"{same}{left}."
    count = len({(one.variant, one.requirement) for one in differing})
    found = "; ".join(
        f"{one.requirement} of variant {one.variant} is {_plain(one.study.value)} in the study and "
        f"{_plain(one.other.value)} under {confirmation.results[one.setting].setting.label}"
        for one in differing
    )
    return f"{count} of {total} verdicts {'depends' if count == 1 else 'depend'} on the setting: {found}."


def outcome_sentence(confirmation: Confirmation) -> str:
    """Sentence on the trials with another outcome under another setting."""
    total = len(confirmation.trials)
    differing = confirmation.differing_trials
    if not differing:
        return f"All {total} trials end alike under every setting." if total > 1 else "The trial ends alike."
    found = "; ".join(trial_sentence(confirmation, trial) for trial in differing)
    verb = "ends" if len(differing) == 1 else "end"
    return f"{len(differing)} of {total} trials {verb} otherwise: {found}."


def trial_sentence(confirmation: Confirmation, trial: ConfirmedTrial) -> str:
    """Outcome of one trial in the study and under the settings that differ, with the figures behind it."""
    parts = []
    for index in trial.differing:
        detail = trial.records[index].failure_detail
        shown = f" ({detail})" if detail else ""
        parts.append(f"{trial.outcome(index)} under {confirmation.results[index].setting.label}{shown}")
    detail = trial.records[0].failure_detail
    own = trial.outcome(0) + (f" ({detail})" if detail else "")
    return f"variant {trial.variant}, seed {trial.seed}: {own} in the study, {_listed(parts, 'and')}"


def _number(count: int) -> str:
    return _NUMBERS[count] if count < len(_NUMBERS) else str(count)


def _plain(text: str) -> str:
    return text.replace("_", " ")


def _listed(parts: Sequence[str], conjunction: str) -> str:
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} {conjunction} {parts[-1]}"
