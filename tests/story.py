"""A small project with evidence, whose every link is known by heart; for the tests of chains and reports."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from rgss.measures import Estimate, StaleCause, Verdict
from rgss.requirements import RequirementSet, load_requirements
from rgss.trace import MeasureKind, MeasureTrace, TraceModel, build_trace_model
from rgss.trace.evidence.evidence_state import EvidenceState, TrialVerdicts
from rgss.trace.evidence.junit_file import TestEnd
from rgss.trace.evidence.software import SoftwareEvidence, TestEvidence
from rgss.trace.evidence.verdict_evidence import TraceEvidence, TrialEvidence, VariantEvidence

NEED = """\
  - id: {id}
    kind: {kind}
    text: {text}
    rationale: Guests wait.
    source: Interview
    priority: high
    status: approved
    owner: operator
"""
REQUIREMENT = """\
  - id: {id}
    group: {group}
    text: {text}
    rationale: It is asked for.
    source: Drawing
    priority: medium
    status: approved
    owner: engineer
"""
FILES = {
    "stakeholder.yaml": "requirements:\n"
    + NEED.format(id="STK-1", kind="functional", text="When a cup is ordered, the system shall serve the cup.")
    + NEED.format(id="STK-2", kind="design", text="The system shall cost little."),
    "system.yaml": "requirements:\n"
    + REQUIREMENT.format(id="SYS-1", group="gripper", text="The gripper shall lift at least 0.8 kg.")
    + """\
    derived_from: [STK-1]
    satisfied_by: [BLK-gripper, ACT-lift]
    verification: analysis
    criterion: {measure: P, comparison: ">=", threshold: "800 g"}
    facility: Simulation
    phase: qualification
"""
    + REQUIREMENT.format(id="SYS-2", group="gripper", text="The gripper shall open.")
    + """\
    parent: SYS-1
    derived_from: [SYS-1]
    satisfied_by: [BLK-finger]
    verification: test
    success: It opens in 20 of 20 runs.
"""
    + REQUIREMENT.format(id="SYS-3", group="script", text="The script shall keep a record.")
    + """\
    derived_from: [STK-2]
    traces: [SYS-1]
    satisfied_by: []
    verification: test
    success: The record is there.
"""
    + REQUIREMENT.format(id="SYS-4", group="script", text="The script shall stop."),
    "architecture.yaml": """\
blocks:
  - {id: BLK-system, name: System, level: system, text: All of it.}
  - {id: BLK-gripper, name: Gripper, level: subsystem, parent: BLK-system, text: Grips.}
  - {id: BLK-finger, name: Finger, level: element, parent: BLK-gripper, text: Touches.}
  - {id: BLK-hook, name: Hook, level: element, parent: BLK-gripper, relation: kind, text: Hangs.}
behaviours:
  - {id: UC-serve, name: Serve, kind: use_case, allocated_to: [BLK-system], refines: [STK-1], text: Serves.}
  - {id: ACT-lift, name: Lift, kind: activity, allocated_to: [BLK-gripper], refines: [UC-serve], text: Lifts.}
""",
}
KEYS = {seed: f"{seed:064x}" for seed in (1, 2, 3)}
TESTS = {"SYS-2": ("tests/test_gripper.py::test_it_opens[fast]", TestEnd.PASSED), "SYS-3": ("tests/test_x.py::t", None)}


def write(folder: Path, changes: Mapping[str, Mapping[str, str]] | None = None) -> Path:
    """Write the files of the project, with texts in them changed."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, original in FILES.items():
        text = original
        for old, new in (changes or {}).get(name, {}).items():
            assert text.count(old) == 1, f"{old!r} is not there exactly once"
            text = text.replace(old, new)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def model(folder: Path) -> TraceModel:
    """The model of the project, with four measures."""

    def measure(name: str, kind: MeasureKind, unit: str, **more: object) -> MeasureTrace:
        return MeasureTrace(id=name, kind=kind, unit=unit, file="requirements/measures.yaml", line=1, column=1, **more)

    requirements: RequirementSet = load_requirements(folder)
    return build_trace_model(
        requirements,
        [
            measure("P", MeasureKind.MOE, "kg", traces=("STK-1",)),
            measure("C", MeasureKind.MOE, "USD", traces=("STK-2",), observed=True),
            measure("P_g", MeasureKind.MOP, "kg", contributes_to=("P",)),
            measure("x", MeasureKind.SUPPLEMENTARY, "1"),
        ],
    )


def evidence(*, shown: bool = True, causes: tuple[StaleCause, ...] = (), choice: str = "variant 7") -> TraceEvidence:
    """Three trials of variant 7, of which two succeeded and decide; verdicts of three variants; two tests."""
    trials = tuple(
        TrialEvidence(
            key=KEYS[seed],
            variant=7,
            seed=seed,
            fidelity="contact",
            outcome="success" if seed < 3 else "object_dropped in lift",
            metrics={"mass_kg": 0.4 + 0.01 * seed, "path_m": (0.5, None)},
            values={"P": 0.85 + 0.01 * seed if seed < 3 else None, "P_g": 1.0, "C": 9.0, "x": None},
        )
        for seed in KEYS
    )
    variant = VariantEvidence(
        variant=7,
        trials=trials,
        missing=0,
        estimates={
            "P": Estimate(value=0.865, unit="kg", low=0.86, high=0.87, n=2),
            "C": Estimate.exact(38800.0, "USD"),
            "P_g": Estimate(value=1.0, unit="kg", low=1.0, high=1.0, n=3),
            "x": Estimate.unknown("1"),
        },
        deciding={"P": (KEYS[1], KEYS[2]), "C": (), "P_g": tuple(KEYS.values()), "x": ()},
    )
    stale = Verdict.STALE if causes else Verdict.MET
    verdicts = {7: stale, 8: Verdict.NOT_MET, 9: Verdict.MET}
    return TraceEvidence(
        shown=variant if shown else None,
        choice=choice,
        variants=3,
        state=EvidenceState(
            trials={
                "SYS-1": TrialVerdicts(
                    requirement="SYS-1", verdicts=verdicts, recorded={}, causes={7: causes} if causes else {}
                )
            },
            software={
                name: SoftwareEvidence(
                    requirement=name,
                    tests=(TestEvidence(requirement=name, test=test, end=end),),
                    marks=(),
                    causes=(),
                )
                for name, (test, end) in TESTS.items()
            },
        ),
    )
