"""The registry of rules."""

from __future__ import annotations

import re
import subprocess
import sys

from rgss.requirements import load_requirements
from rgss.trace import RULES, MeasureKind, check_trace


def test_rules_have_ids_of_their_own_and_say_why():
    assert len({rule.id for rule in RULES}) == len(RULES)
    assert len({rule.explanation for rule in RULES}) == len(RULES)
    for rule in RULES:
        assert re.fullmatch(r"[a-z]+\.[A-Za-z0-9]+(-[A-Za-z0-9]+)*", rule.id)
        assert rule.explanation.endswith(".")


def test_findings_come_in_the_order_of_their_positions(project):
    project.edit(
        "system.yaml", "    derived_from: [STK-1]\n    satisfied_by: [BLK-1]\n    verification: analysis\n", ""
    )
    project.add("S", MeasureKind.MOE).add("M", MeasureKind.MOP)
    findings = check_trace(load_requirements(project.folder), project.measures)
    assert len(findings) == 8
    assert list(findings) == sorted(findings)


def test_the_order_of_measures_does_not_matter(project):
    project.add("S", MeasureKind.MOE).add("M", MeasureKind.MOP).add("x", MeasureKind.MOP, contributes_to=("y",))
    expected = project.findings()
    project.measures.reverse()
    assert project.findings() == expected


def test_the_package_loads_without_its_graph_library():
    code = "import sys, rgss.trace; sys.exit('networkx' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
