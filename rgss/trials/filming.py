"""Film of a trial, rendered from its trace after the trial."""

from __future__ import annotations

import math
from collections.abc import Iterable
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from types import TracebackType

from rgss.evidence.records import PhaseSpan, TrialTrace
from rgss.physics import Camera, Picture, Posture, View
from rgss.scenes import Pose
from rgss.trials.conditions import conditions_of
from rgss.trials.marked_places import marked_places
from rgss.trials.pieces import TrialSpec
from rgss.trials.workcell import cell_of, with_grasp_of

_INSET_SHARE = 0.35
_INSET_MARGIN_SHARE = 0.02
_FRAME_COLOUR = 255
_INSTANTS = 16


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Frame:
    """One frame of a film.

    Attributes:
        picture: Colours, shape (height, width, 3).
        time_s: Time in the trial.
        span: The phase at that time.
    """

    picture: Picture
    time_s: float
    span: PhaseSpan


class Film:
    """Frames of a trial, rendered on request; a context manager that closes its cameras."""

    def __init__(
        self,
        spec: TrialSpec,
        trace: TrialTrace,
        view: View,
        *,
        inset: View | None = None,
        width: int,
        height: int,
        rate_hz: float,
    ) -> None:
        """Set up the cameras.

        Args:
            spec: The trial.
            trace: Its trace.
            view: View of the camera.
            inset: View of a second camera, whose picture is inset in the lower right of the first.
            width: Width of the pictures in pixels.
            height: Height of the pictures in pixels.
            rate_hz: Frames a second.

        Raises:
            SimulationError: The engine cannot build the rendered scene.
        """
        self._trace = trace
        self._rate_hz = rate_hz
        self._inset: Camera | None = None
        scene = conditions_of(spec).true_scene
        self._first = scene.workpiece.id
        if scene.task.candidates is not None:
            scene = with_grasp_of(scene, cell_of(spec))
        with ExitStack() as cameras:  # closes the first camera if the second fails
            open_camera = partial(Camera, scene, spec.gripper, places=marked_places(scene, spec.task).values())
            self._camera = cameras.enter_context(open_camera(view, width=width, height=height))
            last = len(trace.time_s) - 1
            self._camera.fit(self._posture(round(last * place / _INSTANTS)) for place in range(_INSTANTS + 1))
            if inset is not None:
                across, down = round(_INSET_SHARE * width), round(_INSET_SHARE * height)
                self._inset = cameras.enter_context(open_camera(inset, width=across, height=down))
            self._cameras = cameras.pop_all()

    def __enter__(self) -> Film:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the cameras; closing twice is allowed."""
        self._cameras.close()

    def __len__(self) -> int:
        """Number of frames: one at the beginning of each interval, and one at the end."""
        return math.ceil(self._trace.duration_s * self._rate_hz - 1e-9) + 1

    def frame(self, index: int) -> Frame:
        """Frame by index; the last one shows the end."""
        last = index >= len(self) - 1
        return self._frame(len(self._trace.time_s) - 1 if last else self._trace.sample_at(index / self._rate_hz))

    def ends_of_phases(self) -> tuple[Frame, ...]:
        """Frame at the end of each phase that ran."""
        return tuple(self._frame(span.last) for span in self._trace.spans)

    def _posture(self, sample: int) -> Posture:
        trace = self._trace
        present = _pose([*trace.workpiece_position_m[sample], *trace.workpiece_quaternion_xyzw[sample]])
        objects = {name: _pose(rows[sample]) for name, rows in trace.objects.items()}
        return Posture(
            joints_rad=trace.joint_positions_rad[sample].tolist(),
            finger_travel_m=trace.finger_travel_m[sample].tolist(),
            workpiece=objects.pop(self._first, present),
            others=objects,
        )

    def _frame(self, sample: int) -> Frame:
        trace, posture = self._trace, self._posture(sample)
        picture = self._camera.picture(posture)
        if self._inset is not None:
            _set_into(picture, self._inset.picture(posture))
        return Frame(picture=picture, time_s=float(trace.time_s[sample]), span=trace.span_at(sample))


def _pose(values: Iterable[float]) -> Pose:
    x, y, z, qx, qy, qz, qw = (float(value) for value in values)
    return Pose(position_m=(x, y, z), quaternion_xyzw=(qx, qy, qz, qw))


def _set_into(picture: Picture, inset: Picture) -> None:
    """Inset a picture with a white border in the lower right of another."""
    height, width, _ = picture.shape
    margin = round(_INSET_MARGIN_SHARE * height)
    bottom, right = height - margin, width - margin
    top, left = bottom - inset.shape[0], right - inset.shape[1]
    line = max(1, width // 300)
    picture[top - line : bottom + line, left - line : right + line] = _FRAME_COLOUR
    picture[top:bottom, left:right] = inset
