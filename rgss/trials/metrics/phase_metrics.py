"""Metrics of single phases, without a value for the trial."""

from __future__ import annotations

import math

from rgss.trials.metrics.descriptor import WITH_CONTACT, Direction, MetricDescriptor

PHASE_ONLY_METRICS: tuple[MetricDescriptor, ...] = (
    MetricDescriptor(
        name="commanded_tool_speed_m_s",
        unit="m/s",
        meaning="greatest commanded speed of the grasp centre",
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="commanded_tool_acceleration_m_s2",
        unit="m/s**2",
        meaning="greatest commanded acceleration of the grasp centre",
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="workpiece_displacement_m",
        unit="m",
        meaning="displacement of the object before the grasp, or by the hand during and after its release",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="workpiece_position_m",
        unit="m",
        meaning="position of the object in the world at the end: x, y, z",
        fidelities=WITH_CONTACT,
        length=3,
        least=None,
    ),
    MetricDescriptor(
        name="workpiece_tilt_rad",
        unit="rad",
        meaning="tilt of the object at the end",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
        most=math.pi,
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
        meaning="travel from open at the end of the grasp, of each finger",
        fidelities=WITH_CONTACT,
        length=0,
    ),
    MetricDescriptor(
        name="tightenings",
        unit="1",
        meaning="number of increases of the grip force",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="grasp_samples_closed",
        unit="1",
        meaning="number of samples of the grasp in force closure",
        better=Direction.HIGHER,
        fidelities=WITH_CONTACT,
    ),
    MetricDescriptor(
        name="release_height_m",
        unit="m",
        meaning="height above the surface at which the object was released",
        fidelities=WITH_CONTACT,
        least=None,
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
        meaning="settling time of the object after opening",
        better=Direction.LOWER,
        fidelities=WITH_CONTACT,
    ),
)
"""Metrics of single phases."""
