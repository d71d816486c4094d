"""Studies: from a project folder to trials, evidence, estimates and a decision."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.checks import (
        bench_findings,
        double_counting_findings,
        draw_findings,
        impact_findings,
        light_body_findings,
        object_limit_findings,
        strict_findings,
        task_time_findings,
        threshold_findings,
        undefined_findings,
    )
    from rgss.studies.document import MOST_REPLICATES, StudyDocument
    from rgss.studies.expansion import trial_settings, trial_specs
    from rgss.studies.finding_suppression import without_consequences
    from rgss.studies.input_names import CODE, named_inputs
    from rgss.studies.planning import PlanningChoice, planner_problem, read_parameter
    from rgss.studies.project import EVIDENCE, Project, load_project
    from rgss.studies.project_folders import (
        DEFAULT_STUDY,
        FOLDERS,
        REQUIREMENT_PARTS,
        REQUIREMENTS,
        find_project,
        named_sets,
        project_of_study,
        qualifier_of,
        requirements_of_study,
        studies_by_set,
    )
    from rgss.studies.promotion import Promotion, Screening
    from rgss.studies.regression import GuardedMetric, RegressionGuard, WatchedRun
    from rgss.studies.scaffolding import write_scaffold
    from rgss.studies.scene_findings import check_scene
    from rgss.studies.schemas import DOCUMENT_KINDS, DocumentKind, write_headers, write_schemas
    from rgss.studies.source_text import invisible_findings
    from rgss.studies.study import value_anchors
    from rgss.studies.trial_choice import TrialChoice
    from rgss.studies.unread_files import unread_findings
    from rgss.studies.unused_parameters import uncounted_mass_findings, unused_findings
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
