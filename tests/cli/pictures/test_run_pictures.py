"""``rgss run`` with pictures: what it writes, what it prints, and what it refuses before the trial runs."""

from __future__ import annotations

import base64
import gzip
import json
import math
import re
from pathlib import Path
from types import SimpleNamespace

import av
import pytest
from mcap.reader import make_reader
from PIL import Image

from rgss.cli.main import main
from rgss.cli.pictures.options import captioned, made_pictures
from rgss.evidence import Failure
from rgss.studies import load_project
from rgss.trials.replay import ReplayedTrial
from tests.fixtures.eight_states import Phase

REPOSITORY = Path(__file__).parents[3]
RUN = ["run", "65", "--seed", "1", "--project", str(REPOSITORY), "--study", "studies/nominal_world.yaml"]
SMALL = ["--size", "200x200", "--camera", "overview", "--fps", "1"]


def refused(capsys, *arguments):
    """The one line with which a command is refused."""
    status = main([*RUN, *arguments])
    captured = capsys.readouterr()

    assert (status, captured.out) == (2, "")
    (line,) = captured.err.splitlines()
    return line.removeprefix("rgss: ")


@pytest.fixture
def no_trial(monkeypatch):
    """No trial may run."""

    def run(*arguments, **options):
        raise AssertionError("a trial was run")

    monkeypatch.setattr("rgss.trials.pieces.run_trial", run)
    monkeypatch.setattr("rgss.trials.run_traced_trial", run)
    monkeypatch.setattr("rgss.trials.replay.run_replayed_trial", run)


@pytest.mark.engine
def test_all_pictures_with_json_are_one_document(capsys, tmp_path):
    files = [tmp_path / name for name in ("film.gif", "film.webm", "strip.png", "plots.png")]
    options = zip(("--gif", "--film", "--filmstrip", "--plots"), map(str, files), strict=True)
    assert main([*RUN, "--json", *SMALL, *(word for pair in options for word in pair)]) == 0
    captured = capsys.readouterr()
    with_pictures = json.loads(captured.out)
    assert main([*RUN, "--json"]) == 0
    without = json.loads(capsys.readouterr().out)

    assert captured.err == ""
    assert with_pictures == without
    assert sorted(entry.name for entry in tmp_path.iterdir()) == [
        "film.gif",
        "film.webm",
        "plots.png",
        "strip.png",
    ]
    with Image.open(files[0]) as film:
        assert film.size == (200, 200)
        assert film.n_frames == int(with_pictures["metrics"]["motion_time_s"]) + 2
        frames = film.n_frames
    with av.open(str(files[1])) as video:
        assert len(list(video.decode(video=0))) == frames


@pytest.mark.engine
def test_what_was_made_is_told_after_the_trial(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main([*RUN, "--plots", "plots.png"]) == 0
    lines = capsys.readouterr().out.splitlines()

    assert lines[-2].startswith("digest ")
    assert lines[-1] == "plots: plots.png"


@pytest.mark.engine
def test_a_replay_of_two_trials(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main([*RUN, "--replay", "trial.html", "--beside", "1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    page = Path("trial.html").read_text(encoding="utf-8")
    blocks = re.findall(r'<script type="text/plain" class="replay-(model|timeline)">([^<]+)</script>', page)
    timelines = [json.loads(gzip.decompress(base64.b64decode(text))) for kind, text in blocks if kind == "timeline"]

    assert lines[-1] == "replay: trial.html"
    assert [kind for kind, _ in blocks] == ["model", "timeline"] * 2
    assert [one["title"] for one in timelines] == ["Variant 65, seed 1", "Variant 1, seed 1"]
    assert len(page) < 3_000_000


@pytest.mark.engine
def test_a_replay_for_another_viewer_ends_where_the_object_was_placed(capsys, tmp_path):
    path = tmp_path / "trial.mcap"
    assert main([*RUN, "--json", "--replay", str(path)]) == 0
    record = json.loads(capsys.readouterr().out)
    messages = {}
    with path.open("rb") as file:
        for _, channel, message in make_reader(file).iter_messages():
            messages.setdefault(channel.topic, []).append((message.log_time, json.loads(message.data)))
    place = load_project(REPOSITORY, "studies/nominal_world.yaml").scene.place_pose.position_m
    time_ns, last = messages["/object_pose"][-1]

    offset = [last["pose"]["position"][axis] - place[index] for index, axis in enumerate("xy")]
    assert math.hypot(*offset) == pytest.approx(record["metrics"]["place_error_m"], abs=1e-6)
    assert time_ns == pytest.approx(1e9 * record["metrics"]["motion_time_s"], abs=0.02e9)
    assert [one["phase"].replace(" ", "_") for _, one in messages["/phase"]] == [
        one["phase"] for one in record["phases"]
    ]
    assert messages["/log"][-1][1]["message"] == "Done: every phase is complete."
    assert 0.2e6 < path.stat().st_size < 3e6


@pytest.mark.engine
def test_a_file_that_cannot_be_written_after_all(capsys, tmp_path, monkeypatch):
    folder = tmp_path / "folder"
    folder.mkdir()
    monkeypatch.setattr("rgss.documents.why_not_writable", lambda path: folder.rmdir() or "")
    status = main([*RUN, "--plots", str(folder / "plots.png")])
    captured = capsys.readouterr()

    assert status == 2
    assert "digest " in captured.out
    assert captured.err == "rgss: cannot write the pictures: No such file or directory (choose another place)\n"


def test_nothing_is_drawn_where_nothing_moved():
    assert made_pictures(None, None, ReplayedTrial(record=None, trace=None, scene=None)) == (
        "No pictures: the trial ended before anything moved.",
    )


class Still:
    """A film of three frames, all of one state."""

    def __init__(self, phase):
        self.phase = phase

    def __len__(self):
        return 3

    def frame(self, index):
        return SimpleNamespace(time_s=0.5 * index, picture=None, span=SimpleNamespace(phase=self.phase))


@pytest.mark.parametrize(
    ("failure", "failed_phase", "end"),
    [
        (None, None, "1.00 s   3 lift: done"),
        (Failure.OBJECT_DROPPED, Phase.LIFT, "1.00 s   3 lift: object dropped"),
        (
            Failure.PLANNING_LIMIT,
            Phase.MOVE_TO_GRASP_DEPARTURE,
            "1.00 s   3 lift; 4 move to grasp departure: planning limit",
        ),
    ],
)
def test_the_last_frame_says_how_the_trial_ended(failure, failed_phase, end):
    phases = [SimpleNamespace(phase=phase.value) for phase in Phase]
    record = SimpleNamespace(failure=failure, failed_phase=failed_phase, phases=phases)
    said = [captioned(Still(Phase.LIFT), index, record).caption for index in range(3)]
    assert said == ["0.00 s   3 lift", "0.50 s   3 lift", end]


@pytest.mark.usefixtures("no_trial")
class TestRefusals:
    """Each in one line, before anything runs."""

    @pytest.mark.parametrize(
        ("option", "name", "suffix"),
        [
            ("film", "film.gif", ".webm or .mp4"),
            ("gif", "film.mp4", ".gif"),
            ("filmstrip", "strip.jpg", ".png"),
            ("plots", "plots", ".png"),
            ("replay", "trial.glb", ".html or .mcap"),
        ],
    )
    def test_another_kind_of_file(self, capsys, tmp_path, option, name, suffix):
        path = tmp_path / name
        line = refused(capsys, f"--{option}", str(path))

        assert line == f"--{option}: {path} must be a {suffix} file (give a name that ends in {suffix})"

    @pytest.mark.parametrize(
        ("options", "said"),
        [
            (["--beside", "28"], "--beside needs a replay (add --replay FILE.html)"),
            (["--beside", "65", "--replay", "x.html"], "--beside must be another variant than 65 (give its id)"),
            (
                ["--beside", "28", "--replay", "x.mcap"],
                "--beside needs a page, got --replay x.mcap (a .html file shows two trials, others one)",
            ),
        ],
    )
    def test_nothing_to_be_beside(self, capsys, options, said):
        assert refused(capsys, *options) == said

    def test_a_variant_that_is_not_there_beside_it(self, capsys, tmp_path):
        assert "999" in refused(capsys, "--beside", "999", "--replay", str(tmp_path / "x.html"))

    def test_a_folder_that_is_not_there(self, capsys, tmp_path):
        path = tmp_path / "none" / "film.gif"
        line = refused(capsys, "--gif", str(path))

        assert line == f"--gif: cannot write {path}: there is no folder {path.parent} (choose another place)"

    def test_a_folder_in_the_place_of_the_file(self, capsys, tmp_path):
        path = tmp_path / "film.gif"
        path.mkdir()

        assert (
            refused(capsys, "--gif", str(path)) == f"--gif: cannot write {path}: it is a folder (choose another place)"
        )

    def test_two_pictures_in_one_file(self, capsys, tmp_path):
        path = str(tmp_path / "a.png")
        line = refused(capsys, "--filmstrip", path, "--plots", path)

        assert line == "--filmstrip and --plots name the same file (give each its own)"

    @pytest.mark.parametrize("size", ["640", "640x", "axb", "-640x480", "640x480x3", "６40x480", "999999x480"])
    def test_sizes_that_are_none(self, capsys, tmp_path, size):
        line = refused(capsys, "--gif", str(tmp_path / "a.gif"), f"--size={size}")

        assert line == f"--size must be WIDTHxHEIGHT in pixels, got {size!r} (write width and height, such as 640x480)"

    @pytest.mark.parametrize("size", ["199x480", "640x199", "2001x480", "640x2001", "0x0"])
    def test_sizes_out_of_range(self, capsys, tmp_path, size):
        line = refused(capsys, "--gif", str(tmp_path / "a.gif"), "--size", size)

        assert line == f"--size: {size} is out of range (give from 200 to 2000 pixels each way)"

    @pytest.mark.parametrize(
        ("rate", "shown"), [("0.5", "0.5"), ("51", "51"), ("-3", "-3"), ("nan", "nan"), ("inf", "inf")]
    )
    def test_rates_out_of_range(self, capsys, tmp_path, rate, shown):
        line = refused(capsys, "--gif", str(tmp_path / "a.gif"), f"--fps={rate}")

        assert line == f"--fps: {shown} is out of range (give from 1 to 50)"

    @pytest.mark.parametrize("view", ["above", "", "1,2", "1,2,3,4", "a,b,c"])
    def test_views_that_are_not_there(self, capsys, tmp_path, view):
        line = refused(capsys, "--filmstrip", str(tmp_path / "a.png"), f"--camera=hand+{view}")

        assert line == (
            f"--camera: unknown view {view!r} "
            "(choose overview, hand, side, or azimuth,elevation,distance such as 215,30,2.5)"
        )

    @pytest.mark.parametrize(
        "view", ["0,91,2", "0,-91,2", "0,0,0.2", "0,0,11", "nan,0,1", "0,nan,1", "0,0,nan", "inf,0,1"]
    )
    def test_views_out_of_range(self, capsys, tmp_path, view):
        line = refused(capsys, "--gif", str(tmp_path / "a.gif"), "--camera", view)

        assert line == (
            f"--camera: {view} is out of range (elevation from -90 to 90 degrees, distance from 0.3 to 10 m)"
        )

    @pytest.mark.parametrize(
        ("arguments", "needed"),
        [
            (["--camera", "hand"], "--film or --gif or --filmstrip"),
            (["--size", "640x480", "--plots", "a.png"], "--film or --gif or --filmstrip"),
            (["--fps", "10", "--filmstrip", "a.png"], "--film or --gif"),
        ],
    )
    def test_options_for_no_picture(self, capsys, arguments, needed):
        line = refused(capsys, *arguments)

        assert line == f"{arguments[0]} needs a picture (add {needed})"

    @pytest.mark.parametrize(
        ("absent", "line"),
        [
            (["PIL"], "pillow is not installed (pip install 'rgss[sim]')"),
            (["PIL", "matplotlib"], "matplotlib, pillow are not installed (pip install 'rgss[sim]')"),
        ],
    )
    def test_packages_that_are_missing(self, capsys, tmp_path, monkeypatch, absent, line):
        monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name in absent else object())

        told = refused(capsys, "--gif", str(tmp_path / "a.gif"))
        assert told == f"a picture of a trial needs the simulation engines, of which {line}"

    @pytest.mark.parametrize(("suffix", "package", "extra"), [(".mcap", "mcap", "mcap")])
    def test_the_package_of_another_viewer_that_is_missing(self, capsys, tmp_path, monkeypatch, suffix, package, extra):
        monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == extra else object())
        line = refused(capsys, "--replay", str(tmp_path / f"trial{suffix.upper()}"))

        assert line == (
            f"a {suffix} file needs the package {package}, which is not installed "
            f"(pip install 'rgss[{extra}]', or name a .html file)"
        )

    @pytest.mark.parametrize("name", ["trial.html", "trial.mcap"])
    def test_a_replay_replaces_no_source_of_the_project(self, capsys, tmp_path, name):
        source = REPOSITORY / "requirements" / "measures.yaml"
        path = tmp_path / name
        path.symlink_to(source)
        before = source.read_bytes()
        line = refused(capsys, "--replay", str(path))

        assert line.startswith("requirements/measures.yaml is a source of the project and is not overwritten")
        assert source.read_bytes() == before

    @pytest.mark.parametrize("fidelity", ["kinematic", "dynamic"])
    def test_fidelities_that_have_nothing_to_show(self, capsys, tmp_path, fidelity):
        line = refused(capsys, "--gif", str(tmp_path / "a.gif"), "--fidelity", fidelity)

        assert line == f"pictures need contact fidelity, got {fidelity} (add --fidelity contact)"
        assert list(tmp_path.iterdir()) == []
