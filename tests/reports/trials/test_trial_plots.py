"""The plots hold the series of the trace, its limits, and its phases by name."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib._pylab_helpers import Gcf
from matplotlib.colors import to_hex
from PIL import Image

from rgss.reports.trials.trial_plots import trial_figure, write_trial_plots

JOINTS = [f"{name}_joint" for name in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")]


@pytest.fixture
def axes(failed, trace):
    return trial_figure(failed, trace, joints=JOINTS).axes


def lines(ax):
    return {line.get_label(): line.get_xydata() for line in ax.get_lines()}


def bands(ax):
    """Extent and colour of each shaded phase."""
    return [(patch.get_x(), patch.get_x() + patch.get_width(), to_hex(patch.get_facecolor())) for patch in ax.patches]


def test_joint_positions(axes, trace):
    shown = lines(axes[0])

    assert list(shown) == ["shoulder pan", "shoulder lift", "elbow", "wrist 1", "wrist 2", "wrist 3"]
    assert shown["wrist 3"][:, 0] == pytest.approx(trace.time_s)
    assert shown["wrist 3"][:, 1] == pytest.approx(np.degrees(trace.joint_positions_rad[:, 5]))


def test_tool_speed_with_its_limit(axes, trace):
    shown = lines(axes[1])

    assert shown["tool speed"][:, 1] == pytest.approx(trace.tool_speed_m_s)
    assert (shown["limit 1.5 m/s"][:, 1] == 1.5).all()
    assert axes[1].get_ylim()[1] > 1.5


def test_finger_forces_with_what_was_commanded(axes, trace):
    shown = lines(axes[2])

    assert list(shown) == ["finger 1", "finger 2", "finger 3", "commanded"]
    assert shown["finger 3"][:, 1] == pytest.approx(trace.finger_forces_n[:, 2])
    assert shown["commanded"][:, 1] == pytest.approx(trace.commanded_force_n, nan_ok=True)


def test_grip_margin_with_where_it_slips(axes, trace):
    shown = lines(axes[3])

    assert shown["grip margin"][:, 1] == pytest.approx(trace.grip_margin, nan_ok=True)
    assert (shown["slips below 1"][:, 1] == 1.0).all()


def test_phases_are_shaded_in_every_plot_and_the_failed_one_stands_out(axes):
    for ax in axes:
        assert [band[:2] for band in bands(ax)] == [(0.0, 1.0), (1.0, 3.0), (3.0, 3.5)]
    first, second, failed = (band[2] for band in bands(axes[0]))
    assert len({first, second, failed}) == 3
    assert failed == "#f9dedb"


def test_phases_are_named_once(axes):
    assert [text.get_text() for text in axes[0].texts] == ["1 move to grasp", "2 grasp", "3 lift"]
    assert all(not ax.texts for ax in axes[1:])


def test_axes_have_names_with_units(axes):
    assert [ax.get_ylabel() for ax in axes] == [
        "joint position [°]",
        "tool speed [m/s]",
        "finger force [N]",
        "grip margin [1]",
    ]
    assert axes[-1].get_xlabel() == "simulated time without planning [s]"
    assert axes[-1].get_xlim() == (0.0, 3.5)


def test_title_says_what_became_of_the_trial(failed, trace):
    figure = trial_figure(failed, trace, joints=JOINTS)

    assert figure.get_suptitle() == "Variant 7, seed 3: failed at lift, object dropped"


def test_a_trial_that_never_carried(failed, trace):
    never = replace(trace, grip_margin=np.full(len(trace.time_s), np.nan))

    assert trial_figure(failed, never, joints=JOINTS).axes[3].get_ylim() == pytest.approx((0.0, 2.3))


def test_names_and_legends_lie_within_the_figure(failed, trace):
    figure = trial_figure(failed, trace, joints=JOINTS)
    figure.canvas.draw()
    whole = figure.bbox
    boxes = [text.get_window_extent() for text in figure.axes[0].texts]
    boxes += [ax.get_legend().get_window_extent() for ax in figure.axes]

    assert len(boxes) == 7
    assert all(box.x0 >= 0 and box.x1 <= whole.x1 and box.y0 >= 0 and box.y1 <= whole.y1 for box in boxes)


def test_file_is_a_png_and_the_only_one(failed, trace, tmp_path):
    path = tmp_path / "plots.png"
    write_trial_plots(path, failed, trace, joints=JOINTS)

    assert [entry.name for entry in tmp_path.iterdir()] == ["plots.png"]
    with Image.open(path) as image:
        assert image.format == "PNG"
        assert min(image.size) > 800


def test_no_global_figure_is_left(failed, trace):
    trial_figure(failed, trace, joints=JOINTS)

    assert Gcf.get_all_fig_managers() == []
