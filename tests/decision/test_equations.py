"""Requirements that an equation verifies although its measure has a simulation."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from types import SimpleNamespace

import pytest

from rgss.decision.study_decision.equations import equation_verifications
from rgss.reports.decision.model_sentences import _equation_sentence


@pytest.fixture
def by_equation(shipped):
    """The shipped project with SYS-012 on the payload of the equation."""
    system = tuple(
        replace(one, criterion=replace(one.criterion, measure="P_max")) if one.id == "SYS-012" else one
        for one in shipped.requirements.system
    )
    return replace(shipped, requirements=replace(shipped.requirements, system=system))


def designs(*payloads):
    """Designs with their payload by the equation and by the bench in kg."""
    found = []
    for variant, (by_equation, simulated) in enumerate(payloads, start=1):
        estimates = defaultdict(lambda: SimpleNamespace(value=None))
        estimates["P_max"] = SimpleNamespace(value=by_equation)
        estimates["P_max_simulated"] = SimpleNamespace(value=simulated)
        found.append(SimpleNamespace(variant=SimpleNamespace(id=variant), estimates=estimates))
    return found


STEM = (
    "SYS-012 is verified by the equation of P_max, not by its simulation: it needs no trial, and so has a value at "
    "every fidelity."
)
ALIKE = "and all of them are on the same side of the threshold by both."
APART = "variants 1, 3 are on the other side of the threshold by it."


@pytest.mark.parametrize(
    ("payloads", "otherwise", "words"),
    [
        (
            [(1.0, 1.01), (0.7, 0.7), (0.9, None)],
            (),
            f"P_max_simulated differs by at most 1.0 % for 2 designs, {ALIKE}",
        ),
        # The requirement demands 0.8 kg.
        (
            [(0.84, 0.77), (0.9, 0.9), (0.79, 0.82)],
            (1, 3),
            f"P_max_simulated differs by at most 8.3 % for 3 designs; {APART}",
        ),
        ([(1.0, None)], (), "These trials have no value of P_max_simulated."),
    ],
)
def test_the_page_says_why_the_equation_is_used_and_whether_the_simulation_differs(
    by_equation, payloads, otherwise, words
):
    (found,) = equation_verifications(by_equation, designs(*payloads))

    assert (found.requirement, found.otherwise) == ("SYS-012", otherwise)
    assert _equation_sentence(found) == f"{STEM} {words}"


def test_no_shipped_requirement_is_verified_by_an_equation_that_has_a_simulation(shipped):
    assert equation_verifications(shipped, designs((1.0, 1.0))) == ()
