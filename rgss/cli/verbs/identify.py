"""``rgss identify``: the servos of a robot from a recording, and recordings of the simulated arm."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rgss.identification import Recording, ServoFit

HELP = "fit a robot's servos (gains, delay, friction) to a recording, or record the simulated arm"
EXAMPLE = "rgss identify recording.csv --calibration servos.yaml --plots plots"
MORE_EXAMPLES = (
    ("rgss identify excitation.yaml --record recording.csv", "record the simulated arm"),
    ("rgss identify excitation.yaml --record again.csv --servos servos.yaml", "the same with fitted servos"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (CSV), or with --record an excitation")
    parser.add_argument("--record", type=Path, metavar="CSV", help="run the excitation on the simulated arm")
    parser.add_argument("--servos", type=Path, metavar="YAML", help="with --record: a calibration file of the servos")
    parser.add_argument("--study", metavar="STUDY", help="with --record: the study whose arm is recorded")
    parser.add_argument("--variant", type=int, metavar="ID", help="with --record: the variant whose gripper is carried")
    parser.add_argument("--calibration", type=Path, metavar="YAML", help="write the determined parameters")
    parser.add_argument("--plots", type=Path, metavar="DIR", help="write a plot of each joint's responses")
    parser.add_argument("--svg", action="store_true", help="with --plots: SVG instead of PNG")


def run(options: argparse.Namespace) -> int:
    """Record, or fit and show; 1 if a parameter is not determined or the model misses part of the motion."""
    from rgss.errors import DefinitionError

    for names, needed in ((("servos", "study", "variant"), "record"), (("svg",), "plots")):
        for name in names:
            if getattr(options, name) not in (None, False) and getattr(options, needed) is None:
                raise DefinitionError(f"--{name} goes with --{needed}", hint="see 'rgss identify --help'")
    if options.record is not None:
        if options.calibration is not None or options.plots is not None:
            raise DefinitionError("--record only records", hint="then give the recording to 'rgss identify'")
        return _record(options)
    return _identify(options)


def _record(options: argparse.Namespace) -> int:
    from rgss.cli.main import CLEAN
    from rgss.cli.options import chosen_project
    from rgss.cli.output import announce, print_json
    from rgss.engines import require_engines
    from rgss.identification import load_excitation, simulated_recording, write_recording
    from rgss.scenes import load_calibration
    from rgss.studies import trial_specs

    require_engines("'rgss identify --record'")
    project = chosen_project(options)
    variant = project.designs.expand()[0] if options.variant is None else project.designs.variant(options.variant)
    (spec,) = trial_specs(project, variants=[variant], seeds=[project.study.seed])
    excitation = load_excitation(options.file, spec.scene.robot)
    servos = {} if options.servos is None else dict(load_calibration(options.servos).servos)
    recording = simulated_recording(
        excitation, spec.scene.robot, spec.gripper, gravity_m_s2=spec.scene.gravity_m_s2, servos=servos
    )
    write_recording(options.record, recording)
    if options.json:
        print_json({"recording": str(options.record), "segments": len(recording.segments)})
    else:
        announce(
            f"{len(recording.segments)} segments of {len(recording.joints)} joints written to {options.record}",
            options.record,
        )
    return CLEAN


def _identify(options: argparse.Namespace) -> int:
    from rgss.cli.main import CLEAN, FINDINGS
    from rgss.cli.output import announce, print_json
    from rgss.documents import write_output
    from rgss.identification import FitStatus, calibration_text, fit_joint, read_recording

    recording = read_recording(options.file)
    moved = dict.fromkeys(segment.joint for segment in recording.segments)
    fits = [fit_joint(recording, joint) for joint in moved]
    if options.json:
        print_json(_as_json(recording, fits))
    else:
        _show(recording, fits)
    if options.calibration is not None:
        text = calibration_text(recording, fits, file=options.file.name)
        write_output(options.calibration, text.encode(), new_source=True)
        if not options.json:
            announce(f"calibration written to {options.calibration}", options.calibration)
    if options.plots is not None:
        from rgss.engines import require_engines
        from rgss.reports import write_response_plot

        require_engines("'rgss identify --plots'", pictures=True)
        options.plots.mkdir(parents=True, exist_ok=True)
        for fit in fits:
            path = options.plots / f"{fit.joint}.{'svg' if options.svg else 'png'}"
            write_response_plot(path, recording, fit.joint, fit.servo)
        if not options.json:
            announce(f"{len(fits)} plots written to {options.plots}", options.plots)
    open_ends = any(each.status is FitStatus.UNDETERMINED for fit in fits for each in fit.parameters)
    return FINDINGS if open_ends or not all(fit.adequate for fit in fits) else CLEAN


def _as_json(recording: Recording, fits: Sequence[ServoFit]) -> dict[str, Any]:
    from dataclasses import asdict

    from rgss.identification import parameter_key, responses

    return {
        "robot": recording.robot,
        "recorded": recording.recorded,
        "control": recording.control.value,
        "sha256": recording.digest,
        "units": {joint: recording.unit_of(joint) for joint in recording.joints},
        "responses": [asdict(each) for each in responses(recording)],
        "fits": [
            {
                "joint": fit.joint,
                "parameters": [
                    {
                        "name": each.name,
                        "unit": parameter_key(each.name, recording.unit_of(fit.joint))[1],
                        "status": each.status.value,
                        "value": each.value,
                        "interval": None if each.interval is None else [_finite(end) for end in each.interval],
                        "reason": each.reason,
                    }
                    for each in fit.parameters
                ],
                "rms_rad_s": dict(fit.rms_rad_s),
                "samples": fit.samples,
                "autocorrelation": fit.autocorrelation,
                "adequate": fit.adequate,
            }
            for fit in fits
        ],
    }


def _finite(value: float) -> float | None:
    from math import isfinite

    return value if isfinite(value) else None


def _show(recording: Recording, fits: Sequence[ServoFit]) -> None:
    from rgss.cli.output import number, print_table
    from rgss.findings import printable
    from rgss.identification import MISFIT, parameter_key, responses

    print(printable(f"{recording.robot}, {recording.control.value} control ({recording.recorded})"))
    rows = [
        [
            printable(each.joint),
            printable(each.pose),
            printable(each.signal),
            number(None if each.rise_s is None else 1e3 * each.rise_s),
            number(None if each.overshoot is None else 1e2 * each.overshoot, 3),
            number(each.steady_error_rad_s),
            number(1e3 * each.lag_s),
            number(each.rms_rad_s),
        ]
        for each in responses(recording)
    ]
    per_s = "rad/s, m/s" if recording.slides else "rad/s"
    titles = [
        "joint",
        "pose",
        "signal",
        "rise [ms]",
        "overshoot [%]",
        f"steady error [{per_s}]",
        "lag [ms]",
        f"RMS [{per_s}]",
    ]
    print_table(titles, rows, right=(3, 4, 5, 6, 7))
    print()
    rows = []
    for fit in fits:
        for each in fit.parameters:
            low, high = (None, None) if each.interval is None else (_finite(end) for end in each.interval)
            said = f"{each.status.value}: {each.reason}" if each.reason else each.status.value
            key, unit = parameter_key(each.name, recording.unit_of(fit.joint))
            rows.append([printable(fit.joint), f"{key} [{unit}]", number(each.value), number(low), number(high), said])
    print_table(["joint", "parameter", "fitted", "from", "to", "95 % interval"], rows, right=(2, 3, 4))
    for fit in fits:
        residuals = ", ".join(f"{pose} {number(value)}" for pose, value in fit.rms_rad_s.items())
        residuals = f"residual {residuals} {recording.unit_of(fit.joint)}/s"
        print(printable(f"{fit.joint}: {residuals}; autocorrelation {fit.autocorrelation:.2f}"))
        if not fit.adequate:
            print(printable(f"{fit.joint}: {MISFIT}"))
