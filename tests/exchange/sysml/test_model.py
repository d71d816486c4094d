"""The shipped project in the textual notation, read by an interpreter of another hand."""

from __future__ import annotations

import dataclasses

import longeron
import pytest

from rgss.exchange.sysml import sysml_text
from rgss.requirements import Architecture, BehaviourKind, BlockLevel, BlockRelation, LinkKind
from rgss.requirements.architecture import Block

pytestmark = pytest.mark.slow

HOSTILE = "It says */ \"x\" 'y' \\ <b>&amp;</b> =1+1 \U0001f916 {brace}; // end"


def usages(elements, kind):
    return [each for each in elements if isinstance(each, longeron.Usage) and each.kind == kind]


def definitions(elements, kind):
    return [each for each in elements if isinstance(each, longeron.Definition) and each.kind == kind]


def identity(element):
    """What an element is known by: the short name if it has one."""
    return element.short_name or element.name


def last(reference):
    """The last name of a qualified name or of a chain of features."""
    return str(reference).replace("::", ".").rsplit(".", 1)[-1].strip("'")


def documented(element):
    (comment,) = [each for each in element.members if isinstance(each, longeron.Documentation)]
    return comment.body.removeprefix("/*").removesuffix("*/").strip()


def linked(project, kind):
    return sorted((link.source, link.target) for link in project.requirements.links if link.kind is kind)


def asked(project):
    return [*project.requirements.stakeholder, *project.requirements.system]


def test_every_requirement_is_found_with_its_text(elements, shipped):
    texts = {each.name: documented(each) for each in usages(elements, "requirement")}

    assert texts == {element.id: " ".join(element.text.split()) for element in asked(shipped)}


def test_a_requirement_stands_in_the_one_that_contains_it(elements, shipped):
    found = {
        each.name: each.owner.name if isinstance(each.owner, longeron.Usage) else None
        for each in usages(elements, "requirement")
    }

    assert found == {element.id: element.parent for element in asked(shipped)}


def test_every_block_is_a_definition_and_a_part(elements, shipped):
    blocks = {block.id: block for block in shipped.requirements.architecture.blocks}
    found = {identity(each): each for each in definitions(elements, "part")}

    assert sorted(found) == sorted(blocks)
    for block_id, each in found.items():
        block = blocks[block_id]
        kind = block.relation is BlockRelation.KIND and block.parent
        assert [last(general) for general in each.supers] == ([block.parent] if kind else [])
        assert (each.name, documented(each)) == (block.name, " ".join(block.text.split()))
    assert sorted(each.name for each in usages(elements, "part") if not each.is_ref) == sorted(blocks)


def test_values_ports_and_multiplicities_of_blocks_are_found(elements, shipped):
    blocks = shipped.requirements.architecture.blocks
    found = {identity(each): each.members for each in definitions(elements, "part")}
    parts = {each.name: each for each in usages(elements, "part") if not each.is_ref}

    for block in blocks:
        inner = {"attribute": [], "port": []}
        for each in found[block.id]:
            if isinstance(each, longeron.Usage):
                inner[each.kind].append(each.name)
        assert inner == {"attribute": [one.id for one in block.values], "port": [one.id for one in block.ports]}
        assert (parts[block.id].multiplicity is not None) is (block.multiplicity is not None), block.id


def test_every_connector_is_found(written, shipped):
    stated = [each for block in shipped.requirements.architecture.blocks for each in block.connectors]

    assert written.count("interface connect ") == len(stated) > 20


def test_every_satisfy_relation_is_found(elements, shipped):
    found = [(last(e.by), last(e.subsets[0])) for e in elements if isinstance(e, longeron.SatisfyUsage)]

    assert sorted(found) == linked(shipped, LinkKind.SATISFY)


def test_every_allocation_is_found(elements, shipped):
    found = [
        tuple(last(end.target) for end in each.ends) for each in elements if isinstance(each, longeron.AllocationUsage)
    ]

    performed = [
        (node.id, node.performer)
        for behaviour in shipped.requirements.architecture.behaviours
        if behaviour.flow is not None
        for node in behaviour.flow.nodes
        if node.performer is not None
    ]
    assert performed
    assert sorted(found) == sorted([*linked(shipped, LinkKind.ALLOCATE), *performed])


def test_every_derivation_is_found(elements, shipped):
    found = []
    for each in elements:
        if isinstance(each, longeron.ConnectionUsage) and "derivation" in each.metadata:
            ends = {end.metadata[0]: last(end.references) for end in each.members}
            found.append((ends["derive"], ends["original"]))

    assert sorted(found) == linked(shipped, LinkKind.DERIVE)


def test_every_refinement_and_trace_is_a_dependency(elements, shipped):
    dependencies = [each for each in elements if isinstance(each, longeron.Dependency)]
    pairs = [(each, (last(each.clients[0]), last(each.suppliers[0]))) for each in dependencies]

    refinements = sorted(pair for each, pair in pairs if "refinement" in each.metadata)
    traces = sorted(pair for each, pair in pairs if (each.name or "").startswith("trace "))
    assert refinements == linked(shipped, LinkKind.REFINE)
    assert traces == linked(shipped, LinkKind.TRACE)


def test_every_verified_requirement_has_a_verification(elements, shipped):
    found = [last(each.subsets[0]) for each in usages(elements, "verify")]

    assert sorted(found) == sorted(r.id for r in shipped.requirements.system if r.verification is not None)


def test_a_record_that_holds_gives_its_verification_a_verdict(elements):
    verdicts = [each for each in elements if getattr(each, "name", None) == "verdict"]
    found = {each.owner.name for each in verdicts if each.owner.name.startswith("verify ")}

    assert sorted(found) == ["verify SYS-001", "verify SYS-002"]
    documents = {each.name: documented(each) for each in usages(elements, "verification") if each.name in found}
    assert "Recorded met by A. Reader on 2026-05-12: * / Ten of ten." in documents["verify SYS-001"]


@pytest.mark.parametrize(
    ("kind", "keyword"),
    [
        (BehaviourKind.USE_CASE, "use_case"),
        (BehaviourKind.ACTIVITY, "action"),
        (BehaviourKind.SEQUENCE, "occurrence"),
        (BehaviourKind.STATE_MACHINE, "state"),
    ],
)
def test_every_behaviour_is_found_by_its_kind(elements, shipped, kind, keyword):
    wanted = {each.id: each.name for each in shipped.requirements.architecture.behaviours if each.kind is kind}
    found = {each.short_name: each.name for each in usages(elements, keyword) if each.short_name}

    assert found == wanted


def test_the_transitions_of_each_state_machine_are_found(elements, shipped):
    for behaviour in shipped.requirements.architecture.behaviours:
        if behaviour.machine is None:
            continue
        (usage,) = [each for each in usages(elements, "state") if each.short_name == behaviour.id]
        kinds = {state.id: state.kind.value for state in behaviour.machine.states}
        names = {state: {"initial": "<entry>", "final": "done"}.get(kind, state) for state, kind in kinds.items()}
        found = [(each.source, each.target) for each in usage.members if isinstance(each, longeron.TransitionUsage)]
        assert sorted(found) == sorted((names[t.source], names[t.target]) for t in behaviour.machine.transitions)


def test_every_measure_is_a_calculation(elements, shipped):
    found = [identity(each) for each in definitions(elements, "calc")]

    assert sorted(found) == sorted(measure.id for measure in shipped.measures.measures)


def test_calculations_compute_what_the_measures_compute(model, shipped):
    interpreter = longeron.Interpreter(model)
    constants = {constant.id: constant.value for constant in shipped.measures.constants}
    for each in ("P_max", "C_total", "P_max_m", "P_max_g", "M_g", "S"):
        measure = shipped.measures.measure(each)
        inputs = [symbol for symbol in measure.expression.names if symbol not in constants]
        values = {symbol: 0.5 + 1.25 * place for place, symbol in enumerate(inputs)}
        expected = measure.expression.evaluate({**constants, **values})
        found = interpreter.call(f"{shipped.study.id}::Measures::{measure.name}", *values.values())
        assert found == pytest.approx(expected, rel=1e-12), each


def test_the_same_model_gives_the_same_text(written, shipped, records):
    assert sysml_text(shipped.requirements, shipped.measures, title=shipped.study.id, records=records) == written


def test_texts_that_try_to_break_out_of_where_they_stand_stay_texts(read, shipped):
    need = dataclasses.replace(shipped.requirements.stakeholder[0], text=HOSTILE, owner=HOSTILE, parent=None)
    block = Block(
        id="BLK-1", name=HOSTILE, level=BlockLevel.SYSTEM, parent=None, relation=BlockRelation.PART, text=HOSTILE
    )
    requirements = dataclasses.replace(
        shipped.requirements,
        stakeholder=(need,),
        system=(),
        architecture=Architecture(blocks=(block,), behaviours=()),
    )
    measures = dataclasses.replace(shipped.measures, measures=())

    hostile = read(sysml_text(requirements, measures, title=HOSTILE))

    elements = list(hostile.iter_tree())
    assert [each.name for each in elements if getattr(each, "short_name", None) == "BLK-1"] == [HOSTILE]
    owners = [each.value.expr.value for each in elements if getattr(each, "redefines", None) == ["owner"]]
    assert owners == [HOSTILE]
    assert [package.name for package in hostile.members] == [HOSTILE]
    bodies = [each.body for each in elements if isinstance(each, longeron.Documentation)]
    assert sum(body.count("* / \"x\" 'y' \\ <b>") for body in bodies) == 2
