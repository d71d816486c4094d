"""Safe texts for other programs: no spreadsheet formulas, no characters that XML does not allow."""

from __future__ import annotations

import io
import re

from rgss.invisible_characters import visible

LONGEST_EXCEL_TEXT = 32_767
"""Greatest number of characters of a cell in Excel."""

_EPOCH = (1980, 1, 1, 0, 0, 0)
_CLOCK = re.compile(rb"(<dcterms:(created|modified)[^>]*>)[^<]*(</dcterms:)")
_FORMULA = re.compile("^[ \u00a0\u3000]*[=+\\-@\t\r\n\uff1d\uff0b\uff0d\uff20]")
_NO_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x84\x86-\x9f\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")


def starts_like_a_formula(text: str) -> bool:
    """True if a spreadsheet may interpret a text as a formula when it opens a text file.

    The characters are those of the OWASP page on CSV injection, their full-width forms, and either after blanks, which
    some programs strip.
    """
    return _FORMULA.match(text) is not None


def neutralised(text: str) -> str:
    """Text that no spreadsheet interprets as a formula: prefixed with an apostrophe if necessary.

    A text that begins with an apostrophe gets another one, so that `restored` is the inverse.
    """
    return f"'{text}" if starts_like_a_formula(text.lstrip("'")) else text


def restored(text: str) -> str:
    """Inverse of `neutralised`."""
    return text[1:] if text.startswith("'") and starts_like_a_formula(text.lstrip("'")) else text


def printable(text: str) -> str:
    """Text with only characters of UTF-8 and XML that are visible; others are replaced by U+FFFD.

    Characters that reorder or hide text are replaced by their code points.
    """
    return _NO_TEXT.sub("\ufffd", visible(text))


def without_clock(workbook: bytes) -> bytes:
    """Excel file without its creation time, which it contains twice."""
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
