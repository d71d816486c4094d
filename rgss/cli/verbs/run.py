"""``rgss run``: one trial, phase by phase."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rgss.cli.driven import add_driver
from rgss.cli.options import STUDY_HELP, add_fidelity, add_nominal, chosen_project
from rgss.cli.pictures import add_pictures, made_pictures, ordered_pictures, other_trial, seen_trial

if TYPE_CHECKING:
    from rgss.trials import DrawnValue, JointController, TrialSpec

HELP = "run one trial and show it phase by phase"
EXAMPLE = "rgss run 2 --seed 3"
MORE_EXAMPLES = (
    ("rgss run 2 --film trial.webm", "and film it"),
    ("rgss run 2 --replay trial.html --beside 28", "and write a 3D replay of it, with another variant as a ghost"),
    ("rgss run 2 --fidelity kinematic", "motion alone, in a short time"),
    ("rgss run 2 --nominal", "with nominal values, without uncertainty"),
    ("rgss run 28 --nominal --driver ur --address 192.168.0.10", "what would be sent to a robot; --go sends it"),
)

_LEAST_SHOWN_M = 1e-6


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("variant", type=int, metavar="ID", help="the variant's id")
    parser.add_argument("--study", metavar="STUDY", help=STUDY_HELP)
    add_fidelity(parser)
    add_nominal(parser)
    parser.add_argument("--seed", type=int, metavar="N", help="the trial's seed (default: the study's first)")
    add_pictures(parser)
    add_driver(parser)


def run(options: argparse.Namespace) -> int:
    """Run the trial; 1 if it does not succeed."""
    from rgss.cli.drawn import drawn_as_json
    from rgss.cli.driven import check_driver, run_driven
    from rgss.cli.failure_hints import failure_hint
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import print_json
    from rgss.engines import require_engines
    from rgss.errors import DefinitionError
    from rgss.evidence import Fidelity, record_digest
    from rgss.studies import trial_specs
    from rgss.sweep import compute
    from rgss.trials import drawn_values
    from rgss.trials.pieces import run_trial

    require_engines("'rgss run'")
    order = ordered_pictures(options)
    check_driver(options, has_pictures=order is not None)
    project = chosen_project(options)
    seed = project.study.seed if options.seed is None else options.seed
    if not 0 <= seed < 2**31:
        raise DefinitionError(f"--seed must be from 0 to 2147483647, got {seed}", hint="omit it for the study's first")
    variant = project.designs.variant(options.variant)
    (spec,) = trial_specs(project, variants=[variant], seeds=[seed])
    if options.driver is not None:
        return run_driven(options, spec)
    beside = other_trial(options, project, seed=seed)
    seen = None if order is None else seen_trial(order, spec)
    record = compute(run_trial, spec) if seen is None else seen.record
    digest = record_digest(record)
    drawn = drawn_values(spec)
    controller = spec.settings.controller
    acts = spec.fidelity is Fidelity.DYNAMIC or (spec.fidelity is Fidelity.CONTACT and controller.in_contact)
    control = controller.origin if acts else ""
    hint = "" if record.success else failure_hint(record, project, _controller_of(spec, record.failed_phase))
    if options.json:
        shown = {**_as_json(record, digest, hint), **drawn_as_json(record.workload, drawn)}
        print_json({**shown, "control": control} if control else shown)
    else:
        _show(record, digest, drawn, control)
        if hint:
            print(f"To fix it: {hint}.")
    if order is not None and seen is not None:
        lines = made_pictures(order, spec, seen, beside=beside)
        if not options.json:
            print(*lines, sep="\n")
    return CLEAN if record.success else FINDINGS


def _controller_of(spec: TrialSpec, phase: str | None) -> JointController:
    """Controller of the joints in a phase, whose step may state its own."""
    from rgss.trials import stated_in_step

    controller = spec.settings.controller
    own = next((step.control for step in spec.task.steps if step.name == phase), None)
    return controller if own is None else stated_in_step(controller, own)


def _as_json(record: Any, digest: str, hint: str) -> dict[str, Any]:
    return {
        "variant": record.variant,
        "seed": record.seed,
        "success": record.success,
        "failure": None if record.failure is None else record.failure.value,
        "failure_detail": record.failure_detail,
        "failure_hint": hint,
        "phases": [
            {
                "phase": phase.phase,
                "outcome": phase.outcome.value,
                "duration_s": phase.duration_s,
                "metrics": dict(phase.metrics),
            }
            for phase in record.phases
        ],
        "planning": [
            {
                "subtask": planning.subtask,
                "outcome": planning.outcome.value,
                "checks": planning.checks,
                "simplification_checks": planning.simplification_checks,
                "time_s": planning.time_s,
                "path_length_m": planning.path_length_m,
            }
            for planning in record.planning
        ],
        "metrics": dict(record.metrics),
        "digest": digest,
    }


def _show(record: Any, digest: str, drawn: Sequence[DrawnValue], control: str) -> None:
    from rgss.cli.drawn import print_drawn
    from rgss.cli.output import number, print_table

    planning = {entry.subtask: entry for entry in record.planning}
    rows = []
    for position, phase in enumerate(record.phases, start=1):
        planned = planning.get(phase.phase)
        rows.append(
            [
                str(position),
                phase.phase,
                phase.outcome.value,
                number(phase.duration_s),
                "" if planned is None else str(planned.checks),
                "" if planned is None else number(planned.time_s),
                "" if planned is None else number(planned.path_length_m),
                number(phase.metrics.get("grip_margin_min")),
                number(None if phase.metrics.get("slip_m") is None else phase.metrics["slip_m"] * 1e3, 2),
            ]
        )
    controlled = f", control {control}" if control else ""
    print(f"Variant {record.variant}, seed {record.seed}, {record.fidelity.value} fidelity{controlled}")
    print_drawn(record.workload, drawn)
    _print_chosen_grasps(record)
    titles = ["", "phase", "outcome", "time [s]", "checks", "planning [s]", "path [m]", "grip margin", "slip [mm]"]
    print_table(titles, rows, right=(3, 4, 5, 6, 7, 8))
    metrics = record.metrics
    if record.success:
        print(f"Success in {number(metrics['task_time_s'])} s (planning included){_distance_from_place(record)}.")
    else:
        print(f"Failed at {record.failed_phase}: {record.failure.value}: {record.failure_detail}")
    print(f"digest {digest}")


def _distance_from_place(record: Any) -> str:
    """Distance of the placed object from its place, of several releases the greatest; empty if it is not observed."""
    from rgss.cli.output import number

    offset = record.metrics["place_error_m"]
    if offset is None:
        return ""
    releases = sum(phase.metrics.get("release_height_m") is not None for phase in record.phases)
    # An object may be released several times.
    which = "the object" if releases <= 1 else f"of {releases} releases the farthest object"
    # A perfect arm places more exactly than anything is measured.
    shown_mm = "less than 0.001" if 0.0 < offset < _LEAST_SHOWN_M else number(1e3 * offset, 3)
    return f": {which} is {shown_mm} mm from the place"


def _print_chosen_grasps(record: Any) -> None:
    """Print the grasps chosen among the candidates, if there are any; repeated ones once."""
    chosen = {
        phase.phase: _chosen_grasp(phase.metrics) for phase in record.phases if "chosen_grasp_rank" in phase.metrics
    }
    if len(set(chosen.values())) == 1:
        chosen = {"": next(iter(chosen.values()))}
    for phase, text in chosen.items():
        print(f"Grasp in {phase}: {text}" if phase else f"Grasp: {text}")


def _chosen_grasp(metrics: Mapping[str, Any]) -> str:
    from rgss.cli.output import number

    at, opening = metrics["chosen_grasp_position_m"], metrics.get("chosen_grasp_opening_m")
    place = (
        ", ".join(number(round(value * 1e3, 2) + 0.0, 3) for value in at if value is not None)
        if isinstance(at, tuple)
        else ""
    )
    chosen = f"candidate {metrics['chosen_grasp_rank']} of {metrics['chosen_grasp_candidates']}, "
    if "chosen_grasp_weight_1" in metrics:
        room = metrics["chosen_grasp_room_m"]
        return (
            f"{chosen}cup {number(room * 1e3 if isinstance(room, float) else None, 1)} mm from the edge of its face, "
            f"grasp centre at ({place}) mm in the object, bears {number(metrics['chosen_grasp_weight_1'], 3)} N of "
            "weight per N of vacuum"
        )
    width = number(2e3 * opening, 1) if isinstance(opening, float) else ""
    return (
        f"{chosen}centre at ({place}) mm in the object, pads {width} mm apart, smallest maximum wrench "
        f"{number(metrics['chosen_grasp_smw_1'], 3)} N per N"
    )
