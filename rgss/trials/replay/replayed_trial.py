"""Execution of a trial with a replay."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import TrialRecord
from rgss.evidence.records import TrialTrace
from rgss.physics import Contacts, ContactWorld, Posture, SeenSolid, Stage, object_surfaces
from rgss.scenes import Pose, Scene, Workpiece
from rgss.trials.conditions import conditions_of
from rgss.trials.marked_places import marked_places
from rgss.trials.monitors import StepObserver
from rgss.trials.pieces import run_trial
from rgss.trials.replay.planned_lines import planned_lines
from rgss.trials.replay.replay_recorder import ReplayRecorder
from rgss.trials.replay.replay_scene import ContactForce, NodeKind, NodeTrack, PerceivedOffset, ReplayScene
from rgss.trials.tracing import TraceRecorder
from rgss.trials.trial_spec import TrialSpec
from rgss.trials.workcell import cell_of, with_grasp_of

REPLAY_RATE_HZ = 60.0

MOST_SAMPLES = 2400
"""Greatest number of samples of a replay; longer trials are sampled at a lower rate, to limit the file size."""

_PERCEIVED_COLOUR = (0.55, 0.25, 0.75, 0.35)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ReplayedTrial:
    """Trial with its trace and replay.

    Attributes:
        record: Its record, the same as without a replay.
        trace: Its trace; None if nothing moved.
        scene: Scene of the replay; None if nothing moved.
    """

    record: TrialRecord
    trace: TrialTrace | None
    scene: ReplayScene | None


def run_replayed_trial(spec: TrialSpec) -> ReplayedTrial:
    """Run one trial of contact fidelity and record its replay.

    Raises:
        DefinitionError: The fidelity is not available.
        SimulationError: The physics engine cannot build the world.
    """
    physics = spec.settings.physics
    objects = tuple(one.workpiece.id for one in conditions_of(spec).true_scene.objects)
    fingers = spec.gripper.geometry.fingers
    tracer = TraceRecorder(spec)
    recorder = ReplayRecorder(objects, fingers=fingers, step_s=physics.step_s, rate_hz=REPLAY_RATE_HZ)
    record = run_trial(spec, observer=_Observers((tracer, recorder)))
    trace = tracer.trace({phase.phase for phase in record.phases if phase.duration_s is not None})
    scene = None if trace is None else _scene_of(spec, recorder, trace.spans[-1].end_s)
    return ReplayedTrial(record=record, trace=trace, scene=scene)


class _Observers:
    """Composite observer."""

    def __init__(self, observers: tuple[StepObserver, ...]) -> None:
        self._observers = observers

    def after_step(
        self,
        world: ContactWorld,
        phase: str,
        contacts: Contacts,
        grip_margin: float | None,
        commanded_force_n: float | None,
    ) -> None:
        """Pass a step to each observer."""
        for observer in self._observers:
            observer.after_step(world, phase, contacts, grip_margin, commanded_force_n)


def _scene_of(spec: TrialSpec, recorder: ReplayRecorder, end_s: float) -> ReplayScene:
    conditions = conditions_of(spec)
    true_scene = with_grasp_of(conditions.true_scene, cell_of(spec))
    total = recorder.count_until(end_s)
    every = -(-total // MOST_SAMPLES)
    chosen = np.unique(np.append(np.arange(0, total, every), total - 1))
    joints = recorder.joints_rad(total)[chosen]
    if offsets := conditions.joint_offsets_rad:  # the replay shows the true positions of the arm, not the reported ones
        joints = joints + np.array(offsets)
    nodes = _machine_nodes(true_scene, spec, joints, recorder.travel_m(total)[chosen])
    for one in true_scene.objects:
        poses = recorder.poses_of(one.workpiece.id, total)
        nodes.append(_object_node(one.workpiece, NodeKind.OBJECT, [poses[index] for index in chosen]))
    seen = [one.workpiece for one in conditions.perceived_scene.objects]
    nodes += [_object_node(one, NodeKind.PERCEIVED, [one.pose], colour=_PERCEIVED_COLOUR) for one in seen]
    forces = [recorder.contacts_of(finger, total)[chosen] for finger in range(recorder.pressing)]
    return ReplayScene(
        time_s=recorder.times_s(total)[chosen],
        nodes=tuple(nodes),
        contacts=tuple(
            ContactForce(finger=finger, points_m=rows[:, :3], forces_n=rows[:, 3:])
            for finger, rows in enumerate(forces)
        ),
        touches=recorder.touches(end_s),
        lines=planned_lines(spec),
        perceived=tuple(_offset(true.workpiece, one) for true, one in zip(true_scene.objects, seen, strict=True)),
    )


def _machine_nodes(
    scene: Scene, spec: TrialSpec, joints: NDArray[np.float64], travel: NDArray[np.float64]
) -> list[NodeTrack]:
    """Nodes of the fixed bodies, and of the links of arm and gripper over time."""
    places = marked_places(scene, spec.task)
    stage = Stage(scene, spec.gripper, places.values())
    try:
        solids = stage.solids()
        poses: dict[str, list[Pose]] = {}
        for row, closed in zip(joints.tolist(), travel.tolist(), strict=True):
            stage.take(Posture(joints_rad=row, finger_travel_m=closed, workpiece=scene.workpiece.pose))
            for link, pose in stage.link_poses().items():
                poses.setdefault(link, []).append(pose)
    finally:
        stage.close()
    # The mats that mark places come after the bodies of the scene.
    names = [*(body.id for body in scene.bodies), *places]
    fixed = [solid for solid in solids if not solid.link]
    nodes = [_node(name, NodeKind.BODY, (solid,), [Pose()]) for name, solid in zip(names, fixed, strict=True)]
    for link, track in poses.items():
        carried = tuple(solid for solid in solids if solid.link == link)
        nodes.append(_node(link, NodeKind.LINK, carried, track))
    return nodes


def _object_node(
    workpiece: Workpiece, kind: NodeKind, poses: list[Pose], *, colour: tuple[float, ...] | None = None
) -> NodeTrack:
    solids = tuple(
        SeenSolid(link=workpiece.id, surface=surface, pose=at, colour=colour or workpiece.colour)
        for surface, at, _ in object_surfaces(workpiece.shape)
    )
    return _node(workpiece.id, kind, solids, poses)


def _node(name: str, kind: NodeKind, solids: tuple[SeenSolid, ...], poses: list[Pose]) -> NodeTrack:
    """Node; a single sample if it never moves."""
    positions = np.array([pose.position_m for pose in poses])
    quaternions = np.array([pose.quaternion_xyzw for pose in poses])
    # A quaternion and its negative are the same rotation; the one nearer to the previous sample is used.
    turns = np.sum(quaternions[1:] * quaternions[:-1], axis=1)
    quaternions[1:] *= np.cumprod(np.where(turns < 0.0, -1.0, 1.0))[:, np.newaxis]
    if np.ptp(positions, axis=0).max() == 0.0 and np.ptp(quaternions, axis=0).max() == 0.0:
        positions, quaternions = positions[:1], quaternions[:1]
    return NodeTrack(name=name, kind=kind, solids=solids, positions_m=positions, quaternions_xyzw=quaternions)


def _offset(true: Workpiece, perceived: Workpiece) -> PerceivedOffset:
    relative = perceived.pose.relative_to(true.pose)
    return PerceivedOffset(
        object=true.id,
        distance_m=math.dist(true.pose.position_m, perceived.pose.position_m),
        angle_rad=2.0 * math.acos(min(1.0, abs(relative.quaternion_xyzw[3]))),
    )
