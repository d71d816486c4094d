"""Requirements, architecture and measures as one graph of links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rgss.requirements import LinkKind, Requirement, RequirementSet, StakeholderNeed, TraceLink
from rgss.trace.model.measure_trace import MeasureTrace

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceModel:
    """Elements of the trace and their graph.

    Attributes:
        requirements: The requirements and the architecture.
        measures: The measures, in their file's order.
        links: Every link, also those that lead to an id that is not there.
        graph: The elements and the links between them; a link that leads nowhere is left out.
            Edge keys are `LinkKind`; edges point from the later element to the one that it depends on.
    """

    requirements: RequirementSet
    measures: tuple[MeasureTrace, ...]
    links: tuple[TraceLink, ...]
    graph: nx.MultiDiGraph[str]
    _digests: dict[str, str] = field(init=False, repr=False, compare=False, default_factory=dict)

    def content_digest(self, element_id: str) -> str:
        """Digest of the reviewed content of an element, cached; see `RequirementSet.content_digest`."""
        found = self._digests.get(element_id)
        if found is None:
            found = self._digests[element_id] = self.requirements.content_digest(element_id)
        return found

    @property
    def asked_for(self) -> tuple[StakeholderNeed | Requirement, ...]:
        """Stakeholder requirements, then system requirements: all elements with a sentence."""
        return (*self.requirements.stakeholder, *self.requirements.system)

    def targets(self, element_id: str, kind: LinkKind) -> tuple[str, ...]:
        """Ids that an element points at by one kind of link."""
        return tuple(target for _, target, key in self.graph.out_edges(element_id, keys=True) if key is kind)

    def sources(self, element_id: str, kind: LinkKind) -> tuple[str, ...]:
        """Ids that point at an element by one kind of link."""
        return tuple(source for source, _, key in self.graph.in_edges(element_id, keys=True) if key is kind)

    def origins(self, requirement_id: str) -> frozenset[str]:
        """Ids of the stakeholder requirements that a requirement derives from, over any number of steps."""
        reached: set[str] = set()
        queue = [requirement_id]
        while queue:
            fresh = [target for target in self.targets(queue.pop(), LinkKind.DERIVE) if target not in reached]
            reached.update(fresh)
            queue.extend(fresh)
        return frozenset(name for name in reached if self.graph.nodes[name].get("is_need"))


def build_trace_model(requirements: RequirementSet, measures: Sequence[MeasureTrace]) -> TraceModel:
    """Join requirements and measures into one graph.

    A measure traces to stakeholder requirements and to the measures that are computed from it;
    it verifies the requirements whose criterion bounds it.
    """
    import networkx as nx

    graph: nx.MultiDiGraph[str] = nx.MultiDiGraph()
    graph.add_nodes_from(requirements.places)
    graph.add_nodes_from((need.id for need in requirements.stakeholder), is_need=True)
    graph.add_nodes_from(measure.id for measure in measures)
    links = (*requirements.links, *_measure_links(requirements, measures))
    for link in links:
        if link.source in graph and link.target in graph:
            graph.add_edge(link.source, link.target, key=link.kind)
    return TraceModel(requirements=requirements, measures=tuple(measures), links=links, graph=graph)


def _measure_links(requirements: RequirementSet, measures: Sequence[MeasureTrace]) -> Iterator[TraceLink]:
    for measure in measures:
        for target in (*measure.traces, *measure.contributes_to):
            yield TraceLink(source=measure.id, target=target, kind=LinkKind.TRACE)
    for requirement in requirements.system:
        if requirement.criterion is not None:
            yield TraceLink(source=requirement.criterion.measure, target=requirement.id, kind=LinkKind.VERIFY)
