"""Numbers of the model that trials were simulated with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rgss.decision.what_if.numbers import ModelNumber, variant_with
from rgss.designs import DesignVariant
from rgss.studies import Project, trial_specs
from rgss.sweep import key_of


def simulated_numbers(
    project: Project, variants: Sequence[DesignVariant], numbers: Iterable[ModelNumber]
) -> frozenset[str]:
    """The ids of the numbers of which another value needs other trials.

    Args:
        project: The project with its study.
        variants: Its variants.
        numbers: The numbers.
    """
    asked, pairs = [], []
    for number in numbers:
        before = next((one for one in variants if variant_with(one, number, number.value + 1.0) is not one), None)
        if before is not None:
            asked.append(number)
            # Any other value serves, since the key of a trial is a digest of all that it is made of.
            pairs += [before, variant_with(before, number, number.value * 1.5 + 1.0)]
    if not asked:
        return frozenset()
    keys = [key_of(spec) for spec in trial_specs(project, variants=pairs, seeds=project.study.seeds[:1])]
    return frozenset(number.id for place, number in enumerate(asked) if keys[2 * place] != keys[2 * place + 1])
