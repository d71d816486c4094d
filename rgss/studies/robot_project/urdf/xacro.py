"""Expansion of a xacro, the macro language of ROS in which manufacturers publish their robots."""

from __future__ import annotations

import contextlib
import io
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from pathlib import Path

from rgss.engines import require_xacro
from rgss.errors import DefinitionError
from rgss.findings import shown
from rgss.studies.robot_project.urdf.packages import package_folder

_SUBSTITUTION = re.compile(r"\$[({]")
_SUBSTITUTED = ("link", "joint", "material")
_UNUSED = frozenset({"property", "arg"})
_ARGUMENT = "give the xacro's arguments with --xacro {name}:=VALUE, as ROS does"
_MISSING = re.compile(r"Undefined substitution argument (\w+)")


def needs_expansion(root: ET.Element) -> bool:
    """True if a file has parts of a xacro, other than definitions that it does not use.

    Args:
        root: The file's content.
    """
    return any(_is_xacro(one) and one.tag.partition("}")[2] not in _UNUSED for one in root.iter()) or any(
        _SUBSTITUTION.search(value)
        for part in root.iter()
        if part.tag in _SUBSTITUTED
        for element in part.iter()
        for value in element.attrib.values()
    )


def expanded(urdf: Path, *, name: str, arguments: Mapping[str, str]) -> str:
    """URDF of a xacro.

    Packages are found as those of meshes are: folders above the file, and folders in these.

    Raises:
        DefinitionError: The package xacrodoc is not installed, or the file cannot be expanded.
    """
    require_xacro(f"{urdf.name} is a xacro, which")
    from xacrodoc import XacroDoc, packages

    known: dict[str, str] = {}
    # It writes where an error is to stderr; the message has the error.
    with contextlib.redirect_stderr(io.StringIO()):
        while True:
            packages.reset()
            packages.update_package_cache(known)
            try:
                # Included, the file is where the names that it includes begin.
                document = XacroDoc.from_includes(
                    [urdf.resolve().as_posix()], name=name, subargs=dict(arguments), resolve_packages=False
                )
                return str(document.to_urdf_string())
            except Exception as error:
                # Expansion evaluates expressions of the file, which may raise anything.
                chain = tuple(_chain(error))
                package = next(
                    (str(one.args[0]) for one in chain if isinstance(one, packages.PackageNotFoundError)), ""
                )
                if not package:
                    # Some messages of the outer error are those of the inner one after its class.
                    problems = (" ".join(str(one).split()) for one in chain)
                    problem = next((one for one in problems if not one.startswith("<class")), type(error).__name__)
                    missing = _MISSING.search(problem)
                    hint = _ARGUMENT.format(name=missing[1] if missing else "NAME")
                    raise DefinitionError(f"{urdf} cannot be expanded: {problem}", hint=hint) from error
                folder = package_folder(package, urdf)
                if folder is None or package in known:
                    raise DefinitionError(
                        f"{urdf} names the package {shown(package)}, which is not there",
                        hint="put its folder beside that of the file's package",
                    ) from error
                known[package] = str(folder)


def _chain(error: BaseException) -> Iterator[BaseException]:
    """An error and those that led to it; that of a xacro has its reason as an attribute."""
    seen: BaseException | None = error
    while seen is not None:
        yield seen
        reason = getattr(seen, "exc", None)
        seen = reason if isinstance(reason, BaseException) else seen.__cause__ or seen.__context__


def _is_xacro(element: ET.Element) -> bool:
    return "}" in element.tag and "xacro" in element.tag.partition("}")[0]
