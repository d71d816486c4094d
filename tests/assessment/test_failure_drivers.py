"""Drivers of failures: found where they are, silent where they are not, and honest about designs that share draws."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from scipy import stats

from rgss.assessment import Aspect, drivers_of_failures
from rgss.evidence import Failure, Fidelity, TrialRecord
from rgss.reports import driver_lines, drivers_to_json
from tests.fixtures.eight_states import CARRYING, Phase

compared = partial(drivers_of_failures, carried=CARRYING)


def record(seed, draws, failure=None, *, variant=1, workload="", phase=None):
    return TrialRecord(
        variant=variant,
        seed=seed,
        fidelity=Fidelity.CONTACT,
        success=failure is None,
        failure=failure,
        failed_phase=phase,
        failure_detail="",
        phases=(),
        planning=(),
        metrics={},
        workload=workload,
        draws=draws,
    )


def drawn(count, names=("perception.x", "workpiece.friction"), key=0):
    rng = np.random.default_rng(key)
    return [dict(zip(names, row, strict=True)) for row in rng.normal(size=(count, len(names))).tolist()]


def test_the_auc_and_p_of_one_design_are_those_of_mann_and_whitney():
    draws = drawn(40)
    rng = np.random.default_rng(5)
    failed = [draw["workpiece.friction"] + rng.normal() < -0.5 for draw in draws]
    found = compared(
        [
            record(seed, draw, Failure.OBJECT_DROPPED if fails else None)
            for seed, (draw, fails) in enumerate(zip(draws, failed, strict=True))
        ]
    )

    (dropped,) = found.failures
    driver = next(one for one in dropped.drivers if one.quantity == "workpiece.friction")
    values = np.array([draw["workpiece.friction"] for draw in draws])
    test = stats.mannwhitneyu(values[failed], values[~np.array(failed)], method="exact")
    assert driver.auc == pytest.approx(test.statistic / (sum(failed) * (40 - sum(failed))))
    assert driver.p == pytest.approx(test.pvalue, abs=0.004)
    assert driver.aspect is Aspect.VALUE


def test_an_error_of_either_sign_is_found_by_its_size():
    draws = drawn(60)
    found = compared(
        [
            record(seed, draw, Failure.NO_FIRM_GRASP if abs(draw["perception.x"]) > 1.2 else None)
            for seed, draw in enumerate(draws)
        ]
    )

    (driver,) = found.failures[0].significant
    assert (driver.quantity, driver.aspect) == ("perception.x", Aspect.SIZE)
    assert driver.auc > 0.9


def test_a_case_of_the_workload_can_be_a_driver():
    found = compared(
        [
            record(
                seed, {}, Failure.OBJECT_DROPPED if seed % 3 == 0 else None, workload=("heavy", "cup", "mug")[seed % 3]
            )
            for seed in range(30)
        ]
    )

    assert found.failures[0].significant[0].quantity == "heavy"
    assert any("case heavy (AUC 1.00" in line for line in driver_lines(found))


def test_designs_that_share_a_seed_are_one_observation():
    """Twenty designs that fail with the same few seeds: pooled trials would call chance significant."""
    named, pooled = 0, 0
    for key in range(20):
        draws = drawn(20, key=key)
        records = [
            record(seed, draw, Failure.OBJECT_DROPPED if seed < 5 else None, variant=variant)
            for variant in range(20)
            for seed, draw in enumerate(draws)
        ]
        found = compared(records)
        named += bool(found.failures[0].significant)
        values = np.array([draw["perception.x"] for draw in draws for _ in range(20)])
        failed = np.repeat(np.arange(20) < 5, 20)
        pooled += stats.mannwhitneyu(values[failed], values[~failed]).pvalue < 0.05
    # At 5 %, one of twenty would be expected; pooled trials name most.
    assert named <= 3
    assert pooled >= 10


def test_what_is_too_rare_is_not_compared():
    draws = drawn(20)
    found = compared(
        [record(seed, draw, Failure.ARM_COLLISION if seed < 2 else None) for seed, draw in enumerate(draws)]
    )

    assert (found.failures, found.too_few) == ((), (Failure.ARM_COLLISION,))
    assert list(driver_lines(found))[-1] == (
        "arm collision: with too few seeds, or with too few without it, to compare."
    )


def test_without_draws_there_is_nothing_to_compare():
    found = compared([record(seed, {}, Failure.OBJECT_DROPPED) for seed in range(10)])

    assert list(driver_lines(found)) == [
        "Nothing was drawn for these trials: neither the scene nor the study has 'uncertainty' or 'workload'."
    ]


def test_the_document_has_what_the_lines_say():
    draws = drawn(40)
    found = compared(
        [
            record(seed, draw, Failure.OBJECT_DROPPED if draw["workpiece.friction"] < -0.5 else None)
            for seed, draw in enumerate(draws)
        ]
    )
    document = drivers_to_json(found)

    (dropped,) = document["failures"]
    assert dropped["sentence"].startswith("object dropped (")
    assert "low workpiece.friction (AUC 0.00, p" in dropped["sentence"]
    assert dropped["sentence"] in list(driver_lines(found))
    assert {one["quantity"] for one in dropped["drivers"]} == {"perception.x", "workpiece.friction"}


def test_an_object_that_is_dropped_on_its_way_is_told_from_one_that_is_dropped_at_its_place():
    draws = drawn(60)

    def ends(draw):
        if draw["workpiece.friction"] < -0.8:
            return {"failure": Failure.OBJECT_DROPPED, "phase": Phase.LIFT}
        return {"failure": Failure.OBJECT_DROPPED, "phase": Phase.PLACE} if draw["perception.x"] > 0.8 else {}

    found = compared([record(seed, draw, **ends(draw)) for seed, draw in enumerate(draws)])

    named = {(one.stage, one.significant[0].quantity) for one in found.failures}
    assert named == {("carry", "workpiece.friction"), ("place", "perception.x")}
    assert any(line.startswith("object dropped at carry (") for line in driver_lines(found))
