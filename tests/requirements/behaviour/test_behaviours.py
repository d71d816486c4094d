"""Flows, interactions and state machines: what comes out of sound ones, and what is said about broken ones."""

from __future__ import annotations

import pytest

from rgss.documents import read_document
from rgss.requirements import (
    BehaviourKind,
    Flow,
    FlowEdge,
    FlowNode,
    FlowNodeKind,
    Interaction,
    Message,
    State,
    StateKind,
    StateMachine,
    TimingConstraint,
    Transition,
)

ARCHITECTURE = "architecture.yaml"
FLOW, INTERACTION, MACHINE = "[requirements.flow]", "[requirements.interaction]", "[requirements.machine]"
DANGLING, DUPLICATE = "[requirements.dangling-id]", "[requirements.duplicate-id]"


def detail(project, behaviour_id):
    return project.load().element(behaviour_id)


def test_a_flow_as_it_is_written(detailed):
    activity = detail(detailed, "ACT-9")
    assert activity.kind is BehaviourKind.ACTIVITY
    assert isinstance(activity.flow, Flow)
    assert activity.flow.nodes[:3] == (
        FlowNode(id="start", kind=FlowNodeKind.INITIAL, text=None, does=None),
        FlowNode(id="close", kind=FlowNodeKind.ACTION, text="Close.", does="ACT-2"),
        FlowNode(id="firm", kind=FlowNodeKind.DECISION, text="Is it firm?", does=None),
    )
    assert [node.kind for node in activity.flow.nodes[3:]] == [
        FlowNodeKind.MERGE,
        FlowNodeKind.FORK,
        FlowNodeKind.ACTION,
        FlowNodeKind.ACTION,
        FlowNodeKind.JOIN,
        FlowNodeKind.FINAL,
    ]
    assert activity.flow.edges[3] == FlowEdge(source="firm", target="again", guard="not yet")
    assert activity.flow.edges[0].guard is None
    assert (activity.interaction, activity.machine) == (None, None)


def test_an_interaction_as_it_is_written(detailed):
    assert detail(detailed, "SEQ-9").interaction == Interaction(
        lifelines=("BLK-0", "BLK-1"),
        messages=(
            Message(id="lift", source="BLK-0", target="BLK-1", text="Lift.", does="ACT-1", reply=False),
            Message(id="close", source="BLK-1", target="BLK-1", text="Close.", does=None, reply=False),
            Message(id="up", source="BLK-1", target="BLK-0", text="It is up.", does=None, reply=True),
        ),
        timings=(TimingConstraint(first="lift", last="up", criterion_of="SYS-1", text="How long it takes."),),
    )


def test_a_machine_as_it_is_written(detailed):
    assert detail(detailed, "STM-9").machine == StateMachine(
        states=(
            State(id="start", kind=StateKind.INITIAL, name="Before", phase=None, does=None),
            State(id="lifting", kind=StateKind.STATE, name="Lifting", phase="lift", does="ACT-1"),
            State(id="up", kind=StateKind.FINAL, name="Up", phase=None, does=None),
            State(id="dropped", kind=StateKind.FAILED, name="Dropped", phase=None, does=None),
        ),
        transitions=(
            Transition(source="start", target="lifting", guard=None, failure=None),
            Transition(source="lifting", target="up", guard="at the top", failure=None),
            Transition(source="lifting", target="dropped", guard=None, failure="object_dropped"),
        ),
    )


ALLOCATED = "kind: activity\n    allocated_to: [{}]\n    text: A cup"


def performed(project, allocated, **performers):
    """The project with an allocation of its flow, and performers of these nodes."""
    project.edit(ARCHITECTURE, "kind: activity\n    text: A cup", ALLOCATED.format(allocated))
    texts = {"close": "Close., does: ACT-2", "lift": "Lift.", "look": "Look.", "firm": '"Is it firm?"'}
    for name, block in performers.items():
        kind = "decision" if name == "firm" else "action"
        old = f"{{id: {name}, kind: {kind}, text: {texts[name]}"
        project.edit(ARCHITECTURE, f"{old}}}", f"{old}, performer: {block}}}")


def test_a_performer_is_a_block_of_the_allocation_or_within_one(detailed):
    performed(detailed, "BLK-0", close="BLK-1", lift="BLK-0", look="BLK-1")

    nodes = detail(detailed, "ACT-9").flow.nodes
    assert [node.performer for node in nodes if node.kind is FlowNodeKind.ACTION] == ["BLK-1", "BLK-0", "BLK-1"]


def test_broken_performers(detailed):
    performed(detailed, "BLK-1", close="BLK-0", lift="BLK-2", firm="BLK-1")
    messages = {
        "BLK-0}": "performer: 'BLK-0' is no block that the activity is allocated to, nor one within it "
        f"(add it to 'allocated_to') {FLOW}",
        "BLK-1}": f"decision 'firm' has a performer; only an action has {FLOW}",
        "BLK-2}": f"performer: 'BLK-2' is not declared (did you mean 'BLK-1'?) {DANGLING}",
        "{id: look, kind": "action 'look' has no performer, but other actions of the flow have one "
        f"(name the block that performs it) {FLOW}",
    }
    expected = [f"{detailed.position(ARCHITECTURE, start)}: error: {text}" for start, text in messages.items()]
    assert detailed.findings() == expected


def test_actors_are_blocks_that_act(project):
    project.edit(ARCHITECTURE, "kind: use_case,", "kind: use_case, actors: [BLK-0],")
    expected = f"{project.position(ARCHITECTURE, 'BLK-0], alloc')}: error: actors: block 'BLK-0' is not an actor "
    assert project.findings() == [expected + "(give it 'actor: true') [requirements.actor]"]

    requirements = project.edit(ARCHITECTURE, "{id: BLK-0,", "{id: BLK-0, actor: true,").load()
    assert requirements.element("UC-1").actors == ("BLK-0",)
    assert [block.actor for block in requirements.architecture.blocks] == [True, False]


@pytest.mark.parametrize(
    ("key", "kind"),
    [
        ("actors: [BLK-0]", "activity"),
        ("flow: {nodes: [{id: a, kind: initial}], edges: [{source: a, target: a}]}", "sequence"),
        ("interaction: {lifelines: [A], messages: [{id: a, source: A, target: A, text: T}]}", "state_machine"),
        ("machine: {states: [{id: a, kind: initial, name: N}], transitions: [{source: a, target: a}]}", "use_case"),
    ],
)
def test_a_detail_of_another_kind_of_behaviour_is_refused(project, key, kind):
    project.edit(ARCHITECTURE, "kind: activity, text: Closes.", f"kind: {kind}, text: Closes., {key}")
    belongs = {"actors": "use_case", "flow": "activity", "interaction": "sequence", "machine": "state_machine"}
    name = key.split(":")[0]
    (finding,) = project.findings()
    assert f"'{name}' belongs to a behaviour of kind '{belongs[name]}', not '{kind}' [document.value]" in finding


NODES, EDGES, MESSAGES, TIMINGS, STATES, WAYS = (
    ("flow", "nodes"),
    ("flow", "edges"),
    ("interaction", "messages"),
    ("interaction", "timings"),
    ("machine", "states"),
    ("machine", "transitions"),
)
LAST_EDGE = "{source: done, target: end}"

BROKEN_FLOWS = [
    ("{id: look, kind", "{id: lift, kind", (*NODES, 6, "id"), f"id 'lift' is repeated in nodes {DUPLICATE}"),
    (
        "target: end}",
        "target: edn}",
        (*EDGES, 9, "target"),
        "target: 'edn' is not a node of the flow (did you mean 'end'?)",
    ),
    (
        "source: look",
        "source: lok",
        (*EDGES, 8, "source"),
        "source: 'lok' is not a node of the flow (did you mean 'look'?)",
    ),
    ("kind: initial", "kind: merge", NODES, "a flow has 1 initial node, this one has 0"),
    ("kind: merge", "kind: initial", NODES, "a flow has 1 initial node, this one has 2"),
    ("kind: final", "kind: merge", NODES, "a flow has a final node, this one has none"),
    (", text: Lift.", "", (*NODES, 5), "action 'lift' has no text"),
    (', text: "Is it firm?"', "", (*NODES, 2), "decision 'firm' has no text"),
    ("kind: merge", "kind: merge, does: ACT-1", (*NODES, 3, "does"), "merge 'again' does nothing; only an action does"),
    (LAST_EDGE, "{source: done, target: start}", (*NODES, 0), "initial 'start' is reached by an edge"),
    (LAST_EDGE, "{source: end, target: done}", (*NODES, 8), "final 'end' is left by an edge"),
    (
        "        - {source: firm, target: again, guard: not yet}\n",
        "",
        (*NODES, 2),
        "decision 'firm' is left by 1 edges",
    ),
    ("        - {source: both, target: look}\n", "", (*NODES, 4), "fork 'both' is left by 1 edges, not by 2 or more"),
    (
        "        - {source: lift, target: done}\n",
        "",
        (*NODES, 5),
        "action 'lift' is left by 0 edges, not by 1 (lead it to",
    ),
    (
        "{source: lift,",
        "{source: look,",
        (*NODES, 6),
        "action 'look' is left by 2 edges, not by 1 (put a decision or a",
    ),
    (
        LAST_EDGE,
        "{source: done, target: lift}",
        (*NODES, 5),
        "action 'lift' is reached by 2 edges (put a merge or a jo",
    ),
    (
        "        - {source: look, target: done}\n",
        "",
        (*NODES, 7),
        "join 'done' is reached by 1 edges, not by 2 or more",
    ),
    (
        "{source: start, target: again}",
        "{source: start, target: both}",
        (*NODES, 3, "id"),
        "node 'again' is never reached",
    ),
    (", guard: it is", "", (*EDGES, 4), "the edge from decision 'firm' has no guard"),
    ("guard: it is", "guard: not yet", (*EDGES, 4, "guard"), "two edges leave decision 'firm' with the same guard"),
    (
        "target: end}",
        "target: end, guard: now}",
        (*EDGES, 9, "guard"),
        "the edge from 'done' has a guard, but leaves no",
    ),
]

BROKEN_INTERACTIONS = [
    ("id: close,", "id: lift,", (*MESSAGES, 1, "id"), f"id 'lift' is repeated in messages {DUPLICATE}"),
    (
        "[BLK-0, BLK-1]",
        "[BLK-1]",
        (*MESSAGES, 0, "source"),
        "source: 'BLK-0' is not a lifeline (did you mean 'BLK-1'?)",
    ),
    (
        "[BLK-0, BLK-1]",
        "[BLK-1]",
        (*MESSAGES, 2, "target"),
        "target: 'BLK-0' is not a lifeline (did you mean 'BLK-1'?)",
    ),
    ("reply: true", "reply: true, does: ACT-2", (*MESSAGES, 2, "does"), "reply 'up' sets nothing off"),
    ("lift, source: BLK-0", "lift, source: BLK-1", (*MESSAGES, 2), "reply 'up' answers no message"),
    (
        "first: lift",
        "first: lifd",
        (*TIMINGS, 0, "first"),
        "first: 'lifd' is not a message of the sequence (did you mean",
    ),
    (
        "last: up",
        "last: upp",
        (*TIMINGS, 0, "last"),
        "last: 'upp' is not a message of the sequence (did you mean 'up'?)",
    ),
    (
        "first: lift, last: up",
        "first: up, last: lift",
        (*TIMINGS, 0, "last"),
        "message 'lift' does not come after 'up'",
    ),
    ("last: up", "last: lift", (*TIMINGS, 0, "last"), "message 'lift' does not come after 'lift'"),
]

BROKEN_MACHINES = [
    ("id: up,", "id: lifting,", (*STATES, 2, "id"), f"id 'lifting' is repeated in states {DUPLICATE}"),
    ("kind: initial", "kind: state", STATES, "a machine has 1 initial state, this one has 0"),
    ("kind: final", "kind: state", STATES, "a machine has a final state, this one has none"),
    ("kind: final", "kind: state", (*STATES, 2), "state 'up' is never left"),
    ("start, target: lifting", "start, target: up", (*STATES, 1, "id"), "state 'lifting' is never reached"),
    ("name: Up", "name: Up, phase: lift", (*STATES, 2, "phase"), "phase 'lift' is two states"),
    (
        "name: Up",
        "name: Up, phase: top",
        (*STATES, 2, "phase"),
        "final state 'up' has a 'phase'; only a plain state has",
    ),
    (
        "name: Dropped",
        "name: D, does: ACT-2",
        (*STATES, 3, "does"),
        "failed state 'dropped' has a 'does'; only a plain",
    ),
    ("kind: initial", "kind: final", (*STATES, 0), "final state 'start' is left by a transition"),
    ("target: up,", "target: start,", (*STATES, 0), "initial state 'start' is reached by a transition"),
    ("source: start", "source: lifting", (*STATES, 0), "initial state 'start' is never left"),
    (
        "target: up,",
        "target: upp,",
        (*WAYS, 1, "target"),
        "target: 'upp' is not a state of the machine (did you mean 'up'?)",
    ),
    (
        "source: start",
        "source: stat",
        (*WAYS, 0, "source"),
        "source: 'stat' is not a state of the machine (did you mean",
    ),
    ("guard: at the top", "failure: slip", (*WAYS, 1, "failure"), "failure 'slip' does not lead to a failed state"),
    (", failure: object_dropped", "", (*WAYS, 2), "the transition to 'dropped' names no failure"),
    (
        ", guard: at the top",
        ", failure: object_dropped",
        (*WAYS, 2),
        "two transitions leave 'lifting' on the same condition",
    ),
]

BROKEN = [
    *(("flow", *row) for row in BROKEN_FLOWS),
    *(("interaction", *row) for row in BROKEN_INTERACTIONS),
    *(("machine", *row) for row in BROKEN_MACHINES),
]


@pytest.mark.parametrize(("kind", "old", "new", "at", "said"), BROKEN)
def test_a_broken_detail_is_reported_at_its_place(project, written, kind, old, new, at, said):
    project.append(ARCHITECTURE, written[kind])
    project.load()
    project.edit(ARCHITECTURE, old, new)
    document = read_document(project.folder / ARCHITECTURE, label=f"requirements/{ARCHITECTURE}")
    place = document.finding("rule", "", ("behaviours", 3, *at))
    expected = f"{place.file}:{place.line}:{place.column}: error: {said}"
    assert any(finding.startswith(expected) for finding in project.findings()), project.findings()
    known = (f"[requirements.{kind}]", DANGLING, DUPLICATE)
    assert all(finding.endswith(known) for finding in project.findings())


def test_a_timing_is_bounded_by_a_criterion(detailed):
    detailed.edit(
        "system.yaml",
        '    criterion: {measure: P, statistic: low, comparison: ">=", threshold: "800 g"}\n',
        "    success: It lifts.\n",
    )
    assert detailed.findings() == [
        (
            f"{detailed.position(ARCHITECTURE, 'SYS-1, text: How')}: error: criterion_of: 'SYS-1' has no criterion "
            f"that could bound a time {INTERACTION}"
        )
    ]


def test_each_call_is_answered_once(detailed):
    again = "        - {id: again, source: BLK-1, target: BLK-0, text: Up., reply: true}\n      timings:"
    detailed.edit(ARCHITECTURE, "      timings:", again)
    (finding,) = detailed.findings()
    assert f"reply 'again' answers no message {INTERACTION}" in finding


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("does: ACT-2}", "does: ACT-22}", "does: 'ACT-22' is not declared (did you mean 'ACT-2'?)"),
        ("does: ACT-2}", "does: BLK-1}", "does: 'BLK-1' is a block, not a behaviour"),
        ("Lift., does: ACT-1}", "Lift., does: SYS-1}", "does: 'SYS-1' is a system requirement, not a behaviour"),
        ("phase: lift, does: ACT-1", "phase: lift, does: STK-1", "does: 'STK-1' is a stakeholder requirement, not a"),
        (
            "lifelines: [BLK-0, BLK-1]",
            "lifelines: [BLK-0, BLK-1, UC-1]",
            "lifelines: 'UC-1' is a behaviour, not a block",
        ),
        (
            "lifelines: [BLK-0, BLK-1]",
            "lifelines: [BLK-0, BLK-1, BLK-1]",
            "lifelines: 'BLK-1' is named twice (keep one)",
        ),
        ("criterion_of: SYS-1", "criterion_of: STK-1", "criterion_of: 'STK-1' is a stakeholder requirement, not a sys"),
        ("criterion_of: SYS-1", "criterion_of: SYS-9", "criterion_of: 'SYS-9' is not declared (did you mean 'SYS-1'?)"),
    ],
)
def test_what_a_detail_names_elsewhere_is_checked(detailed, old, new, said):
    detailed.edit(ARCHITECTURE, old, new)
    (finding,) = detailed.findings()
    assert f" error: {said}" in finding


def test_a_behaviour_may_call_itself(detailed):
    """Calls are no order: what is tried again calls what tried it."""
    detailed.edit(ARCHITECTURE, "text: Lift.}", "text: Lift., does: ACT-9}")
    assert detailed.load().element("ACT-9").flow.nodes[5].does == "ACT-9"


def test_problems_of_every_behaviour_are_reported_at_once(detailed):
    detailed.edit(ARCHITECTURE, "guard: it is", "guard: not yet")
    detailed.edit(ARCHITECTURE, "last: up", "last: lift")
    detailed.edit(ARCHITECTURE, "guard: at the top", "failure: slip")
    assert [finding.rsplit(" ", 1)[1] for finding in detailed.findings()] == [FLOW, INTERACTION, MACHINE]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("      edges:\n", "      edgs:\n", "unknown key 'edgs' (did you mean 'edges'?)"),
        ("kind: fork", "kind: forks", "kind: 'forks' is not one of 'initial', 'action', 'decision', 'merge', 'fork'"),
        ("reply: true", "reply: yes", "reply: true or false is expected"),
        ("kind: failed", "kind: lost", "kind: 'lost' is not one of 'initial', 'state', 'final' or 'failed'"),
        ("kind: state_machine", "kind: machine", "kind: 'machine' is not one of 'use_case', 'activity', 'sequence' or"),
    ],
)
def test_a_malformed_detail_is_refused(detailed, old, new, said):
    detailed.edit(ARCHITECTURE, old, new)
    assert any(said in finding for finding in detailed.findings())
