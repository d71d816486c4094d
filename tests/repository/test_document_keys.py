"""Each key that a YAML document may have is shown by one: of the project, of a new one, of docs/, or of the tests.

`documents/` has sections of documents for the keys that neither a project nor docs/ needs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

from rgss.documents import read_document
from rgss.studies import FOLDERS
from rgss.studies.schemas.document_kinds import DOCUMENT_KINDS, kind_of
from tests.fixtures.document_keys import keys_of_document, keys_of_section, possible_keys

REPOSITORY = Path(__file__).resolve().parents[2]
PROJECTS = (REPOSITORY, REPOSITORY / "rgss" / "studies" / "scaffold")
SECTIONS = sorted((Path(__file__).parent / "documents").glob("*.yaml"))
EXAMPLE = re.compile(r"^```yaml\n(.*?)^```", re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def shown() -> set[tuple[str, str]]:
    """The keys that documents and examples have, each with the name of its model."""
    found = set()
    for project in PROJECTS:
        for path in (path for folder in FOLDERS for path in sorted((project / folder).rglob("*.yaml"))):
            data = read_document(path).data
            kind = kind_of(path.relative_to(project).as_posix(), data)
            if kind is not None:
                found.update(keys_of_document(kind.model, data))
    pages = [page.read_text(encoding="utf-8") for page in sorted((REPOSITORY / "docs").glob("*.md"))]
    examples = [example for page in pages for example in EXAMPLE.findall(page)]
    for example in (*examples, *(path.read_text(encoding="utf-8") for path in SECTIONS)):
        found.update(keys_of_example(example))
    return found


def keys_of_example(example: str) -> Iterator[tuple[str, str]]:
    """The keys of those sections of an example that a document of some kind may have."""
    sections = [each for data in yaml.safe_load_all(example) if isinstance(data, dict) for each in data.items()]
    for key, value in sections:
        for kind in DOCUMENT_KINDS:
            yield from keys_of_section(kind.model, key, value)


@pytest.mark.parametrize("kind", DOCUMENT_KINDS, ids=lambda kind: kind.id)
def test_every_key_is_shown_by_a_document(kind, shown):
    unseen = {
        f"{model}.{key}"
        for model, keys in possible_keys(kind.model).items()
        for key in keys
        if (model, key) not in shown
    }

    assert sorted(unseen) == [], "give an example in docs/, or a section in tests/repository/documents/"


@pytest.mark.parametrize("path", SECTIONS, ids=lambda path: path.name)
def test_each_section_of_the_tests_is_of_a_document(path):
    for key, value in read_document(path).data.items():
        assert list(keys_of_example(yaml.safe_dump({key: value}))), f"no kind of document has this {key!r}"
