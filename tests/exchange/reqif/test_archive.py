"""ReqIF archives: written, read, and refused where they are hostile."""

from __future__ import annotations

import io
import zipfile

import pytest

from rgss.exchange.attributes import Part
from rgss.exchange.reqif import archive_of, read_reqif, reqif_text


@pytest.fixture
def text(project):
    return reqif_text(project.content, title="t")


@pytest.fixture
def archive(tmp_path):
    def made(members, *, compression=zipfile.ZIP_DEFLATED):
        path = tmp_path / "project.reqifz"
        with zipfile.ZipFile(path, "w", compression) as file:
            for name, content in members.items():
                file.writestr(name, content)
        return path

    return made


def test_an_archive_comes_back_and_has_the_same_bytes(project, text, tmp_path):
    path = tmp_path / "project.reqifz"
    path.write_bytes(archive_of(text, "project.reqif"))

    foreign = read_reqif(path)
    assert project.compare(foreign) == ()
    assert reqif_text(foreign, title="t") == text
    assert archive_of(text, "project.reqif") == path.read_bytes()


def test_attachments_beside_the_file_are_not_read(project, text, archive):
    path = archive({"files/a.png": b"\x89PNG", "in/project.REQIF": text, "in/": b""})
    assert project.compare(read_reqif(path)) == ()


def test_what_macos_adds_to_an_archive_is_not_read(project, text, archive):
    path = archive({"project.reqif": text, "__MACOSX/._project.reqif": b"\x00\x05\x16\x07\x00", "._b.reqif": b"\x00"})
    assert project.compare(read_reqif(path)) == ()


def test_an_archive_under_another_name_is_read_too(project, text, tmp_path):
    path = tmp_path / "project.reqif"
    path.write_bytes(archive_of(text, "project.reqif"))
    assert project.compare(read_reqif(path)) == ()


def test_several_files_are_one_content(project, text, archive):
    content = project.content
    from dataclasses import replace

    halves = [
        reqif_text(replace(content, rows=rows, measures=()), title="t")
        for rows in (
            tuple(row for row in content.rows if row.part is Part.STAKEHOLDER),
            tuple(row for row in content.rows if row.part is Part.BLOCK),
        )
    ]
    foreign = read_reqif(archive({"b.reqif": halves[1], "a.reqif": halves[0]}))

    assert [row.id for row in foreign.rows] == [
        row.id for row in content.rows if row.part in (Part.STAKEHOLDER, Part.BLOCK)
    ]
    assert {row.file.rpartition("(")[2] for row in foreign.rows} == {"a.reqif)", "b.reqif)"}


def test_an_id_in_two_files_is_said_with_the_file(project, text, archive, refused):
    path = archive({"a.reqif": text, "b.reqif": text})
    lines = refused(lambda: project.compare(read_reqif(path)))
    assert lines[0].startswith(f"{path} (b.reqif):")
    assert "is already in line" in lines[0]


@pytest.mark.parametrize("name", ["../outside.reqif", "/outside.reqif", "a/../../b.png", "..\\outside.reqif"])
def test_a_name_that_leads_out_is_refused(text, archive, refused, tmp_path, name):
    path = archive({"a.reqif": text, name: b"x"})
    before = sorted(tmp_path.rglob("*"))
    (line,) = refused(read_reqif, path)

    assert "whose name leads out of the archive, and is refused" in line
    assert sorted(tmp_path.rglob("*")) == before


def test_a_bomb_is_refused(archive, refused):
    (line,) = refused(read_reqif, archive({"a.reqif": b" " * (129 * 1024 * 1024)}))
    assert "would unpack to more than 128 MiB, and is refused" in line


def test_a_bomb_that_lies_about_its_size_is_refused(monkeypatch, archive, refused):
    """The stated sizes are small; what is read is counted all the same."""
    path = archive({"a.reqif": b" " * 3_000_000})
    monkeypatch.setattr("rgss.exchange.reqif.archive.LARGEST_REQIF_BYTES", 2_000_000)
    real = zipfile.ZipFile.infolist

    def understated(self):
        members = real(self)
        for member in members:
            monkeypatch.setattr(member, "file_size", 1, raising=False)
        return members

    monkeypatch.setattr(zipfile.ZipFile, "infolist", understated)
    (line,) = refused(read_reqif, path)
    assert "refused" in line or "damaged" in line


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (b"PK\x03\x04nonsense", "is not a ReqIF archive (.reqifz) that can be read: damaged, or encrypted"),
        (b"PK\x05\x06" + b"\0" * 18, "is an archive without a .reqif file"),
    ],
)
def test_what_is_no_sound_archive_is_one_line(tmp_path, refused, content, complaint):
    path = tmp_path / "a.reqifz"
    path.write_bytes(content)
    (line,) = refused(read_reqif, path)
    assert complaint in line


def test_a_damaged_member_is_one_line(text, tmp_path, refused):
    content = bytearray(archive_of(text, "a.reqif"))
    content[len(content) // 2] ^= 0xFF
    path = tmp_path / "a.reqifz"
    path.write_bytes(content)
    (line,) = refused(read_reqif, path)
    assert "damaged, or encrypted" in line or "not well-formed" in line


def test_two_files_of_one_name_are_refused(text, tmp_path, refused, recwarn):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as file:
        for _ in range(2):
            file.writestr("a.reqif", text)
    recwarn.clear()
    path = tmp_path / "a.reqifz"
    path.write_bytes(out.getvalue())
    (line,) = refused(read_reqif, path)
    assert "has two files of one name" in line
