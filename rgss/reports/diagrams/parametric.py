"""Parametric diagrams: measures as constraint blocks whose parameters are bound to values and to each other.

They follow from the expressions of the measures alone, so that every measure of a project has its place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.counted import counted
from rgss.measures import Constant, InputSymbol, Measure, MeasureKind, MeasureSet, Name
from rgss.reports.diagrams.drawing import Drawing, draw_graph
from rgss.reports.diagrams.frame import Heading
from rgss.reports.diagrams.graph import Edge, Graph, Node, NodePort, Shape
from rgss.reports.diagrams.properties import value_type
from rgss.requirements import Block

MOST_OBSERVED = 12
"""Measures that are one observed quantity each share a diagram, up to this many."""

_RESULT = "result "


def parametric_diagrams(measures: MeasureSet, blocks: Sequence[Block]) -> tuple[Drawing, ...]:
    """Draw each measure of effectiveness, and each other measure that none is computed from.

    A diagram has all that its measure is computed from. Measures that are an observed quantity as
    it is, and that nothing else is computed from, share diagrams.

    Args:
        measures: The measures.
        blocks: The structure, whose values may be bound to symbols.

    Raises:
        DefinitionError: The package ``pygraphviz`` is not installed.
    """
    used = {name for measure in measures.measures for name in measure.expression.names}
    tops = [one for one in measures.measures if one.kind is MeasureKind.EFFECTIVENESS or one.id not in used]
    computed = {measure.id for measure in measures.measures}
    observed = [one for one in tops if isinstance(one.expression.root, Name) and one.expression.root.id not in computed]
    owners = {
        value.symbol: f"{block.name}.{value.id}"
        for block in blocks
        for value in block.values
        if value.symbol is not None
    }
    drawings = [_diagram((one,), measures, owners, one.name, one.id) for one in tops if one not in observed]
    for start in range(0, len(observed), MOST_OBSERVED):
        number = start // MOST_OBSERVED + 1
        title = f"Observed quantities, part {number}"
        drawings.append(
            _diagram(observed[start : start + MOST_OBSERVED], measures, owners, title, f"observed-{number}")
        )
    return tuple(drawings)


def _diagram(
    tops: Sequence[Measure], measures: MeasureSet, owners: Mapping[str, str], title: str, name: str
) -> Drawing:
    reached = {one.id for one in tops} | {other for one in tops for other in measures.dependencies(one.id)}
    shown = [measure for measure in measures.measures if measure.id in reached]
    symbols: dict[str, Constant | InputSymbol] = {one.id: one for one in measures.constants}
    symbols |= {one.id: one for one in measures.inputs}
    taken = dict.fromkeys(name for measure in shown for name in measure.expression.names if name in symbols)
    nodes = [_value_node(symbols[name], owners) for name in taken]
    nodes += [_constraint_node(measure) for measure in shown]
    nodes += [
        Node(
            id=_RESULT + one.id,
            shape=Shape.BOX,
            name=f"{one.id} : {value_type(one.unit)}",
            texts=(owners[one.id],) if one.id in owners else (),
            tint="value",
        )
        for one in tops
    ]
    edges = list(_bindings(shown, tops))
    return draw_graph(
        Graph(nodes=tuple(nodes), edges=tuple(edges), rightwards=True, node_width=260.0),
        heading=Heading(kind="par", element="Constraint Block", subject=title),
        name=f"parametric-{name}",
        title=f"Parametric diagram: {title}",
        description=(
            f"{counted(len(shown), 'equation')}; small squares are parameters, lines bind "
            "these to values and to each other."
        ),
        text_alternative=" ".join(f"{measure.id} = {measure.expression.text}." for measure in shown),
    )


def _bindings(shown: Sequence[Measure], tops: Sequence[Measure]) -> Iterator[Edge]:
    ids = {measure.id for measure in shown}
    for measure in shown:
        for symbol in measure.expression.names:
            yield Edge(
                source=symbol,
                target=measure.id,
                head="",
                source_port=symbol if symbol in ids else "",
                target_port=f"in {symbol}",
            )
    for measure in tops:
        yield Edge(source=measure.id, target=_RESULT + measure.id, head="", source_port=measure.id)


def _constraint_node(measure: Measure) -> Node:
    ports = [NodePort(id=f"in {symbol}", label=symbol) for symbol in measure.expression.names]
    ports.append(NodePort(id=measure.id, label=measure.id, right=True))
    equation = (f"Equation {measure.equation}",) if measure.equation else ()
    text = " ".join(measure.expression.text.split())
    return Node(
        id=measure.id,
        shape=Shape.ROUND,
        name=measure.name,
        stereotype="constraint",
        texts=(f"{{{measure.id} = {text}}}", *equation),
        tint="measure",
        ports=tuple(ports),
    )


def _value_node(symbol: Constant | InputSymbol, owners: Mapping[str, str]) -> Node:
    texts = [owners[symbol.id]] if symbol.id in owners else []
    texts.append(symbol.source if isinstance(symbol, InputSymbol) else "constant")
    return Node(
        id=symbol.id,
        shape=Shape.BOX,
        name=f"{symbol.id} : {value_type(symbol.unit)}",
        texts=(", ".join(texts),),
        tint="value",
    )
