"""Trade-offs that replication until decided supports."""

from __future__ import annotations

from collections.abc import Sequence


def unsupported_reason(
    program: str, demands_on_replicates: Sequence[str], interval_ends: Sequence[tuple[str, str]]
) -> tuple[str, str] | None:
    """Reason why a trade-off has no sequential rule, with a remedy; None if it has one.

    Args:
        program: Name of its program.
        demands_on_replicates: Ids of its chance constraints and bounds on tails.
        interval_ends: The requirements that it judges by an end of an interval, each with its measure.
    """
    if program != "additive":
        return (
            f"replication until decided does not support the {program} program",
            "decide by the weighted value, or run a fixed number of replicates",
        )
    if demands_on_replicates:
        return (
            f"replication until decided does not support demands on replicates, such as {demands_on_replicates[0]}",
            "take the risks out, or run a fixed number of replicates",
        )
    if interval_ends:
        requirement, measure = interval_ends[0]
        return (
            f"replication until decided cannot judge {requirement} by an end of {measure}'s interval",
            "judge it by the value, or run a fixed number of replicates",
        )
    return None
