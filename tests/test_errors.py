"""The exceptions: what they say, what they carry, and that they survive a process boundary."""

from __future__ import annotations

import pickle

import pytest

from rgss import errors
from rgss.errors import DocumentError, QuantityError, RgssError
from rgss.findings import Finding, Severity

PLAIN = [
    errors.RgssError,
    errors.QuantityError,
    errors.DefinitionError,
    errors.SimulationError,
    errors.MotionError,
    errors.DriverError,
    errors.EvidenceError,
    errors.StorageError,
    errors.TradeoffError,
]


def finding(line=1, message="bad"):
    return Finding(file="f.yaml", line=line, column=2, rule="a.b", severity=Severity.ERROR, message=message)


@pytest.mark.parametrize("kind", PLAIN)
def test_message_and_hint(kind):
    assert str(kind("cannot go on")) == "cannot go on"
    assert str(kind("cannot go on", hint="try this")) == "cannot go on (try this)"
    assert (kind("a", hint="b").message, kind("a", hint="b").hint, kind("a").hint) == ("a", "b", "")


def test_every_error_is_an_rgss_error():
    kinds = [kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, Exception)]

    assert set(kinds) == {*PLAIN, DocumentError}
    assert all(issubclass(kind, RgssError) for kind in kinds)
    assert issubclass(QuantityError, ValueError)


def test_document_error_shows_its_first_finding_and_how_many_more():
    first, second, third = finding(1), finding(2), finding(3)

    assert str(DocumentError([first])) == "f.yaml:1:2: error: bad [a.b]"
    assert str(DocumentError([first], hint="see it")) == "f.yaml:1:2: error: bad [a.b] (see it)"
    assert str(DocumentError([first, second, third])) == "f.yaml:1:2: error: bad [a.b] (and 2 more)"
    assert DocumentError([first, second]).findings == (first, second)


def test_document_error_needs_a_finding():
    with pytest.raises(ValueError, match="at least one finding"):
        DocumentError([])


@pytest.mark.parametrize("kind", PLAIN)
def test_errors_cross_processes(kind):
    copy = pickle.loads(pickle.dumps(kind("a", hint="b")))  # noqa: S301

    assert (type(copy), copy.message, copy.hint, str(copy), copy.args) == (kind, "a", "b", "a (b)", ("a",))


def test_document_errors_cross_processes():
    error = DocumentError([finding(1), finding(2)], hint="see it")
    copy = pickle.loads(pickle.dumps(error))  # noqa: S301

    assert (copy.findings, copy.message, copy.hint) == (error.findings, error.message, error.hint)
    assert (str(copy), copy.args) == (str(error), error.args)
