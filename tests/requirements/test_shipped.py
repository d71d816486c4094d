"""The project's own requirements: complete in the sense of the source."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rgss.evidence import Failure
from rgss.quantities import dimension
from rgss.requirements import (
    BehaviourKind,
    BlockLevel,
    FlowNodeKind,
    LinkKind,
    NeedKind,
    RequirementGroup,
    RequirementSet,
    Status,
    VerificationMethod,
    load_requirements,
)
from tests.fixtures.eight_states import Phase

ROOT = Path(__file__).parents[2]

ON_DEMAND = ["initialise-simulation", "execute-simulation", "pause-simulation", "resume-simulation"]
ON_DEMAND += ["shut-down-simulation", "move", "grasp", "lift", "place", "open-gripper", "close-gripper", "plan-path"]
ON_DEMAND += ["detect-collisions"]
STATES = [phase.value.replace("_", "-") for phase in Phase]
CONTEXT = ["BLK-rgss", "BLK-environment", "BLK-users"]
SYSTEM = ["BLK-manipulator", "BLK-end-effector", "BLK-actuators", "BLK-sensors", "BLK-algorithms"]
SYSTEM += ["BLK-simulated-physics", "BLK-simulation-script", "BLK-simulation-scene"]


@pytest.fixture(scope="module")
def shipped() -> RequirementSet:
    return load_requirements(ROOT / "requirements")


@pytest.fixture(scope="module")
def behaviours(shipped):
    return {behaviour.id: behaviour for behaviour in shipped.architecture.behaviours}


def children(shipped, parent):
    return [block.id for block in shipped.architecture.blocks if block.parent == parent]


def test_stakeholder_ids_are_those_of_the_source(shipped):
    ids = [need.id for need in shipped.stakeholder]
    assert ids == ["STK-006", "STK-010", "STK-011", "STK-012", "STK-021", "STK-095", "STK-097"]


def test_every_kind_of_need_and_every_group_of_requirements_occurs(shipped):
    assert {need.kind for need in shipped.stakeholder} == set(NeedKind)
    assert {requirement.group for requirement in shipped.system} == set(RequirementGroup)


def test_system_ids_are_numbered_without_a_gap(shipped):
    assert sorted(item.id for item in shipped.system) == [f"SYS-{n:03}" for n in range(1, len(shipped.system) + 1)]


def test_each_group_has_a_file_of_its_own_in_the_order_of_the_groups(shipped):
    groups = list(dict.fromkeys(requirement.group for requirement in shipped.system))
    assert groups == list(RequirementGroup)
    for number, group in enumerate(groups, start=1):
        files = {shipped.places[item.id].document.label for item in shipped.system if item.group is group}
        assert files == {f"requirements/system/{number}-{group.value}.yaml"}


def test_texts_are_ears_sentences_with_one_shall(shipped):
    for item in (*shipped.stakeholder, *shipped.system):
        assert len(re.findall(r"\bshall\b", item.text)) == 1, item.id
        assert re.match(r"(The|When|While|If|Where) [^.]*( shall )[^.]*(\.\d[^.]*)?\.$", item.text), item.id
        assert item.text.startswith("If") == ("then the " in item.text), item.id


def test_every_requirement_has_every_attribute(shipped):
    for item in shipped.system:
        assert item.derived_from, item.id
        assert item.satisfied_by, item.id
        assert item.verification, item.id
        assert item.facility, item.id
        assert item.phase, item.id
        assert item.status is Status.APPROVED
        assert (item.criterion is None) == bool(item.success), item.id


def test_each_measure_of_effectiveness_has_its_criterion(shipped):
    bounds = {item.id: str(item.criterion) for item in shipped.system if item.criterion is not None}
    measures = {item.criterion.measure for item in shipped.system if item.criterion is not None}
    assert bounds["SYS-012"] == "P_max_simulated >= 0.8 kg"
    assert bounds["SYS-005"] == "t_e_simulated <= 25 s"
    assert measures >= {"P_max_simulated", "C_total", "t_e_simulated", "t_p", "S"}


def test_a_criterion_stands_exactly_where_the_method_is_analysis(shipped):
    for requirement in shipped.system:
        assert (requirement.criterion is not None) == (requirement.verification is VerificationMethod.ANALYSIS)


def test_every_relation_that_files_can_state_is_used(shipped):
    """Verify is the relation of a measure or a test to the requirement; measures and tests state it."""
    assert {link.kind for link in shipped.links} == set(LinkKind) - {LinkKind.VERIFY}


def test_relations_hold_between_what_they_are_for(shipped):
    kinds = {link.kind: set() for link in shipped.links}
    for link in shipped.links:
        kinds[link.kind].add((link.source.split("-")[0], link.target.split("-")[0]))
    assert kinds[LinkKind.CONTAINMENT] == {("STK", "STK"), ("SYS", "SYS"), ("BLK", "BLK")}
    assert kinds[LinkKind.DERIVE] == {("SYS", "STK"), ("SYS", "SYS")}
    assert kinds[LinkKind.SATISFY] == {(kind, "SYS") for kind in ("BLK", "UC", "ACT", "SEQ", "STM")}
    assert kinds[LinkKind.ALLOCATE] == {(kind, "BLK") for kind in ("UC", "ACT", "SEQ", "STM")}
    assert kinds[LinkKind.REFINE] >= {("UC", "STK"), ("ACT", "UC"), ("SEQ", "UC"), ("STM", "UC"), ("STM", "SYS")}
    assert kinds[LinkKind.TRACE] == {("SYS", "SYS"), ("SEQ", "SYS")}


def test_blocks_hang_on_one_context(shipped):
    assert [block.id for block in shipped.architecture.blocks if block.parent is None] == ["BLK-context"]
    assert children(shipped, "BLK-context") == CONTEXT
    assert children(shipped, "BLK-rgss") == SYSTEM


@pytest.mark.parametrize(
    ("parent", "inner"),
    [
        ("BLK-computer", {"modelling-tool", "programming-platform", "simulator", "trade-off-tool"}),
        ("BLK-users", {"systems-engineer", "industry"}),
        ("BLK-manipulator", {"manipulator-links", "manipulator-joints"}),
        ("BLK-end-effector", {"tools", "grippers"}),
        ("BLK-multi-finger-gripper", {"gripper-base", "gripper-fingers"}),
        ("BLK-gripper-fingers", {"gripper-finger-links", "gripper-finger-joints"}),
        ("BLK-manipulator-joints", {f"manipulator-{kind}-joint" for kind in ("screw", "spherical", "revolute")}),
        ("BLK-gripper-finger-joints", {f"finger-{kind}-joint" for kind in ("screw", "spherical", "revolute")}),
        ("BLK-actuators", {f"{kind}-actuator" for kind in ("linear", "rotary", "electric", "pneumatic", "hydraulic")}),
        ("BLK-sensors", {"proximity-sensor", "tactile-sensor", "force-torque-sensor", "camera", "pressure-sensor"}),
        ("BLK-algorithms", {"planning-algorithms", "control-algorithms", "evaluation-algorithms"}),
        ("BLK-planning-algorithms", {"rrt", "trrt", "stride"}),
        ("BLK-simulated-physics", {"kinematics", "dynamics", "joint-dynamics", "materials"}),
        ("BLK-simulation-scene", {"restaurant-scene"}),
    ],
)
def test_the_structure_is_decomposed_as_in_the_source(shipped, parent, inner):
    assert {block.removeprefix("BLK-") for block in children(shipped, parent)} >= inner


@pytest.mark.verifies("SYS-028")
def test_the_restaurant_scene_has_its_bodies(shipped):
    parts = {block.name for block in shipped.architecture.blocks if block.parent == "BLK-restaurant-scene"}
    assert parts == {"L-shaped counter-top", "Tables", "Chairs", "Floor", "Cup"}


def test_a_block_stands_no_higher_than_its_parent(shipped):
    levels = list(BlockLevel)
    by_id = {block.id: block for block in shipped.architecture.blocks}
    for block in shipped.architecture.blocks:
        if block.parent is not None:
            assert levels.index(block.level) >= levels.index(by_id[block.parent].level), block.id


def test_use_cases_are_those_of_the_source_with_those_who_take_part(shipped, behaviours):
    use_cases = [item for item in behaviours.values() if item.kind is BehaviourKind.USE_CASE]
    assert [item.id for item in use_cases] == [f"UC-{name}" for name in ON_DEMAND]
    users = set(children(shipped, "BLK-users"))
    assert {actor for item in use_cases for actor in item.actors} == users
    assert {block.id for block in shipped.architecture.blocks if block.actor} == users


def test_each_need_is_refined_by_a_use_case(shipped, behaviours):
    refined = {target for item in behaviours.values() for target in item.refines}
    assert {need.id for need in shipped.stakeholder} <= refined


@pytest.mark.parametrize("name", [*ON_DEMAND, *STATES])
def test_each_use_case_and_each_state_has_one_activity_and_one_sequence(behaviours, name):
    activity, sequence = behaviours[f"ACT-{name}"], behaviours[f"SEQ-{name}"]
    assert activity.flow is not None
    assert sequence.interaction is not None
    assert {target for target in activity.refines if target.startswith("UC-")}
    assert set(sequence.refines) <= set(activity.refines)
    calls = {message.does for message in sequence.interaction.messages}
    assert activity.id in calls


def test_each_use_case_is_spelled_out_by_an_activity(behaviours):
    for item in behaviours.values():
        if item.kind is BehaviourKind.USE_CASE:
            refining = {other.kind for other in behaviours.values() if item.id in other.refines}
            assert refining >= {BehaviourKind.ACTIVITY, BehaviourKind.SEQUENCE}, item.id


def test_every_activity_and_sequence_has_its_detail(behaviours):
    assert [item.id for item in behaviours.values() if item.kind is BehaviourKind.ACTIVITY and item.flow is None] == []
    sequences = [item for item in behaviours.values() if item.kind is BehaviourKind.SEQUENCE]
    assert [item.id for item in sequences if item.interaction is None] == []


def test_the_eight_states_are_activities_in_their_order(behaviours):
    found = [item.removeprefix("ACT-") for item in behaviours if item.startswith("ACT-")]
    assert [name for name in found if name in STATES] == STATES


def test_what_a_use_case_includes_is_called_when_it_runs(behaviours):
    """An activity of a use case reaches an activity of each included one by calls, over any number of steps."""
    for use_case in behaviours.values():
        if use_case.kind is not BehaviourKind.USE_CASE:
            continue
        reached = called_from(behaviours, [f"ACT-{use_case.id.removeprefix('UC-')}"])
        for included in use_case.includes:
            # A grasp or a place is preceded by the move that the states have for it.
            if included != "UC-move":
                assert f"ACT-{included.removeprefix('UC-')}" in reached, (use_case.id, included)


def test_the_moves_of_the_task_are_moves(behaviours):
    for name in STATES:
        if name.startswith("move-"):
            calls = {node.does for node in behaviours[f"ACT-{name}"].flow.nodes}
            assert calls == {None, "ACT-move"}


def called_from(behaviours, names):
    reached, pending = set(), list(names)
    while pending:
        behaviour = behaviours[pending.pop()]
        if behaviour.id in reached:
            continue
        reached.add(behaviour.id)
        nodes = () if behaviour.flow is None else behaviour.flow.nodes
        states = () if behaviour.machine is None else behaviour.machine.states
        pending += [each.does for each in (*nodes, *states) if each.does is not None]
    return reached


def test_to_execute_the_simulation_is_to_do_everything_but_pause_and_choose(behaviours):
    activities = {item.id for item in behaviours.values() if item.kind is BehaviourKind.ACTIVITY}
    outside = {"ACT-pause-simulation", "ACT-resume-simulation", "ACT-choose-design"}
    assert called_from(behaviours, ["ACT-execute-simulation"]) & activities == activities - outside


def test_final_nodes_say_how_an_activity_ended(behaviours):
    for item in behaviours.values():
        ends = [node for node in item.flow.nodes if node.kind is FlowNodeKind.FINAL] if item.flow is not None else []
        if len(ends) > 1:
            assert all(node.text for node in ends), item.id
            named = re.findall(r"\b[A-Z]+_[A-Z_]+\b", " ".join(node.text for node in ends))
            assert all(name in Failure.__members__ for name in named), item.id


def test_a_sequence_is_allocated_to_lifelines_of_its_own(shipped, behaviours):
    bystanders = {"BLK-cup"} | {block.id for block in shipped.architecture.blocks if block.actor}
    for item in behaviours.values():
        if item.interaction is not None:
            lifelines = set(item.interaction.lifelines)
            assert set(item.allocated_to) <= lifelines, item.id
            assert lifelines - set(item.allocated_to) <= {*bystanders, "BLK-modelling-tool", "BLK-simulator"}, item.id


def test_every_lifeline_takes_part(behaviours):
    for item in behaviours.values():
        if item.interaction is not None:
            ends = {end for message in item.interaction.messages for end in (message.source, message.target)}
            assert ends == set(item.interaction.lifelines), item.id


def test_timing_constraints_are_bound_to_criteria_on_times(shipped, behaviours):
    bound = {
        timing.criterion_of
        for item in behaviours.values()
        if item.interaction is not None
        for timing in item.interaction.timings
    }
    times = {item.id for item in shipped.system if item.criterion and dimension(item.criterion.unit) == dimension("s")}
    assert bound == times == {"SYS-005", "SYS-009", "SYS-033"}


def test_every_state_of_the_task_is_timed(behaviours):
    for name in STATES:
        timings = behaviours[f"SEQ-{name}"].interaction.timings
        assert "SYS-005" in {timing.criterion_of for timing in timings}, name


def test_every_activity_and_state_machine_satisfies_a_requirement(shipped):
    satisfying = {link.source for link in shipped.links if link.kind is LinkKind.SATISFY}
    activities = [item for item in shipped.architecture.behaviours if item.id.startswith("ACT-")]
    assert [item.id for item in activities if item.id not in satisfying] == []
    states = [item for item in shipped.architecture.behaviours if item.kind is BehaviourKind.STATE_MACHINE]
    assert [item.id for item in states if item.id not in satisfying] == []


def test_no_file_of_the_model_is_long():
    paths = [*(ROOT / "requirements").glob("*/*.yaml"), ROOT / "requirements" / "stakeholder.yaml"]
    for path in paths:
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 600, path.name
