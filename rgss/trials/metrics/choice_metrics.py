"""Metrics of the grasp chosen among candidates; none for a stated grasp."""

from __future__ import annotations

from rgss.trials.metrics.descriptor import Direction, MetricDescriptor

CHOICE_METRICS: tuple[MetricDescriptor, ...] = (
    MetricDescriptor(
        name="chosen_grasp_rank",
        unit="1",
        meaning="rank of the chosen grasp among the candidates, from 1",
        better=Direction.LOWER,
    ),
    MetricDescriptor(
        name="chosen_grasp_candidates",
        unit="1",
        meaning="grasp candidates that the gripper can close on in force closure",
    ),
    MetricDescriptor(
        name="chosen_grasp_opening_m",
        unit="m",
        meaning="distance of the pads from the gripper's axis at the chosen grasp, as computed",
    ),
    MetricDescriptor(
        name="chosen_grasp_smw_1",
        unit="1",
        meaning="smallest maximum wrench of the chosen grasp for finger forces of 1 N",
        better=Direction.HIGHER,
    ),
    MetricDescriptor(
        name="chosen_grasp_weight_1",
        unit="1",
        meaning="weight at rest that a suction cup holds at the chosen point, divided by the force of its vacuum",
        better=Direction.HIGHER,
    ),
    MetricDescriptor(
        name="chosen_grasp_room_m",
        unit="m",
        meaning="distance of the chosen suction point from the nearest edge of its face",
        better=Direction.HIGHER,
    ),
    MetricDescriptor(
        name="chosen_grasp_com_distance_m",
        unit="m",
        meaning="distance of the centre of mass from the line of two contacts, the middle of more, or a cup's axis",
        better=Direction.LOWER,
    ),
    MetricDescriptor(
        name="chosen_grasp_position_m",
        unit="m",
        meaning="position of the grasp centre in the object's frame: x, y, z",
        length=3,
        least=None,
    ),
    MetricDescriptor(
        name="chosen_grasp_quaternion_1",
        unit="1",
        meaning="orientation of the tool in the object's frame: quaternion x, y, z, w",
        length=4,
        least=-1.0,
        most=1.0,
    ),
)
