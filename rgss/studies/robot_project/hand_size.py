"""Size of the hands and of the object of a new project, by the reach and the strength of its arm."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from rgss.scenes import Robot, standing_links
from rgss.studies.robot_project.holding import payload_kg, weak_joints
from rgss.studies.robot_project.layout import Cup
from rgss.studies.robot_project.reach import arm_reach_m

_SCALES = (1.0, 0.7, 0.5, 0.35, 0.25)
# Hand with three fingers, their drives and the cup at scale 1, with room for the acceleration of the tool.
_CARRIED_KG = 2.0
# Reach at which a hand of scale 1 takes half of the reach.
_REACH_M = 0.3
# Greatest mass of hand and object, as a share of the arm's: joints with heavier loads follow their targets badly.
_SHARE_OF_ARM = 0.5
_STEP = 2
_LEAST_CLEARANCE_MM = 2.0
_NUMBER = r"(\d+(?:\.\d+)?)"


@dataclass(frozen=True, slots=True, kw_only=True)
class HandSize:
    """Scale of hands and object relative to those of a project without `--robot`.

    Attributes:
        scale: Factor of lengths and speeds. Masses follow its cube, forces its square.
        own_cup: The object of a gripper that is not scaled; None where hands and object are.
    """

    scale: float = 1.0
    own_cup: Cup | None = None

    @property
    def clearance_m(self) -> float:
        """Clearance of planned paths in m, in whole millimetres."""
        return max(round(8.0 * self.scale), _LEAST_CLEARANCE_MM) / 1e3

    def fitted_text(self, name: str, text: str) -> str:
        """Text of a file of a new project, with its lengths, speeds, masses and forces scaled.

        Args:
            name: Name of the file, relative to the project.
            text: Its text at scale 1.
        """
        if self.scale == 1.0:
            return text
        scaled = {} if self.own_cup is not None else _QUANTITIES
        for pattern, power in scaled.get(name.rpartition("/")[0] if "/grippers/" in name else name, ()):
            text = re.sub(pattern, self._scaled(power), text)
        return text.replace("clearance: 8 mm", f"clearance: {self.clearance_m * 1e3:g} mm")

    def _scaled(self, power: int) -> Callable[[re.Match[str]], str]:
        def scaled(found: re.Match[str]) -> str:
            return f"{found[1]}{float(found[2]) * self.scale**power:.4g}{found[3]}"

        return scaled


# Files of the scaffold, the quantities in them and the power of the scale by which each changes.
_QUANTITIES = {
    "scenes/grippers": ((rf"(){_NUMBER}( mm)", 1), (rf"( at ){_NUMBER}( m/s)", 1)),
    "designs/design_space.yaml": (
        (rf"((?:finger|base)_mass: ){_NUMBER}( kg)", 3),
        (rf"(finger_speed: ){_NUMBER}( m/s)", 1),
        (rf"(finger_force: ){_NUMBER}( N)", 2),
        (rf"(tool_speed: ){_NUMBER}( m/s)", 1),
    ),
    "designs/catalogue.yaml": ((rf"(value: ){_NUMBER}( kg)", 3), (rf"(value: ){_NUMBER}( N)", 2)),
    "requirements/system.yaml": ((rf"(){_NUMBER}( kg)", 2),),
    "studies/pick_place.yaml": ((rf"((?:worst|best): ){_NUMBER}( kg)", 2),),
}


def hand_sizes(robot: Robot, cups: Sequence[Cup] = ()) -> Iterator[HandSize]:
    """Sizes to try, the largest first that the arm can carry and whose hand leaves room to reach.

    Args:
        robot: The arm.
        cups: Objects of a gripper that has its own size, the largest first; its scale is that of the tables.
    """
    if cups:
        scale = next((one for one in _SCALES if one <= arm_reach_m(robot) / _REACH_M), _SCALES[-1])
        yield from (HandSize(scale=scale, own_cup=cup) for cup in cups)
        return
    # Efforts that do not hold the arm itself are no measure of what it carries; `rgss check` reports them.
    by_weight = 1.0 if weak_joints(robot) else (payload_kg(robot) / _CARRIED_KG) ** (1 / 3)
    by_mass = (_SHARE_OF_ARM * moving_mass_kg(robot) / _CARRIED_KG) ** (1 / 3)
    largest = min(1.0, by_weight, by_mass, arm_reach_m(robot) / _REACH_M)
    smaller = [scale for scale in _SCALES if scale <= largest + 1e-9] or [_SCALES[-1]]
    yield from (HandSize(scale=scale) for scale in smaller[::_STEP])


def moving_mass_kg(robot: Robot) -> float:
    """Mass of the links that the joints of an arm move."""
    root = ET.fromstring(robot.urdf)  # noqa: S314 - checked on reading
    still = standing_links(root)
    masses = (link.find("inertial/mass") for link in root.findall("link") if link.get("name") not in still)
    return math.fsum(float(mass.get("value", "0")) for mass in masses if mass is not None)
