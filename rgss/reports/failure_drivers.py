"""Drivers of failures as lines for a terminal and as a JSON document."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from rgss.assessment import Aspect, CaseSuccess, Driver, DriversOfFailures, FailureDrivers
from rgss.counted import counted
from rgss.reports.plain_text import aligned_table

_SHOWN = 5
_LEAST_P = 0.001


def driver_lines(found: DriversOfFailures) -> Iterator[str]:
    """Lines with a sentence for each kind of failure, and the table behind it."""
    if not found.seeds:
        yield "Nothing was drawn for these trials: neither the scene nor the study has 'uncertainty' or 'workload'."
        return
    yield (
        f"Drivers of failures: {counted(found.trials, 'trial')}, {counted(found.seeds, 'seed')}; a failed trial is "
        "compared with the others of its design"
    )
    yield ""
    for one in found.failures:
        yield driver_sentence(one)
    for failure in found.too_few:
        yield f"{_words(failure.value)}: with too few seeds, or with too few without it, to compare."
    if not found.failures:
        return
    yield ""
    rows = [
        [_place(one), driver_name(each), f"{each.auc:.2f}", _p(each.p), _p(each.adjusted_p)]
        for one in found.failures
        for each in one.drivers[:_SHOWN]
    ]
    yield from aligned_table(["failure", "draw", "AUC", "p", "p, adjusted"], rows, right=(2, 3, 4))


def driver_sentence(one: FailureDrivers) -> str:
    """Sentence on the drivers of a kind of failure."""
    where = f"{_place(one)} ({counted(one.trials, 'trial')}, {counted(one.seeds, 'seed')})"
    if not one.significant:
        return f"{where}: no draw stands out; more seeds would show weaker effects."
    named = [f"{driver_name(each)} (AUC {each.auc:.2f}, p {_compared(each.adjusted_p)})" for each in one.significant]
    return f"{where}: {', '.join(named)}"


def driver_name(one: Driver) -> str:
    """Name of a driver with its direction, such as ``large perception.x`` or ``low workpiece.friction``."""
    is_greater = one.auc >= 0.5
    if one.aspect is Aspect.CASE:
        return f"{'' if is_greater else 'not '}case {one.quantity}"
    if one.aspect is Aspect.SIZE:
        return f"{one.quantity} far from its median" if is_greater else f"{one.quantity} near its median"
    return f"{'high' if is_greater else 'low'} {one.quantity}"


def drivers_to_json(found: DriversOfFailures) -> dict[str, Any]:
    """The drivers as plain data."""
    return {
        "trials": found.trials,
        "seeds": found.seeds,
        "failures": [
            {
                "failure": one.failure.value,
                "stage": one.stage,
                "trials": one.trials,
                "seeds": one.seeds,
                "designs": one.designs,
                "sentence": driver_sentence(one),
                "drivers": [
                    {
                        "quantity": each.quantity,
                        "aspect": each.aspect.value,
                        "auc": each.auc,
                        "p": each.p,
                        "adjusted_p": each.adjusted_p,
                    }
                    for each in one.drivers
                ],
            }
            for one in found.failures
        ],
        "too_few": [failure.value for failure in found.too_few],
    }


def case_lines(cases: Sequence[CaseSuccess]) -> Iterator[str]:
    """Lines on the success of each case of the workload; empty if there is none."""
    if cases:
        yield ""
        rows = [[one.case, str(one.trials), str(one.successes), f"{100.0 * one.share:.1f} %"] for one in cases]
        yield from aligned_table(["case", "trials", "successes", "share"], rows, right=(1, 2, 3))


def cases_to_json(cases: Sequence[CaseSuccess]) -> list[dict[str, Any]]:
    """The success of each case as plain data."""
    return [{"case": one.case, "trials": one.trials, "successes": one.successes} for one in cases]


def _place(one: FailureDrivers) -> str:
    """Failure with the phase of the task, such as ``object dropped at carry``."""
    return _words(one.failure.value) + (f" at {_words(one.stage)}" if one.stage else "")


def _words(name: str) -> str:
    return name.replace("_", " ")


def _p(value: float) -> str:
    return f"{value:.3f}" if value >= _LEAST_P else f"< {_LEAST_P}"


def _compared(value: float) -> str:
    return f"= {value:.3f}" if value >= _LEAST_P else f"< {_LEAST_P}"
