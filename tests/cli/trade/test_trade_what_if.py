"""Suppositions on the command line."""

from __future__ import annotations

import re

import pytest


def test_before_and_after(rgss, with_evidence):
    plain = rgss("trade", "--brief", "--json", "--project", with_evidence).document
    words = ["--what-if", "weight.t_e=0.1", "--what-if", "SYS-004.threshold=39000 USD", "--project", with_evidence]
    told = rgss("trade", "--brief", *words)
    document = rgss("trade", "--brief", "--json", *words).document

    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith("Study pick_place: 72 variants, 216 trials\n\nWhat if\n  weight.t_e: 0.2 → 0.1\n")
    assert "  SYS-004.threshold: 43,000 USD → 39,000 USD\n" in told.output
    assert "The other weights keep their proportions, so that all sum to 1: P_max 0.25 → 0.281" in told.output
    assert f"The decision changes from variant {plain['chosen']} to variant {document['chosen']}." in told.output
    assert f"Variant {plain['chosen']} would violate SYS-004." in told.output
    assert "The decision under these suppositions" in told.output
    assert document["what_if"]["decision_before"] == {key: plain[key] for key in document["what_if"]["decision_before"]}
    assert [change["id"] for change in document["what_if"]["changes"]] == ["weight.t_e", "SYS-004.threshold"]
    assert [change["id"] for change in document["what_if"]["rescaled"]] == [
        "weight.P_max",
        "weight.C_total",
        "weight.t_p",
        "weight.S",
    ]
    assert document["demands"]["SYS-004"] == "C_total <= 39,000 USD"


def test_what_changes_nothing(rgss, with_evidence):
    told = rgss("trade", "--brief", "--what-if", "catalogue.ka-58.mass=60 g", "--project", with_evidence)

    assert told.status == 0
    assert "The decision stays the same." in told.output
    assert "The trials were simulated with the present catalogue.ka-58.mass; what they showed is held." in told.output


def test_what_leaves_nothing_feasible(rgss, with_evidence):
    told = rgss("trade", "--what-if", "SYS-012.threshold=5 kg", "--project", with_evidence)

    assert (told.status, told.errors) == (1, "")
    assert "to nothing." in told.output
    assert "No variant is chosen: none meets every requirement by its estimates" in told.output
    assert "SYS-012" in told.output


CONFLICTING = [
    *("--what-if", "SYS-005.threshold=5 s"),
    *("--what-if", "SYS-012.threshold=0.9 kg"),
    *("--what-if", "SYS-004.threshold=40500 USD"),
]


def printed_limits(line):
    """What a line of the table of repairs lets a requirement become."""
    return re.findall(r"(SYS-\d+) ([\d.,]+ ?(?:s|kg|USD)?)(?:,|  )", line)


def test_what_is_printed_as_enough_is_enough(rgss, with_evidence):
    """Every repair on the page, put in as it is written, lets the variant win that the page names."""
    told = rgss("trade", "--brief", *CONFLICTING, "--project", with_evidence)
    lines = told.output.split("enough together", 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    document = rgss("trade", "--brief", "--json", *CONFLICTING, "--project", with_evidence).document["conflicts"]

    assert told.status == 1
    assert len(lines) == sum(len(repair["requirements"]) > 1 for repair in document["joint_repairs"])
    assert lines
    for line in lines:
        words = [*CONFLICTING]
        limits = dict(printed_limits(line))
        assert limits
        for requirement, limit in limits.items():
            place = next((at for at, word in enumerate(words) if word.startswith(requirement)), None)
            supposed = f"{requirement}.threshold={limit.replace(',', '')}"
            words = (
                [*words, "--what-if", supposed] if place is None else [*words[:place], supposed, *words[place + 1 :]]
            )
        mended = rgss("trade", "--brief", "--json", *words, "--project", with_evidence).document
        assert f"variant {mended['chosen']} " in f"{line} "
        assert mended["counts"]["feasible"] == int((re.search(r"of (\d+) feasible$", line) or [0, "1"])[1])


def test_conflicts_and_whether_they_survive_noise(rgss, with_evidence):
    told = rgss("trade", "--brief", *CONFLICTING, "--project", with_evidence)
    document = rgss("trade", "--brief", "--json", *CONFLICTING, "--project", with_evidence).document["conflicts"]

    assert "no variant meets" in told.output
    for conflict, share in zip(document["minimal_conflicts"], document["survival"]["conflicts"], strict=True):
        name = " and ".join(conflict) if len(conflict) > 1 else f"{conflict[0]} alone"
        assert re.search(rf"^{name} +{round(100 * share)} %$", told.output, re.MULTILINE)
    assert (
        "share of all 10 resamples of the replicates in which the conflict remains; nothing is feasible in"
        in told.output
    )
    one = rgss("trade", "--brief", "--replicates", "1", *CONFLICTING, "--project", with_evidence)
    assert (
        "(Whether a conflict survives noise: no measure of the requirements has two replicates; measures that follow "
        "from the design alone have no noise)" in one.output
    )


def test_what_drops_variants(rgss, with_evidence):
    told = rgss("trade", "--brief", "--what-if", "catalogue.kg-3-light.max_force=25 N", "--project", with_evidence)

    assert told.status == 0
    assert "The rules of the design space would no longer allow variants 37–54." in told.output


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("weight.t_x=0.4", "unknown input 'weight.t_x' (did you mean weight.t_p or weight.t_e or weight.P_max?)"),
        (
            "SYS-012.threshold=1 s",
            "SYS-012.threshold: unit 's' does not measure what 'kg' measures (give it in kg or a multiple of it)",
        ),
        (
            "nonsense",
            (
                "supposition must be NAME=VALUE, got 'nonsense' (write weight.t_p=0.4, \"SYS-012.threshold=0.8 kg\" or "
                '"catalogue.kg-2-light.cost=4500 USD")'
            ),
        ),
    ],
)
def test_what_cannot_be_supposed_is_one_line(rgss, with_evidence, text, complaint):
    told = rgss("trade", "--what-if", text, "--project", with_evidence)

    assert (told.status, told.output, told.complaint) == (2, "", f"rgss: --what-if: {complaint}")


def test_a_supposition_changes_no_file(rgss, with_evidence):
    files = {path: path.read_bytes() for path in with_evidence.rglob("*.yaml")}
    rgss("trade", "--brief", "--what-if", "weight.t_e=0.9", "--project", with_evidence)

    assert {path: path.read_bytes() for path in with_evidence.rglob("*.yaml")} == files
