"""Numbers of the model that trials were simulated with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rgss.decision.what_if.numbers import ModelNumber, variant_with
from rgss.designs import DesignVariant
from rgss.studies import Project, trial_specs
from rgss.trials.pieces import digests_of


def simulated_numbers(
    project: Project, variants: Sequence[DesignVariant], numbers: Iterable[ModelNumber]
) -> frozenset[str]:
    """Ids of the numbers whose change needs other trials."""
    asked, pairs = [], []
    for number in numbers:
        before = next((one for one in variants if variant_with(one, number, number.value + 1.0) is not one), None)
        if before is not None:
            asked.append(number)
            # Any other value suffices, since the digest of a trial covers all its inputs.
            pairs += [before, variant_with(before, number, number.value * 1.5 + 1.0)]
    if not asked:
        return frozenset()
    specs = trial_specs(project, variants=pairs, seeds=project.study.seeds[:1])
    # Both of a pair would be made by the same code and engines, so that no versions are needed, nor engines installed.
    inputs = [digests_of(spec, {}).trial for spec in specs]
    return frozenset(number.id for place, number in enumerate(asked) if inputs[2 * place] != inputs[2 * place + 1])
