"""Reading of named frames: parents by name, and chains of frames composed."""

from __future__ import annotations

import difflib
from collections.abc import Iterator, Mapping
from dataclasses import replace

from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes.frames.document import FrameEntry
from rgss.scenes.frames.named_frame import NamedFrame
from rgss.scenes.pose import Pose

WORLD = "world"
ROBOT = "robot"


def frames_of(
    entries: Mapping[str, FrameEntry],
    roots: Mapping[str, NamedFrame],
    document: Document,
    findings: list[Finding],
    *,
    default: str,
) -> tuple[NamedFrame, ...]:
    """Frames of a file, each composed with its parents.

    Args:
        entries: The frames by name.
        roots: What is a parent and no frame of the file, by name: the world, the robot, objects, other frames.
        document: The file, for positions.
        findings: The findings, to which those on the frames are added.
        default: Name of the parent of a frame that states none.
    """
    parents = {name: entry.parent or default for name, entry in entries.items()}
    problems = list(_problems(parents, roots, document))
    findings += problems
    if problems:
        return ()
    found = dict(roots)

    def composed(name: str) -> NamedFrame:
        if name not in found:
            entry, parent = entries[name], composed(parents[name])
            pose = Pose.from_roll_pitch_yaw(entry.position, (entry.roll, entry.pitch, entry.yaw))
            found[name] = replace(parent, id=name, pose=parent.pose @ pose)
        return found[name]

    return tuple(composed(name) for name in entries)


def _problems(parents: Mapping[str, str], roots: Mapping[str, NamedFrame], document: Document) -> Iterator[Finding]:
    """Taken names, unknown parents and cycles."""
    for name, parent in parents.items():
        at = ("frames", name)
        if name in roots:
            message = f"the name {name!r} of a frame is taken"
            yield document.finding("scene.duplicate-id", message, at, hint="choose another name")
        elif parent not in parents and parent not in roots:
            known = [*roots, *parents]
            near = difflib.get_close_matches(parent, known, n=1)
            hint = f"did you mean {near[0]!r}?" if near else f"parents: {', '.join(known)}"
            message = f"frame {name!r} has the unknown parent {parent!r}"
            yield document.finding("scene.frame", message, (*at, "parent"), hint=hint)
        else:
            chain = [name]
            while parents.get(chain[-1]) is not None and parents[chain[-1]] not in chain:
                chain.append(parents[chain[-1]])
            if parents.get(chain[-1]) == name:
                message = f"frame {name!r} is its own parent: {' in '.join([*chain, name])}"
                hint = "let one of them have another parent"
                yield document.finding("scene.frame", message, (*at, "parent"), hint=hint)
