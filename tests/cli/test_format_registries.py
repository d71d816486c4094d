"""Registries of output formats: names, endings, and a format that is added as a contributor would."""

from __future__ import annotations

import pytest

from rgss.errors import DefinitionError
from rgss.exchange.formats import EXPORT_FORMATS, export_format
from rgss.reports.trace import TRACE_FORMATS, TraceFormat, trace_format
from rgss.reports.trace.formats import registry
from rgss.reports.variants import VARIANT_FORMATS


@pytest.mark.parametrize(
    "formats", [TRACE_FORMATS, EXPORT_FORMATS, VARIANT_FORMATS], ids=["trace", "export", "variants"]
)
def test_names_are_unique(formats):
    names = [one.name for one in formats]
    assert len(set(names)) == len(names)


def test_endings_are_unique():
    assert len({one.suffix for one in TRACE_FORMATS}) == len(TRACE_FORMATS)
    assert all(one.suffix.startswith(".") for one in TRACE_FORMATS)


@pytest.mark.parametrize("find", [trace_format, export_format])
def test_an_unknown_name(find):
    with pytest.raises(DefinitionError, match="unknown format 'docx'") as error:
        find("docx")
    assert error.value.hint.startswith("choose one of ")


def test_a_new_format_is_one_registration(monkeypatch, rgss, with_evidence, tmp_path):
    """It is listed, found by its ending, and refuses what it cannot do, with nothing else edited."""
    ids = TraceFormat(
        name="ids",
        suffix=".ids",
        title="a list of ids",
        write_report=lambda report, _: "".join(f"{one.id}\n" for one in report.model.requirements.system).encode(),
        write_found=lambda found, _: found.id.encode(),
        is_printable=False,
    )
    formats = (*TRACE_FORMATS, ids)
    monkeypatch.setattr(registry, "TRACE_FORMATS", formats)
    for module in ("rgss.cli.trace_output", "rgss.cli.verbs.trace"):
        monkeypatch.setattr(f"{module}.TRACE_FORMATS", formats)
    file = tmp_path / "trace.ids"
    written = rgss("trace", "-o", file, "--project", with_evidence)
    printed = rgss("trace", "--format", "ids", "--project", with_evidence)
    table = rgss("trace", "--table", "gaps", "-o", tmp_path / "other.ids", "--project", with_evidence)

    assert (written.status, written.output) == (0, f"Wrote {file}\n")
    assert file.read_text(encoding="utf-8").splitlines()[0].startswith("SYS-")
    assert "a list of ids cannot be printed (name a file with -o trace.ids)" in printed.complaint
    *others, last = [one.name for one in TRACE_FORMATS if one.has_tables]
    use = f"use {', '.join(others)} or {last}"
    assert f"--table does not go with ids, which holds everything ({use})" in table.complaint
