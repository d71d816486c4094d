"""Texts for other programs: no formulas for spreadsheets, no characters that XML does not allow."""

from __future__ import annotations

import io
import re

from rgss.invisible_characters import visible

LONGEST_EXCEL_TEXT = 32_767
"""As many characters a cell of Excel holds."""

_EPOCH = (1980, 1, 1, 0, 0, 0)
_CLOCK = re.compile(rb"(<dcterms:(created|modified)[^>]*>)[^<]*(</dcterms:)")
_FORMULA = re.compile("^[ \u00a0\u3000]*[=+\\-@\t\r\n\uff1d\uff0b\uff0d\uff20]")
_NO_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x84\x86-\x9f\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")


def starts_like_a_formula(text: str) -> bool:
    """True if a spreadsheet may take a text for a formula when it opens a text file.

    The signs are those of the OWASP page on CSV injection, their full-width forms, and either
    behind blanks, which some programs cut off.
    """
    return _FORMULA.match(text) is not None


def neutralised(text: str) -> str:
    """A text that no spreadsheet takes for a formula: with an apostrophe before what one might.

    A text that begins with apostrophes gets one more, so that `restored` gives back every text.
    """
    return f"'{text}" if starts_like_a_formula(text.lstrip("'")) else text


def restored(text: str) -> str:
    """The text that `neutralised` was given."""
    return text[1:] if text.startswith("'") and starts_like_a_formula(text.lstrip("'")) else text


def printable(text: str) -> str:
    """A text that UTF-8 and XML can hold and people can see: what they cannot is replaced by U+FFFD.

    Characters that reorder or hide text are shown by their code points.
    """
    return _NO_TEXT.sub("\ufffd", visible(text))


def without_clock(workbook: bytes) -> bytes:
    """The same Excel file without its time of creation, which it contains twice."""
    import zipfile

    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(workbook)) as source, zipfile.ZipFile(out, "w") as target:
        for name in source.namelist():
            part = source.read(name)
            if name == "docProps/core.xml":
                part = _CLOCK.sub(rb"\g<1>1980-01-01T00:00:00Z\3", part)
            entry = zipfile.ZipInfo(name, date_time=_EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            target.writestr(entry, part)
    return out.getvalue()
