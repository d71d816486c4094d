"""Picture options of ``rgss run``: film, filmstrip, plots."""

from __future__ import annotations

import argparse
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.output import shown_path
from rgss.cli.pictures.progress import film_progress
from rgss.cli.pictures.replays import add_replay, check_replay, write_replay
from rgss.documents import is_disk_failure
from rgss.engines import require_engines
from rgss.errors import DefinitionError, StorageError
from rgss.reports.replay import REPLAY_SUFFIXES, require_viewer_package

if TYPE_CHECKING:
    from rgss.evidence import TrialRecord
    from rgss.evidence.records import TrialTrace
    from rgss.physics import View
    from rgss.reports.trials import CaptionedPicture
    from rgss.trials import Film
    from rgss.trials.pieces import TrialSpec
    from rgss.trials.replay import ReplayedTrial

SUFFIXES = {
    "film": (".webm", ".mp4"),
    "gif": (".gif",),
    "filmstrip": (".png",),
    "plots": (".png",),
    "replay": REPLAY_SUFFIXES,
}
_DRAWN = ("film", "gif", "filmstrip")
_PLAYED = ("film", "gif")
_CAMERA, _SIZE, _RATE_HZ = "overview+hand", "640x480", 12.0
_SMALLEST, _LARGEST = 200, 2000
_NEAREST_M, _FARTHEST_M = 0.3, 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOrder:
    """Requested pictures.

    Attributes:
        files: The file of each kind: ``film``, ``gif``, ``filmstrip``, ``plots``, ``replay``.
        view: Camera of the pictures.
        inset: Camera of the inset picture; None without one.
        width: Width of each picture in pixels.
        height: Height of each picture in pixels.
        rate_hz: Frames a second of the film.
    """

    files: dict[str, Path]
    view: View
    inset: View | None
    width: int
    height: int
    rate_hz: float


def add_pictures(parser: argparse.ArgumentParser) -> None:
    """Add the options for pictures."""
    group = parser.add_argument_group("pictures", "of a trial at contact fidelity; they do not change its result")
    group.add_argument("--film", type=Path, metavar="FILE", help="write a film with pause and seek, .webm or .mp4")
    group.add_argument("--gif", type=Path, metavar="FILE", help="write a film as a GIF, for a README")
    group.add_argument("--filmstrip", type=Path, metavar="FILE", help="write a PNG with the last frame of each phase")
    group.add_argument("--plots", type=Path, metavar="FILE", help="write a PNG of joints, speed and forces over time")
    add_replay(group)
    group.add_argument(
        "--camera",
        metavar="VIEW",
        help="overview, hand, side, or azimuth,elevation,distance in degrees and metres; "
        f"a second one after a plus is inset (default: {_CAMERA})",
    )
    group.add_argument("--size", metavar="SIZE", help=f"width and height in pixels (default: {_SIZE})")
    group.add_argument("--fps", type=float, metavar="N", help=f"frames a second of the film (default: {_RATE_HZ:g})")


def ordered_pictures(options: argparse.Namespace) -> PictureOrder | None:
    """Requested pictures, each file checked to be writable; None if there are none.

    Raises:
        DefinitionError: An option is wrong, a file cannot be written, or a package is missing.
    """
    files = {kind: path for kind in SUFFIXES if (path := getattr(options, kind)) is not None}
    for option in ("camera", "size", "fps"):
        needed = _PLAYED if option == "fps" else _DRAWN
        if getattr(options, option) is not None and not any(kind in files for kind in needed):
            named = " or ".join(f"--{kind}" for kind in needed)
            raise DefinitionError(f"--{option} needs a picture", hint=f"add {named}")
    check_replay(options)
    if not files:
        return None
    require_engines("a picture of a trial", pictures=True)
    _check_files(files)
    if "replay" in files:
        require_viewer_package(files["replay"])
    width, height = picture_size(options.size or _SIZE)
    main, plus, inset = (options.camera or _CAMERA).partition("+")
    return PictureOrder(
        files=files,
        view=_view(main),
        inset=_view(inset) if plus else None,
        width=width,
        height=height,
        rate_hz=film_rate(_RATE_HZ if options.fps is None else options.fps),
    )


def seen_trial(order: PictureOrder, spec: TrialSpec) -> ReplayedTrial:
    """Run a trial with the trace that the requested pictures need; there is no trace if nothing moved.

    The scene is added only for a replay.

    Raises:
        DefinitionError: The trial's fidelity is not contact.
        SimulationError: The physics engine cannot build the world.
    """
    from rgss.evidence import Fidelity
    from rgss.sweep import compute
    from rgss.trials import run_traced_trial
    from rgss.trials.replay import ReplayedTrial, run_replayed_trial

    if spec.fidelity is not Fidelity.CONTACT:
        raise DefinitionError(
            f"pictures need contact fidelity, got {spec.fidelity.value}", hint="add --fidelity contact"
        )
    if "replay" in order.files:
        return compute(run_replayed_trial, spec)
    record, trace = compute(run_traced_trial, spec)
    return ReplayedTrial(record=record, trace=trace, scene=None)


def made_pictures(
    order: PictureOrder, spec: TrialSpec, seen: ReplayedTrial, *, beside: TrialSpec | None = None
) -> tuple[str, ...]:
    """Draw the requested pictures and write the files.

    Args:
        order: The requested pictures.
        spec: The inputs of the trial.
        seen: The trial.
        beside: The inputs of a trial that is replayed beside it; None without one.

    Returns:
        A line of text for each file.

    Raises:
        DefinitionError: A file cannot be written.
        StorageError: The disk is full or fails.
        SimulationError: The engine cannot draw the scene.
    """
    if seen.trace is None:
        return ("No pictures: the trial ended before anything moved.",)
    try:
        _make(order, spec, seen.record, seen.trace)
        if "replay" in order.files:
            write_replay(order.files["replay"], seen, spec, beside)
    except OSError as error:
        reason = error.strerror or str(error)
        what = "the replay" if set(order.files) == {"replay"} else "the pictures"
        if is_disk_failure(error):
            raise StorageError(f"cannot write {what}: {reason}", hint="free some space, or check the disk") from error
        raise DefinitionError(f"cannot write {what}: {reason}", hint="choose another place") from error
    return tuple(f"{kind}: {shown_path(path)}" for kind, path in order.files.items())


def _make(order: PictureOrder, spec: TrialSpec, record: TrialRecord, trace: TrialTrace) -> None:
    from rgss.reports.trials import write_film, write_filmstrip, write_trial_plots, write_video
    from rgss.trials import Film

    files = order.files
    if "plots" in files:
        joints = [joint.name for joint in spec.scene.robot.joints]
        write_trial_plots(files["plots"], record, trace, joints=joints)
    if not set(_DRAWN) & set(files):
        return
    with Film(
        spec,
        trace,
        order.view,
        inset=order.inset,
        width=order.width,
        height=order.height,
        rate_hz=order.rate_hz,
    ) as film:
        if "filmstrip" in files:
            ends = {frame.span.phase: frame.picture for frame in film.ends_of_phases()}
            write_filmstrip(files["filmstrip"], record, ends)
        played = [(kind, files[kind]) for kind in _PLAYED if kind in files]
        if not played:
            return
        with film_progress(len(played) * len(film)) as advance:
            for kind, path in played:
                write = write_video if kind == "film" else write_film
                write(
                    path,
                    lambda index: captioned(film, index, record),
                    count=len(film),
                    rate_hz=order.rate_hz,
                    on_frame=advance,
                )


def captioned(film: Film, index: int, record: TrialRecord) -> CaptionedPicture:
    """Frame of a film with its time and phase as caption, the last one with the outcome of the trial."""
    from rgss.reports.trials import CaptionedPicture, words

    phases = [one.phase for one in record.phases]

    def titled(phase: str) -> str:
        return f"{phases.index(phase) + 1} {words(phase)}"

    frame = film.frame(index)
    phase = frame.span.phase
    caption = f"{frame.time_s:.2f} s   {titled(phase)}"
    if index == len(film) - 1:
        # A state that nothing moved in has no frame of its own.
        if record.failed_phase not in (None, phase):
            caption += f"; {titled(record.failed_phase)}"
        caption += f": {'done' if record.failure is None else words(record.failure.value)}"
    return CaptionedPicture(picture=frame.picture, caption=caption)


def _check_files(files: dict[str, Path]) -> None:
    from rgss.documents import why_not_writable

    kind_of: dict[Path, str] = {}
    for kind, path in files.items():
        suffixes = SUFFIXES[kind]
        if path.suffix.lower() not in suffixes:
            named = " or ".join(suffixes)
            raise DefinitionError(f"--{kind}: {path} must be a {named} file", hint=f"give a name that ends in {named}")
        reason = why_not_writable(path)
        if reason:
            raise DefinitionError(f"--{kind}: cannot write {path}: {reason}", hint="choose another place")
        other = kind_of.setdefault(path.resolve(), kind)
        if other != kind:
            raise DefinitionError(f"--{other} and --{kind} name the same file", hint="give each its own")


def _view(text: str) -> View:
    from rgss.physics import VIEWS, View

    if text in VIEWS:
        return VIEWS[text]
    try:
        azimuth, elevation, distance = (float(part) for part in text.split(","))
    except ValueError:
        raise DefinitionError(
            f"--camera: unknown view {text!r}",
            hint=f"choose {', '.join(VIEWS)}, or azimuth,elevation,distance such as 215,30,2.5",
        ) from None
    if not (math.isfinite(azimuth) and -90 <= elevation <= 90 and _NEAREST_M <= distance <= _FARTHEST_M):
        raise DefinitionError(
            f"--camera: {text} is out of range",
            hint=f"elevation from -90 to 90 degrees, distance from {_NEAREST_M:g} to {_FARTHEST_M:g} m",
        )
    return View(azimuth_rad=math.radians(azimuth), elevation_rad=math.radians(elevation), distance_m=distance)


def picture_size(text: str, option: str = "--size") -> tuple[int, int]:
    """Width and height of a text such as ``640x480``.

    Raises:
        DefinitionError: It is not a size, or one out of range.
    """
    match = re.fullmatch(r"(\d{1,5})x(\d{1,5})", text, re.ASCII)
    if match is None:
        raise DefinitionError(
            f"{option} must be WIDTHxHEIGHT in pixels, got {text!r}", hint=f"write width and height, such as {_SIZE}"
        )
    width, height = int(match[1]), int(match[2])
    if not (_SMALLEST <= width <= _LARGEST and _SMALLEST <= height <= _LARGEST):
        raise DefinitionError(
            f"{option}: {text} is out of range", hint=f"give from {_SMALLEST} to {_LARGEST} pixels each way"
        )
    return width, height


def film_rate(rate_hz: float, option: str = "--fps") -> float:
    """Frame rate of a film in Hz, validated.

    Raises:
        DefinitionError: It is out of range.
    """
    from rgss.reports.trials import HIGHEST_RATE_HZ

    if not 1.0 <= rate_hz <= HIGHEST_RATE_HZ:
        raise DefinitionError(f"{option}: {rate_hz:g} is out of range", hint=f"give from 1 to {HIGHEST_RATE_HZ:g}")
    return rate_hz
