"""Parts of a ReqIF file that name what it lacks are losses, each with its line; the rest is imported."""

import pytest

from rgss.exchange import ChangeKind, Part
from rgss.exchange.reqif import read_reqif

from .other_tools import reqif_of


@pytest.fixture
def exported(as_xml, text):
    return as_xml(text)


@pytest.mark.parametrize(
    ("old", "new", "loss"),
    [
        ("<SOURCE>\n<SPEC-OBJECT-REF>", "<SOURCE>\n<SPEC-OBJECT-REF>_", "' is not imported: the object '_"),
        ("<SPEC-RELATION-TYPE-REF>", "<SPEC-RELATION-TYPE-REF>_", "' is not imported: the type '_"),
        ("<OBJECT>\n<SPEC-OBJECT-REF>", "<OBJECT>\n<SPEC-OBJECT-REF>_", "the hierarchy names the object '_"),
    ],
)
def test_what_names_a_missing_element_is_lost_alone(project, exported, as_xml, old, new, loss):
    whole = read_reqif(exported)
    text = exported.read_text(encoding="utf-8")
    assert old in text
    found = read_reqif(as_xml(text.replace(old, new, 1)))

    assert len(found.rows) == len(whole.rows)
    assert any(loss in each.message and each.line > 1 for each in found.losses)
    assert all(each.kind is ChangeKind.CHANGED for each in project.compare(found))


def test_a_value_of_an_unknown_attribute_is_lost_alone(as_xml):
    types = {"Req": (("ReqIF.ForeignID", "STRING"), ("ReqIF.Text", "XHTML"), ("Rationale", "STRING"))}
    values = {"ReqIF.ForeignID": "SYS-8", "ReqIF.Text": "The gripper shall hold 3 kg.", "Rationale": "Cups are heavy."}
    text = reqif_of(types, [("Req", values)])
    head, tail = text.rsplit("<ATTRIBUTE-DEFINITION-STRING-REF>", 1)
    foreign = read_reqif(as_xml(f"{head}<ATTRIBUTE-DEFINITION-STRING-REF>_{tail}"), part=Part.SYSTEM)

    (row,), (loss,) = foreign.rows, foreign.losses
    assert (row.id, row.cells["text"], row.cells.get("rationale", "")) == ("SYS-8", "The gripper shall hold 3 kg.", "")
    assert loss.message == "a value of the object '_o0' is of no attribute of its type, and not imported"


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "iso-8859-1", "windows-1252"])
def test_other_encodings_are_read_alike(exported, tmp_path, encoding):
    text = exported.read_text(encoding="utf-8").replace("UTF-8", encoding.removesuffix("-be"), 1)
    text = "".join(each if ord(each) < 256 or "16" in encoding else f"&#{ord(each)};" for each in text)
    path = tmp_path / "other.reqif"
    path.write_bytes((b"\xfe\xff" if encoding.endswith("-be") else b"") + text.encode(encoding))

    assert [row.cells for row in read_reqif(path).rows] == [row.cells for row in read_reqif(exported).rows]
    assert not read_reqif(path).losses
