"""Payload bench: the mass at which a gripper first fails, by bisection.

The payload depends only on the gripper, the object and the acceleration, so that one bench is evidence for every design
with that gripper (MOE 1 and its MOPs; compare eq. 4.8).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rgss.errors import DefinitionError
from rgss.trials.payload_bench.range import outside
from rgss.trials.payload_bench.rig import PayloadLimit, Probe, probe
from rgss.trials.payload_bench.spec import BenchSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class PayloadResult:
    """Payload of a gripper at its first failure, with the theoretical values.

    Attributes:
        payload_kg: Greatest mass that was lifted and held; 0 if none was.
        limited_by: Failure of the next greater mass, or `RATED` if all masses were held.
        bracket_kg: Greatest mass held and smallest mass not held; both the rated mass if all were held.
        theory_kg: mu N_f F / (g + a_m); of a cup F (1 - leak) / ((g + a_m) (1 + d / r)), see `BenchSpec.theory_kg`.
        eq_4_8_kg: The same divided by the safety factor.
        probes: All probed masses, in order.
    """

    payload_kg: float
    limited_by: PayloadLimit
    bracket_kg: tuple[float, float]
    theory_kg: float
    eq_4_8_kg: float
    probes: tuple[Probe, ...]

    @property
    def trials(self) -> int:
        """Number of probed masses."""
        return len(self.probes)


def run_bench(spec: BenchSpec, *, probe_mass: Callable[[BenchSpec, float], Probe] = probe) -> PayloadResult:
    """Find the mass at which the gripper first fails.

    The smallest mass for the default solver iterations and the rated mass are probed first; if the smallest slips, a
    smaller one with more iterations follows; then the bracket is bisected geometrically. Theory is not used. The search
    assumes that a gripper that holds a mass also holds any smaller one.

    Raises:
        DefinitionError: The specification is invalid, or outside the validated range.
        SimulationError: The physics engine cannot build the rig.
    """
    spec.check()
    strange = outside(spec)
    if strange:
        raise DefinitionError(
            f"the payload bench is not validated for {strange[0]}",
            hint="it is valid only where simulation and statics agree within 2 %",
        )
    low, high = probe_mass(spec, spec.first_kg), probe_mass(spec, spec.rated_kg)
    probes = [low, high]
    # A lighter object has the same forces and impacts, and slips later.
    if low.stopped_by is PayloadLimit.SLIP and spec.smallest_kg < low.mass_kg:
        low, high = probe_mass(spec, spec.smallest_kg), low
        probes.append(low)
    if not low.held:
        return _result(spec, 0.0, low, probes)
    if high.held:
        return _result(spec, high.mass_kg, high, probes)
    while high.mass_kg - low.mass_kg > spec.settings.resolution * high.mass_kg:
        middle = probe_mass(spec, math.sqrt(low.mass_kg * high.mass_kg))
        probes.append(middle)
        low, high = (middle, high) if middle.held else (low, middle)
    return _result(spec, low.mass_kg, high, probes)


def _result(spec: BenchSpec, payload_kg: float, above: Probe, probes: Sequence[Probe]) -> PayloadResult:
    return PayloadResult(
        payload_kg=payload_kg,
        limited_by=above.stopped_by or PayloadLimit.RATED,
        bracket_kg=(payload_kg, above.mass_kg),
        theory_kg=spec.theory_kg,
        eq_4_8_kg=spec.eq_4_8_kg,
        probes=tuple(probes),
    )
