"""``rgss report``: one page whose figures are those of the study, and one line for what is wrong."""

from __future__ import annotations

import io
import json
import os
import re
import shlex
import shutil
from contextlib import redirect_stdout
from io import StringIO

import av
import numpy as np
import pytest

from rgss.assessment.measuring import measure_variants
from rgss.cli.main import main
from rgss.cli.pictures import report as report_pictures
from rgss.decision.choosing import choose
from rgss.decision.robustness.robustness import analyse_robustness
from rgss.evidence import EvidenceStore
from rgss.reports.study.trials import NotableTrial
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.sweep.planning_history import planning_runs
from rgss.trials.pieces.run import run_trial


@pytest.fixture(scope="module")
def told(with_evidence, tmp_path_factory):
    """The page, and the document that it shows."""
    file = tmp_path_factory.mktemp("report") / "report.html"
    with redirect_stdout(StringIO()) as output:
        status = main(["report", "--project", str(with_evidence), "--out", str(file), "--no-film", "--json"])
    answer = json.loads(output.getvalue())
    assert status == 0
    assert answer["bytes"] == file.stat().st_size
    return file.read_text(encoding="utf-8"), answer["report"]


@pytest.fixture(scope="module")
def side(with_evidence):
    """The project, its measures, its decision and how robust that is, from the study itself."""
    project = load_project(with_evidence)
    with EvidenceStore.open(project.evidence, create=False) as store:
        measured = measure_variants(project, store)
        runs = planning_runs(project, store)
    decision = choose(project, measured)
    return project, measured, decision, analyse_robustness(project, measured, decision), runs


def at(column, place):
    return column[place] if isinstance(column, list) else column


def test_estimates_and_verdicts_are_those_of_the_study(told, side):
    _, document = told
    _, measured, *_ = side
    assert document["variants"]["id"] == [entry.variant.id for entry in measured]
    for place, entry in enumerate(measured):
        for column in document["measures"]:
            estimate = entry.estimates[column["id"]]
            assert at(column["value"], place) == (
                None if estimate.value is None else pytest.approx(estimate.value, rel=1e-4)
            )
            if column["from_trials"]:
                assert at(column["n"], place) == estimate.n
                assert at(column["low"], place) == (
                    None if estimate.low is None else pytest.approx(estimate.low, rel=1e-4)
                )
        for column in document["requirements"]:
            assert at(column["verdict"], place) == entry.verdicts[column["id"]].value


def test_the_decision_and_the_ranking_are_those_of_the_study(told, side):
    _, document = told
    _, measured, decision, found, _ = side
    variants = document["variants"]
    assert document["decision"]["chosen"] == decision.chosen
    ranks = {one: rank for rank, one in zip(variants["rank"], variants["id"], strict=True) if rank}
    assert sorted(ranks, key=ranks.get) == [one.variant for one in decision.ranking]
    # What the page ranks with gives the values that the study has.
    worths = np.array(
        [np.broadcast_to(np.array(one["worth"], dtype=float), len(measured)) for one in document["weights"]["measures"]]
    )
    weights = np.array([one["weight"] for one in document["weights"]["measures"]])
    values = {one.variant: one.value for one in decision.ranking}
    for place, variant in enumerate(variants["id"]):
        if variant in values:
            assert weights @ worths[:, place] == pytest.approx(values[variant], abs=1e-10)
    front = [variant for variant, support in zip(variants["id"], variants["pareto"], strict=True) if support]
    assert front == [found.variants[p.row] for p in found.front.points if p.support.value != "dominated"]
    first = {found.variants[row]: share for row, share in enumerate(found.weighting.acceptability.first)}
    for one in document["decision"]["acceptability"]["variants"]:
        assert one["first"] == pytest.approx(first[one["variant"]], abs=1e-6)


def test_main_effects_are_those_of_the_study(told, side):
    _, document = told
    *_, found, _ = side
    of = {one.measure: one.analysis for one in found.effects.measures}
    for column in document["effects"]:
        analysis = of[column["measure"]]
        mains = [] if analysis is None else [effect for effect in analysis.effects if len(effect.factors) == 1]
        for term, effect in zip(column["main"], mains, strict=True):
            assert term["factor"] == effect.factors[0]
            assert term["effect"] == pytest.approx(effect.levels.tolist(), rel=1e-6, abs=1e-12)


def test_each_search_is_shown_once(told, side):
    _, document = told
    *_, runs = side
    planning = document["planning"]
    names = [one["name"] for one in planning["planners"]]
    shown = sorted(
        (planner, time or -1.0) for planner, time in zip(planning["planner"], planning["time_s"], strict=True)
    )
    expected = sorted((names.index(run.planner), run.time_s if run.outcome.value == "solved" else -1.0) for run in runs)
    assert [planner for planner, _ in shown] == [planner for planner, _ in expected]
    assert [time for _, time in shown] == pytest.approx([time for _, time in expected], rel=1e-6)
    # Every variant shares some searches, unless none of its moves was planned.
    assert {place for group in planning["groups"] for place in group} <= set(range(72))


def test_trials_their_failures_and_their_commands(told, side):
    text, document = told
    project, measured, decision, *_ = side
    trials = document["trials"]
    keys = [key[:12] for entry in measured for key in entry.trials]
    assert trials["key"] == keys
    failed = sum(failure >= 0 for failure in trials["failure"])
    assert failed == sum(not record.success for entry in measured for record in entry.records)
    notable = [(trials["key"][one["trial"]], one["why"]) for one in trials["notable"]]
    first = next(entry for entry in measured if entry.variant.id == decision.chosen)
    assert notable[0] == (first.trials[0][:12], "the deciding trial: the chosen variant")
    assert [why for _, why in notable[1:]] == ["the worst failure, planning limit"]
    assert trials["worst"]["trial"] == trials["notable"][1]["trial"]
    assert trials["worst"]["why"].startswith("No trial of variant ")
    assert "The report was made without films" in text
    assert len(trials["timelines"]) == len(keys) == len(trial_specs(project))


def test_assumptions_and_provenance_are_there(told, side):
    _, document = told
    project, *_ = side
    said = {(one["where"], one["about"]) for one in document["assumptions"]}
    assert ("studies/pick_place.yaml", "planning.charge_per_check") in said
    assert len([one for one in said if one[0] == "measures"]) == len(project.measures.assumptions)
    assert "studies/pick_place.yaml" in [name for name, _ in document["provenance"]["files"]]
    assert {"ompl", "pybullet"} <= {name for name, _ in document["provenance"]["versions"]}


def test_the_page_names_nothing_to_load(told):
    text, _ = told
    shell = re.sub(r"<script[^>]*>.*?</script>", "", text, flags=re.DOTALL)
    assert re.findall(r'(?:src|srcset|action|poster)="(?!data:)', shell) == []
    assert re.findall(r"<(?:link|iframe|object|embed)\b|@import|url\(", shell) == []
    assert re.findall(r'href="(?!#)', shell) == []
    assert "default-src 'none'" in text


def test_without_evidence_one_line_says_what_to_run(folder, tmp_path, rgss):
    said = rgss("report", "--project", folder, "--out", tmp_path / "report.html")

    assert said.status == 2
    assert said.complaint.endswith(f"(run 'rgss sweep --project {folder}' first)")
    assert not (tmp_path / "report.html").exists()


def test_too_little_evidence_names_the_sweep_that_is_missing(with_evidence, tmp_path, rgss):
    said = rgss("report", "--project", with_evidence, "--replicates", 5, "--out", tmp_path / "report.html")

    assert said.status == 2
    assert said.complaint == (
        "rgss: 144 of 360 trials have no evidence for the project as it is now "
        f"(run 'rgss sweep --project {with_evidence} --replicates 5' first)"
    )
    said = rgss("report", "studies/pick_place.yaml", "--project", with_evidence, "--fidelity", "kinematic")
    assert f"(run 'rgss sweep studies/pick_place.yaml --project {with_evidence} --fidelity kinematic' first)" in (
        said.complaint
    )
    said = rgss("report", "--nominal", "--replicates", 5, "--project", with_evidence)
    assert f"(run 'rgss sweep --project {with_evidence} --replicates 5 --nominal' first)" in said.complaint


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        (
            ("--film-size", "huge"),
            "--film-size must be WIDTHxHEIGHT in pixels, got 'huge' (write width and height, such as 640x480)",
        ),
        (("--film-size", "9x9"), "--film-size: 9x9 is out of range (give from 200 to 2000 pixels each way)"),
        (("--film-rate", "99"), "--film-rate: 99 is out of range (give from 1 to 50)"),
        (("--no-film", "--film-rate", "5"), "--film-rate is given with --no-film (omit one of them)"),
    ],
)
def test_a_film_that_cannot_be_is_told_before_anything_is_done(with_evidence, tmp_path, rgss, options, problem):
    said = rgss("report", "--project", with_evidence, "--out", tmp_path / "report.html", *options)

    assert said.status == 2
    assert said.complaint == f"rgss: {problem}"


def test_films_are_large_where_they_are_few():
    look = report_pictures.ordered_look
    assert look(None, None, films=4) == report_pictures.LARGE
    assert look(None, None, films=5) == report_pictures.SMALL
    assert look("640x480", 12.0, films=9) == report_pictures.FilmLook(width=640, height=480, rate_hz=12.0)


@pytest.fixture(scope="module")
def infeasible(with_evidence, tmp_path_factory):
    """The project with limits that no variant meets."""
    project = tmp_path_factory.mktemp("infeasible") / "project"
    shutil.copytree(with_evidence, project)
    for name, changes in {
        "1-manipulator.yaml": {"43000 USD": "40500 USD", "within 25 s": "within 5 s", '"25 s"': '"5 s"'},
        "2-gripper.yaml": {"at least 0.8 kg": "at least 0.9 kg", '"0.8 kg"': '"0.9 kg"'},
    }.items():
        file = project / "requirements" / "system" / name
        text = file.read_text(encoding="utf-8")
        for before, after in changes.items():
            assert before in text
            text = text.replace(before, after)
        file.write_text(text, encoding="utf-8")
    return project


def test_an_infeasible_study_leads_with_what_conflicts_and_what_mends_it(infeasible, tmp_path, rgss):
    file = tmp_path / "report.html"
    with redirect_stdout(StringIO()) as output:
        assert main(["report", "--project", str(infeasible), "--out", str(file), "--no-film", "--json"]) == 1
    told = json.loads(output.getvalue())["report"]["conflicts"]
    with redirect_stdout(StringIO()) as output:
        assert main(["trade", "--project", str(infeasible), "--json"]) == 1
    trade = json.loads(output.getvalue())["conflicts"]

    assert [one["requirements"] for one in told["conflicts"]] == trade["minimal_conflicts"]
    assert ["SYS-005"] in trade["minimal_conflicts"]
    assert [one["survives"] for one in told["conflicts"]] == trade["survival"]["conflicts"]
    assert {one["requirement"]: one["excludes"] for one in told["requirements"]} == {
        one["requirement"]: one["excluded"] for one in trade["excluded_by"]
    }
    # The same ways to mend it, the one whose largest relative change is least first.
    assert {tuple(one["requirements"]): one["winner"] for one in told["joint"]} == {
        tuple(one["requirements"]): one["winner"] for one in trade["joint_repairs"]
    }
    largest = [
        max(change["relative"] for change in one["changes"])
        for shown in told["joint"]
        for one in trade["joint_repairs"]
        if one["requirements"] == shown["requirements"]
    ]
    assert largest == sorted(largest)
    text = file.read_text(encoding="utf-8")
    headline, together, mend = (
        text.index(words)
        for words in (
            "none meets every requirement by its estimates",
            "Requirements that cannot be met together",
            "Repairs",
        )
    )
    assert headline < together < mend < text.index("All variants</h2>")
    # The limits as they are written are enough.
    tried = shlex.split(told["example"])
    assert tried[:2] == ["rgss", "trade"]
    with redirect_stdout(StringIO()) as output:
        assert main([*tried[1:], "--project", str(infeasible), "--json"]) == 0
    assert json.loads(output.getvalue())["chosen"] == told["joint"][0]["winner"]


def test_every_figure_of_the_decision_leads_to_its_evidence(told, side):
    text, _ = told
    _, measured, decision, *_ = side
    table = re.search(r'<table class="cards compared">.*?</table>', text, flags=re.DOTALL).group()
    figures = [cell for cell in re.findall(r"<td[^>]*>(.*?)</td>", table, flags=re.DOTALL) if re.search(r"\d", cell)]
    assert len(figures) > 20
    assert all("<a " in cell for cell in figures)
    for variant in (decision.chosen, decision.runner_up):
        entry = next(one for one in measured if one.variant.id == variant)
        for key in entry.trials:
            assert f'<a href="#variant-{variant}/{key[:12]}"><code>rgss replay {key[:12]}</code></a>' in table


@pytest.mark.parametrize(
    ("name", "problem"),
    [("report.txt", "does not end in .html"), ("no/where/report.html", "there is no folder")],
)
def test_a_wrong_file_is_told_before_anything_is_done(with_evidence, tmp_path, rgss, name, problem):
    said = rgss("report", "--project", with_evidence, "--out", tmp_path / name)

    assert said.status == 2
    assert problem in said.complaint


def test_a_result_of_tests_needs_tests(with_evidence, tmp_path, rgss):
    junit = tmp_path / "junit.xml"
    junit.write_text("<testsuites/>", encoding="utf-8")
    said = rgss("report", "--project", with_evidence, "--out", tmp_path / "r.html", "--no-film", "--junit", junit)

    assert said.status == 2
    assert "--junit is given, but the project has no tests" in said.complaint


def test_what_cannot_be_filmed_is_said(side):
    project, measured, *_ = side
    notable = [NotableTrial(key="0" * 64, record=measured[0].records[0], why="x")]
    pictures, notice = report_pictures.trial_pictures(
        project.with_fidelity("kinematic"), notable, look=report_pictures.SMALL
    )
    assert pictures == ()
    assert notice == "Films need trials at contact fidelity; those of this study are kinematic."
    assert report_pictures.trial_pictures(project, [], look=report_pictures.SMALL) == (
        (),
        "There are no trials to film.",
    )


@pytest.mark.engine
def test_a_notable_trial_is_run_again_and_filmed(side):
    project, *_ = side
    look = report_pictures.FilmLook(width=200, height=150, rate_hz=1.0)
    (spec,) = trial_specs(project, variants=[project.designs.variant(28)], seeds=[1])
    one = NotableTrial(key="ab" * 32, record=run_trial(spec), why="the deciding trial", worst="The only one.")

    (picture,), notice = report_pictures.trial_pictures(project, [one], look=look)

    assert notice == ""
    assert picture.title == "Variant 28, seed 1: the deciding trial"
    assert picture.note == "It succeeded."
    assert picture.worst == "The only one."
    assert picture.replay == "rgss replay abababababab"
    assert picture.filmstrip.startswith(b"\x89PNG")
    with av.open(io.BytesIO(picture.film)) as film:
        assert (film.format.name, film.streams.video[0].codec_context.name) == ("matroska,webm", "vp9")
        pictures = [one.to_ndarray(format="rgb24") for one in film.decode(video=0)]
    assert len(pictures) == int(one.record.metrics["motion_time_s"]) + 2
    assert pictures[0].shape == (150, 200, 3)
    assert (pictures[0] != pictures[-1]).any()


def test_a_folder_whose_name_is_no_utf_8(with_little_evidence, tmp_path, monkeypatch):
    folder = tmp_path / os.fsdecode(b"caf\xe9")
    shutil.copytree(with_little_evidence, folder)
    monkeypatch.chdir(folder / "studies")
    with redirect_stdout(StringIO()):
        assert main(["report", "--out", str(tmp_path / "report.html"), "--no-film"]) == 0
    assert "pick_place" in (tmp_path / "report.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("place", ["a folder of the project", "another folder"])
def test_the_same_study_gives_the_same_bytes_from_any_folder(told, with_evidence, tmp_path, monkeypatch, rgss, place):
    text, _ = told
    inside = place == "a folder of the project"
    monkeypatch.chdir(with_evidence / "studies" if inside else tmp_path)
    again = tmp_path / "again.html"
    said = rgss("report", *(() if inside else ("--project", with_evidence)), "--out", again, "--no-film")

    assert said.status == 0
    assert said.output.endswith(f"Wrote {again} ({again.stat().st_size / 1e6:.1f} MB)\n")
    assert again.read_text(encoding="utf-8") == text
    assert len(text) < 15e6
    assert str(with_evidence) not in text
