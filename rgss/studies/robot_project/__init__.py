"""Arms of which there is a URDF: new projects round them, and their robot files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.robot_project.adding import add_robot
    from rgss.studies.robot_project.description import robot_findings
    from rgss.studies.robot_project.summary import RobotSummary, robot_summary
    from rgss.studies.robot_project.writing import write_robot_project
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
