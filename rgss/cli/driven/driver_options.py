"""Options of a run on a driver."""

from __future__ import annotations

import argparse
import ipaddress
import socket
from pathlib import Path

from rgss.cli.driven.real_drivers import REAL_DRIVERS
from rgss.cli.options import option_quantity
from rgss.errors import DefinitionError
from rgss.findings import shown

DRIVERS = ("simulated", *(one.name for one in REAL_DRIVERS))
_ONLY_WITH_DRIVER = ("address", "speed", "go", "recording", "gripper_output")


def add_driver(parser: argparse.ArgumentParser) -> None:
    """Add the driver and its options."""
    group = parser.add_argument_group("run the planned motion on a robot (docs/hardware.md)")
    group.add_argument("--driver", choices=DRIVERS, help="the robot; a real one is only rehearsed without --go")
    group.add_argument("--address", metavar="HOST", help="name or IP address of a real robot's controller")
    group.add_argument("--speed", metavar="SHARE", help="share of the planned speed (default: 10 %%)")
    group.add_argument("--go", action="store_true", default=None, help="move the real robot")
    group.add_argument("--recording", type=Path, metavar="FILE", help="write measured against commanded motion as CSV")
    group.add_argument(
        "--gripper-output",
        type=int,
        metavar="N",
        help="standard digital output that closes a UR's gripper (default: 0)",
    )


def check_driver(options: argparse.Namespace, *, has_pictures: bool) -> None:
    """Refuse options that exclude each other.

    Args:
        options: The options of the verb.
        has_pictures: True if films or plots are requested.

    Raises:
        DefinitionError: Options exclude each other, or one that is needed is missing.
    """
    if options.driver is None:
        for name in _ONLY_WITH_DRIVER:
            if getattr(options, name) is not None:
                raise DefinitionError(f"--{name.replace('_', '-')} needs --driver", hint=f"one of {', '.join(DRIVERS)}")
        return
    if has_pictures:
        raise DefinitionError("a run on a driver draws no pictures", hint="omit --driver, or the options of pictures")
    if options.driver == "simulated":
        for name in ("address", "go"):
            if getattr(options, name) is not None:
                raise DefinitionError(f"--{name} is for a real robot", hint="omit it with --driver simulated")
    elif options.go and not options.address:
        raise DefinitionError(f"--driver {options.driver} --go needs --address", hint="give the controller's address")
    if options.address is not None:
        _check_address(options.address, is_used=bool(options.go))
    if options.recording is not None and options.driver != "simulated" and not options.go:
        raise DefinitionError("a rehearsal measures nothing to record", hint="--recording needs --go")
    if options.gripper_output is not None and (options.driver != "ur" or not 0 <= options.gripper_output <= 7):
        raise DefinitionError("--gripper-output must be from 0 to 7 and is for --driver ur")
    speed_of(options)


def _check_address(address: str, *, is_used: bool) -> None:
    """Refuse numbers that are no IPv4 address, and names without one before the rehearsal of a run that uses them.

    Resolvers fill in missing numbers, so that another robot would move.
    """
    if ":" in address or not set(address.strip()) <= set("0123456789."):
        _check_name(address, is_used=is_used)
        return
    try:
        ipaddress.IPv4Address(address)
    except ValueError as error:
        raise DefinitionError(
            f"--address must be a name or four numbers from 0 to 255, got {shown(address)}",
            hint="such as 192.168.0.10, without leading zeros",
        ) from error


def _check_name(address: str, *, is_used: bool) -> None:
    """Refuse IPv6 addresses, which the SDKs do not open, and unknown names."""
    if ":" in address:
        what = "an IPv6 address" if _is_ipv6(address) else "a port or a URL"
        raise DefinitionError(
            f"--address must be a name or an IPv4 address, got {what}: {shown(address)}",
            hint="give the address alone, such as 192.168.0.10; each driver has its ports",
        )
    if not is_used:
        return
    try:
        socket.getaddrinfo(address, None, socket.AF_INET)
    except (OSError, UnicodeError) as error:
        raise DefinitionError(
            f"--address: no IPv4 address of {shown(address)} is found", hint="check its spelling and the network"
        ) from error


def _is_ipv6(address: str) -> bool:
    try:
        ipaddress.IPv6Address(address.strip("[]"))
    except ValueError:
        return False
    return True


def speed_of(options: argparse.Namespace) -> float:
    """The share of the planned speed, from 0 to 1.

    Raises:
        DefinitionError: It is not a share above 0 % and at most 100 %.
    """
    if options.speed is None:
        return 0.1
    share = option_quantity("--speed", options.speed, "1", example='"10 %"')
    if not 0.0 < share <= 1.0:
        raise DefinitionError(f"--speed must be above 0 % and at most 100 %, got {options.speed}")
    return share
