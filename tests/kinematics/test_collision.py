"""Freedom from collision: cases made by hand, and every pair of solids tried on its own."""

from __future__ import annotations

import itertools
import math
import subprocess
import sys
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.kinematics import Arm, CollisionContext, CollisionModel
from rgss.scenes import Box, Pose

FREE = (0.0, -1.5, 1.5, -1.5, -1.5, 0.0)
ELBOW_UP = (-0.19, -1.77, -1.86, -1.08, 1.57, -1.76)


@pytest.fixture
def held(scene):
    """The cup in the hand, its centre on the grasp centre."""
    return scene.grasp.inverse() @ scene.workpiece.pose


@pytest.fixture
def empty(scene):
    """Nothing in the hand, nothing on the counter."""
    return CollisionContext(opening_m=0.07)


def reaching(inverse, position_m, yaw_rad=0.0, near=ELBOW_UP):
    pose = Pose.from_roll_pitch_yaw(position_m, (math.pi, 0.0, yaw_rad))
    return inverse.nearest(pose, near)


def test_a_configuration_in_free_space_is_valid(scene, gripper, empty):
    model = CollisionModel(scene, gripper, empty)
    assert model.contacts(FREE) == ()
    assert model.is_valid(FREE)
    assert model.distance(FREE) > 0.0


def test_the_arm_in_the_counter(scene, gripper, empty):
    model = CollisionModel(scene, gripper, empty)
    into_the_counter = (math.pi, 0.25, 0.0, 0.0, -1.5, 0.0)
    assert not model.is_valid(into_the_counter)
    assert ("counter", "forearm_link") in model.contacts(into_the_counter)
    assert model.distance(into_the_counter) < 0.0


def test_the_fingers_in_the_counter(scene, gripper, empty, inverse):
    model = CollisionModel(scene, gripper, empty)
    # The finger tips are 30 mm below the grasp centre, the counter's top is at 0.90 m.
    assert model.is_valid(reaching(inverse, (0.70, -0.30, 0.931)))
    low = reaching(inverse, (0.70, -0.30, 0.929))
    assert model.contacts(low) == tuple(("counter", f"finger_{number}") for number in (1, 2, 3))


def test_the_cup_on_the_counter_between_the_open_fingers(scene, gripper, inverse):
    model = CollisionModel(scene, gripper, CollisionContext(opening_m=0.07, standing=scene.workpiece.pose))
    assert model.is_valid(reaching(inverse, (0.70, -0.30, 0.95)))


def test_a_finger_that_comes_down_on_the_cup(scene, gripper, inverse):
    model = CollisionModel(scene, gripper, CollisionContext(opening_m=0.07, standing=scene.workpiece.pose))
    beside = reaching(inverse, (0.70 - 0.07 - 0.006, -0.30, 0.95))
    assert not model.is_valid(beside)
    assert ("cup", "finger_1") in model.contacts(beside)


def test_closed_fingers_touch_the_cup_unless_that_is_allowed(scene, gripper, inverse):
    at_grasp = reaching(inverse, (0.70, -0.30, 0.95))
    closed = CollisionContext(opening_m=0.0345, standing=scene.workpiece.pose)
    assert {pair[0] for pair in CollisionModel(scene, gripper, closed).contacts(at_grasp)} == {"cup"}
    allowed = frozenset({("cup", "finger_1"), ("finger_2", "cup"), ("cup", "finger_3")})
    assert CollisionModel(scene, gripper, replace(closed, allowed=allowed)).is_valid(at_grasp)


def test_the_carried_cup_in_the_shelf(scene, gripper, held, inverse):
    # Held below the shelf's front edge, the hand in front of it and the cup's rim in the board.
    at_the_edge = reaching(inverse, (0.70, 0.09, 1.45))
    without = CollisionModel(scene, gripper, CollisionContext(opening_m=0.036))
    carrying = CollisionModel(scene, gripper, CollisionContext(opening_m=0.036, carried=held))
    contacts = set(carrying.contacts(at_the_edge)) - set(without.contacts(at_the_edge))
    assert contacts == {("cup", "shelf")}
    assert not carrying.is_valid(at_the_edge)


def test_the_carried_cup_against_the_counter_is_allowed_when_asked_for(scene, gripper, held, inverse):
    at_grasp = reaching(inverse, (0.70, -0.30, 0.9499))
    carrying = CollisionContext(opening_m=0.036, carried=held)
    assert CollisionModel(scene, gripper, carrying).contacts(at_grasp) == (("counter", "cup"),)
    lifting = replace(carrying, allowed=frozenset({("cup", "counter")}))
    assert CollisionModel(scene, gripper, lifting).is_valid(at_grasp)


def test_what_is_held_is_not_checked_against_the_hand(scene, gripper, held):
    squeezed = CollisionContext(opening_m=0.02, carried=held)
    assert CollisionModel(scene, gripper, squeezed).is_valid(FREE)


def test_the_folded_arm_touches_itself(scene, gripper, empty):
    model = CollisionModel(scene, gripper, empty)
    folded = (0.0, -1.5, 3.1, 0.0, 0.0, 0.0)
    assert ("forearm_link", "shoulder_link") in model.contacts(folded)
    assert not model.is_valid(folded)


def test_neighbouring_links_and_the_pedestal_are_not_counted(scene, gripper, empty, configurations):
    model = CollisionModel(scene, gripper, empty)
    chain = ["base_link", "shoulder_link", "upper_arm_link", "forearm_link", "wrist_1_link", "wrist_2_link"]
    chain.append("wrist_3_link")
    neighbours = {tuple(sorted(pair)) for pair in itertools.pairwise(chain)}
    seen = {pair for q in configurations(300) for pair in model.contacts(q)}
    assert not seen & neighbours
    assert ("base_link", "pedestal") not in seen


@pytest.mark.verifies("SYS-015")
def test_beyond_a_joint_range_nothing_is_valid(scene, gripper, empty, robot):
    model = CollisionModel(scene, gripper, empty)
    assert not model.is_valid((*FREE[:5], robot.joints[5].upper_rad + 1e-3))
    assert not model.is_valid(np.array([*FREE[:2], robot.joints[2].lower_rad - 1e-3, *FREE[3:]]))
    assert model.is_valid((*FREE[:5], robot.joints[5].upper_rad))


def test_clearance_keeps_the_hand_from_the_scene(scene, gripper, empty, inverse):
    near = reaching(inverse, (0.70, -0.30, 0.938))
    assert CollisionModel(scene, gripper, empty).distance(near) == pytest.approx(0.008, abs=1e-6)
    assert CollisionModel(scene, gripper, empty, clearance_m=0.0079).is_valid(near)
    kept = CollisionModel(scene, gripper, empty, clearance_m=0.0081)
    assert not kept.is_valid(near)
    assert ("counter", "finger_1") in kept.contacts(near)


def test_clearance_is_not_asked_of_the_cup_above_what_it_stands_on(scene, gripper, held, inverse):
    placing = CollisionContext(opening_m=0.036, carried=held)
    just_above = reaching(inverse, (0.70, -0.30, 0.953))
    model = CollisionModel(scene, gripper, placing, clearance_m=0.01)
    assert model.is_valid(just_above)
    assert not model.is_valid(reaching(inverse, (0.70, -0.30, 0.9499)))


def test_clearance_is_not_asked_between_links(scene, gripper, empty, configurations):
    plain = CollisionModel(scene, gripper, empty)
    wide = CollisionModel(scene, gripper, empty, clearance_m=0.03)
    bodies = {body.id for body in scene.bodies}
    for q in configurations(200, seed=1):
        own = {pair for pair in wide.contacts(q) if not bodies & set(pair)}
        assert own == {pair for pair in plain.contacts(q) if not bodies & set(pair)}


def test_an_allowed_contact_with_what_is_not_there(scene, gripper):
    situation = CollisionContext(opening_m=0.07, allowed=frozenset({("cup", "tabel"), ("fingers", "cup")}))
    with pytest.raises(DefinitionError) as caught:
        CollisionModel(scene, gripper, situation)
    assert caught.value.message == "a contact is allowed with fingers, tabel, which is not in the scene bench"
    assert "finger_1" in caught.value.hint
    assert "counter" in caught.value.hint


def test_collision_shapes_that_cannot_be_read(scene, gripper, empty, new_robot, capfd):
    shape = '<geometry><cylinder radius="0.075" length="0.038"/></geometry>'
    urdf = new_robot().urdf.replace(shape, '<geometry><mesh filename="package://nowhere/base.stl"/></geometry>')
    with pytest.raises(DefinitionError, match="the collision shapes of the robot ur10 cannot be read"):
        CollisionModel(replace(scene, robot=new_robot(urdf=urdf)), gripper, empty)


def test_a_verdict_depends_on_the_configuration_alone(scene, gripper, empty, configurations):
    guide = CollisionModel(scene, gripper, empty)
    qs = configurations(120, seed=2)
    # States within a tenth of a millimetre of touching, where a solver's starting point could tell.
    near = []
    for one, other in itertools.pairwise(qs):
        verdict = guide.is_valid(one)
        if verdict != guide.is_valid(other):
            low, high = 0.0, 1.0
            for _ in range(16):
                middle = (low + high) / 2
                near.append(one + middle * (other - one))
                low, high = (middle, high) if guide.is_valid(near[-1]) == verdict else (low, middle)
    assert len(near) > 500
    forward, backward = (CollisionModel(scene, gripper, empty) for _ in range(2))
    ahead = [forward.contacts(q) for q in near]
    behind = [backward.contacts(q) for q in reversed(near)]
    assert ahead == behind[::-1]
    assert [forward.is_valid(q) for q in near] == [not contacts for contacts in ahead]
    assert [CollisionModel(scene, gripper, empty).contacts(q) for q in near[15::16]] == ahead[15::16]


class EveryPair:
    """All solids from the description and the scene, placed by plain matrix products, each pair tried on its own."""

    def __init__(self, scene, gripper, situation, link_frames, matrix_of):
        import coal

        self.coal, self.link_frames, self.base = coal, link_frames, matrix_of(scene.robot.base)
        root = ET.fromstring(scene.robot.urdf)  # noqa: S314 - our own file
        links = ["base_link", "shoulder_link", "upper_arm_link", "forearm_link"]
        links += [f"wrist_{number}_link" for number in (1, 2, 3)]
        self.solids = []
        for number, name in enumerate(links):
            for element in root.findall(f"link[@name='{name}']/collision"):
                origin, cylinder = element.find("origin"), element.find("geometry/cylinder")
                xyz = tuple(float(value) for value in origin.get("xyz").split())
                rpy = tuple(float(value) for value in origin.get("rpy").split())
                shape = coal.Cylinder(float(cylinder.get("radius")), float(cylinder.get("length")))
                self.solids.append((name, number, matrix_of(Pose.from_roll_pitch_yaw(xyz, rpy)), shape))
        hand = [("gripper_base", gripper.base_pose, gripper.base)]
        hand += [
            (f"finger_{index + 1}", gripper.finger_pose(index, situation.opening_m), gripper.finger)
            for index in range(gripper.fingers)
        ]
        if situation.carried is not None:
            hand.append(("cup", gripper.grasp_centre @ situation.carried, scene.workpiece.shape))
        self.solids += [(name, 7, matrix_of(pose), self.solid(shape)) for name, pose, shape in hand]
        fixed = [(body.id, body.pose, body.shape) for body in scene.bodies]
        if situation.standing is not None:
            fixed.append(("cup", situation.standing, scene.workpiece.shape))
        self.solids += [(name, None, matrix_of(pose), self.solid(shape)) for name, pose, shape in fixed]

    def solid(self, shape):
        if isinstance(shape, Box):
            return self.coal.Box(*shape.size_m)
        return self.coal.Cylinder(shape.radius_m, shape.height_m)

    def contacts(self, q):
        frames = self.link_frames(q)
        placed = []
        for name, number, local, shape in self.solids:
            if number is None:
                matrix = local
            elif number == 0:
                matrix = self.base @ local
            elif number == 7:
                matrix = self.base @ frames[6] @ local
            else:
                # Link i turns with joint i about z of frame i-1: frame i without the transform along the link.
                turned = frames[number - 1].copy()
                c, s = math.cos(q[number - 1]), math.sin(q[number - 1])
                turned[:3, :3] = turned[:3, :3] @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
                matrix = self.base @ turned @ local
            placed.append((name, number, self.coal.Transform3s(matrix[:3, :3], matrix[:3, 3]), shape))
        distances = {}
        for index, (one, first, here, shape) in enumerate(placed):
            for other, second, there, other_shape in placed[index + 1 :]:
                still = {None, 0}
                if {first, second} <= still or (first is not None and second is not None and abs(first - second) < 2):
                    continue
                request, result = self.coal.DistanceRequest(), self.coal.DistanceResult()
                pair = tuple(sorted((one, other)))
                distance = self.coal.distance(shape, here, other_shape, there, request, result)
                distances[pair] = min(distance, distances.get(pair, math.inf))
        return distances


@pytest.mark.parametrize("kind", ["standing", "carried"])
def test_contacts_equal_those_of_every_pair_on_its_own(
    kind, scene, gripper, held, configurations, link_frames, matrix_of
):
    situation = {
        "standing": CollisionContext(opening_m=0.07, standing=scene.workpiece.pose),
        "carried": CollisionContext(opening_m=0.036, carried=held),
    }[kind]
    model = CollisionModel(scene, gripper, situation)
    every_pair = EveryPair(scene, gripper, situation, link_frames, matrix_of)
    touching = 0
    for q in configurations(250, seed=3):
        distances = every_pair.contacts(q)
        contacts = set(model.contacts(q))
        touching += bool(contacts)
        assert {pair for pair, distance in distances.items() if distance < -1e-5} <= contacts
        assert contacts <= {pair for pair, distance in distances.items() if distance < 1e-5}
        assert model.is_valid(q) == (not contacts)
        assert model.distance(q) == pytest.approx(min(distances.values()), abs=1e-5)
    assert 50 < touching < 200


def test_the_tool_of_arm_and_collision_model_is_the_same(scene, gripper, robot, inverse):
    """A ball-like cup at the grasp centre touches a body exactly when the arm says that the tool is there."""
    arm = Arm(robot, gripper.grasp_centre)
    q = reaching(inverse, (0.70, -0.30, 1.1))
    x, y, z = arm.tool_pose(q).position_m
    probe = replace(scene.bodies[2], id="probe", shape=Box(size_m=(0.002,) * 3), pose=Pose(position_m=(x, y, z)))
    model = CollisionModel(
        replace(scene, bodies=(*scene.bodies, probe)), gripper, CollisionContext(opening_m=0.07, carried=Pose())
    )
    assert ("cup", "probe") in model.contacts(q)


def test_the_first_invalid_of_many_is_the_first_that_is_invalid(scene, gripper, held):
    carrying = CollisionContext(
        opening_m=scene.workpiece.shape.radius_m, carried=held, largest_tilt_rad=math.radians(45.0)
    )
    model = CollisionModel(scene, gripper, carrying, clearance_m=0.008)
    rng = np.random.default_rng(2)
    lower, upper = (
        np.array([getattr(joint, f"{end}_rad") for joint in scene.robot.joints]) for end in ("lower", "upper")
    )
    lengths = []
    for _ in range(200):
        start, end = rng.uniform(lower, upper, (2, 6))
        states = start + (end - start) * np.linspace(0.0, 1.0, 12)[:, None]
        verdicts = [model.is_valid(state) for state in states]
        first = next((index for index, valid in enumerate(verdicts) if not valid), None)
        assert model.first_invalid_between(states) == first
        lengths.append(len(states) if first is None else first)
    assert max(lengths) > 2
    assert min(lengths) == 0


def test_the_clearance_is_the_greatest_that_a_model_can_keep(scene, gripper, empty, configurations):
    """Bisected by models with a clearance of their own, which make no query of a distance."""
    model = CollisionModel(scene, gripper, empty)
    free = [q for q in configurations(200) if model.is_valid(q)][:12]
    assert len(free) == 12
    for q in free:
        clearance_m = model.clearance_m(q)
        assert 0.0 < clearance_m < 5.0
        for change_m, valid in ((-1e-5, True), (1e-5, False)):
            kept = CollisionModel(scene, gripper, empty, clearance_m=clearance_m + change_m)
            assert kept.is_valid(q) == valid


def test_links_of_the_arm_do_not_count_as_clearance(scene, gripper, empty, configurations):
    model = CollisionModel(scene, gripper, empty)
    assert any(model.clearance_m(q) > model.distance(q) + 0.01 for q in configurations(100))
    assert all(model.clearance_m(q) >= model.distance(q) for q in configurations(100))


def test_the_clearance_is_the_least_of_all_pairs_that_keep_one(scene, gripper, empty, configurations):
    """Also where the arm is in the furniture: the depth then."""
    model = CollisionModel(scene, gripper, empty)
    inside = 0
    for q in configurations(300):
        model.distance(q)
        everything = [float(model._state.distanceResults[index].min_distance) for index in model._clear]
        assert model.clearance_m(q) == min(everything)
        inside += min(everything) < 0.0
    assert 20 < inside < 290


_DISTANCES = """
import sys
import coal
from rgss.kinematics.description import transform
from rgss.kinematics.geometry import solid_of
from rgss.kinematics.overlap_search import Solid, overlaps
from rgss.scenes import Box, Cylinder, Pose

box, cup = Box(size_m=(0.4, 0.3, 0.2)), Cylinder(radius_m=0.04, height_m=0.1)
if sys.argv[1] == "boxes first":
    places = {"a": Pose(), "b": Pose(position_m=(1.0, 0.0, 0.0))}
    solids = [Solid(name=name, shape=box, pose=pose) for name, pose in places.items()]
    assert overlaps(solids, deeper_than_m=0.0) == ()
for step in range(20):
    place = transform(Pose.from_roll_pitch_yaw((0.4, 0.1 * step, 0.3), (0.1 + 0.2 * step, 0.3, 0.5)))
    there = coal.Transform3s(place.rotation, place.translation)
    one = coal.Transform3s.Identity()
    print(coal.distance(solid_of(cup), there, solid_of(box), one, coal.DistanceRequest(), coal.DistanceResult()))
"""


@pytest.mark.verifies("SYS-021")
def test_distances_do_not_depend_on_the_first_query_of_a_process():
    """Coal sizes all boxes of a process by the direction of its first query of one."""
    first, after = (
        subprocess.run([sys.executable, "-c", _DISTANCES, order], capture_output=True, text=True, check=True).stdout
        for order in ("cup first", "boxes first")
    )

    assert len(first.split()) == 20
    assert first == after
