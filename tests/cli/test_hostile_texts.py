"""One project whose texts and file names are hostile, on every surface: all of it shows as text."""

from __future__ import annotations

import csv
import html
import json
from xml.etree import ElementTree as ET

import pytest

from rgss import load_study
from rgss.evidence import EvidenceStore
from rgss.invisible_characters import invisible_places, visible
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.studies.scaffolding import write_scaffold
from tests.fixtures.stored_trials import put_trials

from .conftest import made_record

OVERRIDE = "\u202e"
"""From here on a terminal would write from right to left."""

MARKUP = "<script>alert(1)</script><img src=x onerror=alert(2)>"
HOSTILE = f"=1+1 @SUM(A1) {MARKUP} \"q\" 'a' & {{{{7*7}}}} |p| `c` 🤖𝔘 {OVERRIDE}abc\u200f\u05d0"
SCENE = f"scenes/=1+1 <b>'&🤖{OVERRIDE}.yaml"
STUDY = f"studies/@s <i>🤖{OVERRIDE}.yaml"
TEXTS = (
    (
        "requirements/stakeholder.yaml",
        "text: When a cup is ordered, the serving robot shall carry the cup from the counter to the tray.",
        "text: ",
    ),
    ("requirements/stakeholder.yaml", "rationale: Carrying cups is what the robot is for.", "rationale: "),
    ("requirements/system.yaml", "text: The gripper shall have a payload of at least 0.5 kg.", "text: "),
    ("requirements/measures.yaml", "name: Payload\n", "name: "),
    ("requirements/architecture.yaml", "name: Carry a cup\n", "name: "),
    ("designs/catalogue.yaml", "name: UR10\n", "name: "),
    ("designs/catalogue.yaml", "rationale: Order of magnitude of an arm of this class.", "rationale: "),
    ("designs/design_space.yaml", "name: Tool speed\n", "name: "),
)
SECTION = """
regression:
  runs:
    - {id: planning, fidelity: kinematic, variants: "1-4", replicates: 2}
  decision: planning
  metrics:
    - {metric: success, better: higher, margin: 40 %}
"""


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    """A scaffolded project with such texts, and evidence of its kinematic trials."""
    folder = tmp_path_factory.mktemp("hostile") / "project"
    write_scaffold(folder)
    quoted = "'" + HOSTILE.replace("'", "''") + "'"
    for name, old, key in TEXTS:
        path = folder / name
        text = path.read_text(encoding="utf-8")
        assert old in text, old
        end = "\n" if old.endswith("\n") else ""
        path.write_text(text.replace(old, f"{key}{quoted}{end}", 1), encoding="utf-8")
    (folder / "scenes/kitchen.yaml").rename(folder / SCENE)
    path = folder / "studies/pick_place.yaml"
    text = path.read_text(encoding="utf-8").replace("scenes/kitchen.yaml", json.dumps(SCENE, ensure_ascii=False))
    path.write_text(text, encoding="utf-8")
    (folder / STUDY).write_text(text + SECTION, encoding="utf-8")
    project = load_project(folder).with_fidelity("kinematic")
    with EvidenceStore.open(project.evidence) as store:
        put_trials(store, trial_specs(project, variants=project.designs.expand(), seeds=(1, 2)), made_record)
    return folder


def as_shown(text: str) -> str:
    """The text as a terminal gets it."""
    return "".join(sign if sign.isprintable() else "\N{REPLACEMENT CHARACTER}" for sign in text)


def test_the_terminal_is_not_steered(rgss, hostile, monkeypatch):
    monkeypatch.chdir(hostile)
    (hostile / "studies" / f"broken{OVERRIDE}.yaml").write_text("study: [", encoding="utf-8")
    told = [
        rgss("check"),
        rgss("check", STUDY),
        rgss("check", f"studies/broken{OVERRIDE}.yaml"),
        rgss("variants", f"studies/broken{OVERRIDE}.yaml"),
        rgss("trace", "STK-1"),
        rgss("measure", "--fidelity", "kinematic"),
        rgss("trade", "--fidelity", "kinematic"),
        rgss("regress", STUDY, "--update", "--reason", HOSTILE.replace(OVERRIDE, "")),
        rgss("regress", STUDY),
        rgss("regress", STUDY, "--baseline", f"no{OVERRIDE}"),
    ]
    assert [one.status for one in told] == [1, 1, 2, 2, 0, 0, 0, 0, 0, 2]
    for one in told:
        for line in (one.output + one.errors).splitlines():
            assert line.isprintable(), line
    # A table and a chain break long lines; nothing of the text is lost.
    assert MARKUP in told[4].output
    assert as_shown(STUDY) in told[8].output


@pytest.mark.parametrize("kind", ["html", "md", "csv", "xlsx"])
def test_traceability(rgss, hostile, tmp_path, kind):
    path = tmp_path / f"<b>=1 🤖.{kind}"
    table = ("--table", "stakeholder-moe") if kind == "csv" else ()
    told = rgss("trace", "--project", hostile, *table, "-o", path)
    assert (told.status, told.errors) == (0, "")
    if kind == "xlsx":
        import openpyxl

        cells = [cell for sheet in openpyxl.load_workbook(path) for row in sheet.iter_rows() for cell in row]
        held = [cell for cell in cells if cell.value == visible(HOSTILE)]
        assert held
        assert {(cell.data_type, cell.quotePrefix) for cell in held} == {("s", True)}
        return
    text = path.read_text(encoding="utf-8")
    if kind == "csv":
        cells = [cell for row in csv.reader(text.lstrip("\ufeff").splitlines()) for cell in row]
        assert f"'{visible(HOSTILE)}" in cells
        assert not any(cell.startswith(("=", "@")) for cell in cells)
        return
    assert not invisible_places(text.lstrip("\ufeff"))
    assert "[U+202E]abc[U+200F]" in text.replace("\\", "")
    assert MARKUP not in text
    assert "<img src=x" not in text.replace("\\<", "")
    if kind == "html":
        assert visible(HOSTILE) in html.unescape(text)


def test_diagrams_and_the_model_in_sysml(rgss, hostile, tmp_path):
    assert rgss("trace", "--project", hostile, "--diagrams", tmp_path / "diagrams").status == 0
    assert rgss("export", "sysml", "--project", hostile, "-o", tmp_path / "diagrams" / "model.sysml").status == 0
    texts = [path.read_text(encoding="utf-8") for path in (tmp_path / "diagrams").iterdir()]

    assert not any(map(invisible_places, texts))
    assert sum("[U+202E]" in text for text in texts) > 1


@pytest.mark.parametrize("kind", ["reqif", "csv", "xlsx"])
def test_exchange_gives_it_back(rgss, hostile, tmp_path, kind):
    path = tmp_path / f"requirements.{kind}"
    assert rgss("export", kind, "--project", hostile, "-o", path).status == 0
    if kind == "reqif":
        text = path.read_text(encoding="utf-8")
        assert MARKUP not in text
        root = ET.fromstring(text)  # noqa: S314 - our own file
        values = [*root.itertext(), *(value for element in root.iter() for value in element.attrib.values())]
        assert any(HOSTILE in value for value in values)
    back = rgss("import", kind, path, "--project", hostile)
    assert (back.status, back.output) == (0, "No changes.\n")


def test_the_guard(rgss, hostile, tmp_path, monkeypatch):
    monkeypatch.chdir(hostile)
    assert rgss("regress", STUDY, "--update", "--reason", "<b>").status == 0
    files = ("--junit", tmp_path / "j.xml", "--markdown", tmp_path / "s.md")
    assert rgss("regress", STUDY, *files).status == 0
    suite = ET.fromstring((tmp_path / "j.xml").read_bytes())  # noqa: S314 - our own file
    assert suite.get("name") == f"rgss regress {STUDY}"
    text = (tmp_path / "s.md").read_text(encoding="utf-8")
    assert "<i>" not in text
    assert "&lt;i&gt;🤖" in text
    assert "\\@s" in text


def test_frames_in_a_notebook(hostile):
    study = load_study(hostile, fidelity="kinematic", replicates=2)
    frames = [study.variants, study.trials, study.measures, study.verdicts, study.ranking, study.columns("measures")]
    for frame in frames:
        assert "<script" not in frame.to_html()
        assert "<img" not in frame._repr_html_()
