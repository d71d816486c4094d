"""Files of ReqIF with a text of their own."""

from __future__ import annotations

import pytest


@pytest.fixture
def as_xml(tmp_path):
    """A file with some text of its own."""

    def written(text):
        path = tmp_path / "foreign.reqif"
        path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
        return path

    return written
