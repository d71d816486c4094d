"""Comparison of planners on the moves of a study's task: same scene, same seeds, same clock."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace

from rgss.errors import DefinitionError
from rgss.evidence import PlanOutcome
from rgss.motion import PlannerSettings
from rgss.studies import Project, planner_problem, trial_specs
from rgss.sweep.kept_searches import KeptSearches
from rgss.trials import PlannedMove, TaskPlan, TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedPlanner:
    """A planner with its searches for every move, gripper shape and seed.

    Attributes:
        name: Its name in the study, or in OMPL.
        is_reference: Whether no design has it.
        settings: The planner with its parameters.
        plans: The searches by gripper shape and seed.
    """

    name: str
    is_reference: bool
    settings: PlannerSettings
    plans: tuple[TaskPlan, ...]

    @property
    def label(self) -> str:
        """Its name, and that it has no cost where it is made for one."""
        return f"{self.name} (no cost)" if self.settings.has_no_cost else self.name

    def moves(self, limit_s: float) -> tuple[PlannedMove, ...]:
        """Every search as it would have been under a limit, in s; at most the one that it was run with."""
        return tuple(plan.move_within(phase, limit_s) for plan in self.plans for phase in plan.moves)

    def solved(self, limit_s: float) -> float:
        """Share of the searches that find a path which is valid, within a limit in s."""
        moves = self.moves(limit_s)
        return sum(move.outcome is PlanOutcome.SOLVED for move in moves) / len(moves)

    def checks_quantile(self, share: float, limit_s: float) -> int | None:
        """The number of checks within which a share of the searches is solved; None if fewer are.

        Args:
            share: The share, above 0 and at most 1.
            limit_s: The limit.
        """
        moves = self.moves(limit_s)
        checks = sorted(move.checks for move in moves if move.outcome is PlanOutcome.SOLVED)
        rank = math.ceil(share * len(moves))
        return checks[rank - 1] if rank <= len(checks) else None

    def mean_time_s(self, limit_s: float) -> float:
        """Mean planning time t_sp of a move; the limit where it finds no path."""
        moves = self.moves(limit_s)
        return math.fsum(move.time_s for move in moves) / len(moves)

    def mean_path_m(self, limit_s: float) -> float | None:
        """Mean length of the tool's path over the moves that are solved; None if none is."""
        lengths = [move.path_length_m for move in self.moves(limit_s) if move.path_length_m is not None]
        return math.fsum(lengths) / len(lengths) if lengths else None

    def count(self, limit_s: float, is_counted: Callable[[PlannedMove], bool]) -> int:
        """Number of searches under a limit of which a predicate holds."""
        return sum(map(is_counted, self.moves(limit_s)))


def compared_planners(
    project: Project,
    *,
    seeds: Sequence[int],
    names: Sequence[str] = (),
    kept: KeptSearches | None = None,
    on_plan: Callable[[int, int], None] | None = None,
) -> tuple[ComparedPlanner, ...]:
    """Search for every move of the task with the planners of the designs and with the references.

    Args:
        project: The project with its study.
        seeds: The seeds.
        names: Planners in place of those of the designs and of the study's references.
        kept: Searches to take and to add to; none by default.
        on_plan: Callback after each task that was planned: their number so far, and how many there are.

    Raises:
        DefinitionError: A planner is unknown, no move is planned, or an engine is not installed.
    """
    chosen = _chosen(project, names)
    if not has_searches(project):
        raise DefinitionError(
            f"{project.study.label}: no move of task {project.study.task.id!r} is planned",
            hint="planners search for moves of mode 'planned'",
        )
    kept = kept or KeptSearches(None)
    total, done, found = len(seeds) * sum(len(specs) for _, _, _, specs in chosen), 0, []
    for name, is_reference, settings, specs in chosen:
        plans = []
        for spec in specs:
            for seed in seeds:
                plans.append(kept.plan(replace(spec, seed=seed)))
                done += 1
                if on_plan is not None:
                    on_plan(done, total)
        found.append(ComparedPlanner(name=name, is_reference=is_reference, settings=settings, plans=tuple(plans)))
    return tuple(found)


def has_searches(project: Project) -> bool:
    """True if a planner searches for some move of the task."""
    return bool(project.study.task.planned) and any(
        spec.searched for spec in trial_specs(project, seeds=[project.study.seed])
    )


def limits_of(project: Project) -> tuple[float, ...]:
    """The planning limits of the designs in s, from the shortest."""
    return tuple(sorted({spec.planning_limit_s for spec in trial_specs(project, seeds=[project.study.seed])}))


_Chosen = tuple[str, bool, PlannerSettings, tuple[TrialSpec, ...]]


def _chosen(project: Project, names: Sequence[str]) -> list[_Chosen]:
    """Each planner with a trial for each shape of gripper."""
    planning = project.study.planning
    specs = trial_specs(project, seeds=[project.study.seed])
    of_designs = list(dict.fromkeys((spec.planner, spec.planned_by) for spec in specs))
    own = {name for name, _ in of_designs}
    for name in names:
        if problem := planner_problem(name, {*planning.planners, *own}):
            raise DefinitionError(problem[0], hint=problem[1])
    wanted: Iterable[tuple[str, PlannerSettings]] = (
        [pair for name in names for pair in _named(name, of_designs, planning.planner_settings(name))]
        if names
        else [*of_designs, *((name, planning.planner_settings(name)) for name in planning.references)]
    )
    shapes = list({spec.gripper.geometry: spec for spec in specs}.values())
    return [
        (
            name,
            name not in own,
            settings,
            tuple(replace(spec, planner=name, planner_settings=settings) for spec in shapes),
        )
        for name, settings in dict.fromkeys(wanted)
    ]


def _named(
    name: str, of_designs: Iterable[tuple[str, PlannerSettings]], settings: PlannerSettings
) -> list[tuple[str, PlannerSettings]]:
    """The planner of a name as designs have it, several if they set its parameters; else as the study has it."""
    return [pair for pair in of_designs if pair[0] == name] or [(name, settings)]
