"""Plots of a recording: commanded, measured and fitted speed of each joint, one panel for each pose and signal."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rgss.documents import replaced_file
from rgss.identification import Recording, servo_motion
from rgss.scenes import JointServo

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_COMMANDED, _MEASURED, _FITTED = "#21252b", "#0072b2", "#d55e00"
_ACROSS = 3
_PANEL_IN = (4.2, 2.5)
_DOTS_PER_INCH = 110


def write_response_plot(path: Path, recording: Recording, joint: str, servo: JointServo | None) -> None:
    """Write the responses of a joint as a PNG or an SVG, by the suffix of the name.

    Args:
        path: The file.
        recording: The recording.
        joint: The joint.
        servo: The fitted servo, if there is one.

    Raises:
        OSError: The file cannot be written.
    """
    import matplotlib as mpl

    figure = response_figure(recording, joint, servo)
    kind = path.suffix[1:].lower()
    with replaced_file(path) as part, mpl.rc_context({"svg.hashsalt": "rgss"}):
        figure.savefig(part, format=kind, dpi=_DOTS_PER_INCH, metadata={"Date": None} if kind == "svg" else None)


def response_figure(recording: Recording, joint: str, servo: JointServo | None) -> Figure:
    """Commanded, measured and fitted speed of a joint over time.

    Args:
        recording: The recording.
        joint: The joint.
        servo: The fitted servo, if there is one.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    segments = recording.of_joint(joint)
    down = max(1, math.ceil(len(segments) / _ACROSS))
    across = min(_ACROSS, max(1, len(segments)))
    figure = Figure(figsize=(_PANEL_IN[0] * across, _PANEL_IN[1] * down + 0.6), layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(f"{joint} of {recording.robot}, {recording.control.value} control ({recording.recorded})")
    for index, segment in enumerate(segments):
        ax = figure.add_subplot(down, across, index + 1)
        series, times_s = segment.excited, segment.times_s - segment.times_s[0]
        ax.plot(times_s, series.measured_rad_s, color=_MEASURED, linewidth=1.0, label="measured")
        ax.step(times_s, series.commanded_rad_s, where="post", color=_COMMANDED, linewidth=1.0, label="commanded")
        if servo is not None:
            rest = max(1, int(np.flatnonzero(np.append(np.abs(series.commanded_rad_s) > 0.0, True))[0]))
            start = (float(series.measured_rad[:rest].mean()), 0.0 if rest > 1 else float(series.measured_rad_s[0]))
            motion = servo_motion(
                [servo],
                segment.times_s,
                series.commanded_rad,
                series.commanded_rad_s,
                start=start,
                commands=recording.commands,
            )
            ax.plot(times_s, motion.velocities_rad_s[0], color=_FITTED, linestyle="--", linewidth=1.2, label="fitted")
        ax.set_title(f"{segment.pose}: {segment.signal}", fontsize=9)
        ax.grid(visible=True, color="#d5dae0", linewidth=0.6)
        ax.margins(x=0)
        if index == 0:
            ax.legend(frameon=False, fontsize=8)
    figure.supxlabel("time [s]")
    figure.supylabel(f"joint speed [{recording.unit_of(joint)}/s]")
    return figure
