"""A study that screens: swept here and on a cluster, and every verb afterwards says what was screened out."""

from __future__ import annotations

import contextlib
import io
import re
import shutil

import pytest
from distributed import LocalCluster

import rgss as package
from rgss.cli.main import main
from rgss.evidence import EvidenceStore

SPACE, STUDY = "designs/grasping_system.yaml", "studies/pick_place.yaml"
LEFT_OUT = (
    "      - id: trrt\n        sets: {d8: TRRT}\n      - id: stride\n        sets: {d8: STRIDE}\n",
    "      - id: medium\n        sets: {d9: 6 s}\n      - id: long\n        sets: {d9: 8 s}\n",
)

pytestmark = [pytest.mark.engine, pytest.mark.slow]


@pytest.fixture(scope="module")
def asked(untouched, tmp_path_factory):
    """A project of 8 designs, of which the two of the highest possible value get a contact trial."""
    folder = tmp_path_factory.mktemp("screened") / "asked"
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(untouched / name, folder / name)
    space = (folder / SPACE).read_text(encoding="utf-8")
    for levels in LEFT_OUT:
        assert space.count(levels) == 1
        space = space.replace(levels, "")
    (folder / SPACE).write_text(space, encoding="utf-8")
    study = (folder / STUDY).read_text(encoding="utf-8")
    study = re.sub(r"(?ms)^regression:\n.*?(?=^\S|\Z)", "", study)
    study = re.sub(r"(?m)^replicates: .*$", "replicates: 1", study)
    study = re.sub(r"(?m)^fidelity: .*$", "fidelity: [kinematic, contact]\npromotion: {keep: 2}", study)
    (folder / STUDY).write_text(study, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def swept(asked):
    """The project with its evidence, what the sweep said, and the designs that went on."""
    folder = shutil.copytree(asked, asked.parent / "swept")
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        assert main(["sweep", "--project", str(folder), "--jobs", "1"]) == 0
    return folder


@pytest.fixture(scope="module")
def screening(swept):
    """The document of what became of each design."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        main(["trade", "--brief", "--json", "--project", str(swept)])
    import json

    return json.loads(output.getvalue())["screening"]


def records_of(folder):
    with EvidenceStore.open(folder / ".rgss" / "evidence.sqlite") as store:
        return {trial.key: trial.content_digest for trial in store.all()}


def test_a_cluster_screens_as_this_machine_does(rgss, asked, swept):
    folder = shutil.copytree(asked, asked.parent / "cluster")
    with LocalCluster(
        n_workers=1, threads_per_worker=2, processes=False, dashboard_address=":0", silence_logs=60
    ) as cluster:
        told = rgss("sweep", "--project", folder, "--dask", cluster.scheduler_address)

    assert (told.status, told.errors) == (0, "")
    assert told.output.startswith("Screening at kinematic fidelity (requirements: possible, keep: 2): 2 of 8 designs")
    assert "2 trials: 2 run, 0 from evidence" in told.output
    assert records_of(folder) == records_of(swept)
    assert len(records_of(folder)) == 8 + 2


def test_nothing_is_left_to_do(rgss, swept):
    assert rgss("sweep", "--dry-run", "--project", swept).output.startswith("10 trials: 0 to run, 10 from evidence.")
    rows = rgss("evidence", "--json", "--project", swept).document["studies"]
    (row,) = [row for row in rows if row["study"] == STUDY]
    assert (row["trials"], row["with_evidence"], row["missing"]) == (10, 10, 0)
    assert "nothing to remove" in rgss("evidence", "gc", "--strict", "--project", swept).output


def test_the_decision_says_what_was_screened_out_and_why(rgss, swept, screening):
    out = [one for one in screening["variants"] if one["fate"] == "outranked"]
    assert (len(screening["survivors"]), len(out), screening["would_go_on"]) == (2, 6, [])
    told = rgss("trade", "--project", swept)

    assert told.status == 0
    for one in out:
        assert f"  screened out: {one['variant']}: {one['reason']}" in told.output.splitlines()
        assert "below those of the best 2" in one["reason"]
    assert re.search(rf"Variant ({'|'.join(map(str, screening['survivors']))})\b", told.output)
    assert "6 of" not in told.errors


def test_a_supposition_that_would_screen_otherwise_says_so(rgss, swept, screening):
    told = rgss("trade", "--brief", "--what-if", "weight.C_total=0.95", "--project", swept)
    document = rgss("trade", "--brief", "--what-if", "weight.C_total=0.95", "--json", "--project", swept).document

    more = document["screening"]["would_go_on"]
    assert more
    assert not {*more} & {*screening["survivors"]}
    assert told.output.splitlines()[-1] == (
        f"  would go on under these suppositions, and is in no comparison above: {', '.join(map(str, more))} "
        "(make that change in the study's file and run 'rgss sweep')"
    )
    same = rgss("trade", "--brief", "--what-if", "SYS-005.threshold=24 s", "--json", "--project", swept).document
    assert same["screening"]["would_go_on"] == []


def test_measures_are_those_of_the_designs_that_went_on(rgss, swept, screening):
    told = rgss("measure", "--project", swept)
    assert told.status == 0
    assert "Screening at kinematic fidelity (requirements: possible, keep: 2): 2 of 8 designs go on" in told.output
    out = next(one for one in screening["variants"] if one["fate"] == "outranked")

    refused = rgss("measure", "--variant", out["variant"], "--project", swept)
    assert (refused.status, refused.output) == (2, "")
    assert refused.complaint == (
        f"rgss: variant {out['variant']} was screened out: {out['reason']} "
        "('--fidelity kinematic' shows what is known of it)"
    )
    words = ("--fidelity", "kinematic", "--replicates", 1)
    assert rgss("measure", "--variant", out["variant"], *words, "--project", swept).status == 0


def test_the_report_names_them(rgss, swept, screening, tmp_path):
    page = tmp_path / "page.html"
    assert rgss("report", "--no-film", "--out", page, "--project", swept).status == 0
    ids = ", ".join(str(one["variant"]) for one in screening["variants"] if one["fate"] == "outranked")
    text = page.read_text(encoding="utf-8")

    assert "6 of 8 designs were screened out by kinematic trials (requirements: possible, keep: 2)" in text
    assert f": variants {ids}." in text


def test_in_python_it_is_the_same(swept, screening):
    study = package.load_study(swept)

    assert dict(zip(study.variants.index, study.variants["screening"], strict=True)) == {
        one["variant"]: one["fate"] for one in screening["variants"]
    }
    assert study.decision.chosen in screening["survivors"]
