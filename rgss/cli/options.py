"""Options that several verbs have, and the project that they choose."""

from __future__ import annotations

import argparse
import re
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.studies import Project

STUDY_HELP = "the study, by its file or its name (default: pick_place, or the only one)"
FIDELITIES = ("kinematic", "dynamic", "contact")
_EVIDENCE_COMMAND = re.compile("(?<=')rgss evidence(?: (?:verify --mend|verify|merge|gc --apply|gc))?(?=[' ])")


def add_study(parser: argparse.ArgumentParser) -> None:
    """Add the study as an argument."""
    parser.add_argument("study", nargs="?", metavar="STUDY", help=STUDY_HELP)


def add_arm_mass(parser: argparse.ArgumentParser, when: str) -> None:
    """Add the mass of an arm whose URDF has none."""
    parser.add_argument(
        "--mass",
        metavar="MASS",
        help=f"{when}: mass of the whole arm, as '20 kg', shared by volume where the URDF has none",
    )


def add_xacro_arguments(parser: argparse.ArgumentParser, when: str) -> None:
    """Add the arguments of a xacro."""
    parser.add_argument(
        "--xacro",
        action="append",
        metavar="NAME:=VALUE",
        help=f"{when}: an argument of a xacro, which is expanded (pip install 'rgss[xacro]'); may be given several "
        "times",
    )


def xacro_arguments(texts: Sequence[str] | None) -> dict[str, str]:
    """Arguments of a xacro by name; none without the option.

    Raises:
        DefinitionError: One is not of the form NAME:=VALUE.
    """
    from rgss.errors import DefinitionError
    from rgss.findings import shown

    found = {}
    for text in texts or ():
        name, sign, value = text.partition(":=")
        if not sign or not name.strip():
            raise DefinitionError(
                f"--xacro: {shown(text)} is not of the form NAME:=VALUE", hint="write it as --xacro ur_type:=ur5e"
            )
        found[name.strip()] = value
    return found


def arm_mass_kg(text: str | None) -> float | None:
    """The mass that `--mass` gives, in kg; None without it.

    Raises:
        DefinitionError: It is not a mass above zero.
    """
    return None if text is None else positive_quantity("--mass", text, "kg", example="--mass '20 kg'")


def option_quantity(option: str, text: str, unit: str, *, example: str) -> float:
    """The quantity that an option gives, in a unit.

    Args:
        option: The option.
        text: Its value.
        unit: The unit.
        example: How it is written, for the hint.

    Raises:
        DefinitionError: It is not a quantity of that unit.
    """
    from rgss.errors import DefinitionError, QuantityError
    from rgss.quantities import parse_quantity

    try:
        return parse_quantity(text, unit)
    except QuantityError as error:
        raise DefinitionError(f"{option}: {error.message}", hint=f"write it as {example}") from error


def positive_quantity(option: str, text: str, unit: str, *, example: str) -> float:
    """The quantity above zero that an option gives, in a unit; the arguments are those of `option_quantity`.

    Raises:
        DefinitionError: It is not a quantity of that unit above zero.
    """
    from rgss.errors import DefinitionError
    from rgss.findings import shown

    value = option_quantity(option, text, unit, example=example)
    if value <= 0.0:
        raise DefinitionError(f"{option} must be greater than zero, got {shown(text)}", hint=f"write it as {example}")
    return value


def add_replicates(parser: argparse.ArgumentParser) -> None:
    """Add the number of trials of each variant."""
    parser.add_argument("--replicates", type=int, metavar="N", help="trials of each variant (default: the study's)")


def add_fidelity(parser: argparse.ArgumentParser) -> None:
    """Add the fidelity of the trials."""
    parser.add_argument("--fidelity", choices=FIDELITIES, help="fidelity of the simulation (default: the study's)")


def add_nominal(parser: argparse.ArgumentParser) -> None:
    """Add the switch for nominal values."""
    parser.add_argument(
        "--nominal", action="store_true", help="without uncertainty and workload: the nominal values of the files"
    )


def add_evidence_choice(parser: argparse.ArgumentParser) -> None:
    """Add the options that select the trials of a study: study, replicates, fidelity, nominal values."""
    add_study(parser)
    add_replicates(parser)
    add_fidelity(parser)
    add_nominal(parser)


def add_junit(parser: argparse.ArgumentParser) -> None:
    """Add the file with the result of the tests."""
    parser.add_argument(
        "--junit",
        type=Path,
        metavar="FILE",
        help="read the result of the tests from FILE (default: .rgss/junit.xml in the project)",
    )


def sweep_words(options: argparse.Namespace, *names: str) -> list[str]:
    """The words of ``rgss sweep`` for the trials that a command's options select.

    Args:
        options: The command's options.
        names: The options with a value that are named beside the study, such as ``fidelity``.
    """
    from rgss.studies import TrialChoice

    given = {name: getattr(options, name, None) for name in names}
    words = ["rgss", "sweep", *([options.study] if getattr(options, "study", None) else [])]
    words += ["--project", str(given["project"])] if given.get("project") is not None else []
    chosen = TrialChoice(
        fidelity=given.get("fidelity"),
        replicates=given.get("replicates"),
        is_nominal=getattr(options, "nominal", False),
    )
    return [*words, *chosen.words]


def sweep_command(options: argparse.Namespace) -> str:
    """The command that makes the evidence which a command's options select, as it can be typed."""
    return shlex.join(sweep_words(options, "project", "fidelity", "replicates"))


def with_sweep_options(hint: str, options: argparse.Namespace) -> str:
    """A hint that names ``rgss sweep`` with the options that select the trials of a command."""
    return hint.replace("'rgss sweep'", f"'{sweep_command(options)}'")


def with_given_options(hint: str, options: argparse.Namespace) -> str:
    """A hint whose commands have the options of the present one: what selects its trials, and its project."""
    hint = with_sweep_options(hint, options)
    if getattr(options, "project", None) is None:
        return hint
    project = shlex.quote(str(options.project))
    return _EVIDENCE_COMMAND.sub(lambda command: f"{command[0]} --project {project}", hint)


def chosen_project(options: argparse.Namespace) -> Project:
    """The project with the study, replicates and fidelity of the options, and with nominal values if requested.

    Raises:
        DocumentError: Files of the project are wrong.
        DefinitionError: There is no project, or a number is impossible.
    """
    from rgss.errors import DefinitionError
    from rgss.studies import MOST_REPLICATES, find_project, load_project

    project = load_project(find_project(options.project), options.study)
    replicates = getattr(options, "replicates", None)
    if replicates is not None:
        if not 1 <= replicates <= MOST_REPLICATES:
            raise DefinitionError(
                f"--replicates must be from 1 to {MOST_REPLICATES}, got {replicates}",
                hint="omit it for the study's number",
            )
        project = project.with_replicates(replicates)
    if getattr(options, "nominal", False):
        project = project.nominal()
    fidelity = getattr(options, "fidelity", None)
    return project if fidelity is None else project.with_fidelity(fidelity)
