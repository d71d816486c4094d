"""The payload bench: the mass at which a gripper first fails, found by bisection.

The payload depends on the gripper, the object and the acceleration alone, so that one bench is
evidence for every design with that gripper (MOE 1 and its MOPs; beside eq. 4.8).
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
    """The payload of a gripper at its first failure, beside what theory says.

    Attributes:
        payload_kg: Greatest mass that was lifted and held; 0 if none was.
        limited_by: What happened to the mass next above, or `RATED` if all masses were held.
        bracket_kg: Greatest mass held and smallest mass not held; both the rated mass if all were held.
        theory_kg: mu N_f F / (g + a_m).
        eq_4_8_kg: The same divided by the safety factor.
        probes: Every mass that was tried, in order.
    """

    payload_kg: float
    limited_by: PayloadLimit
    bracket_kg: tuple[float, float]
    theory_kg: float
    eq_4_8_kg: float
    probes: tuple[Probe, ...]

    @property
    def trials(self) -> int:
        """Number of masses that were tried."""
        return len(self.probes)


def run_bench(spec: BenchSpec, *, probe_mass: Callable[[BenchSpec, float], Probe] = probe) -> PayloadResult:
    """Find the mass at which the gripper first fails.

    The smallest mass for the solver as it is and the rated mass are tried first, then, if the smallest
    slips, a still smaller one with more iterations; the bracket between two of them is then halved in
    proportion. Theory is not used. The search assumes that a gripper that holds a mass also holds any smaller one.

    Args:
        spec: The bench.
        probe_mass: What tries one mass.

    Raises:
        DefinitionError: The bench cannot be run as it is specified, or is outside of its validated range.
        SimulationError: The physics engine cannot build the rig.
    """
    spec.check()
    strange = outside(spec)
    if strange:
        raise DefinitionError(
            f"the payload bench is not validated for a {strange[0]}",
            hint="it answers only where simulation and Coulomb's law agree within 2 %",
        )
    low, high = probe_mass(spec, spec.first_kg), probe_mass(spec, spec.rated_kg)
    probes = [low, high]
    # On a lighter object the forces and impacts are the same, and it slips later.
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
