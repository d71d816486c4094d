"""Figures of a study: what they show is what the frames have."""

from __future__ import annotations

import io
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

import rgss
from rgss.api import plots
from rgss.errors import DefinitionError
from rgss.measures import Direction
from rgss.reports.decision import ids_text
from rgss.reports.study_plots.plotted import PlottedMeasure
from rgss.reports.study_plots.scatter import draw_limit


def png(figure) -> bytes:
    written = io.BytesIO()
    figure.savefig(written, format="png", metadata={"Software": None})
    return written.getvalue()


def points(ax):
    """All marks of axes, as rounded pairs."""
    found = [tuple(map(float, pair)) for marks in ax.collections for pair in np.asarray(marks.get_offsets())]
    return sorted((round(x, 9), round(y, 9)) for x, y in found)


def values(study, measure):
    return study.measures.xs(measure, level="measure")["value"]


@pytest.fixture(scope="module")
def plot(study):
    return study.plot


def test_each_design_is_a_mark_at_its_two_measures(study, plot):
    figure = plot.pareto("C_total", "t_p")
    (ax,) = figure.axes
    expected = sorted(
        (round(x, 9), round(y, 9)) for x, y in zip(values(study, "C_total"), values(study, "t_p"), strict=True)
    )
    assert points(ax) == expected
    assert ax.get_xlabel() == "Total cost estimate C_total [USD]\n← lower is better"
    assert ax.get_ylabel() == "Total planning time t_p [s]\n← lower is better"
    assert [text.get_text() for text in ax.texts if "SYS-" in text.get_text()] == [
        "SYS-004: ≤ 43,000",
        "SYS-033: ≤ 15",
    ]
    assert f"chosen {study.decision.chosen}" in figure.alt_text


def test_the_heaviest_weights_are_the_default(study, plot):
    weights = study.trade().weights()["weight"].sort_values(ascending=False, kind="stable")
    (ax,) = plot.pareto().axes
    assert weights.index[0] in ax.get_xlabel()
    assert weights.index[1] in ax.get_ylabel()
    (ax,) = plot.pareto(y=weights.index[0]).axes
    assert weights.index[1] in ax.get_xlabel()


def test_the_front_is_what_no_feasible_design_dominates(study, plot):
    names = ["C_total", "t_p", "P_max"]
    feasible = study.variants.query("feasible").index
    # Less is better of the first two, more of the third.
    table = np.array(
        [
            [-values(study, names[0])[one], -values(study, names[1])[one], values(study, names[2])[one]]
            for one in feasible
        ]
    )
    best = [
        int(one)
        for one, own in zip(feasible, table, strict=True)
        if not any((other >= own).all() and (other > own).any() for other in table)
    ]
    figure = plot.front(names)
    assert f"nondominated in all of them: {ids_text(best)}" in figure.alt_text
    assert sum(ax.get_visible() for ax in figure.axes) == 3


def test_a_line_of_parallel_coordinates_is_a_design(study, plot):
    figure = plot.parallel(["C_total", "t_p"])
    (ax,) = figure.axes
    lines = {tuple(np.round(line.get_ydata(), 6)) for line in ax.lines if len(line.get_xdata()) == 2}
    chosen = study.decision.chosen
    low, high = values(study, "t_p").min(), values(study, "t_p").max()
    height = round(1.0 - (values(study, "t_p")[chosen] - low) / (high - low), 6)
    assert any(abs(ends[1] - height) < 0.1 for ends in lines)
    assert [text.split("\n")[-1] for text in (one.get_text() for one in ax.get_xticklabels())] == 2 * [
        "lower is better"
    ]
    assert f"the chosen design has C_total {values(study, 'C_total')[chosen]:,.0f} USD; t_p " in figure.alt_text
    with pytest.raises(DefinitionError, match=r"measures: all designs have the same values \(name measures that"):
        plot.parallel(["t_gc"])


def test_intervals_and_boxes_of_a_measure(study, plot):
    figure = plot.measure("t_p", by="fingers")
    wide, boxes = figure.axes
    frame = study.measures.xs("t_p", level="measure")
    drawn = sorted(
        tuple(np.round(line.get_ydata(), 9))
        for line in wide.lines
        if len(line.get_xdata()) == 2 and line.get_linestyle() == "-"
    )
    assert drawn == sorted(
        (round(low, 9), round(high, 9)) for low, high in zip(frame["low"], frame["high"], strict=True) if high > low
    )
    assert [label.get_text() for label in boxes.get_xticklabels()] == ["three\n4", "two\n4"]
    assert sorted(y for _, y in points(wide)) == sorted(frame["value"].round(9))


def test_the_axis_of_a_share_ends_at_one(plot):
    wide, boxes = plot.measure("S").axes
    (ax,) = plot.pareto("t_p", "S").axes
    assert [one.get_ylim()[1] for one in (wide, boxes, ax)] == [1.0, 1.0, 1.0]
    # No other measure is cut.
    assert ax.get_xlim()[1] > max(x for x, _ in points(ax))


def test_a_bar_is_as_long_as_the_state_took(study, plot):
    variant = int(study.trials.index[0][0])
    figure = plot.timeline(variant)
    (ax,) = figure.axes
    lengths = sum(bar.get_width() for bar in ax.patches)
    phases = study.phases.loc[variant]
    assert lengths == pytest.approx(phases["duration_s"].sum() + phases["planning_time_s"].sum())
    assert [label.get_text() for label in ax.get_yticklabels()] == ["seed 1", "seed 2"]
    assert f"variant {study.decision.chosen}" in plot.timeline().alt_text


def test_ranges_of_weights(study, plot):
    (ax,) = plot.weights().axes
    frame = study.trade().weights()
    spans = [tuple(line.get_xdata()) for line in ax.lines if line.get_color() == "#0072b2"]
    assert spans == list(zip(frame["low"], frame["high"], strict=True))
    assert [text.get_text().split("\n")[0] for text in ax.get_yticklabels()] == list(frame.index)


def test_ends_of_the_tornado(study, plot):
    (ax,) = plot.tornado().axes
    frame = study.tornado()
    frame = frame[(frame["swing"] > 1e-9)][: plots.MOST_INPUTS]
    assert [label.get_text().split("\n")[0] for label in ax.get_yticklabels()] == list(frame.index)
    ends = sorted(round(bar.get_x() + (bar.get_width() if bar.get_width() else 0.0), 9) for bar in ax.patches)
    known = [end for end in (*frame["lead_low"], *frame["lead_high"]) if np.isfinite(end)]
    assert ends == sorted(round(end, 9) for end in known)


def test_the_same_figure_is_the_same_bytes_and_has_a_text(plot):
    first, again = plot.pareto(), plot.pareto()
    assert png(first) == png(again)
    data, metadata = first._repr_mimebundle_()
    assert data["text/plain"] == metadata["image/png"]["alt"] == repr(first)
    assert repr(first).startswith("Scatter plot of 8 designs over")


def test_without_every_trial_no_design_is_judged(swept):
    study = rgss.load_study(swept, fidelity="kinematic", replicates=3)
    figure = study.plot.pareto("C_total", "t_p")
    assert "8 not judged" in figure.alt_text
    (legend,) = figure.legends
    assert "not judged: 8 trials have no evidence yet" in legend.get_title().get_text()


def test_suppositions_are_drawn(study):
    figure = study.trade({"SYS-004.threshold": "40000 USD"}).plot.pareto("C_total", "t_p")
    assert "SYS-004: ≤ 40,000" in [text.get_text() for text in figure.axes[0].texts]


def test_no_line_of_a_limit_passes_through_the_label_of_another(study):
    (axes,) = study.trade({"SYS-004.threshold": "40000 USD"}).plot.pareto("C_total", "t_p").axes
    labels = [text for text in axes.texts if text.get_text().startswith("SYS-")]
    limits = [line for line in axes.lines if line.get_linestyle() == "--"]
    assert labels
    assert limits
    for label in labels:
        ground = label.get_bbox_patch()
        assert ground.get_facecolor() == (1.0, 1.0, 1.0, 1.0)
        assert label.get_zorder() > max(line.get_zorder() for line in limits)


def test_a_level_label_of_a_limit_is_away_from_an_upright_one():
    axes = Figure().subplots()
    axes.set(xlim=(0.0, 10.0), ylim=(0.0, 10.0))
    draw_limit(axes, SimpleNamespace(value=9.0), vertical=True)
    draw_limit(axes, SimpleNamespace(value=8.0), vertical=False)
    upright, level = axes.texts
    assert (upright.xy, level.xy, level.get_ha()) == ((9.0, 0.99), (0.01, 8.0), "left")


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (
            lambda plot: plot.pareto("C_totl"),
            r"x: 'C_totl' is not a measure with one value .* \(did you mean 'C_total'\?",
        ),
        (lambda plot: plot.pareto("C_total", "zzz"), r"y: 'zzz' is not a measure .* \(study\.measures has all \d+\)$"),
        (lambda plot: plot.measure("Total_Planning_Time"), r"measure: .* \(did you mean 't_p'\? study\.measures has"),
        (lambda plot: plot.measure("cost"), r"measure: 'cost' is not a measure .* \(did you mean 'C_total'"),
        (lambda plot: plot.front("C_total"), r"measures: name two or more, got 'C_total'"),
        (lambda plot: plot.front(["C_total", "C_total"]), r"measures: name two or more, got 'C_total'"),
        (lambda plot: plot.front([]), r"measures: name two or more, got none"),
        (lambda plot: plot.front(None), r"measures must be a list of texts, got None \(such as front"),
        (lambda plot: plot.front([5, 6]), r"an entry of measures must be a text, got 5 \(such as front"),
        (lambda plot: plot.pareto("S", "S"), r"x, y: both are S \(name two measures\)"),
        (lambda plot: plot.pareto(5), r"x must be a text, got 5 \(give the id of a measure\)"),
        (lambda plot: plot.pareto("C_total", ["t_p"]), r"y must be a text, got \['t_p'\] \(give the id of a measure\)"),
        (lambda plot: plot.pareto(pd.DataFrame({"a": [1]})), r"x must be a text, got a DataFrame"),
        (lambda plot: plot.parallel("C_total"), r"measures must be a list of texts, got 'C_total' \(such as parallel"),
        (lambda plot: plot.parallel(None), r"measures must be a list of texts, got None"),
        (lambda plot: plot.measure(["t_p"]), r"measure must be a text, got \['t_p'\]"),
        (
            lambda plot: plot.measure("t_p", by=["colour"]),
            r"by must be a text, got \['colour'\] \(factors: gripper_mass",
        ),
        (lambda plot: plot.timeline([28]), r"variant must be a whole number, got \[28\]"),
        (
            lambda plot: plot.measure("t_p", by="colour"),
            r"by: 'colour' is not a factor \(factors: gripper_mass, fingers",
        ),
        (lambda plot: plot.timeline(99), r"variant: unknown variant 99 \(name a variant of the study\)"),
    ],
)
def test_what_is_not_there(plot, ask, message):
    with pytest.raises(DefinitionError, match=message):
        ask(plot)


def test_without_matplotlib(study, monkeypatch):
    monkeypatch.setattr(plots.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(DefinitionError, match=r"plot needs Matplotlib, which is not installed \(pip install 'rgss\["):
        _ = study.plot


@pytest.mark.parametrize(
    ("id_", "name", "title"),
    [
        ("task_time", "Task time", "Task time [s]"),
        ("t_e", "Execution time", "Execution time t_e [s]"),
        ("task_time", "Time of the task", "Time of the task task_time [s]"),
    ],
)
def test_an_id_that_is_the_name_is_not_repeated(id_, name, title):
    measure = PlottedMeasure(id=id_, name=name, unit="s", better=Direction.LOWER, estimates={})
    assert measure.title == title
