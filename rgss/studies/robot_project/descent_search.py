"""Search for places on a table that an arm reaches with its tool pointing down, over its whole workspace."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import Arm, InverseKinematics, inverse_kinematics
from rgss.scenes import GripperGeometry, JointKind, Pose, Robot
from rgss.studies.robot_project.layout import Layout, raised_layout
from rgss.studies.robot_project.reach import arm_reach_m, middle_height_m, sampled_configurations

Array = NDArray[np.float64]

_DOWN = (math.pi, 0.0, 0.0)
_RADIUS_SHARES = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8)
_HEIGHT_SHARES = (-0.75, -0.6, -0.45, -0.3, -0.15, 0.0, 0.15, 0.3, 0.45)
_RISE_SHARES = (0.2, 0.12)
_MOST_TRIED = 8
_LARGEST_AZIMUTH_RAD, _LEAST_AZIMUTH_RAD = math.radians(35.0), math.radians(12.0)
_USED_OF_RANGE = 0.45
_VERTICAL_COSINE = 0.999
_BASE_M = 0.6
_DESCENTS = 4

NOT_VERTICAL = "its first joint does not turn about a vertical axis on a level base"
_PLACES = len(_RADIUS_SHARES) * len(_HEIGHT_SHARES)
NEVER_DOWN = f"the tool points down at none of {_PLACES} places within its reach"
DOWN_ELSEWHERE = f"the tool points down, but the joints bring it so to none of {_PLACES} places within its reach"
UNMENDED = frozenset({NEVER_DOWN, DOWN_ELSEWHERE})
"""Reasons that a smaller hand does not resolve."""

Cell = tuple[int, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class DescentSearch:
    """Result of a search.

    Attributes:
        layouts: Layouts to try, those amid most others of their kind first.
        reason: What prevents one, if there is none.
    """

    layouts: tuple[Layout, ...]
    reason: str = ""


def angles_from_vertical_rad(robot: Robot) -> dict[str, float]:
    """Least angle of each axis of the flange from straight down, over sampled configurations on a level base."""
    arm = Arm(replace(robot, base=Pose()), Pose())
    rows = np.array([arm.tool_matrix(q)[2, :3] for q in sampled_configurations(robot)])
    lowest = {"": rows.min(axis=0), "-": -rows.max(axis=0)}
    cosines = {f"{sign}{axis}": -float(low[at]) for sign, low in lowest.items() for at, axis in enumerate("xyz")}
    return {axis: math.acos(min(1.0, max(-1.0, cosine))) for axis, cosine in cosines.items()}


def turns_down(robot: Robot) -> bool:
    """True if an arm on a level base brings the axis z of its flange straight down in some configuration."""
    from scipy.optimize import minimize

    arm = Arm(replace(robot, base=Pose()), Pose())
    nearest = sorted(sampled_configurations(robot), key=lambda q: float(arm.tool_matrix(q)[2, 2]))[:_DESCENTS]
    bounds = [(joint.lower_rad, joint.upper_rad) for joint in robot.joints]
    ends = (minimize(lambda q: float(arm.tool_matrix(q)[2, 2]), q, bounds=bounds) for q in nearest)
    return any(float(end.fun) < -_VERTICAL_COSINE for end in ends)


def descent_search(robot: Robot, geometry: GripperGeometry, *, scale: float) -> DescentSearch:
    """Search for layouts on a grid of distances and heights about the arm's first axis.

    The grasp may be turned about the vertical as suits the arm. With a vertical first axis, one direction stands for
    all, and the first joint's range determines the sector in which the tables are.

    Args:
        robot: The arm.
        geometry: The longest gripper.
        scale: Scale of hand and object.
    """
    level = replace(robot, base=Pose())
    arm = Arm(level, geometry.grasp_centre)
    first, axis = robot.joints[0], arm.joint_axes()[0][0]
    if first.kind is not JointKind.REVOLUTE or abs(float(axis[2])) < _VERTICAL_COSINE:
        return DescentSearch(layouts=(), reason=NOT_VERTICAL)
    turning = replace(first, lower_rad=-math.pi, upper_rad=math.pi)
    inverse = inverse_kinematics(
        Arm(replace(level, joints=(turning, *robot.joints[1:])), geometry.grasp_centre), is_turn_free=True
    )
    reach_m = arm_reach_m(robot)
    x, y, _ = arm.first_axis_m
    grid = _Grid(inverse, (x, y, middle_height_m(level)), reach_m)
    sector = (first.lower_rad, first.upper_rad, math.copysign(1.0, float(axis[2])))
    reasons: list[str] = []
    for share in _RISE_SHARES:
        rise_m = min(0.24, share * reach_m)
        found = {cell: width for cell in grid.cells() if (width := _sector(grid, cell, rise_m, sector)) is not None}
        if not found:
            if any(grid.positions(cell) for cell in grid.cells()):
                reasons.append(f"where the tool points down, it cannot rise by {rise_m * 1e3:.0f} mm above the object")
            continue
        wide = {cell: one for cell, one in found.items() if _azimuth(one) >= _LEAST_AZIMUTH_RAD}
        if not wide:
            reasons.append(f"the joint {first.name} turns too little where the tool points down")
            continue
        kept = sorted(wide, key=lambda cell: (-_neighbours(cell, wide), _unusual(cell), cell))
        rough = Layout(
            reach_m=reach_m,
            x_m=0.0,
            y_m=0.0,
            table_m=0.0,
            scale=scale,
            rise_share=share,
            is_yaw_free=True,
            has_low_post=True,
        )
        return DescentSearch(layouts=tuple(_layout(rough, grid, cell, wide[cell]) for cell in kept[:_MOST_TRIED]))
    if not reasons:
        reasons = [DOWN_ELSEWHERE if turns_down(robot) else NEVER_DOWN]
    return DescentSearch(layouts=(), reason=reasons[-1])


class _Grid:
    """Distances from the first axis and heights over a point of it, with the positions of the first joint at each."""

    def __init__(self, inverse: InverseKinematics, axis_m: tuple[float, float, float], reach_m: float) -> None:
        self.axis_m = axis_m
        self._inverse, self._reach_m = inverse, reach_m
        self._found: dict[tuple[float, float], tuple[float, ...]] = {}

    def cells(self) -> Iterator[Cell]:
        """Indices of distance and height."""
        return itertools.product(range(len(_RADIUS_SHARES)), range(len(_HEIGHT_SHARES)))

    def radius_m(self, cell: Cell) -> float:
        """Distance of a cell from the first axis."""
        return _RADIUS_SHARES[cell[0]] * self._reach_m

    def height_m(self, cell: Cell) -> float:
        """Height of a cell in the frame of the base."""
        return self.axis_m[2] + _HEIGHT_SHARES[cell[1]] * self._reach_m

    def positions(self, cell: Cell, rise_m: float = 0.0) -> tuple[float, ...]:
        """Positions of the first joint with the grasp centre above a cell and the tool pointing down, along x."""
        x, y, _ = self.axis_m
        place = (self.radius_m(cell), self.height_m(cell) + rise_m)
        if place not in self._found:
            pose = Pose.from_roll_pitch_yaw((x + place[0], y, place[1]), _DOWN)
            self._found[place] = tuple(float(q[0]) for q in self._inverse.solve(pose))
        return self._found[place]


def _sector(grid: _Grid, cell: Cell, rise_m: float, range_: tuple[float, float, float]) -> tuple[float, float] | None:
    """Widest sector of azimuths in which a cell and the place above it are reached; None if there is none."""
    low = _sectors(grid.positions(cell), range_)
    if not low or not (high := _sectors(grid.positions(cell, rise_m), range_)):
        return None
    both = [(max(a[0], b[0]), min(a[1], b[1])) for a in low for b in high]
    best = max(both, key=_width)
    return best if _width(best) > 0.0 else None


def _sectors(positions: tuple[float, ...], range_: tuple[float, float, float]) -> list[tuple[float, float]]:
    lower, upper, sign = range_
    turns = (-math.tau, 0.0, math.tau)
    ends = [(sign * (lower - q + turn), sign * (upper - q + turn)) for q in positions for turn in turns]
    within = ((max(min(pair), -math.pi), min(max(pair), math.pi)) for pair in ends if min(pair) < math.pi)
    # Configurations of one position of the joint have one sector, and those of a turn beside it have none.
    return [one for one in dict.fromkeys(within) if _width(one) > 0.0]


def _width(sector: tuple[float, float]) -> float:
    return sector[1] - sector[0]


def _azimuth(sector: tuple[float, float]) -> float:
    return min(_LARGEST_AZIMUTH_RAD, _USED_OF_RANGE * _width(sector))


def _neighbours(cell: Cell, among: dict[Cell, tuple[float, float]]) -> int:
    steps = itertools.product((-1, 0, 1), (-1, 0, 1))
    return sum((cell[0] + a, cell[1] + b) in among for a, b in steps)


def _unusual(cell: Cell) -> float:
    """Distance from a table at half of the reach, below the middle of the tool's region, in shares of the reach."""
    return abs(_RADIUS_SHARES[cell[0]] - 0.55) + abs(_HEIGHT_SHARES[cell[1]] + 0.25)


def _layout(rough: Layout, grid: _Grid, cell: Cell, sector: tuple[float, float]) -> Layout:
    azimuth = _azimuth(sector)
    ahead = sector[0] + azimuth <= 0.0 <= sector[1] - azimuth
    # The tables are ahead, along x, and the base is turned if the sector is elsewhere.
    yaw = 0.0 if ahead else -math.radians(round(math.degrees(sum(sector) / 2)))
    x, y, _ = grid.axis_m
    cosine, sine = math.cos(yaw), math.sin(yaw)
    base = (round(sine * y - cosine * x, 4) + 0.0, round(-sine * x - cosine * y, 4) + 0.0, _BASE_M)
    return raised_layout(
        replace(
            rough,
            x_m=grid.radius_m(cell) * math.cos(azimuth),
            y_m=grid.radius_m(cell) * math.sin(azimuth),
            table_m=round(_BASE_M + grid.height_m(cell) - rough.cup_half_height_m, 3),
            base_m=base,
            base_yaw_rad=yaw,
        )
    )
