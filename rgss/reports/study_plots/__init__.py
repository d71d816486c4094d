"""Plots of a study as Matplotlib figures, for notebooks."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.study_plots.canvas import StudyFigure
    from rgss.reports.study_plots.front_matrix import front_figure, with_front
    from rgss.reports.study_plots.parallel_coordinates import parallel_figure
    from rgss.reports.study_plots.phase_bars import PhaseBar, TrialBars, timeline_figure
    from rgss.reports.study_plots.plotted import Limit, PlottedDesigns, PlottedMeasure, Role
    from rgss.reports.study_plots.scatter import nondominated_of, pareto_figure
    from rgss.reports.study_plots.sensitivity_bars import InputBar, WeightRange, tornado_figure, weights_figure
    from rgss.reports.study_plots.spread import spread_figure
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
