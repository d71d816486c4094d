"""A shape of value functions may have a key that is a pure number: it is read as it is, and is no anchor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import pytest

from rgss.documents import Dimensionless, read_document
from rgss.studies.trade_off import values as reading
from rgss.studies.trade_off.document import ValueEntry
from rgss.studies.trade_off.elicitation import AnswerReader
from rgss.studies.trade_off.places import SECTION, TradeOffPlaces
from rgss.tradeoff import SHAPE_KEYS
from rgss.tradeoff.problem.values import PiecewiseValue
from rgss.tradeoff.problem.values.value_function import AnchoredBetween


class PowerEntry(ValueEntry):
    """An entry with the keys of a further shape."""

    exponent: Dimensionless | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Power(AnchoredBetween):
    """The further shape."""

    required: ClassVar[tuple[str, ...]] = ("worst", "best", "exponent")
    numbers: ClassVar[tuple[str, ...]] = ("exponent",)
    own: ClassVar[tuple[str, ...]] = ("exponent",)
    label: ClassVar[str] = "'exponent'"

    exponent: float

    def function(self, quantity_of):
        worst, best = quantity_of(self.worst), quantity_of(self.best)
        return PiecewiseValue(measure=self.measure, worst=worst, best=best)


@pytest.fixture
def reader(shipped, monkeypatch):
    monkeypatch.setattr(reading, "SHAPE_KEYS", (*SHAPE_KEYS, "exponent"))
    monkeypatch.setattr(reading, "shape_of", lambda _: Power)
    document = read_document(shipped.folder / "studies" / "pick_place.yaml")
    places = TradeOffPlaces(document, shipped.measures, lambda: shipped.requirements)
    return reading.ValueReader(places, AnswerReader(places, (), SECTION))


def test_a_key_that_is_a_number_is_no_anchor(reader):
    entry = PowerEntry(measure="t_e", weight=1.0, worst="25 s", best="5 s", exponent=2)

    nodes = reader.read([entry], None, (*SECTION, "values"))

    (valued,) = reader.valued
    assert [node.name for node in nodes] == ["t_e"]
    assert valued == Power(measure="t_e", worst=25.0, best=5.0, exponent=2.0)
    assert dict(valued.anchors) == {"worst": 25.0, "best": 5.0}
