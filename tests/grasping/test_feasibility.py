"""Verdicts without margins against the linear programs that have them, and against grasps known by hand."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.grasping import ContactKind, analyse_grasp, feasibility, primitive_wrenches
from rgss.grasping.closure import equilibrium, force_closure, form_closure
from rgss.grasping.feasibility import can_balance, positively_span

CENTRE = (0.0, 0.0, 0.0)


def test_the_verdicts_are_those_of_the_linear_programs_on_500_random_grasps(random_contacts, grasp_of):
    rng, verdicts = np.random.default_rng(14), []
    for _ in range(500):
        kinds = (ContactKind.HARD, ContactKind.SOFT) if rng.random() < 0.7 else tuple(ContactKind)
        grasp = grasp_of(random_contacts(rng, int(rng.integers(2, 6)), kinds=kinds))
        edges = primitive_wrenches(grasp, cone_edges=5).matrix
        closed, balanced = positively_span(edges), can_balance(edges)
        assert closed == force_closure(grasp, cone_edges=5).holds
        assert balanced == equilibrium(grasp, cone_edges=5).holds
        assert balanced or not closed
        verdicts.append((closed, balanced))
    assert 100 < sum(closed for closed, _ in verdicts) < 400
    assert sum(balanced and not closed for closed, balanced in verdicts) >= 1


def test_form_closure_agrees_too(random_contacts, grasp_of):
    rng, closed = np.random.default_rng(3), 0
    for _ in range(200):
        grasp = grasp_of(random_contacts(rng, 7, kinds=(ContactKind.FRICTIONLESS,)))
        found = positively_span(primitive_wrenches(grasp, frictionless=True).matrix)
        assert found == form_closure(grasp).holds
        closed += found
    assert closed >= 2


def test_two_opposed_hard_contacts_balance_and_do_not_close(ring, grasp_of):
    # They resist no torque about the line through them.
    edges = primitive_wrenches(grasp_of(ring(2))).matrix

    assert (can_balance(edges), positively_span(edges)) == (True, False)


@pytest.mark.parametrize("count", [3, 4])
def test_three_and_more_round_a_circle_close(ring, grasp_of, count):
    edges = primitive_wrenches(grasp_of(ring(count))).matrix

    assert (can_balance(edges), positively_span(edges)) == (True, True)


def test_one_contact_holds_nothing(ring, grasp_of):
    edges = primitive_wrenches(grasp_of(ring(1))).matrix

    assert (can_balance(edges), positively_span(edges)) == (False, False)


def test_no_more_wrenches_than_dimensions_span_nothing():
    assert not positively_span(np.hstack([np.eye(3), -np.ones((3, 1))])[:, :3])
    assert positively_span(np.hstack([np.eye(3), -np.ones((3, 1))]))


@pytest.mark.parametrize("contacts", [2, 3, 5])
def test_an_analysis_without_margins_is_the_same_but_for_them(random_contacts, contacts):
    rng = np.random.default_rng(15)
    for _ in range(6):
        points = random_contacts(rng, contacts)
        whole, quick = (
            analyse_grasp(
                points, centre_of_mass_m=CENTRE, finger_force_limit_n=10.0, cone_edges=4, with_margins=with_margins
            ).metrics()
            for with_margins in (True, False)
        )
        margins = {name for name in whole if name.endswith("_margin_1")}
        assert len(margins) == 3
        assert {name: value for name, value in quick.items() if name not in margins} == {
            name: value for name, value in whole.items() if name not in margins
        }
        assert [quick[name] for name in sorted(margins)] == [None] * 3


def test_a_solver_that_gives_up_is_an_error(monkeypatch):
    def gives_up(*_):
        raise RuntimeError("no minimum was found")

    monkeypatch.setattr(feasibility, "nonnegative_least_squares", gives_up)

    with pytest.raises(DefinitionError) as caught:
        can_balance(np.eye(6))

    assert str(caught.value) == (
        "the wrenches of a grasp were not judged: no minimum was found "
        "(check that the contacts' coefficients are of a sensible size)"
    )
