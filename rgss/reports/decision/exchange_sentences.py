"""Rows and sentences on exchange rates that the pages of a decision share."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.decision.sensitivity import BetterDesign, ExchangeRate, ExchangeRates, Worth
from rgss.reports.decision.words import UNKNOWN, amount

EXCHANGE_HEADS = ("measure", "is", "step", "is worth", "better design")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExchangeRow:
    """Exchange rate in words.

    Attributes:
        measure: The measure.
        quantity: The quantity of the chosen design.
        step: The change for the better.
        worth: What it is worth in the reference.
        variant: The design with a better quantity, at the least worsening of the reference; None if there is none.
        better: Its quantity, the price, and the requirements that it misses.
    """

    measure: str
    quantity: str
    step: str
    worth: str
    variant: int | None
    better: str

    @property
    def cells(self) -> tuple[str, ...]:
        """The cells under `EXCHANGE_HEADS`."""
        better = "none" if self.variant is None else f"{self.variant}: {self.better}"
        return self.measure, self.quantity, self.step, self.worth, better


def exchange_rows(found: ExchangeRates) -> tuple[ExchangeRow, ...]:
    """A row for each measure but the reference."""
    return tuple(_row(found, rate) for rate in found.rates)


def exchange_title(found: ExchangeRates) -> str:
    """Title of the table, with the measure in which all is paid."""
    more = "less" if found.more_is_better else "more"
    return f"What a step for the better is worth to variant {found.variant}, paid in {more} {found.reference}"


def exchange_sentences(found: ExchangeRates) -> tuple[str, ...]:
    """Sentences on the lead and on the meaning of the rates."""
    end = "highest" if found.more_is_better else "lowest"
    others = (
        "; one that misses requirements is named where no feasible one is better"
        if any(rate.better is not None and rate.better.misses for rate in found.rates)
        else ""
    )
    tied = (
        " Tied: the evidence does not separate its value from that of the choice."
        if any(rate.better is not None and rate.better.is_tied for rate in found.rates)
        else ""
    )
    better = (
        f"Better design: of the feasible ones that are better in the measure, by the estimates, the one with the {end} "
        f"{found.reference}{others}.{tied}"
    )
    by = "The weights and value functions say so: who would pay less, or more, for a step has other weights."
    return tuple(filter(None, (lead_sentence(found), by, better)))


def lead_sentence(found: ExchangeRates) -> str:
    """Sentence on the worth of the lead; empty without a rival."""
    return "" if found.lead is None else f"Its lead over variant {found.rival} is worth {_worth(found, found.lead)}."


def exchange_clause(found: ExchangeRates, *, code: str = "") -> str:
    """Rates in one sentence without its full stop; empty if no step is worth anything.

    Args:
        found: The rates.
        code: Mark on both sides of the name of a measure.
    """
    parts = [
        f"{step} of {code}{rate.measure}{code} {_worth(found, rate.worth)}"
        for rate, step in ((rate, _step(rate)) for rate in found.rates)
        if rate.gain > 0.0
    ]
    return ", ".join(parts)


def worth_sentences(found: ExchangeRates, *, code: str = "") -> str:
    """Sentences on what the steps and the lead are worth; empty if nothing is.

    Args:
        found: The rates.
        code: As for `exchange_clause`.
    """
    clause = exchange_clause(found, code=code)
    worth = f"By the weights and value functions these are worth: {clause}." if clause else ""
    return " ".join(filter(None, (worth, lead_sentence(found))))


def _row(found: ExchangeRates, rate: ExchangeRate) -> ExchangeRow:
    better = rate.better
    return ExchangeRow(
        measure=rate.measure,
        quantity=amount(rate.quantity, rate.unit),
        step=_step(rate) if rate.step else "at its best",
        worth=_worth(found, rate.worth) if rate.step else UNKNOWN,
        variant=None if better is None else better.variant,
        better="none" if better is None else _better(found, rate, better),
    )


def _better(found: ExchangeRates, rate: ExchangeRate, better: BetterDesign) -> str:
    missed = f", misses {', '.join(better.misses)}" if better.misses else ""
    tied = ", tied" if better.is_tied else ""
    return f"{amount(better.quantity, rate.unit)} for {_signed(better.extra, found.unit)}{missed}{tied}"


def _step(rate: ExchangeRate) -> str:
    return _signed(rate.step, rate.unit)


def _signed(value: float, unit: str) -> str:
    return f"{'-' if value < 0.0 else '+'}{amount(abs(value), unit)}"


def _worth(found: ExchangeRates, worth: Worth) -> str:
    return f"{'> ' if worth.is_bound else ''}{amount(worth.amount, found.unit)}"
