"""Files of a new project with one gripper of a URDF: how hard it grips, and how fast the arm moves."""

from __future__ import annotations

import re
from collections.abc import Mapping

from rgss.studies.robot_project.drafted_gripper import DraftedGripper

_COMPONENT = """\
  - id: {id}
    role: gripper
    name: {id}
    manufacturer: not stated
    geometry: scenes/grippers/{id}.yaml
    cost: {{value: 4000 USD, assumption: true, rationale: Order of magnitude of a gripper with two fingers.}}

"""
_FACTOR = """\
  - id: grip
    name: Grip force
    levels:
      - {{id: gentle, sets: {{finger_force: {gentle:g} N}}}}
      - {{id: firm, sets: {{finger_force: {firm:g} N}}}}
"""
_VALUES = """\
  values:
    - {measure: payload, weight: 0.4, worst: 0.2 kg, best: 1.5 kg}
    - {measure: task_time, weight: 0.4, worst: 20 s, best: 8 s}
    - {measure: success, weight: 0.2, worst: 0.9, best: 1.0}
"""


def with_gripper(texts: Mapping[str, str], gripper: DraftedGripper) -> dict[str, str]:
    """The files of a new project with a gripper of a URDF in the place of the scaffold's two.

    The gripper has its own masses, speed and drive, so that no design sets them; four designs are two grip forces by
    two tool speeds. Its price is that of all designs, and has no weight.
    """
    changed = {name: text for name, text in texts.items() if not re.fullmatch(r"scenes/grippers/.*\.yaml", name)}
    for name, edits in _edits(gripper).items():
        for pattern, new in edits:
            changed[name], count = re.subn(pattern, new.replace("\\", r"\\"), changed[name])
            if count == 0:
                raise AssertionError(f"the scaffold's {name} has no {pattern!r}")
    return changed


def _edits(gripper: DraftedGripper) -> Mapping[str, tuple[tuple[str, str], ...]]:
    """Regular expressions and their replacements by file."""
    force = {"gentle": gripper.force_n / 2, "firm": gripper.force_n}
    return {
        "README.md": (("Which gripper, on how fast an arm, serves", "How hard a grip, on how fast an arm, serves"),),
        "designs/catalogue.yaml": (
            (r"  - id: finger_actuator\n(?:    .*\n)+", ""),
            (r"  - id: kg-2\n(?s:.*?)(?=  - id: rrt)", _COMPONENT.format(id=gripper.id)),
        ),
        "designs/design_space.yaml": (
            (r"  - id: (finger_mass|base_mass|finger_speed)\n(?:    .*\n)+", ""),
            (r"  (finger_mass|base_mass|finger_speed|finger_force): .*\n", ""),
            (r"constants:\n", "constants:\n  fingers: 2\n  friction: 0.7\n"),
            (r"  - id: gripper\n(?:    .*\n)+", _FACTOR.format(**force)),
            (r"\nrules:\n(?s:.*)", ""),
        ),
        "requirements/measures.yaml": (
            (r"  - \{id: drive_cost, .*\n", ""),
            (r"\"Cost of the gripper, without its drives\.\"", "Cost of the gripper with its drive."),
            (r"Cost of the gripper with a drive for each finger\.", "Cost of the gripper with its drive."),
            (r"gripper_cost \+ fingers \* drive_cost", "gripper_cost"),
        ),
        "studies/pick_place.yaml": ((r"  values:\n(?:    .*\n)+", _VALUES),),
    }
