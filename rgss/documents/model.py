"""Base class of the document models of YAML files."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)
"""Configuration of the pydantic dataclasses of files: unknown keys are rejected, nothing is coerced."""


class DocumentModel(BaseModel):
    """Part of a YAML file: unknown keys are rejected, nothing is coerced, values are frozen."""

    model_config = ConfigDict(**STRICT, frozen=True)
