"""The YAML form of an excitation."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from rgss.documents import (
    DocumentModel,
    Hertz,
    Identifier,
    JointPosition,
    JointSpeed,
    Metres,
    MetresPerSecond,
    Radians,
    RadiansPerSecond,
    Seconds,
)
from rgss.scenes import ServoControl

Speeds = Annotated[tuple[JointSpeed, ...], Field(min_length=1)]


class StepsEntry(DocumentModel):
    """Steps of the speed: each speed forwards, then backwards, each for `hold`."""

    speeds: Speeds
    hold: Seconds


class SinesEntry(DocumentModel):
    """Sine speeds: each amplitude at each frequency, for a number of cycles."""

    amplitudes: Speeds
    frequencies: Annotated[tuple[Hertz, ...], Field(min_length=1)]
    cycles: Annotated[int, Field(ge=1, le=100)] = 2


class NoiseEntry(DocumentModel):
    """Standard deviations of the simulated measurements, of joints that turn and of joints that slide."""

    position: Radians = 0.0
    velocity: RadiansPerSecond = 0.0
    slide_position: Metres = 0.0
    slide_velocity: MetresPerSecond = 0.0
    seed: Annotated[int, Field(ge=0, lt=2**31)] = 0


class ExcitationDocument(DocumentModel):
    """An excitation file."""

    excitation: Identifier
    control: ServoControl = ServoControl.VELOCITY
    rate: Hertz
    rest: Seconds
    steps: StepsEntry | None = None
    sines: SinesEntry | None = None
    poses: Annotated[dict[Identifier, tuple[JointPosition, ...]], Field(min_length=1)]
    joints: tuple[Identifier, ...] | None = None
    noise: NoiseEntry = NoiseEntry()
