"""Import of a vendor's SDK, an optional part of an installation."""

from __future__ import annotations

import contextlib
import importlib
import sys
from collections.abc import Callable, Iterator
from types import ModuleType

from rgss.errors import DefinitionError, DriverError, RgssError


def import_sdk(module: str, *, distribution: str, extra: str) -> ModuleType:
    """A module of a vendor's SDK.

    Args:
        module: Name of the module.
        distribution: The distribution that brings it.
        extra: The extra of rgss that installs it.

    Raises:
        DefinitionError: It is not installed.
    """
    try:
        # Some SDKs print their version when they are imported, which is not part of our output.
        with contextlib.redirect_stdout(sys.stderr):
            return importlib.import_module(module)
    except ImportError as error:
        raise DefinitionError(
            f"the driver {extra} needs {distribution}, which is not installed", hint=f"pip install 'rgss[{extra}]'"
        ) from error


def prints_to_stderr(module: str) -> None:
    """Let a module of an SDK print to standard error: what it says is not part of our output.

    It also prints from threads of its own at any time, so that redirecting the standard output while it is called
    would not do.
    """
    vars(importlib.import_module(module))["print"] = _print_to_stderr


@contextlib.contextmanager
def sdk_errors(message: str, *, hint: str = "") -> Iterator[None]:
    """Context that translates exceptions of an SDK, including a bare ``Exception``, into errors of the driver.

    Args:
        message: The failed operation.
        hint: How to resolve it.

    Raises:
        DriverError: The SDK raised.
    """
    try:
        yield
    except RgssError:
        raise
    # The SDKs raise a bare Exception for whatever goes wrong.
    except Exception as error:
        raise DriverError(f"{message}: {' '.join(str(error).split())}", hint=hint) from error


def close_sdk(disconnect: Callable[[], object]) -> None:
    """Close a connection of an SDK; an exception of it does not replace the outcome of the run before.

    Args:
        disconnect: The SDK's call.
    """
    # The SDKs raise a bare Exception for whatever goes wrong. The robot was stopped before.
    with contextlib.suppress(Exception):
        disconnect()


def _print_to_stderr(*values: object, **_: object) -> None:
    sys.stderr.write(" ".join(str(value) for value in values) + "\n")
