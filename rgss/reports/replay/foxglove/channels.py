"""Channels of an MCAP file: topics with their schemas and messages."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any

Message = Mapping[str, Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class Schema:
    """JSON Schema of the messages of a channel.

    Attributes:
        name: Its name, by which a viewer recognizes the content.
        text: The schema.
    """

    name: str
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Channel:
    """Messages of one topic, encoded as JSON.

    Attributes:
        topic: The topic.
        schema: Schema of the messages.
        messages: Time in s and content of each message, in their order.
    """

    topic: str
    schema: Schema
    messages: Sequence[tuple[float, Message]]


def published_schema(name: str) -> Schema:
    """Schema that Foxglove publishes; the files in ``schemas`` are those of its SDK, unchanged, with their licence.

    Args:
        name: Its name without the prefix, such as ``SceneUpdate``.
    """
    file = resources.files(__package__).joinpath(f"schemas/{name}.json")
    return Schema(name=f"foxglove.{name}", text=file.read_text(encoding="utf-8"))


def number_schema(name: str, fields: Mapping[str, str]) -> Schema:
    """Schema of messages that contain numbers, each of which may be absent where it is unknown.

    Args:
        name: Name of the schema.
        fields: Description of each number by its key.
    """
    properties = {key: {"type": "number", "description": description} for key, description in fields.items()}
    return Schema(name=name, text=json.dumps({"title": name, "type": "object", "properties": properties}))
