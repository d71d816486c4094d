"""Every example of YAML in the documentation is accepted by the document that it is part of."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rgss.documents import load_document, read_document
from rgss.errors import DocumentError
from rgss.exchange.mapping_file import MappingFile, read_mapping
from rgss.studies.schemas.document_kinds import DOCUMENT_KINDS

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
FOREIGN = {"apiVersion", "jobs"}
"""Keys of documents of other programs: a cluster's and a workflow's."""
PARTIAL = {"document.missing-key"}
"""What an example may lack, for it shows a part of its document."""


def examples():
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for found in re.finditer(r"^( *)```yaml\n(.*?)^ *```", text, re.MULTILINE | re.DOTALL):
            block = re.sub(rf"^{found[1]}", "", found[2], flags=re.MULTILINE)
            if not re.search(rf"^({'|'.join(FOREIGN)}):", block, re.MULTILINE):
                yield pytest.param(block, id=f"{page.name}:{text.count(chr(10), 0, found.start()) + 1}")


def findings_of(path, model):
    try:
        load_document(path, model)
    except DocumentError as error:
        return [finding for finding in error.findings if finding.rule not in PARTIAL]
    return []


@pytest.mark.parametrize("block", list(examples()))
def test_an_example_is_part_of_a_document(tmp_path, block):
    path = tmp_path / "example.yaml"
    path.write_text(block, encoding="utf-8")
    data = read_document(path).data
    if not isinstance(data, dict):
        return  # entries of a list, which the tutorial's test puts into their files

    models = {**{kind.id: kind.model for kind in DOCUMENT_KINDS}, "names of another tool": MappingFile}
    found = {kind: findings_of(path, model) for kind, model in models.items()}

    closest = min(found, key=lambda kind: len(found[kind]))
    assert found[closest] == [], closest
    if models[closest] is MappingFile:
        assert read_mapping(path).names.attributes


def test_examples_are_found():
    assert len(list(examples())) > 70
