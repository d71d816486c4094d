"""The base of every typed model that a YAML file is read into."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)
"""Configuration of the pydantic dataclasses of files: unknown keys are refused, nothing is coerced."""


class DocumentModel(BaseModel):
    """A part of a YAML file: unknown keys are refused, nothing is coerced, values are frozen."""

    model_config = ConfigDict(**STRICT, frozen=True)
