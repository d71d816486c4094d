"""Document models of scene, robot and gripper files."""

from __future__ import annotations

from enum import Enum
from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from rgss.documents import (
    Dimensionless,
    DocumentModel,
    Identifier,
    JointAcceleration,
    JointEffort,
    JointPosition,
    JointSpeed,
    Kilograms,
    KilogramsPerCubicMetre,
    KilogramSquareMetres,
    Metres,
    MetresPerSecond,
    MetresPerSecondSquared,
    Newtons,
    Radians,
    Seconds,
    Text,
)
from rgss.scenes.frames import FrameEntry
from rgss.scenes.grasps import Approach, GraspCandidates
from rgss.scenes.robot import MOST_JOINTS
from rgss.scenes.scene import FORCE_WINDOW_S, LANDING_LIMIT_M_S, LARGEST_DRAG_M, LARGEST_DROP_M
from rgss.scenes.uncertainty import CorrelationEntry, DistributionEntry, QuantityName

Colour = Annotated[str, StringConstraints(pattern=r"^#[0-9a-fA-F]{6}$")]
Point = tuple[Metres, Metres, Metres]
PointOnTop = tuple[Metres, Metres]
Inertia = tuple[
    KilogramSquareMetres,
    KilogramSquareMetres,
    KilogramSquareMetres,
    KilogramSquareMetres,
    KilogramSquareMetres,
    KilogramSquareMetres,
]


class AssumptionEntry(DocumentModel):
    """An assumption with its rationale."""

    about: Text
    rationale: Text


class CylinderEntry(DocumentModel):
    """An upright cylinder."""

    radius: Metres
    height: Metres


class BodyEntry(DocumentModel):
    """A fixed body; exactly one of `box` and `cylinder`."""

    id: Identifier
    box: Point | None = None
    cylinder: CylinderEntry | None = None
    foot: Point
    yaw: Radians = 0.0
    friction: Dimensionless
    colour: Colour | None = None
    moves_with_robot: bool = False


class CollisionShapes(str, Enum):
    """Convex approximation of a mesh for contact and collision checks."""

    HULL = "hull"
    DECOMPOSE = "decompose"
    BOXES = "boxes"


class Rest(str, Enum):
    """Resting pose of an object: as its shape is described, or tipped by 90 deg about its y axis."""

    UPRIGHT = "upright"
    LYING = "lying"


class GivenGraspEntry(DocumentModel):
    """A grasp of an object: the frame of the grasp centre in the frame of the shape, and the distance of the pads."""

    id: Identifier
    at: Point
    roll: Radians = 0.0
    pitch: Radians = 0.0
    yaw: Radians = 0.0
    width: Metres


class WorkpieceEntry(DocumentModel):
    """The object to carry; its shape is a box, a cylinder, a mesh, or the radius and height of a cylinder."""

    id: Identifier
    radius: Metres | None = None
    height: Metres | None = None
    box: Point | None = None
    cylinder: CylinderEntry | None = None
    mesh: Text | None = None
    scale: Dimensionless = 1.0
    collision: CollisionShapes | None = None
    rests: Rest = Rest.UPRIGHT
    yaw: Radians = 0.0
    mass: Kilograms | None = None
    density: KilogramsPerCubicMetre | None = None
    centre_of_mass: Point | None = None
    inertia: Inertia | None = None
    rolling_resistance: Metres | None = None
    grasps: tuple[GivenGraspEntry, ...] = ()
    friction: Dimensionless
    force_limit: Newtons
    force_window: Seconds = FORCE_WINDOW_S
    landing_limit: MetresPerSecond = LANDING_LIMIT_M_S
    stands_on: Identifier
    at: PointOnTop
    colour: Colour | None = None


class PlaceRegionEntry(DocumentModel):
    """Place region of the object, on top of a body."""

    stands_on: Identifier
    at: PointOnTop
    radius: Metres
    largest_tilt: Radians
    largest_drop: Metres = LARGEST_DROP_M
    largest_drag: Metres = LARGEST_DRAG_M
    largest_turn: Radians | None = None


class GraspRule(str, Enum):
    """Rule of the grasp: the stated one from above, or the best of the default candidates."""

    AS_STATED = "as_stated"
    AUTOMATIC = "automatic"


class CandidatesEntry(DocumentModel):
    """Grasps of the object to try."""

    approaches: Annotated[tuple[Approach, ...], Field(min_length=1)] = GraspCandidates().approaches
    heights: Annotated[int, Field(ge=1, le=9)] = GraspCandidates().heights
    yaws: Annotated[int, Field(ge=1, le=36)] = GraspCandidates().yaws
    samples: Annotated[int, Field(ge=0, le=1000)] = GraspCandidates().samples


class GraspCandidatesEntry(DocumentModel):
    """Candidates, of which the best reachable one is chosen."""

    candidates: CandidatesEntry


class TaskEntry(DocumentModel):
    """Heights and yaw angles of the waypoints."""

    approach_height: Metres
    lift_height: Metres
    departure_height: Metres
    place_approach_height: Metres
    place_clearance: Metres
    largest_carry_tilt: Radians
    grasp_yaw: Radians
    place_yaw: Radians
    grasp: GraspRule | GraspCandidatesEntry = GraspRule.AS_STATED
    free_yaw: bool = False
    steps: Text | None = None


class RobotPlacementEntry(DocumentModel):
    """Robot file, and the pose of its base."""

    description: Text
    base: Point
    roll: Radians = 0.0
    pitch: Radians = 0.0
    yaw: Radians = 0.0


class OtherObjectEntry(WorkpieceEntry):
    """A further object, with its own place region."""

    place_region: PlaceRegionEntry


class NamedPlaceEntry(PlaceRegionEntry):
    """A place without an object of its own."""

    id: Identifier


class SceneDocument(DocumentModel):
    """A scene file."""

    scene: Identifier
    gravity: MetresPerSecondSquared
    robot: RobotPlacementEntry
    bodies: Annotated[tuple[BodyEntry, ...], Field(min_length=1)]
    workpiece: WorkpieceEntry
    place_region: PlaceRegionEntry
    workpieces: tuple[OtherObjectEntry, ...] = ()
    places: tuple[NamedPlaceEntry, ...] = ()
    frames: dict[Identifier, FrameEntry] = Field(default_factory=dict)
    task: TaskEntry
    uncertainty: dict[QuantityName, DistributionEntry] = Field(default_factory=dict)
    correlations: tuple[CorrelationEntry, ...] = ()
    assumptions: tuple[AssumptionEntry, ...] = ()


class JointEntry(DocumentModel):
    """One joint's limits."""

    name: Identifier
    range: tuple[JointPosition, JointPosition]
    speed: JointSpeed
    acceleration: JointAcceleration
    torque: JointEffort


class RobotDocument(DocumentModel):
    """A robot file."""

    robot: Identifier
    description: Text
    flange: Identifier
    joints: Annotated[tuple[JointEntry, ...], Field(min_length=1, max_length=MOST_JOINTS)]
    payload: Kilograms
    tool_speed: MetresPerSecond | None = None
    tool_acceleration: MetresPerSecondSquared
    home: Annotated[tuple[JointPosition, ...], Field(min_length=1, max_length=MOST_JOINTS)]
    frozen: dict[Identifier, JointPosition] = Field(default_factory=dict)
    without: tuple[Identifier, ...] = ()
    collision: CollisionShapes = CollisionShapes.HULL
    calibration: Text | None = None
    frames: dict[Identifier, FrameEntry] = Field(default_factory=dict)
    assumptions: tuple[AssumptionEntry, ...] = ()


class BaseEntry(CylinderEntry):
    """Base of a gripper; its mass applies if no design sets it."""

    mass: Kilograms | None = None


class FingerEntry(DocumentModel):
    """A finger's box (radial, tangential, axial), and its values that apply if no design sets them."""

    thickness: Metres
    width: Metres
    length: Metres
    mass: Kilograms | None = None
    speed: MetresPerSecond | None = None
    force: Newtons | None = None
    friction: Dimensionless | None = None
    drive_inertia: Kilograms | None = None


class CommandEntry(DocumentModel):
    """Commands of a gripper without feedback, each complete after a fixed time; neutral switches the drive off."""

    travel_time: Seconds
    unpowered_force: Newtons = 0.0


class FirmGraspEntry(DocumentModel):
    """Condition of a firm grasp: the normal force that each finger must exceed."""

    finger_force: Newtons


class GripperDocument(DocumentModel):
    """Gripper file of prismatic fingers that close by the same stroke towards the axis."""

    gripper: Identifier
    kind: Literal["fingers"] = "fingers"
    azimuths: Annotated[tuple[Radians, ...], Field(min_length=2)]
    base: BaseEntry
    finger: FingerEntry
    largest_opening: Metres
    stroke: Metres
    grasp_depth: Metres
    firm_grasp: FirmGraspEntry | None = None
    mounting: Identifier | None = None
    assumptions: tuple[AssumptionEntry, ...] = ()
