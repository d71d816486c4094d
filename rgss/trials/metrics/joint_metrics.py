"""Metrics of the arm's joints: torque, speed, utilisation and work."""

from __future__ import annotations

from rgss.trials.metrics.descriptor import FOR_EACH_JOINT, WITH_TORQUES, Aggregation, Direction, MetricDescriptor

JOINT_METRICS: tuple[MetricDescriptor, ...] = (
    MetricDescriptor(
        name="peak_joint_torque_n_m",
        unit="N*m",
        meaning="greatest torque, of each joint of the arm",
        better=Direction.LOWER,
        trial=Aggregation.GREATEST_OF_EACH,
        fidelities=WITH_TORQUES,
        length=FOR_EACH_JOINT,
    ),
    MetricDescriptor(
        name="peak_joint_torque_ratio",
        unit="1",
        meaning="greatest share of its torque limit that a joint reached",
        better=Direction.LOWER,
        trial=Aggregation.GREATEST,
        fidelities=WITH_TORQUES,
    ),
    MetricDescriptor(
        name="most_loaded_joint",
        unit="1",
        meaning="number of the joint nearest to its torque limit, from 1",
        trial=Aggregation.OF_GREATEST,
        fidelities=WITH_TORQUES,
        source="peak_joint_torque_ratio",
    ),
    MetricDescriptor(
        name="joint_saturated_s",
        unit="s",
        meaning="time at the torque limit, of each joint of the arm",
        better=Direction.LOWER,
        trial=Aggregation.SUM_OF_EACH,
        fidelities=WITH_TORQUES,
        length=FOR_EACH_JOINT,
    ),
    MetricDescriptor(
        name="peak_joint_speed_ratio",
        unit="1",
        meaning="greatest share of its speed limit that a joint reached",
        better=Direction.LOWER,
        trial=Aggregation.GREATEST,
    ),
    MetricDescriptor(
        name="fastest_joint",
        unit="1",
        meaning="number of the joint nearest to its speed limit, from 1",
        trial=Aggregation.OF_GREATEST,
        source="peak_joint_speed_ratio",
    ),
    MetricDescriptor(
        name="peak_joint_utilisation",
        unit="1",
        meaning="greatest share of a limit, of torque or of speed, that a joint reached",
        better=Direction.LOWER,
        trial=Aggregation.GREATEST,
        fidelities=WITH_TORQUES,
    ),
    MetricDescriptor(
        name="governing_joint",
        unit="1",
        meaning="number of the joint nearest to a limit of torque or of speed, from 1",
        trial=Aggregation.OF_GREATEST,
        fidelities=WITH_TORQUES,
        source="peak_joint_utilisation",
    ),
    MetricDescriptor(
        name="joint_work_j",
        unit="J",
        meaning="mechanical work of the joints without recuperation, the sum of ∫abs(τ q̇)dt",
        better=Direction.LOWER,
        trial=Aggregation.SUM,
        fidelities=WITH_TORQUES,
    ),
    MetricDescriptor(
        name="joint_net_work_j",
        unit="J",
        meaning="net work of the joints with full recuperation, the sum of ∫τ q̇ dt",
        better=Direction.LOWER,
        trial=Aggregation.SUM,
        fidelities=WITH_TORQUES,
        least=None,
    ),
)
"""Metrics of the joints."""
