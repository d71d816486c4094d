"""Columns that several frames share."""

from __future__ import annotations

from rgss.api.column import Column, Kind

VARIANT = Column(name="variant", meaning="id of the design variant", unit="1", kind=Kind.COUNT)


SEED = Column(name="seed", meaning="seed of the trial; replicate r has the study's seed + r", unit="1", kind=Kind.COUNT)


MEASURE = Column(name="measure", meaning="id of the measure")


AS_UNIT = "as `unit` says"


UNIT = Column(name="unit", meaning="unit of the numbers of the row")
