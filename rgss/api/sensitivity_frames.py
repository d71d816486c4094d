"""Sensitivity of a decision as pandas frames, with the columns of `rgss.api.columns`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, TypeVar

from rgss.api.frames import described_frame
from rgss.decision.robustness import Part
from rgss.decision.sensitivity import Sensitivity, Tornado
from rgss.errors import TradeoffError

if TYPE_CHECKING:
    import pandas as pd

Result = TypeVar("Result")


def computed_tornado(found: Sensitivity) -> Tornado:
    """The tornado of a sensitivity.

    Raises:
        TradeoffError: The sensitivity was not analysed, or could not be computed.
    """
    return _computed(found, Part.TORNADO, found.tornado)


def tornado_frame(found: Sensitivity) -> pd.DataFrame:
    """One row for each uncertain input.

    Raises:
        TradeoffError: The sensitivity was not analysed, or could not be computed.
    """
    rows = [
        {
            "input": bar.id,
            "kind": bar.kind.value,
            "unit": bar.unit,
            "base": bar.base,
            "low": bar.low.value,
            "high": bar.high.value,
            "range_is": bar.basis.value,
            "lead_low": bar.low.lead,
            "lead_high": bar.high.lead,
            "swing": bar.swing,
            "wins_low": _names(bar.low.winners),
            "wins_high": _names(bar.high.winners),
            "flip_low": bar.low.flip,
            "flip_high": bar.high.flip,
        }
        for bar in computed_tornado(found).bars
    ]
    return described_frame("tornado", rows)


def exchange_rates_frame(found: Sensitivity) -> pd.DataFrame:
    """One row for each measure with a weight but the one in which all is paid.

    Raises:
        TradeoffError: They were not analysed, or could not be computed.
    """
    exchange = _computed(found, Part.EXCHANGE_RATES, found.exchange)
    rows = [
        {
            "measure": rate.measure,
            "unit": rate.unit,
            "quantity": rate.quantity,
            "step": rate.step,
            "gain": rate.gain,
            "reference": exchange.reference,
            "reference_unit": exchange.unit,
            "worth": rate.worth.amount,
            "is_bound": rate.worth.is_bound,
            "better_variant": None if rate.better is None else rate.better.variant,
            "better_quantity": None if rate.better is None else rate.better.quantity,
            "extra": None if rate.better is None else rate.better.extra,
            "misses": "" if rate.better is None else ", ".join(rate.better.misses),
            "is_tied": None if rate.better is None else rate.better.is_tied,
        }
        for rate in exchange.rates
    ]
    return described_frame("exchange_rates", rows)


def worth_keeping_frame(found: Sensitivity) -> pd.DataFrame:
    """One row for each feasible variant.

    Raises:
        TradeoffError: It was not analysed, or could not be computed.
    """
    rows = [
        {
            "variant": found.variants[one.row],
            "kept": one.is_kept,
            "reason": one.reason.value,
            "shortfall": one.shortfall,
            "behind": one.behind,
            "beaten_by": _names(found.variants[row] for row in one.beaten_by),
        }
        for one in _computed(found, Part.KEPT, found.kept)
    ]
    return described_frame("worth_keeping", rows)


def stakeholders_frame(found: Sensitivity) -> pd.DataFrame:
    """One row for each stakeholder and feasible variant; no row if the study names no stakeholder.

    Raises:
        TradeoffError: It was not analysed, or could not be computed.
    """
    _computed(found, Part.STAKEHOLDERS, found.kept)
    agreement = found.agreement
    rows = []
    for view in () if agreement is None else agreement.views:
        for row, variant in enumerate(found.variants):
            if agreement is not None and view.regrets[row] >= 0.0:
                rows.append(
                    {
                        "stakeholder": view.name,
                        "variant": variant,
                        "regret": float(view.regrets[row]),
                        "best": row in view.best,
                        "accepted": row in view.accepted,
                        "compromise": row in agreement.compromise,
                    }
                )
    return described_frame("stakeholders", rows)


def _computed(found: Sensitivity, part: Part, result: Result | None) -> Result:
    if found.refused:
        raise TradeoffError(f"{part.words}: not analysed: {found.refused}", hint="decide by weighted value")
    why = found.not_computed.get(part)
    if why is not None or result is None:
        reason, remedy = ("it is empty", "") if why is None else (why.reason, why.remedy)
        raise TradeoffError(f"{part.words}: not computed: {reason}", hint=remedy)
    return result


def _names(variants: Iterable[int]) -> str:
    return ", ".join(map(str, variants))
