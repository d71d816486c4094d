"""The cell of a new project: two tables before the arm, as far away as its tool reaches pointing down."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

_PEDESTAL_HEIGHT_M = 0.6
_SHARES_OF_REACH = (0.55, 0.6, 0.5, 0.65, 0.45, 0.7, 0.4, 0.35)
_HEIGHT_SHARES = (0.0, 0.1, -0.1, 0.2, -0.2, -0.3)
_AZIMUTH_RAD = math.radians(35.0)
_NEAR_M, _LEAST_NEAR_M = 0.08, 0.04


_SCENE = """\
# Where the arm works: it carries a cup from one table to another, past a post between them. Everything is scaled by the
# arm's reach. World frame: origin on the floor under the {origin}, z up. `foot` is the centre of a body's bottom face.
scene: kitchen
gravity: 9.81 m/s^2

robot:
  description: robots/{robot}
  base: [{base_x:g} m, {base_y:g} m, {base_z:g} m]
{base_yaw}
bodies: # a box has its size along x, y and z
  - {{id: floor, box: [5 m, 5 m, 0.02 m], foot: [0 m, 0 m, -0.02 m], friction: 0.6, colour: "#6b625b"}}
{pedestal}  - id: counter
    box: [{deep:.3f} m, {long:.3f} m, {table:g} m]
    foot: [{x:.3f} m, {left:.3f} m, 0 m]
    friction: 0.5
    colour: "#b98a5a"
  - id: tray
    box: [{deep:.3f} m, {long:.3f} m, {table:g} m]
    foot: [{x:.3f} m, {y:.3f} m, 0 m]
    friction: 0.5
    colour: "#a97c4f"
  - id: post
    cylinder: {{radius: {post:.3f} m, height: {post_top:.3f} m}}
    foot: [{post_x:.3f} m, 0 m, 0 m]
    friction: 0.5
    colour: "#2f3338"

workpiece: # an upright cylinder
  id: cup
  radius: 35 mm
  height: 100 mm
  mass: 0.25 kg
  friction: 1.0 # the coefficient of a contact is the product of both bodies'; the designs give that of the finger
  force_limit: 40 N # what it bears before it breaks
  stands_on: counter
  at: [{x:.3f} m, {left:.3f} m]
  colour: "#d94f3d"

place_region:
  stands_on: tray
  at: [{x:.3f} m, {y:.3f} m]
  radius: 40 mm
  largest_tilt: 5 deg

task: # heights of the gripper over its waypoints, and how it is turned there
  approach_height: {approach:.0f} mm
  lift_height: {lift:.0f} mm
  departure_height: {high:.0f} mm
  place_approach_height: {high:.0f} mm
  place_clearance: 3 mm
  largest_carry_tilt: 45 deg
  grasp_yaw: 0 deg
  place_yaw: 0 deg
{free_yaw}
assumptions:
  - about: workpiece.force_limit
    rationale: No source gives the force that breaks the cup; this is well above the closing impact of one finger.
{carried}"""
_PEDESTAL = """\
  - id: pedestal
    cylinder: {{radius: {foot:.3f} m, height: {height:g} m}}
    foot: [0 m, 0 m, 0 m]
    friction: 0.6
    colour: "#4a4f57"
"""
_CARRIED = """\
  - about: robot.base
    rationale: What carries the arm above the tables is not modelled; it is outside of the tool's region.
"""
_LOWERED = """\
  - about: bodies
    rationale: The pedestal ends below the arm's base, for collision shapes of the arm reach below its base.
"""
_FREE_YAW = "  free_yaw: true # the cup is round: an arm of few joints turns the gripper as it can\n"


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """Positions of the tables.

    Attributes:
        reach_m: The arm's reach, the scale of the layout.
        x_m: x of the object and of its place in the world.
        y_m: y of the place; the object is on the other side.
        table_m: Height of the tables' tops over the floor.
        base_m: Position of the arm's base in the world.
        base_yaw_rad: Its turn about the vertical.
        is_overhead: Whether the arm hangs above the tables, instead of standing on a pedestal before them.
        pedestal_gap_m: Distance of the pedestal's top below the arm's base, where shapes of the arm reach below it.
    """

    reach_m: float
    x_m: float
    y_m: float
    table_m: float
    base_m: tuple[float, float, float] = (0.0, 0.0, _PEDESTAL_HEIGHT_M)
    base_yaw_rad: float = 0.0
    is_overhead: bool = False
    pedestal_gap_m: float = 0.0


def layouts(reach_m: float) -> Iterator[Layout]:
    """Layouts to try, the most common first.

    Args:
        reach_m: The arm's reach from its first axis.
    """
    for height in _HEIGHT_SHARES:
        for share in _SHARES_OF_REACH:
            table_m = max(0.1, _PEDESTAL_HEIGHT_M + height * reach_m)
            distance_m = share * reach_m
            if distance_m * math.cos(_AZIMUTH_RAD) - _depth_m(reach_m) / 2 < _LEAST_NEAR_M:
                continue
            yield Layout(
                reach_m=reach_m,
                x_m=distance_m * math.cos(_AZIMUTH_RAD),
                y_m=distance_m * math.sin(_AZIMUTH_RAD),
                table_m=round(table_m, 3),
            )


def _depth_m(reach_m: float) -> float:
    """Depth of the tables; those of a small arm bear a cup and leave room for its pedestal."""
    return max(min(0.2, 0.4 * reach_m), 0.3 * reach_m)


def scene_text(layout: Layout, *, robot: str, is_yaw_free: bool = False) -> str:
    """The text of a scene file.

    Args:
        layout: Positions of the tables.
        robot: Name of the robot file.
        is_yaw_free: Whether the gripper may be turned about the vertical as suits the arm.
    """
    reach = layout.reach_m
    x, y = layout.x_m, layout.y_m
    long, deep = max(0.2, 0.45 * reach), _depth_m(reach)
    near = x - deep / 2
    height = _PEDESTAL_HEIGHT_M - layout.pedestal_gap_m
    foot = min(0.14, near * 0.7 if near < _NEAR_M else near * 0.5)
    post = 0.05 * reach
    high = min(0.24, 0.2 * reach)
    approach = min(0.15, 0.12 * reach)
    lift = min(0.06, 0.05 * reach)
    return _SCENE.format(
        robot=robot,
        origin="middle of where its tool goes" if layout.is_overhead else "arm",
        free_yaw=_FREE_YAW if is_yaw_free else "",
        base_x=layout.base_m[0],
        base_y=layout.base_m[1],
        base_z=layout.base_m[2],
        base_yaw=f"  yaw: {math.degrees(layout.base_yaw_rad):g} deg\n" if layout.base_yaw_rad else "",
        pedestal="" if layout.is_overhead else _PEDESTAL.format(foot=foot, height=height),
        carried=_CARRIED if layout.is_overhead else _LOWERED if layout.pedestal_gap_m else "",
        deep=deep,
        long=long,
        table=layout.table_m,
        x=x,
        left=-y,
        y=y,
        post=post / 2,
        post_top=layout.table_m + 0.2 * reach,
        post_x=x + 0.12 * reach,
        approach=approach * 1e3,
        lift=lift * 1e3,
        high=high * 1e3,
    )
