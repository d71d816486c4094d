"""The shipped project in the language, and an interpreter of another hand."""

from __future__ import annotations

import gc
from pathlib import Path

import longeron
import longeron.parser
import pytest
from antlr4.atn.ParserATNSimulator import ParserATNSimulator

from rgss.exchange.sysml import sysml_text
from rgss.measures import StaleCause
from rgss.requirements import RecordedResult, VerificationRecord
from rgss.studies.project import load_project
from rgss.trace.evidence import RecordEvidence

WIDE_RULES = frozenset({"identification", "usageDeclaration", "featureSpecializationPart", "multiplicityPart"})
"""Rules of the grammar that almost anything may follow, with all of whose followers a prediction begins otherwise."""


class _Predictor(ParserATNSimulator):
    """Prediction of ANTLR, which begins with the true followers of a rule where a rule has too many.

    It then predicts what it would predict in the end: where the followers of a rule in every place leave a conflict, it
    begins again with those in this one ("Adaptive LL(*) Parsing", Parr, Harwell and Fisher, 2014). For this grammar
    the table of the followers in every place takes two minutes in Python, nine tenths of the time of the parser.
    """

    def adaptivePredict(self, input, decision, outerContext):  # noqa: A002, N802, N803 - the names of ANTLR
        dfa = self.decisionToDFA[decision]
        if self.parser.ruleNames[dfa.atnStartState.ruleIndex] not in WIDE_RULES:
            return super().adaptivePredict(input, decision, outerContext)
        self._input, self._startIndex, self._outerContext, self._dfa = input, input.index, outerContext, dfa
        marker, start = input.mark(), input.index
        try:
            begin = self.computeStartState(dfa.atnStartState, outerContext, True)
            return self.execATNWithFullContext(dfa, None, begin, input, start, outerContext)
        finally:
            self._dfa = self.mergeCache = None
            input.seek(start)
            input.release(marker)


class _Parser(longeron.parser.SysMLParser):
    """The interpreter's parser with that prediction."""

    def __init__(self, tokens):
        super().__init__(tokens)
        usual = self._interp
        self._interp = _Predictor(self, usual.atn, usual.decisionToDFA, usual.sharedContextCache)


@pytest.fixture(scope="session")
def shipped():
    return load_project(Path(__file__).resolve().parents[3])


def recorded(name, result, *causes):
    record = VerificationRecord(
        result=result, by="A. Reader", date="2026-05-12", note="*/ Ten of ten.", files={}, requirement="0" * 64
    )
    return RecordEvidence(requirement=name, record=record, causes=causes)


@pytest.fixture(scope="session")
def records():
    """Verification records: one that holds, one that says not met, and one that no longer holds."""
    found = [
        recorded("SYS-001", RecordedResult.MET),
        recorded("SYS-002", RecordedResult.NOT_MET),
        recorded("SYS-003", RecordedResult.MET, StaleCause.REQUIREMENT),
    ]
    return {each.requirement: each for each in found}


@pytest.fixture(scope="session")
def written(shipped, records):
    return sysml_text(shipped.requirements, shipped.measures, title=shipped.study.id, records=records)


@pytest.fixture(scope="session")
def read():
    """Reads a text with the interpreter.

    What it makes is garbage at no time, and to look through it again and again takes a quarter more.
    """

    def read_text(text):
        gc.disable()
        try:
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(longeron.parser, "SysMLParser", _Parser)
                return longeron.loads(text)
        finally:
            gc.enable()

    return read_text


@pytest.fixture(scope="session")
def model(read, written):
    """The whole export as the interpreter reads it."""
    return read(written)


@pytest.fixture(scope="session")
def elements(model):
    return list(model.iter_tree())
