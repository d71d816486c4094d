"""Pictures for a report: the few trials that are worth looking at, run once more and filmed."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.evidence.trial_trace import TrialTrace
    from rgss.reports.report_page import TrialPictures
    from rgss.studies.project import Project
    from rgss.studies.report_trials import NotableTrial
    from rgss.trials.spec import TrialSpec

WIDTH, HEIGHT = 400, 300
RATE_HZ = 5.0
"""Small and slow enough that a dozen films stay within a few megabytes."""


def trial_pictures(
    project: Project, notable: Sequence[NotableTrial], *, wanted: bool
) -> tuple[tuple[TrialPictures, ...], str]:
    """Film trials, or say why not.

    Args:
        project: The project with its study.
        notable: The trials.
        wanted: Whether pictures are wanted at all.

    Returns:
        The pictures, and what there is to say of them; empty if nothing.

    Raises:
        DefinitionError: A package for pictures is missing.
        SimulationError: The physics engine cannot build or draw the world.
    """
    from rgss.evidence import Fidelity
    from rgss.studies.expansion import trial_specs

    if not notable:
        return (), "There are no trials to look at."
    if not wanted:
        return (), "The report was made without films; each trial can be filmed by “rgss run ID --seed N --gif FILE”."
    if project.study.fidelity is not Fidelity.CONTACT:
        return (), f"Trials of {project.study.fidelity.value} fidelity have nothing to film; those with contact have."
    made = []
    for place, one in enumerate(notable, start=1):
        if sys.stderr.isatty():
            print(f"\rFilming trial {place} of {len(notable)}", end="", file=sys.stderr)
        variant = project.designs.variant(one.record.variant)
        (spec,) = trial_specs(project, variants=[variant], seeds=[one.record.seed])
        made.append(_pictures(one, spec))
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return tuple(made), ""


def _pictures(one: NotableTrial, spec: TrialSpec) -> TrialPictures:
    from rgss.evidence import record_digest
    from rgss.reports.report_page import TrialPictures
    from rgss.trace.verdict_evidence import KEY_DIGITS
    from rgss.trials.tracing import run_traced_trial

    record, trace = run_traced_trial(spec)
    same = record_digest(record) == record_digest(one.record)
    strip, film = (b"", b"") if trace is None else _drawn(spec, one, trace)
    end = "It succeeded." if one.record.success else f"{one.record.failure_detail}."
    return TrialPictures(
        title=f"Variant {one.record.variant}, seed {one.record.seed}: {one.why}",
        note=end if same else f"{end} Run again, it did not give the same bits.",
        replay=f"rgss replay {one.key[:KEY_DIGITS]}",
        filmstrip=strip,
        film=film,
    )


def _drawn(spec: TrialSpec, one: NotableTrial, trace: TrialTrace) -> tuple[bytes, bytes]:
    from rgss.cli.picture_options import captioned
    from rgss.physics.camera import VIEWS
    from rgss.reports.film import write_film
    from rgss.reports.filmstrip import write_filmstrip
    from rgss.trials.filming import Film

    with (
        tempfile.TemporaryDirectory() as folder,
        Film(spec, trace, VIEWS["overview"], inset=VIEWS["hand"], width=WIDTH, height=HEIGHT, rate_hz=RATE_HZ) as film,
    ):
        strip, gif = Path(folder) / "strip.png", Path(folder) / "film.gif"
        write_filmstrip(strip, one.record, {frame.span.phase: frame.picture for frame in film.ends_of_phases()})
        write_film(gif, lambda index: captioned(film, index), count=len(film), rate_hz=RATE_HZ)
        return strip.read_bytes(), gif.read_bytes()
