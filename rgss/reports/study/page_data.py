"""Data in a page: a report's document and its pictures as texts of the page."""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Mapping
from typing import Any

from rgss.invisible_characters import visible_throughout

_COLUMNS = ("value", "low", "high", "n")


def parted(document: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Split of a document: without the columns of measures that have no weight and no limit, and these columns.

    A page with many variants is shown sooner without them, and adds them afterwards.

    Returns:
        The document, and the removed columns by the measure's id.
    """
    wanted = {requirement["measure"] for requirement in document["requirements"]}
    measures, later = [], {}
    for measure in document["measures"]:
        decisive = measure["kind"] == "moe" or measure["weight"] is not None or measure["id"] in wanted
        columns = {} if decisive else {name: measure[name] for name in _COLUMNS if isinstance(measure.get(name), list)}
        measures.append({name: value for name, value in measure.items() if name not in columns})
        if columns:
            later[measure["id"]] = columns
    return {**document, "measures": measures}, later


def embedded_json(document: Any) -> str:
    """A document as JSON that is safe within a script element.

    Nothing in it can end the element or a line: non-ASCII characters and ``<``, ``>`` and ``&`` are
    written as JSON escapes. Invisible characters are replaced by their code points, since the page
    displays the texts.

    Args:
        document: Dictionaries, lists, texts, finite numbers.
    """
    text = json.dumps(visible_throughout(document), allow_nan=False, ensure_ascii=True, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def packed_json(text: str) -> str:
    """A JSON text compressed with gzip and encoded in base64, reproducible byte for byte."""
    return base64.b64encode(gzip.compress(text.encode("ascii"), compresslevel=9, mtime=0)).decode("ascii")


def data_address(kind: str, content: bytes) -> str:
    """Data URL of a file; empty if the file is empty.

    Args:
        kind: Its media type.
        content: Its bytes.
    """
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}" if content else ""
