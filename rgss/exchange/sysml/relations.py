"""The links of the model as SysML v2 relations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from rgss.exchange.sysml.behaviour import reference
from rgss.exchange.sysml.notation import body, documentation, name
from rgss.exchange.sysml.structure import Parts
from rgss.exchange.verification_records import evidence_lines
from rgss.measures import Verdict
from rgss.requirements import Behaviour, BehaviourKind, Block, LinkKind, Requirement, RequirementSet, StakeholderNeed
from rgss.trace.evidence import RecordEvidence

_VERDICTS: Mapping[Verdict, str] = MappingProxyType(
    {Verdict.MET: "pass", Verdict.NOT_MET: "fail", Verdict.INCONCLUSIVE: "inconclusive"}
)
"""The verdicts of SysML; a record that no longer holds gives none."""

NEEDS = "Stakeholder requirements"
SYSTEM = "System requirements"


class Relations:
    """Writer of the links of a set of requirements, between qualified names of elements."""

    def __init__(self, requirements: RequirementSet, parts: Parts, records: Mapping[str, RecordEvidence]) -> None:
        """Index the elements.

        Args:
            requirements: The requirements and the architecture.
            parts: The paths of the blocks' parts.
            records: The verification records by id of the requirement.
        """
        self._requirements = requirements
        self._parts = parts
        self._records = records

    def lines(self) -> Iterator[str]:
        """Derivations, satisfactions, refinements, allocations, traces, inclusions, verifications."""
        yield from self._links()
        for behaviour in self._requirements.architecture.behaviours:
            yield from self._performers(behaviour)
            yield from self._inclusions(behaviour)
        for requirement in self._requirements.system:
            if requirement.verification is not None or requirement.id in self._records:
                yield from self._verification(requirement)

    def _links(self) -> Iterator[str]:
        for link in self._requirements.links:
            source, target = self._name(link.source), self._name(link.target)
            if link.kind is LinkKind.DERIVE:
                yield from body(
                    "#derivation connection", [f"end #original ::> {target};", f"end #derive ::> {source};"]
                )
            elif link.kind is LinkKind.SATISFY:
                yield f"satisfy {target} by {source};"
            elif link.kind is LinkKind.ALLOCATE:
                yield f"allocate {source} to {target};"
            elif link.kind is LinkKind.REFINE:
                yield f"#refinement dependency from {source} to {target};"
            elif link.kind is LinkKind.TRACE:
                yield f"dependency {name(f'trace {link.source} {link.target}')} from {source} to {target};"

    def _performers(self, behaviour: Behaviour) -> Iterator[str]:
        for node in () if behaviour.flow is None else behaviour.flow.nodes:
            if node.performer is not None:
                yield f"allocate {reference(behaviour.id)}.{name(node.id)} to {self._name(node.performer)};"

    def _inclusions(self, behaviour: Behaviour) -> Iterator[str]:
        if behaviour.kind is BehaviourKind.USE_CASE:
            return  # Written within the use case.
        for other in behaviour.includes:
            head = f"dependency {name(f'include {behaviour.id} {other}')}"
            yield f"{head} from {reference(behaviour.id)} to {reference(other)};"

    def _verification(self, requirement: Requirement) -> list[str]:
        text = f"By {requirement.verification.value}." if requirement.verification is not None else ""
        text += f" Facility: {requirement.facility}." if requirement.facility else ""
        text += f" Phase: {requirement.phase.value}." if requirement.phase is not None else ""
        lines = [f"objective {{ verify {self._name(requirement.id)}; }}"]
        found = self._records.get(requirement.id)
        if found is not None:
            result = found.record.result.value.replace("_", " ")
            evidence = "; ".join(evidence_lines(found))
            text += f" Recorded {result} by {found.record.by} on {found.record.date}{': ' * bool(evidence)}{evidence}"
            verdict = _VERDICTS.get(found.verdict)
            lines += [] if verdict is None else [f"return verdict : VerdictKind = VerdictKind::{verdict};"]
        return body(f"verification {name(f'verify {requirement.id}')}", [documentation(text.strip()), *lines])

    def _name(self, element_id: str) -> str:
        element = self._requirements.element(element_id)
        if isinstance(element, Block):
            return self._parts.path(element_id)
        if isinstance(element, Behaviour):
            return reference(element_id)
        chain = [name(element_id)]
        while element.parent is not None:
            chain.append(name(element.parent))
            parent = self._requirements.element(element.parent)
            assert isinstance(parent, (StakeholderNeed, Requirement))  # noqa: S101 - loading refuses other parents
            element = parent
        package = NEEDS if isinstance(element, StakeholderNeed) else SYSTEM
        return "::".join([name(package), *reversed(chain)])
