from __future__ import annotations

from itertools import pairwise

import networkx as nx
from hypothesis import given
from hypothesis import strategies as st

from rgss.measures.dependencies import evaluation_order, transitive_use

NODES = "abcdefg"
GRAPHS = st.dictionaries(st.sampled_from(NODES), st.lists(st.sampled_from(NODES), unique=True), min_size=1).map(
    lambda uses: {node: [other for other in used if other in uses] for node, used in uses.items()}
)


@given(GRAPHS)
def test_the_order_and_the_use_agree_with_networkx(uses: dict[str, list[str]]) -> None:
    graph = nx.DiGraph()
    graph.add_nodes_from(uses)
    graph.add_edges_from((node, other) for node, used in uses.items() for other in used)
    order, cycles = evaluation_order(uses)
    assert bool(cycles) == (not nx.is_directed_acyclic_graph(graph))
    for cycle in cycles:
        assert cycle[0] == cycle[-1]
        assert all(graph.has_edge(node, other) for node, other in pairwise(cycle))
    assert {*order} | {node for cycle in cycles for node in cycle} == {*uses}
    position = {node: index for index, node in enumerate(order)}
    for node in order:
        assert all(position[other] < position[node] for other in uses[node] if other in position)
    if not cycles:
        reached = transitive_use(uses, order)
        assert {node: {*reached[node]} for node in uses} == {node: nx.descendants(graph, node) for node in uses}


def test_a_cycle_begins_with_what_comes_first_and_goes_the_way_of_use() -> None:
    order, cycles = evaluation_order({"a": ["c"], "b": ["a"], "c": ["b"], "d": ["a"], "e": ["e"]})
    assert cycles == (("a", "c", "b", "a"), ("e", "e"))
    assert order == ("d",)


def test_leaves_are_part_of_the_use() -> None:
    assert transitive_use({"a": ["x"], "b": ["a", "y"]}, ["a", "b"])["b"] == {"a", "x", "y"}
