"""Domain values as plain data, for digests and comparisons."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from enum import Enum
from typing import Any


def to_plain(value: Any) -> Any:
    """Convert a value of frozen dataclasses to plain mappings, lists, texts and numbers.

    Fields that do not take part in a comparison are no content, and are omitted.

    Args:
        value: A dataclass, an enumeration, a tuple, a list, a mapping, or plain data.
    """
    if dataclasses.is_dataclass(value):
        return {f.name: to_plain(getattr(value, f.name)) for f in dataclasses.fields(value) if f.compare}
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, (tuple, list)):
        return [to_plain(item) for item in value]
    if isinstance(value, Mapping):
        return {key: to_plain(item) for key, item in value.items()}
    return value


def without(values: dict[str, Any], names: tuple[str, ...]) -> dict[str, Any]:
    """Plain values without some names."""
    return {name: value for name, value in values.items() if name not in names}
