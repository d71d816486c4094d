"""Metrics of single phases, of which a trial as a whole has none."""

from __future__ import annotations

from rgss.trials.metrics.descriptor import WITH_CONTACT, Direction, MetricDescriptor

PHASE_ONLY_METRICS: tuple[MetricDescriptor, ...] = (
    MetricDescriptor(
        name="commanded_tool_speed_m_s",
        unit="m/s",
        meaning="greatest speed of the grasp centre that was asked for",
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="commanded_tool_acceleration_m_s2",
        unit="m/s**2",
        meaning="greatest acceleration that was asked for",
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="workpiece_displacement_m",
        unit="m",
        meaning="how far the object moved before the grasp, or the hand moved it in its release and afterwards",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="workpiece_position_m",
        unit="m",
        meaning="position of the object in the world at the end: x, y, z",
        fidelities=WITH_CONTACT,
        length=3,
    ),
    MetricDescriptor(
        name="workpiece_tilt_rad",
        unit="rad",
        meaning="angle by which the object leans at the end",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="finger_force_n",
        unit="N",
        meaning="normal force at the end of the grasp, of each finger",
        fidelities=WITH_CONTACT,
        length=0,
    ),
    MetricDescriptor(
        name="finger_force_needed_n",
        unit="N",
        meaning="normal force of a finger that Coulomb friction needs at rest",
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="finger_travel_m",
        unit="m",
        meaning="how far it had closed at the end of the grasp, of each finger",
        fidelities=WITH_CONTACT,
        length=0,
    ),
    MetricDescriptor(
        name="tightenings",
        unit="1",
        meaning="how often the grip was tightened",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="grasp_samples_closed",
        unit="1",
        meaning="how many of the samples of the grasp were in force closure",
        better=Direction.HIGHER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="release_height_m",
        unit="m",
        meaning="height above the surface at which the object was released",
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="landing_speed_m_s",
        unit="m/s",
        meaning="greatest velocity change of the object by the scene as it lands",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="touch_force_n",
        unit="N",
        meaning="greatest normal force of a finger on the object after its release",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="opening_s",
        unit="s",
        meaning="time of opening",
        better=Direction.LOWER,
    ),
    MetricDescriptor(
        name="settling_s",
        unit="s",
        meaning="time after opening until the object stood still",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
)
"""Metrics of single phases."""
