"""Cell of a new project: two tables before the arm, as far away as its tool reaches pointing down."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

_PEDESTAL_HEIGHT_M = 0.6
_SHARES_OF_REACH = (0.55, 0.6, 0.5, 0.65, 0.45, 0.7, 0.4, 0.35)
_HEIGHT_SHARES = (0.0, 0.1, -0.1, 0.2, -0.2, -0.3)
_AZIMUTH_RAD = math.radians(35.0)
_NEAR_M, _LEAST_NEAR_M = 0.08, 0.04
_RISE_SHARE = 0.2
_TABLE_M, _LEAST_TABLE_M = 0.2, 0.1
# Share of the distance of the two tables' centres that each may take.
_BESIDE = 0.95
_CUP_RADIUS_M, _CUP_HEIGHT_M, _CUP_KG, _CUP_N = 0.035, 0.1, 0.25, 40.0

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
    cylinder: {{radius: {post:.4g} m, height: {post_top:.3f} m}}
    foot: [{post_x:.3f} m, 0 m, 0 m]
    friction: 0.5
    colour: "#2f3338"

workpiece: # an upright cylinder
  id: cup
  radius: {cup_radius:g} mm
  height: {cup_height:g} mm
  mass: {cup_mass:.3g} kg
  friction: 1.0 # the coefficient of a contact is the product of both bodies'; the designs give that of the finger
  force_limit: {cup_force:.3g} N # what it bears before it breaks
  stands_on: counter
  at: [{x:.3f} m, {left:.3f} m]
  colour: "#d94f3d"

place_region:
  stands_on: tray
  at: [{x:.3f} m, {y:.3f} m]
  radius: {place_radius:g} mm
  largest_tilt: 5 deg

task: # heights of the gripper over its waypoints, and how it is turned there
  approach_height: {approach:.0f} mm
  lift_height: {lift:.0f} mm
  departure_height: {high:.0f} mm
  place_approach_height: {high:.0f} mm
  place_clearance: {clearance:g} mm
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
    moves_with_robot: true # where designs set robot.base.x, y, z or yaw
"""
_CARRIED = """\
  - about: robot.base
    rationale: What carries the arm above the tables is not modelled; it is outside of the tool's region.
"""
_LOWERED = """\
  - about: bodies
    rationale: The pedestal ends below the arm's base, for collision shapes of the arm reach below its base.
"""
_FREE_YAW = "  free_yaw: true # the cup is round: the arm turns the gripper as it can\n"


@dataclass(frozen=True, slots=True, kw_only=True)
class Cup:
    """The object of a new project."""

    radius_m: float = _CUP_RADIUS_M
    height_m: float = _CUP_HEIGHT_M


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
        scale: Scale of the object relative to a cup of 100 mm.
        rise_share: Height to which the gripper rises over the object, as a share of the reach; 0.24 m at most.
        is_yaw_free: Whether the gripper may be turned about the vertical as suits the arm.
        has_low_post: Whether the object is carried over the post, which is half as high as the gripper rises.
        own_cup: The object of a gripper that it was made for; None for a cup of 100 mm to the scale.
    """

    reach_m: float
    x_m: float
    y_m: float
    table_m: float
    base_m: tuple[float, float, float] = (0.0, 0.0, _PEDESTAL_HEIGHT_M)
    base_yaw_rad: float = 0.0
    is_overhead: bool = False
    pedestal_gap_m: float = 0.0
    scale: float = 1.0
    rise_share: float = _RISE_SHARE
    is_yaw_free: bool = False
    has_low_post: bool = False
    own_cup: Cup | None = None

    @property
    def cup(self) -> Cup:
        """The object."""
        return self.own_cup or Cup(radius_m=_CUP_RADIUS_M * self.scale, height_m=_CUP_HEIGHT_M * self.scale)

    @property
    def rise_m(self) -> float:
        """Height of the gripper over its grasp, between the object's place and its destination."""
        return min(0.24, self.rise_share * self.reach_m)

    @property
    def cup_half_height_m(self) -> float:
        """Half of the object's height."""
        return self.cup.height_m / 2

    @property
    def depth_m(self) -> float:
        """Depth of the tables; those of a small arm bear a cup and leave room for its pedestal."""
        deep = max(min(_TABLE_M * self.scale, 0.4 * self.reach_m), 0.3 * self.reach_m)
        room = 2 * (self.x_m - _LEAST_NEAR_M * self.scale)
        return deep if self.is_overhead else max(min(deep, room), 2 * _CUP_RADIUS_M * self.scale)

    @property
    def length_m(self) -> float:
        """Length of the tables, which leave a gap between them."""
        return min(max(_TABLE_M * self.scale, 0.45 * self.reach_m), 2 * _BESIDE * self.y_m)


def layouts(reach_m: float, *, scale: float = 1.0, is_yaw_free: bool = False) -> Iterator[Layout]:
    """Layouts to try, the most common first.

    Args:
        reach_m: The arm's reach from its first axis.
        scale: Scale of the object.
        is_yaw_free: Whether the gripper may be turned about the vertical.
    """
    for height in _HEIGHT_SHARES:
        for share in _SHARES_OF_REACH:
            distance_m = share * reach_m
            layout = Layout(
                reach_m=reach_m,
                x_m=distance_m * math.cos(_AZIMUTH_RAD),
                y_m=distance_m * math.sin(_AZIMUTH_RAD),
                table_m=round(max(_LEAST_TABLE_M, _PEDESTAL_HEIGHT_M + height * reach_m), 3),
                scale=scale,
                is_yaw_free=is_yaw_free,
            )
            deep = max(min(_TABLE_M * scale, 0.4 * reach_m), 0.3 * reach_m)
            if layout.x_m - deep / 2 >= _LEAST_NEAR_M * scale:
                yield layout


def raised_layout(layout: Layout) -> Layout:
    """Layout on a higher pedestal, if its tables would be lower than 0.1 m."""
    lift_m = _LEAST_TABLE_M - layout.table_m
    if lift_m <= 0.0:
        return layout
    x, y, z = layout.base_m
    return replace(layout, table_m=_LEAST_TABLE_M, base_m=(x, y, round(z + lift_m, 3)))


def scene_text(layout: Layout, *, robot: str) -> str:
    """Text of a scene file.

    Args:
        layout: Positions of the tables.
        robot: Name of the robot file.
    """
    reach, scale = layout.reach_m, layout.scale
    x, y, deep = layout.x_m, layout.y_m, layout.depth_m
    near = x - deep / 2
    foot = min(0.14, near * 0.7 if near < _NEAR_M else near * 0.5)
    pedestal = _PEDESTAL.format(foot=foot, height=round(layout.base_m[2] - layout.pedestal_gap_m, 3))
    return _SCENE.format(
        robot=robot,
        origin="middle of where its tool goes" if layout.is_overhead else "arm",
        free_yaw=_FREE_YAW if layout.is_yaw_free else "",
        base_x=layout.base_m[0],
        base_y=layout.base_m[1],
        base_z=layout.base_m[2],
        base_yaw=f"  yaw: {math.degrees(layout.base_yaw_rad):g} deg\n" if layout.base_yaw_rad else "",
        pedestal="" if layout.is_overhead else pedestal,
        carried=_CARRIED if layout.is_overhead else _LOWERED if layout.pedestal_gap_m else "",
        deep=deep,
        long=layout.length_m,
        table=layout.table_m,
        x=x,
        left=-y,
        y=y,
        post=0.025 * reach,
        post_top=layout.table_m + (layout.rise_m / 2 if layout.has_low_post else layout.rise_share * reach),
        post_x=x + 0.12 * reach,
        approach=min(0.15, 0.12 * reach, layout.rise_m) * 1e3,
        lift=min(0.06, 0.05 * reach) * 1e3,
        high=layout.rise_m * 1e3,
        clearance=max(1.0, round(3.0 * scale, 1)),
        cup_radius=layout.cup.radius_m * 1e3,
        cup_height=layout.cup.height_m * 1e3,
        cup_mass=_CUP_KG * scale**3,
        cup_force=_CUP_N * scale**2,
        place_radius=40.0 * scale,
    )
