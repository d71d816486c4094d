"""The trade-off's page of a study that weighs eight measures, each within bounds; and another solver's opinion."""

from __future__ import annotations

import re
import shutil
import sys

import pytest

VALUES = {
    "P_max": ("0.8 kg", "1.4 kg"),
    "C_total": ("44000 USD", "38000 USD"),
    "t_e": ("25 s", "5 s"),
    "t_p": ("15 s", "1 s"),
    "S": ("0.8", "1.0"),
    "M_g": ("3 kg", "0.5 kg"),
    "F_max": ("1 N", "100 N"),
    "C_g": ("9000 USD", "1000 USD"),
}


@pytest.fixture(scope="module")
def wide(tmp_path_factory):
    """A function that gives a copy of a project with eight bounded weights, decided by a program."""

    def make(project, program):
        folder = tmp_path_factory.mktemp(program) / "project"
        shutil.copytree(project, folder)
        study = folder / "studies" / "pick_place.yaml"
        lines = "".join(
            f"    - {{measure: {measure}, weight: 0.125, weight_between: [0.05, 0.4], worst: {worst}, best: {best}}}\n"
            for measure, (worst, best) in VALUES.items()
        )
        text, count = re.subn(
            r"(trade_off:\n  values:\n)(?:    - .*\n)+", rf"\1{lines}", study.read_text(encoding="utf-8")
        )
        assert count == 1
        rule = f"  decide_by: {{program: {program}{', over: weights' if program == 'minimax_regret' else ''}}}\n"
        study.write_text(text.replace("  practical_margin:", rule + "  practical_margin:"), encoding="utf-8")
        return folder

    return make


@pytest.mark.parametrize("program", ["additive", "minimax_regret"])
def test_every_part_of_the_page_is_there(rgss, wide, with_evidence, program):
    folder = wide(with_evidence, program)
    told = rgss("trade", "--project", folder)
    assert (told.status, told.errors) == (0, "")
    assert "not computed" not in told.output.lower()
    for part in (
        "\nWhy\n",
        "\nWhat nearly won\n",
        "\nWhat would change it\n",
        "\nWhat drives",
        "\nCertificate: optimal",
    ):
        assert part in told.output
    if program == "additive":
        for part in ("share of the elicited weights", "Weights: moving", "stays best from", "Rank reversal"):
            assert part in told.output


def test_every_weight_of_the_page_can_be_supposed(rgss, wide, with_little_evidence):
    folder = wide(with_little_evidence, "additive")
    for measure in VALUES:
        told = rgss("trade", "--brief", "--project", folder, "--what-if", f"weight.{measure}=0.13")
        assert (told.status, told.errors) == (0, "")


def test_another_solver_is_named_on_the_page_and_in_the_document(rgss, with_evidence):
    told = rgss("trade", "--brief", "--solver-check", "scip", "--project", with_evidence)
    assert (told.status, told.errors) == (0, "")
    assert "Certificate: optimal by HIGHS and SCIP, gap 0;" in told.output
    assert "Check: independent solver agrees: SCIP comes to the same answer.\n" in told.output
    document = rgss("trade", "--brief", "--json", "--solver-check", "scip", "--project", with_evidence).document
    assert document["certificate"]["solver"] == "HIGHS and SCIP"
    assert document["certificate"]["checks"][-1]["kind"] == "independent solver"


def test_another_solver_that_is_not_installed(rgss, with_evidence, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyscipopt", None)
    told = rgss("trade", "--solver-check", "scip", "--project", with_evidence)
    assert (told.status, told.output) == (2, "")
    assert told.complaint == (
        "rgss: the solver check 'scip' needs the package pyscipopt, which is not installed (pip install 'rgss[scip]')"
    )
