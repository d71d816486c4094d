"""MCAP file of a replay, for Foxglove and other readers of the format."""

from __future__ import annotations

import io
import json

from rgss.reports.replay.foxglove.channels import Channel
from rgss.reports.replay.foxglove.primitives import nanoseconds
from rgss.reports.replay.foxglove.scene_channels import scene_channels
from rgss.reports.replay.foxglove.series_channels import series_channels
from rgss.reports.replay.timeline import Timeline
from rgss.trials.replay import ReplayScene

_LIBRARY = "rgss"


def replay_to_mcap(timeline: Timeline, scene: ReplayScene) -> bytes:
    """A replay as an MCAP file; the same trial gives the same bytes.

    Messages are JSON with JSON Schemas, those of Foxglove where it publishes one. Times are those of the trial, in
    simulated time; the file has no other.
    """
    from mcap.writer import Writer

    file = io.BytesIO()
    writer = Writer(file)
    # The library would otherwise be named with its release, on which the content does not depend.
    writer.start(library=_LIBRARY)
    channels = (*scene_channels(timeline, scene), *series_channels(timeline))
    schemas: dict[str, int] = {}
    for channel in channels:
        if channel.schema.name not in schemas:
            schemas[channel.schema.name] = writer.register_schema(
                name=channel.schema.name, encoding="jsonschema", data=channel.schema.text.encode("utf-8")
            )
    identifiers = {
        channel.topic: writer.register_channel(
            topic=channel.topic, message_encoding="json", schema_id=schemas[channel.schema.name]
        )
        for channel in channels
    }
    writer.add_metadata("trial", {"title": timeline.title, "outcome": timeline.outcome})
    for time_ns, topic, sequence, content in _ordered(channels):
        writer.add_message(
            channel_id=identifiers[topic], log_time=time_ns, publish_time=time_ns, sequence=sequence, data=content
        )
    writer.finish()
    return file.getvalue()


def _ordered(channels: tuple[Channel, ...]) -> list[tuple[int, str, int, bytes]]:
    """Time, topic, number in its channel and content of all messages, by time; at one time in order of the channels."""
    messages = [
        (
            nanoseconds(time_s),
            channel.topic,
            number,
            json.dumps(content, allow_nan=False, separators=(",", ":")).encode("utf-8"),
        )
        for channel in channels
        for number, (time_s, content) in enumerate(channel.messages)
    ]
    return sorted(messages, key=lambda message: message[0])
