"""Section on replication until decided: confidence, margin, and number of trials."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from rgss.documents import Dimensionless, Document, DocumentModel
from rgss.findings import Finding
from rgss.tradeoff.sequential import SequentialRule

MOST_TRIALS = 10_000
"""Largest number of trials of a variant in replication until decided."""

_DEFAULT = SequentialRule()
FEWEST_PILOT = 2
"""Replicates of a pilot without which nothing is known of their noise."""

_Count = Annotated[int, Field(ge=1, le=MOST_TRIALS)]


class UntilDecidedEntry(DocumentModel):
    """The rule of ``rgss sweep --until decided``."""

    error_rate: Dimensionless = _DEFAULT.error_rate
    margin: Dimensionless = _DEFAULT.margin
    slack: Dimensionless = _DEFAULT.slack
    pilot: Annotated[int, Field(ge=FEWEST_PILOT, le=MOST_TRIALS)] | None = None
    batch: _Count = _DEFAULT.batch
    cap: _Count = _DEFAULT.cap
    verdict_cap: Annotated[int, Field(ge=0, le=MOST_TRIALS)] = _DEFAULT.verdict_cap
    budget: Annotated[int, Field(ge=1)] | None = None
    finalists: Annotated[int, Field(ge=2)] | None = None
    reserve: Annotated[int, Field(ge=1)] | None = None
    good_selection: Dimensionless = _DEFAULT.good_selection


def read_until_decided(
    entry: UntilDecidedEntry | None, document: Document, findings: list[Finding], *, replicates: int
) -> SequentialRule:
    """The rule that a study's file states; the default one if it states none.

    A pilot that is left out has the study's replicates, and without a budget at least those of the default rule.

    Args:
        entry: The section of the file; None if there is none.
        document: The file.
        findings: Collects the problems.
        replicates: The study's replicates, which are read of every variant.

    Returns:
        The rule. It is the study's if nothing was found.
    """
    if entry is None:
        return _DEFAULT
    fewest = _DEFAULT.pilot if entry.budget is None else FEWEST_PILOT
    pilot = max(fewest, replicates) if entry.pilot is None else entry.pilot
    found = list(_problems(entry, pilot, replicates))
    for key, message, hint in found:
        # A key that is left out has no place in the file.
        place = ("until_decided", key) if key in entry.model_fields_set else ("until_decided",)
        findings.append(document.finding("study.until-decided", message, place, hint=hint))
    return _DEFAULT if found else SequentialRule(**{**entry.model_dump(), "pilot": pilot})


def _problems(entry: UntilDecidedEntry, pilot: int, replicates: int) -> list[tuple[str, str, str]]:
    """The key, the message and the hint of each thing that is wrong."""
    found = []
    if not 0.0 < entry.error_rate < 0.5:
        message = f"error rate must be between 0 and 0.5, got {entry.error_rate:g}"
        found.append(("error_rate", message, "give a share between 0 and 0.5, such as 5 %"))
    if not 0.0 <= entry.margin < 1.0:
        message = f"margin must be from 0 to below 1, got {entry.margin:g}"
        found.append(("margin", message, "a difference of value, such as 0.05"))
    if not 0.0 <= entry.slack < 1.0:
        found.append(
            ("slack", f"slack must be from 0 to below 1, got {entry.slack:g}", "a share of a threshold, such as 10 %")
        )
    for key, count in (("pilot", pilot), ("verdict_cap", entry.verdict_cap)):
        if count > entry.cap:
            message = f"{key} must be at most the cap of {entry.cap}, got {count}"
            found.append(
                (key if key in entry.model_fields_set else "cap", message, "raise the cap, or lower the other")
            )
    if entry.finalists is not None and entry.budget is None:
        found.append(("finalists", "finalists needs a budget", "give a budget too"))
    if entry.reserve is not None and entry.budget is None:
        found.append(("reserve", "reserve needs a budget", "give a budget too"))
    if not 0.0 < entry.good_selection < 1.0:
        message = f"good_selection must be between 0 and 1, got {entry.good_selection:g}"
        found.append(("good_selection", message, "give a probability such as 90 %"))
    if "good_selection" in entry.model_fields_set and entry.reserve is None:
        found.append(("good_selection", "good_selection needs a reserve", "it says when the reserve is left; give one"))
    if pilot < replicates:
        message = f"pilot must be at least the study's replicates, {replicates}, got {pilot}"
        found.append(("pilot", message, "raise it, or lower the replicates"))
    return found
