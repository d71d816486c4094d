"""Files of ReqIF with a text of their own."""

from __future__ import annotations

import pytest

from rgss.exchange.reqif import read_reqif, reqif_text


@pytest.fixture
def as_xml(tmp_path):
    """A file with some text of its own."""

    def written(text):
        path = tmp_path / "foreign.reqif"
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
        return path

    return written


@pytest.fixture
def text(project):
    """The small project as ReqIF."""
    return reqif_text(project.content, title="t")


@pytest.fixture
def read(as_xml):
    """The content of a text as a file of ReqIF."""
    return lambda text: read_reqif(as_xml(text))
