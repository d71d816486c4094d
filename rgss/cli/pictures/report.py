"""Films of a report: its notable trials, run again."""

from __future__ import annotations

import itertools
import shlex
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.pictures.progress import film_parts_progress

if TYPE_CHECKING:
    from rgss.evidence.records import TrialTrace
    from rgss.reports import TrialPictures
    from rgss.reports.study import NotableTrial
    from rgss.studies import Project
    from rgss.trials.pieces import TrialSpec

MOST_LARGE_FILMS = 4
"""With more trials, films are smaller by default, so that a dozen of them stay within a few megabytes."""


_SIMULATED = 0.3
"""Part of the time of a trial's pictures after which it has been simulated; the frames take the rest."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmLook:
    """Appearance of films.

    Attributes:
        width: Width in pixels.
        height: Height in pixels.
        rate_hz: Frames a second.
    """

    width: int
    height: int
    rate_hz: float


LARGE = FilmLook(width=480, height=360, rate_hz=8.0)
SMALL = FilmLook(width=400, height=300, rate_hz=5.0)


def ordered_look(size: str | None, rate_hz: float | None, *, films: int) -> FilmLook:
    """Appearance of films by the options, with defaults that depend on the number of films.

    Args:
        size: Width and height, such as ``640x480``; None if not given.
        rate_hz: Frames a second; None if not given.
        films: How many films there are.

    Raises:
        DefinitionError: A size or a rate is out of range.
    """
    from rgss.cli.pictures.options import film_rate, picture_size

    fitting = LARGE if films <= MOST_LARGE_FILMS else SMALL
    width, height = (fitting.width, fitting.height) if size is None else picture_size(size, "--film-size")
    return FilmLook(
        width=width,
        height=height,
        rate_hz=fitting.rate_hz if rate_hz is None else film_rate(rate_hz, "--film-rate"),
    )


def trial_pictures(
    project: Project, notable: Sequence[NotableTrial], *, look: FilmLook | None
) -> tuple[tuple[TrialPictures, ...], str]:
    """Film trials, or state why there are no films.

    Args:
        project: The project with its study.
        notable: The trials.
        look: How films look; None if no pictures are wanted.

    Returns:
        The pictures, and a note on them; empty if there is none.

    Raises:
        DefinitionError: A package for pictures is missing.
        SimulationError: The physics engine cannot build or draw the world.
    """
    from rgss.engines import INSTALL, missing_engines
    from rgss.evidence import Fidelity
    from rgss.studies import trial_specs

    if not notable:
        return (), "There are no trials to film."
    if look is None:
        return (), "The report was made without films; each trial can be filmed by “rgss run ID --seed N --film FILE”."
    if missing_engines(pictures=True):
        return (), f"The report was made without films, which need the simulation engines ({INSTALL})."
    if project.study.fidelity is not Fidelity.CONTACT:
        return (), f"Films need trials at contact fidelity; those of this study are {project.study.fidelity.value}."
    made = []
    with film_parts_progress(len(notable), "Trials filmed") as reach:
        for number, one in enumerate(notable):
            variant = project.designs.variant(one.record.variant)
            (spec,) = trial_specs(project, variants=[variant], seeds=[one.record.seed])
            made.append(_pictures(project, one, spec, look, on_part=partial(_reach, reach, number)))
            reach(number + 1)
    return tuple(made), ""


def _reach(reach: Callable[[float], None], before: int, part: float) -> None:
    reach(before + part)


def _pictures(
    project: Project, one: NotableTrial, spec: TrialSpec, look: FilmLook, *, on_part: Callable[[float], None]
) -> TrialPictures:
    from rgss.cli.pictures.replays import packed_trial
    from rgss.evidence import record_digest
    from rgss.reports import TrialPictures
    from rgss.studies import DEFAULT_STUDY
    from rgss.sweep import compute
    from rgss.trace.evidence import KEY_DIGITS
    from rgss.trials.replay import run_replayed_trial

    seen = compute(run_replayed_trial, spec)
    on_part(_SIMULATED)
    same = record_digest(seen.record) == record_digest(one.record)
    strip, film, still = (b"", b"", b"") if seen.trace is None else _drawn(spec, one, seen.trace, look, on_part)
    label = project.study.label
    named = "" if label == DEFAULT_STUDY else f" --study {shlex.quote(label)}"
    detail = one.record.failure_detail
    end = "It succeeded." if one.record.success else f"{detail[:1].upper()}{detail[1:]}."
    return TrialPictures(
        title=f"Variant {one.record.variant}, seed {one.record.seed}: {one.why}",
        note=end if same else f"{end} Run again, it did not give the same bits.",
        replay=f"rgss replay {one.key[:KEY_DIGITS]}{named}",
        variant=one.record.variant,
        still=still,
        filmstrip=strip,
        film=film,
        player=packed_trial(seen, spec),
        failed=not one.record.success,
        worst=one.worst,
    )


def _drawn(
    spec: TrialSpec, one: NotableTrial, trace: TrialTrace, look: FilmLook, on_part: Callable[[float], None]
) -> tuple[bytes, bytes, bytes]:
    from rgss.cli.pictures.options import captioned
    from rgss.physics import VIEWS
    from rgss.reports.trials import still_png, write_filmstrip, write_video
    from rgss.trials import Film

    with (
        tempfile.TemporaryDirectory() as folder,
        Film(
            spec,
            trace,
            VIEWS["overview"],
            inset=VIEWS["hand"],
            width=look.width,
            height=look.height,
            rate_hz=look.rate_hz,
        ) as film,
    ):
        strip, video = Path(folder) / "strip.png", Path(folder) / "film.webm"
        ends = {frame.span.phase: frame.picture for frame in film.ends_of_phases()}
        write_filmstrip(strip, one.record, ends)
        frames = itertools.count(1)
        write_video(
            video,
            lambda index: captioned(film, index, one.record),
            count=len(film),
            rate_hz=look.rate_hz,
            on_frame=lambda: on_part(_SIMULATED + (1.0 - _SIMULATED) * next(frames) / len(film)),
        )
        # The still shows the object being carried, if the trial reached such a phase.
        shown = next((ends[phase] for phase in spec.task.carried if phase in ends), next(iter(ends.values())))
        return strip.read_bytes(), video.read_bytes(), still_png(shown)
