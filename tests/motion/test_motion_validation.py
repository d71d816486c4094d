"""Our validator of motions against the engine's own: the same verdicts by the same checks in the same order."""

from __future__ import annotations

from operator import itemgetter

import numpy as np
import pytest

from rgss.motion import SOURCE_PLANNERS
from rgss.motion.engine import load_engine
from rgss.motion.motion_validation import motion_validator
from rgss.motion.validity import first_invalid_between

pytestmark = pytest.mark.engine

ANGLES = itemgetter(0, 1, 2)


class Arena:
    """A cube of joint angles with a ball in it, and a note of every state that is asked for."""

    def __init__(self) -> None:
        self.engine = load_engine()
        base = self.engine.base
        self.space = base.RealVectorStateSpace(3)
        bounds = base.RealVectorBounds(3)
        bounds.setLow(-1.0)
        bounds.setHigh(1.0)
        self.space.setBounds(bounds)
        self.information = base.SpaceInformation(self.space)
        self.information.setStateValidityCheckingResolution(0.01)
        self.asked: list[tuple[float, ...]] = []
        self.checker = base.StateValidityCheckerFn(lambda state: self.is_valid(ANGLES(state)))
        self.information.setStateValidityChecker(self.checker)
        self.ours = motion_validator(self.engine, self.information, ANGLES, self.is_valid, first_invalid_between(self))
        self.information.setup()
        self.theirs = base.DiscreteMotionValidator(self.information)

    def is_valid(self, angles) -> bool:
        self.asked.append(tuple(angles))
        return sum(angle * angle for angle in angles) > 0.16

    def state(self, values):
        state = self.engine.base.State(self.information)
        for index, value in enumerate(values):
            state[index] = float(value)
        return state

    def outcome(self, validator, start, end, *last):
        self.asked = []
        return validator.checkMotion(start(), end(), *last), self.asked


@pytest.fixture(scope="module")
def arena() -> Arena:
    return Arena()


def motions():
    generator = np.random.default_rng(7)
    ends = [generator.uniform(-1.0, 1.0, (2, 3)) for _ in range(300)]
    # Beside long motions those of one piece and of none.
    return ends + [(one, one + 1e-4) for one, _ in ends[:20]] + [(one, one) for one, _ in ends[:5]]


def test_it_finds_what_the_engine_finds_check_for_check(arena):
    verdicts = []
    for one, other in motions():
        start, end = arena.state(one), arena.state(other)
        ours, theirs = (arena.outcome(validator, start, end) for validator in (arena.ours, arena.theirs))
        assert ours == theirs
        verdicts.append(ours[0])

    assert 20 < sum(verdicts) < len(verdicts) - 20


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_every_planner_searches_as_with_the_engines_own(planner, seed):
    # STRIDE also asks how far a motion is valid, which nothing but the engine itself can ask.
    found = [solved(Arena(), planner, seed, ours=ours) for ours in (True, False)]

    assert found[0] == found[1]
    assert len(found[0][0]) > 100


def solved(arena, planner, seed, *, ours):
    base = arena.engine.base
    arena.engine.util.RNG.setSeed(seed)
    information = arena.information
    information.setMotionValidator(arena.ours if ours else arena.theirs)
    information.setup()
    definition = base.ProblemDefinition(information)
    definition.setStartAndGoalStates(arena.state((-0.9, -0.5, 0.1)), arena.state((0.9, 0.5, -0.1)))
    algorithm = getattr(arena.engine.geometric, planner)(information)
    algorithm.setRange(0.5)
    algorithm.setProblemDefinition(definition)
    algorithm.setup()
    arena.asked = []
    stop = base.PlannerTerminationConditionFn(lambda: len(arena.asked) > 5000)
    algorithm.solve(base.PlannerTerminationCondition(stop))
    asked = arena.asked
    assert definition.hasExactSolution()
    return asked, [ANGLES(state) for state in definition.getSolutionPath().getStates()]
