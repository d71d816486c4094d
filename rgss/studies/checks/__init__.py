"""Findings about a whole study: what its parts demand of each other before anything is simulated."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.checks.bench_check import bench_findings
    from rgss.studies.checks.candidate_grasps import checked_mounting, lack_of_room
    from rgss.studies.checks.double_counting import double_counting_findings
    from rgss.studies.checks.draw_check import draw_findings
    from rgss.studies.checks.gripped_objects import MISFITS, TOO_WIDE, Misfit, is_of_fingers
    from rgss.studies.checks.held_load_check import held_load_findings
    from rgss.studies.checks.impact_check import impact_findings
    from rgss.studies.checks.light_check import light_body_findings
    from rgss.studies.checks.object_limit_check import object_limit_findings
    from rgss.studies.checks.scene_places import ScenePlaces
    from rgss.studies.checks.step_check import check_step_findings, step_findings
    from rgss.studies.checks.strict_check import strict_findings
    from rgss.studies.checks.task_time_check import task_time_findings
    from rgss.studies.checks.threshold_check import threshold_findings
    from rgss.studies.checks.too_tall import TooTall, is_at_the_palm, objects_too_tall
    from rgss.studies.checks.undefined_check import undefined_findings
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
