"""Mountings of grippers that designs set."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rgss.designs import DesignSpace, ParameterValue, written_values
from rgss.documents import Document
from rgss.errors import DefinitionError
from rgss.findings import Finding, shown
from rgss.scenes import GripperFile, GripperGeometry

MOUNTING = "gripper.mounting"


def mounted(file: GripperFile, mounting: ParameterValue | None, variant: int) -> GripperGeometry:
    """The shape of a gripper in the mounting of a design.

    Args:
        file: The gripper.
        mounting: What the design sets; None for the gripper's own.
        variant: Id of the design.

    Raises:
        DefinitionError: The gripper has no such mounting.
    """
    name = file.mounting if mounting is None else mounting
    if isinstance(name, str) and name in file.mountings:
        return file.mountings[name]
    raise DefinitionError(
        f"gripper {file.geometry.id} of variant {variant} has no mounting {shown(str(name))}", hint=_known(file)
    )


def mounting_findings(
    designs: DesignSpace, document: Document, grippers: Mapping[str, GripperFile]
) -> Iterator[Finding]:
    """Find mountings that a design sets and no gripper has.

    Args:
        designs: The design space.
        document: Its file, for positions.
        grippers: The gripper file of each gripper component, by its name.
    """
    ids = {parameter.id for parameter in designs.parameters if parameter.sets == MOUNTING}
    known = {name for file in grippers.values() for name in file.mountings if name}
    for place, own, value in written_values(designs):
        if own in ids and grippers and value not in known:
            hint = f"mountings: {', '.join(sorted(known))}" if known else "no gripper of the catalogue has mountings"
            yield document.finding(
                "design.mounting", f"no gripper has a mounting {shown(str(value))}", place, hint=hint
            )


def _known(file: GripperFile) -> str:
    names = [name for name in file.mountings if name]
    return f"mountings: {', '.join(names)}" if names else "give it mountings in its file, 'kind: parallel'"
