"""Output of a sweep and of a dry run, as text and as JSON."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rgss.sweep import Cause, DryRun, DueTrials, LostTrials, SweepResult

_ORDER = ("plan", "timing", "execution", "bench", "trial")
_CAUSES_SHOWN = 4
_TRIALS_SHOWN = 6


def result_lines(
    trials: int, tally: Mapping[str, int], failures: Mapping[str, int], result: SweepResult, label: str
) -> list[str]:
    """Result of a sweep as lines of text.

    Args:
        trials: How many trials the study has.
        tally: How many were ``run`` and ``kept``, ``succeeded`` and ``failed``.
        failures: How many trials failed in which way.
        result: The pieces and the failures of the run.
        label: The evidence file's name.
    """
    lost = len({trial for lost in result.lost for trial in lost.trials})
    lines = [
        f"{_counted_trials(trials)}: {tally['run']} run, {tally['kept']} from evidence; "
        f"{tally['succeeded']} succeeded, {tally['failed']} failed" + (f"; {lost} could not be run." if lost else ".")
    ]
    lines += [
        f"  {count} × {reason}" for reason, count in sorted(failures.items(), key=lambda item: (-item[1], item[0]))
    ]
    if "trial" in result.made:
        lines.append(f"Pieces: none shared; {_counted(result.made)} run by {_themselves(result.made['trial'])}.")
    elif result.made or result.reused:
        lines.append(f"Pieces: {_counted(result.made)} made{_reused(result.reused)}.")
    return [*lines, f"Evidence: {label}"]


def result_as_json(
    trials: int, tally: Mapping[str, int], failures: Mapping[str, int], result: SweepResult, label: str
) -> dict[str, Any]:
    """Result of a sweep as JSON; the arguments are those of `result_lines`."""
    return {
        "trials": trials,
        "run": tally["run"],
        "from_evidence": tally["kept"],
        "succeeded": tally["succeeded"],
        "failed": tally["failed"],
        "failures": dict(sorted(failures.items())),
        "pieces_made": dict(sorted(result.made.items())),
        "pieces_from_evidence": dict(sorted(result.reused.items())),
        "run_failures": [
            {
                "what": lost.failure.what,
                "digest": lost.failure.key,
                "kind": lost.failure.kind.value,
                "detail": lost.failure.detail,
                "attempts": lost.failure.attempts,
                "trials": _as_pairs(lost.trials),
            }
            for lost in result.lost
        ],
        "elapsed_s": round(result.elapsed_s, 3),
        "busy_s": round(result.busy_s, 3),
        "evidence": label,
    }


def lost_line(lost: LostTrials) -> str:
    """A failure of the run in one line.

    Args:
        lost: What failed, and the trials that have no record for it.
    """
    failure = lost.failure
    tried = f"tried {'once' if failure.attempts == 1 else f'{failure.attempts} times'}"
    return (
        f"the {failure.what} of {shown_trials(lost.trials)} {_FAILED[failure.kind.value]}: {failure.detail} ({tried})"
    )


_FAILED = {
    "crashed": "crashed",
    "timed_out": "took too long",
    "out_of_memory": "ran out of memory",
    "raised": "failed",
    "wrong_answer": "was answered wrongly",
}


def dry_run_lines(found: DryRun, label: str) -> list[str]:
    """Result of a dry run as lines of text.

    Args:
        found: The trials and pieces that a sweep would make.
        label: The evidence file's name.
    """
    lines = [f"{_counted_trials(found.trials)}: {found.run} to run, {found.kept} from evidence."]
    if found.pieces:
        made = _counted({kind.value: count.make for kind, count in found.pieces.items() if count.make})
        stored = _reused({kind.value: count.stored for kind, count in found.pieces.items() if count.stored})
        lines.append(f"Pieces: {made} to make{stored}.")
    lines += [line for due in found.due for line in _due_lines(due)]
    return [*lines, f"Evidence: {label}"]


def dry_run_as_json(found: DryRun, label: str) -> dict[str, Any]:
    """Result of a dry run as JSON; the arguments are those of `dry_run_lines`."""
    return {
        "trials": found.trials,
        "run": found.run,
        "from_evidence": found.kept,
        "pieces": {
            kind.value: {"make": count.make, "from_evidence": count.stored, "uses": count.uses}
            for kind, count in found.pieces.items()
        },
        "due": [
            {
                "causes": [
                    {"reason": cause.reason.value, "name": cause.name, "then": cause.then, "now": cause.now}
                    for cause in due.causes
                ],
                "pieces": [kind.value for kind in due.pieces],
                "trials": _as_pairs(due.trials),
            }
            for due in found.due
        ],
        "evidence": label,
    }


def shown_trials(trials: Sequence[tuple[int, int]]) -> str:
    """Trials by variants and seeds, such as ``variants 1-12, seeds 1-3``."""
    variants, seeds = sorted({variant for variant, _ in trials}), sorted({seed for _, seed in trials})
    if len(variants) * len(seeds) != len(set(trials)):
        first = ", ".join(f"{variant}/{seed}" for variant, seed in sorted(trials)[:_TRIALS_SHOWN])
        more = len(trials) - _TRIALS_SHOWN
        return f"variant/seed {first}" + (f" and {more} more" if more > 0 else "")
    return (
        f"variant{'s' if len(variants) > 1 else ''} {_ranges(variants)}, "
        f"seed{'s' if len(seeds) > 1 else ''} {_ranges(seeds)}"
    )


def _due_lines(due: DueTrials) -> list[str]:
    pieces = ", ".join(f"{kind.value}{_ending(kind.value, 2)}" for kind in due.pieces)
    lines = [
        f"  {_counted_trials(len(due.trials))} ({shown_trials(due.trials)}): "
        + (f"{pieces} to make" if pieces else "only records to put together")
    ]
    lines += [f"    {_cause_line(cause)}" for cause in due.causes[:_CAUSES_SHOWN]]
    more = len(due.causes) - _CAUSES_SHOWN
    return [*lines, *([f"    and {more} more (--json shows them)"] if more > 0 else [])]


def _cause_line(cause: Cause) -> str:
    from rgss.sweep import Reason

    if cause.reason in (Reason.INPUT, Reason.ENGINE):
        return f"{cause.reason.value}: {cause.name} {cause.then} → {cause.now}"
    if cause.reason is Reason.FAILED:
        return f"{cause.reason.value}: {cause.name}, {cause.then}"
    return f"{cause.reason.value}: {cause.name}" if cause.name else cause.reason.value


def _counted_trials(count: int) -> str:
    return f"{count} trial{_ending('trial', count)}"


def _counted(counts: Mapping[str, int]) -> str:
    named = sorted(counts.items(), key=lambda item: _ORDER.index(item[0]))
    return ", ".join(f"{count} {name}{_ending(name, count)}" for name, count in named) or "none"


def _ending(name: str, count: int) -> str:
    return "" if count == 1 else "es" if name == "bench" else "s"


def _themselves(count: int) -> str:
    return "itself" if count == 1 else "themselves"


def _reused(counts: Mapping[str, int]) -> str:
    return f", {_counted(counts)} from evidence" if counts else ""


def _ranges(numbers: Iterable[int]) -> str:
    """Sorted numbers such as ``1-3, 7``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(str(run[0]) if len(run) == 1 else f"{run[0]}-{run[-1]}" for run in runs)


def _as_pairs(trials: Iterable[tuple[int, int]]) -> list[dict[str, int]]:
    return [{"variant": variant, "seed": seed} for variant, seed in trials]
