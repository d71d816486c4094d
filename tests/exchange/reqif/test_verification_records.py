"""Verification records in ReqIF: written with their evidence, compared on import, and not read."""

from __future__ import annotations

from datetime import date
from pathlib import Path

import pytest
import reqif
import xmlschema
from lxml import etree

from rgss.exchange.content import content_of
from rgss.exchange.reqif import read_reqif, reqif_text
from rgss.exchange.verification_records import record_cells, with_records_compared
from rgss.requirements import RecordedResult
from rgss.trace.evidence import evidence_of_records, new_record, with_record, write_records

NAMESPACES = {"r": "http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"}


@pytest.fixture
def protocol(project):
    """A protocol by which the closing of the gripper is recorded as met."""
    path = project.folder / "closing <1>.md"
    path.write_text("1.8 s at most.\n", encoding="utf-8")
    record = new_record(
        project.folder,
        result=RecordedResult.MET,
        by="A. “Reader” & Co",
        on="2026-05-12",
        today=date(2026, 12, 31),
        note="Ten strokes, <2 s each.",
        files=[str(path)],
    )
    write_records(project.folder / "requirements", with_record(project.requirements, ["SYS-2"], record))
    return path


def records_of(project):
    return record_cells(evidence_of_records(project.requirements, project.folder))


def text_of(project):
    return reqif_text(content_of(project.requirements, {}, records_of(project)), title="t")


def test_a_record_is_written_with_its_evidence_by_the_schema(project, protocol, as_xml):
    path = as_xml(text_of(project))

    folder = Path(reqif.__file__).parent / "reqif_schema"
    xmlschema.XMLSchema(folder / "reqif.xsd", base_url=str(folder.parents[1])).validate(path)
    (found,) = read_reqif(path).records.values()
    (digest,) = project.requirements.records["SYS-2"].files.values()
    assert found == {
        "verification_result": "met",
        "verification_state": "holds",
        "verified_by": "A. “Reader” & Co",
        "verified_on": "2026-05-12",
        "verification_evidence": f"Ten strokes, <2 s each.\nclosing <1>.md (SHA-256 {digest})",
    }


def test_a_record_that_no_longer_holds_says_what_has_changed(project, protocol, read):
    protocol.write_text("2.4 s.\n", encoding="utf-8")
    system = project.file("system.yaml")
    system.write_text(system.read_text(encoding="utf-8").replace("within 2 s", "within 3 s"), encoding="utf-8")

    found = read(text_of(project)).records["SYS-2"]

    assert (found["verification_result"], found["verification_state"]) == ("met", "stale")
    _, file, requirement = found["verification_evidence"].split("\n")
    assert file.endswith("): changed since")
    assert requirement == "The requirement has changed since."


def test_what_was_exported_comes_back_to_the_same_bytes_and_without_a_loss(project, protocol, read):
    text = text_of(project)
    foreign = read(text)

    assert reqif_text(foreign, title="t").replace("t_e", "") == text.replace("t_e", "")
    assert (foreign.notes, with_records_compared(foreign, records_of(project)).losses) == ((), ())
    assert project.compare(foreign) == ()


@pytest.mark.parametrize("is_withdrawn", [True, False])
def test_another_record_of_a_file_is_a_loss(project, protocol, read, is_withdrawn):
    text = text_of(project) if is_withdrawn else text_of(project).replace("2026-05-12", "2026-05-13")
    own = {} if is_withdrawn else records_of(project)

    (loss,) = with_records_compared(read(text), own).losses

    assert "the verification of SYS-2 in the file (met, A. “Reader” & Co, 2026-05-1" in loss.message
    assert loss.hint == "an import reads no records; 'rgss verify SYS-2' makes one"


def test_requirements_without_a_record_have_no_values(project, read):
    root = etree.fromstring(text_of(project).encode())
    names = [each.get("LONG-NAME") for each in root.iterfind(".//r:SPEC-ATTRIBUTES/*", NAMESPACES)]

    assert "verification_result" in names
    assert with_records_compared(read(text_of(project)), {}).losses == ()
