"""The trade-off's page, its document and its section."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from rgss.decision.robustness.effect_findings import MeasureEffects
from rgss.reports.decision.markdown import BEGIN, END
from rgss.reports.decision.text import effects_lines
from rgss.reports.decision.words import amount, ids_text, moved_limit, moves_text, variants_text
from rgss.requirements import load_requirements
from rgss.trace.evidence import run_properties
from rgss.trace.views import share_in_words
from rgss.tradeoff.robustness.sampled_effects import SampledIndex

REPOSITORY = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def page(request, with_evidence, trade_as_json):
    """The whole page of the shipped study with made evidence, effects included, and its document."""
    from rgss.cli.main import main

    capture = request.getfixturevalue("capsys_module")
    assert main(["trade", "--effects", "--project", str(with_evidence)]) == 0
    assert trade_as_json.status == 0
    return capture(), trade_as_json.document


@pytest.fixture(scope="module")
def capsys_module():
    """Standard output since the last call, for fixtures that outlive a test."""
    import io
    from contextlib import redirect_stdout

    stream = io.StringIO()

    def read() -> str:
        text = stream.getvalue()
        stream.seek(0)
        stream.truncate()
        return text

    with redirect_stdout(stream):
        yield read


def test_the_page_has_its_parts_in_order(page):
    text, document = page
    parts = [
        "Study pick_place: 72 variants, 216 trials",
        "\nWhy\n",
        "\nWhat nearly won\n",
        "\nWhat would change it\n",
        "\nWhat drives the measures",
        "\nCaution: ",
        "\nCertificate: optimal",
        "\nEvidence: ",
    ]
    places = [text.index(part) for part in parts]

    assert places == sorted(places)
    assert f"Variant {document['chosen']} has the highest value" in text
    assert re.search(r"^Closest limits: SYS-\d+ \(.+\) at .+ inside; SYS-\d+ ", text, re.MULTILINE)
    assert "All assumed costs of components together may be off by ±" in text
    assert "Rank reversal: none, whichever variant is removed." in text


def test_the_page_says_what_the_document_says(page):
    text, document = page
    changes = document["robustness"]["weight_changes"]
    nearest = min((one for one in changes["nearest"] if one["distance"] > 0), key=lambda one: one["moved"])
    interval = next(one for one in changes["ranges"] if one["measure"] == "C_total")

    assert f"moving {nearest['moved']:.3f} of weight lets {variants_text(nearest['variants'])} win" in text
    assert re.search(rf"^C_total +0\.25 +{interval['low']:.3f} +{interval['high']:.3f} ", text, re.MULTILINE)
    assert f"may be off by ±{100 * document['robustness']['costs']['factor']:.2f} %" in text
    assert f"{changes['acceptability']['iterations']:,} draws of all weights and of the evidence" in text
    assert document["conclusion"]["headline"] in text


def test_the_document_is_the_decision_with_more(page):
    _, document = page

    assert document["schema"] == 3
    assert (document["study"], document["what_if"], document["portfolio"]) == ("pick_place", None, None)
    assert document["certificate"]["enumeration_agrees"] == "agreed"
    assert document["robustness"]["refused"] == {}


def keys_of(value, path=""):
    """The paths of all keys of a document; entries of a list share theirs."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield f"{path}{key}"
            yield from keys_of(inner, f"{path}{key}.")
    elif isinstance(value, list):
        for inner in value:
            yield from keys_of(inner, f"{path.rstrip('.')}[].")


def holds_nothing(value, path):
    """Whether a path ends early in a document, at a list without entries or at null."""
    for step in path.replace("[]", ".[]").split("."):
        if value is None or value == []:
            return True
        values = [inner for inner in value if inner] if step == "[]" else None
        value = value.get(step) if values is None else (values[0] if values else None)
    return False


def test_the_document_is_described(page, rgss, with_evidence):
    """Every key of the document stands in docs/robustness.md, and no key that is not in one."""
    _, document = page
    supposed = rgss("trade", "--brief", "--json", "--what-if", "weight.t_e=0.4", "--project", with_evidence).document
    document = {**document, "what_if": {**supposed["what_if"], "decision_before": None}}
    text = (REPOSITORY / "docs" / "robustness.md").read_text(encoding="utf-8").split("## The document", 1)[1]
    named = set(re.findall(r"^\| `([\w.\[\]]+)` \|", text, re.MULTILINE))
    # Below these, keys are ids of measures, factors, requirements or components.
    by_id = re.compile(
        r"^robustness\.(weights|refused|costs\.(worst_corner|assumed)"
        r"|.*\.(centre|low|high|weights|weights_by_sum|central_weights|ranks|first_order|total_order|sampled_first_order))\..+$"
        r"|^sensitivity\..*\.(effective_weights|regrets|weights)\..+$"
    )
    own = re.compile(
        r"^(conclusion|robustness|sensitivity|what_if|portfolio|model_gaps|verified_by_equation|substitutions"
        r"|readings|modelling_assumptions)\b"
    )
    found = {key for key in keys_of(document) if (own.match(key) or "." not in key) and not by_id.match(key)}

    # Both ends of a bent function have the same keys.
    found = {key for key in found if not re.match(r"sensitivity\.bent_values\[\]\.concave\.", key)}
    assert found - named == set()
    assert {key for key in named - found if not holds_nothing(document, key)} == set()


def test_the_decision_in_the_document_is_described(page, rgss, with_evidence):
    """Every key of a decision and of one that is infeasible stands in docs/trade_off.md, and no other."""
    words = ["--what-if", "SYS-005.threshold=5 s", "--what-if", "SYS-012.threshold=0.9 kg"]
    nothing = rgss("trade", "--brief", "--json", *words, "--project", with_evidence)
    # Something is worth more than what is chosen, but excluded.
    excluded = rgss(
        "trade", "--brief", "--json", "--what-if", "SYS-004.threshold=39000 USD", "--project", with_evidence
    )
    documents = [page[1], nothing.document, excluded.document]
    found = set().union(*(keys_of({**one, "demands": None}) for one in documents))
    text = (
        (REPOSITORY / "docs" / "trade_off.md").read_text(encoding="utf-8").split("## The decision as a document", 1)[1]
    )
    named = set(re.findall(r"^\| `([\w.\[\]]+)` \|", text, re.MULTILINE))
    whole = {"schema", "study", "double_counting", "shared_parts", "conclusion", "robustness", "portfolio", "what_if"}
    whole |= {"evidence", "screening", "model_gaps", "readings", "sensitivity", "elicitation"}
    whole |= {"verified_by_equation", "substitutions"}
    whole |= {"modelling_assumptions", "failure_drivers", "cases"}

    assert nothing.status == 1
    assert {key for key in found if key.split(".")[0].rstrip("[]") not in whole} == named
    for one in documents:
        assert {key.split(".")[0].split("[")[0] for key in named} <= set(one)


def test_brief_is_the_decision_alone(rgss, with_evidence):
    told = rgss("trade", "--brief", "--project", with_evidence)

    assert told.status == 0
    assert "Certificate: optimal" in told.output
    assert "What nearly won" not in told.output
    assert rgss("trade", "--brief", "--json", "--project", with_evidence).document["robustness"] is None


def test_effects_are_tables_of_levels(page):
    text, document = page
    effects = {one["measure"]: one for one in document["robustness"]["effects"]["measures"]}
    fingers = next(one for one in effects["P_max_simulated"]["effects"] if one["factors"] == ["fingers"])

    assert "Effects on P_max_simulated [kg]: mean 1.06 of 72 designs" in text
    assert re.search(rf"^fingers +100 % +three +\{fingers['levels'][0]:+.4g}", text, re.MULTILINE)
    assert "without planner=stride" in text


def test_one_replicate_is_said(rgss, with_evidence):
    told = rgss("trade", "--replicates", 1, "--project", with_evidence)

    assert (told.status, told.errors) == (0, "")
    assert "Not analysed: noise: noise cannot be estimated from 1 replicate of each variant" in told.output
    assert "draws of all weights alone (without noise)" in told.output
    # How much another study would differ, and how probable the choice is, cannot be known from it.
    assert "studies of this size" not in told.output
    assert "confidence: " not in told.output
    row = next(line for line in told.output.splitlines() if "extreme" in line)
    assert len(re.findall(r"–", row)) >= 2


def test_a_section_goes_between_the_markers_of_a_file(rgss, with_evidence, page, tmp_path):
    _, document = page
    file = tmp_path / "README.md"
    file.write_text(f"# Title\n\n{BEGIN}\nold\n{END}\n\nend\n", encoding="utf-8")
    told = rgss("trade", "--section", "--into", file, "--project", with_evidence)
    text = file.read_text(encoding="utf-8")

    assert (told.status, told.output) == (0, f"Wrote the decision into {file}.\n")
    assert text.startswith(f"# Title\n\n{BEGIN}\n\n**Variant {document['chosen']}** is chosen")
    assert text.endswith(f"{END}\n\nend\n")
    assert "old" not in text
    assert "*What decides it.*" in text
    assert "*The assumed costs of components matter.*" in text
    for one in document["robustness"]["assumptions"]:
        decisive = one["low"] is not None or one["high"] is not None
        if one["id"].endswith(".cost"):
            assert (f"- `{one['id'].split('.')[1]}` costs" in text) == decisive


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("nothing here", "has no place for the decision"),
        (f"{END}\n{BEGIN}\n", "has no place for the decision"),
        (f"{BEGIN}{BEGIN}{END}", "has no place for the decision"),
        (None, "cannot be read (name a Markdown file)"),
    ],
)
def test_a_file_without_a_place_for_the_section(rgss, with_evidence, tmp_path, content, message):
    file = tmp_path / "README.md"
    if content is not None:
        file.write_text(content, encoding="utf-8")
    told = rgss("trade", "--section", "--into", file, "--project", with_evidence)

    assert (told.status, told.output) == (2, "")
    assert message in told.complaint
    assert content is None or file.read_text(encoding="utf-8") == content


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--into", "README.md"], "rgss: --into needs --section (the section is what goes into the file)"),
        (
            ["--section", "--json"],
            "rgss: --section excludes --what-if and --json (omit them: the section shows the study itself)",
        ),
    ],
)
def test_options_that_do_not_go_together(rgss, with_evidence, words, message):
    told = rgss("trade", *words, "--project", with_evidence)

    assert (told.status, told.output, told.complaint) == (2, "", message)


def test_words():
    assert ids_text([64, 28, 30, 29, 33, 34]) == "28–30, 33, 34, 64"
    assert ids_text(range(1, 99, 2)).endswith(" …")
    assert ids_text(range(1, 99, 2), counted=True).endswith("21, 23 and 37 more")
    assert variants_text([1, 2, 4, 5, *range(7, 99, 2), 200, 201, 202], counted=True).endswith("19, 21 and 41 more")
    assert variants_text([]) == "nothing"
    assert (variants_text([3]), variants_text([3, 4])) == ("variant 3", "variants 3, 4")
    assert [share_in_words(share) for share in (0.0, 0.0004, 0.034, 0.456, 1.0)] == [
        "0 %",
        "< 0.1 %",
        "3.4 %",
        "46 %",
        "100 %",
    ]
    assert [share_in_words(share) for share in (0.994, 0.996, 0.9996, 1.0)] == ["99 %", "99.6 %", "> 99.9 %", "100 %"]
    assert (amount(1234.5, "USD"), amount(0.5, "1"), amount(0.5, "kg")) == ("1,234 USD", "0.5", "0.5 kg")
    # Rounded away from the limit, so that what is written is enough.
    assert [moved_limit(9.0, 9.1983, "s"), moved_limit(0.9, 0.84776, "kg")] == ["9.199 s", "0.8477 kg"]
    assert [moved_limit(40500, 41749.2, "USD"), moved_limit(50, 45.7, "USD")] == ["41,750 USD", "45 USD"]
    assert [moved_limit(1, 9.2 + 1e-15, "s"), moved_limit(1, 0.0, "s"), moved_limit(1, -0.33338, "m")] == [
        "9.2 s",
        "0 s",
        "-0.3334 m",
    ]
    assert moves_text({"a": 0.2, "b": 0.8}, {"a": 0.3, "b": 0.7}) == "a 0.2 → 0.3, b 0.8 → 0.7"
    assert moves_text({"a": 0.2}, {"a": 0.2}) == "no weight moves"


def test_a_portfolio_of_one_gripper_for_two_studies(rgss, with_evidence, tmp_path):
    """The second study weighs nothing but payload; one gripper serves both, each by its best variant."""
    folder = Path(shutil.copytree(with_evidence, tmp_path / "portfolio"))
    text = (folder / "studies/pick_place.yaml").read_text(encoding="utf-8")
    head, rest = text.split("trade_off:\n", 1)
    payload = "trade_off:\n  values:\n    - {measure: P_max, weight: 1.0, worst: 0.8 kg, best: 1.4 kg}\n"
    (folder / "studies/payload.yaml").write_text(head + payload, encoding="utf-8")
    portfolio = (
        "trade_off:\n  portfolio:\n    at_most: 1\n    aim: mean\n    member: component.gripper\n    studies:\n"
        "      - {study: studies/pick_place.yaml, weight: 0.5}\n      - {study: studies/payload.yaml, weight: 0.5}\n"
    )
    (folder / "studies/both.yaml").write_text(head + portfolio + rest, encoding="utf-8")
    told = rgss("trade", "--brief", "studies/both.yaml", "--project", folder)
    found = rgss("trade", "--brief", "--json", "studies/both.yaml", "--project", folder).document["portfolio"]

    assert told.status == 0
    assert f"\nPortfolio\n{found['members'][0]} serves every study; value " in told.output
    assert [one["study"] for one in found["assignments"]] == ["studies/pick_place.yaml", "studies/payload.yaml"]
    assert found["value"] == pytest.approx(sum(one["value"] for one in found["assignments"]) / 2)
    assert found["enumeration_agrees"] == "agreed"
    assert (found["status"], found["gap"], found["cut"]) == ("optimal", pytest.approx(0.0, abs=1e-9), None)
    assert "Value with at most so many members: 1: " in told.output


def test_effects_of_sampled_designs():
    """Shares below 0 come from chance and are shown as 0."""
    effects = MeasureEffects(
        measure="P_max",
        unit="kg",
        factors=(),
        left_out=(),
        designs=64,
        analysis=None,
        sampled={
            "fingers": SampledIndex(share=0.9, low=0.8, high=0.95),
            "d7": SampledIndex(share=-0.1, low=-0.2, high=0),
        },
    )
    nothing = MeasureEffects(measure="S", unit="1", factors=(), left_out=(), designs=0, analysis=None, not_computed="R")
    text = "\n".join(effects_lines((effects, nothing)))

    assert "Effects on P_max [kg]: 64 designs of a sample" in text
    assert re.search(r"^fingers +90 % +80 % – 95 %$", text, re.MULTILINE)
    assert re.search(r"^d7 +0 % +0 % – 0 %$", text, re.MULTILINE)
    assert "Effects on S: not computed, since R" in text


def test_a_failed_test_of_the_project_is_told_on_the_page(rgss, with_evidence, tmp_path, monkeypatch):
    """By the file that pytest writes into the project; without one, requirements without a criterion are not judged."""
    folder = tmp_path / "project"
    shutil.copytree(with_evidence, folder)
    plain = rgss("trade", "--brief", "--json", "--project", folder).document["conclusion"]
    (folder / "tests").mkdir()
    mark = '@pytest.mark.verifies("SYS-003")'
    (folder / "tests/test_a.py").write_text(f"import pytest\n\n\n{mark}\ndef test_a():\n    pass\n", encoding="utf-8")
    noted = run_properties(folder, load_requirements(folder / "requirements").system)
    of_run = "".join(f'<property name="{name}" value="{value}"/>' for name, value in noted.items())
    (folder / ".rgss/junit.xml").write_text(
        f'<testsuites><testsuite name="pytest"><properties>{of_run}</properties><testcase classname="tests.test_a" '
        'name="test_a"><properties><property name="rgss.test" value="tests/test_a.py::test_a"/></properties>'
        '<failure message="no"/></testcase></testsuite></testsuites>',
        encoding="utf-8",
    )
    told = rgss("trade", "--brief", "--json", "--project", folder).document["conclusion"]

    assert (plain["failed_tests"], told["failed_tests"]) == ([], ["SYS-003"])
    assert "SYS-003" in plain["chosen"]["not_run"]
    assert "SYS-003" in told["chosen"]["missed"]
    assert told["counts"] == {"feasible": 0, "open": 0, "infeasible": 72}
    assert "Tests of SYS-003 failed: no design meets it." in told["headline"]
    assert "0 of 72 are shown to meet every requirement that a measure or a test decides" in told["headline"]
    monkeypatch.chdir(folder)
    assert told["headline"] in " ".join(rgss().output.split())
