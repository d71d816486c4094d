"""Export of trials to Parquet or CSV, written atomically."""

from __future__ import annotations

import csv
import importlib.util
import io
import os
from collections.abc import Iterable
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from rgss.documents import neutralised, replaced_file
from rgss.errors import EvidenceError
from rgss.evidence.records import StoredTrial
from rgss.evidence.store.connection import error_of
from rgss.evidence.store.trial_table import trial_frame

if TYPE_CHECKING:
    import pandas as pd


def require_exportable(path: Path) -> None:
    """Require a supported file name and installed format, before any work.

    Raises:
        EvidenceError: The suffix is unknown, or the format needs a package that is not installed.
    """
    ending = path.suffix.lower()
    if ending not in (".parquet", ".csv"):
        raise EvidenceError(f"{path} must end in .parquet or .csv", hint="the suffix selects the format")
    if ending == ".parquet" and importlib.util.find_spec("pyarrow") is None:
        raise EvidenceError(
            "a Parquet file needs pyarrow, which is not installed",
            hint="pip install 'rgss[parquet]', or name a .csv file",
        )


def export_trials(trials: Iterable[StoredTrial], path: Path) -> int:
    """Write trials as a table, one row for each, with the columns of `rgss.evidence.store.trial_table`.

    Args:
        trials: The trials.
        path: The file, whose suffix selects the format. An existing file is replaced only when the new one is complete.

    Returns:
        The number of trials.

    Raises:
        EvidenceError: As `require_exportable` and `rgss.evidence.store.trial_table.trial_frame`; or the
            file cannot be written: `StorageError` if the disk is full.
    """
    require_exportable(path)
    frame = trial_frame(trials)
    try:
        with replaced_file(path) as part, part.open("wb") as file:
            if path.suffix.lower() == ".csv":
                _write_csv(frame, file)
            else:
                frame.to_parquet(file, engine="pyarrow", index=False)
    except OSError as error:
        problem = os.strerror(error.errno) if error.errno else str(error)
        raise error_of(error)(f"{path} cannot be written: {problem}") from error
    return len(frame)


def _write_csv(frame: pd.DataFrame, file: IO[bytes]) -> None:
    """Write a table as CSV by RFC 4180, with an apostrophe before every text that could be a formula.

    Numbers are written by ``repr``, so that they are read back bit for bit.
    """
    text = io.TextIOWrapper(file, encoding="utf-8", newline="")
    # With both characters in the line terminator, a cell with either is quoted.
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow([_as_text(name) for name in frame.columns])
    columns = [_csv_cells(frame[name]) for name in frame.columns]
    writer.writerows(zip(*columns, strict=True))
    text.flush()
    text.detach()


def _csv_cells(column: pd.Series[Any]) -> list[object]:
    """Cells of a column; missing values are empty."""
    values = column.astype(object).where(column.notna(), None).tolist()
    return [_as_text(value) for value in values] if column.dtype == "string" else values


def _as_text(text: str | None) -> str | None:
    return None if text is None else neutralised(text)
