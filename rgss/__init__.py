"""Choosing a robot design by evidence: requirements, simulated trials, a certified trade-off.

The public interface is `load_study`, described in docs/api.md, and `RgssError`, from which every error
derives that is raised on purpose.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.errors import RgssError

if TYPE_CHECKING:
    from os import PathLike

    from rgss.api import Study

__all__ = ["RgssError", "load_study"]


def load_study(
    folder: str | PathLike[str] | None = None,
    study: str | PathLike[str] | None = None,
    *,
    fidelity: str | None = None,
    replicates: int | None = None,
) -> Study:
    """Load a project and one of its studies, for analysis as pandas frames.

    Nothing is simulated, and evidence is read only on request.

    Args:
        folder: The project's folder, or a study file (``.yaml``) in one; the nearest folder at or
            above the current one by default.
        study: The study file, relative to the project; ``studies/pick_place.yaml`` by default.
        fidelity: ``kinematic``, ``dynamic`` or ``contact``; overrides the study.
        replicates: Number of trials of each variant; overrides the study.

    Raises:
        DocumentError: Files are invalid; with every problem in all of them.
        DefinitionError: There is no project, or an argument is invalid.
    """
    from importlib import import_module

    # By name, since this package is above all others and yet imported with each: an import statement would make every
    # module a dependency of every other, both for code digests and for layers.
    analysis = import_module("rgss.api.load")
    drawing = import_module("rgss.api.trial").Drawing(
        figure=import_module("rgss.reports.trials.trial_plots").trial_figure,
        filmstrip=import_module("rgss.reports.trials.filmstrip").filmstrip,
    )
    found: Study = analysis.load(
        analysis.path_argument("folder", folder),
        analysis.path_argument("study", study),
        fidelity=fidelity,
        replicates=replicates,
        drawing=drawing,
    )
    return found
