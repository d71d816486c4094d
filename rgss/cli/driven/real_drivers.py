"""Registry of the drivers of real robots: a new one is a module in `rgss/drivers` and an entry here."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.drivers import Driver
    from rgss.trials import TrialSpec


@dataclass(frozen=True, slots=True, kw_only=True)
class RealDriver:
    """Driver of a manufacturer's robots.

    Attributes:
        name: Its name, the value of ``--driver``.
        fewest_joints: Fewest joints of these robots; all turn.
        most_joints: Most joints.
        without_neutral: Reason why the hand has no neutral state, after the driver's name; empty if it has one.
        made: Makes the driver, not yet connected, from the options of the verb and the trial.
    """

    name: str
    fewest_joints: int
    most_joints: int
    without_neutral: str = ""
    made: Callable[[argparse.Namespace, TrialSpec], Driver]


def _xarm(options: argparse.Namespace, spec: TrialSpec) -> Driver:
    from rgss.drivers import XarmDriver

    joints = len(spec.scene.robot.joints)
    return XarmDriver(options.address or "", joints=joints, is_vacuum=spec.gripper.suction is not None)


def _ur(options: argparse.Namespace, spec: TrialSpec) -> Driver:  # noqa: ARG001
    from rgss.drivers import UrDriver, UrSettings

    return UrDriver(options.address or "", settings=UrSettings(gripper_output=options.gripper_output or 0))


REAL_DRIVERS: tuple[RealDriver, ...] = (
    RealDriver(name="xarm", fewest_joints=5, most_joints=7, made=_xarm),
    RealDriver(
        name="ur",
        fewest_joints=6,
        most_joints=6,
        without_neutral="sets one output for the gripper, open or closed",
        made=_ur,
    ),
)
"""All of them, in the order in which they are listed."""


def real_driver(name: str) -> RealDriver | None:
    """The driver of real robots with a name; None for the simulated one."""
    return next((one for one in REAL_DRIVERS if one.name == name), None)
