"""Draws of an object that its geometry excludes: a centre of mass outside it, or a position beside its support."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from rgss.kinematics import Solid
from rgss.scenes import Pose, Scene, Workpiece
from rgss.scenes.uncertainty import Uncertainty, quantity_of
from rgss.trials.scene_check import beyond_edge

_DRAWS = 1000
_ALONG = {"offset_x_m": (1.0, 0.0), "offset_y_m": (0.0, 1.0)}


@dataclass(frozen=True, slots=True, kw_only=True)
class DrawProblem:
    """Quantity with draws that the geometry of the scene excludes.

    Attributes:
        quantity: Its name.
        object: The object.
        support: The support beside which it would be; empty for a centre of mass outside the object.
        share: Share of such draws, of this quantity alone.
        farthest_m: Greatest distance of the centre of mass beyond the object's top or foot, or the support's edge.
    """

    quantity: str
    object: str
    support: str = ""
    share: float
    farthest_m: float


def draw_problems(scene: Scene, uncertainty: Uncertainty) -> Iterator[DrawProblem]:
    """Quantities with draws outside the geometry, each compared at evenly spaced quantiles."""
    for one in uncertainty.values:
        quantity = quantity_of(one.quantity)
        name = quantity.object or scene.workpiece.id
        drawn = next((found for found in scene.objects if found.workpiece.id == name), None)
        if drawn is None:
            continue
        if quantity.field == "centre_of_mass_m":
            measure = partial(_beyond_ends, drawn.workpiece)
        elif quantity.field in _ALONG:
            support = next(body for body in _bodies(scene) if body.name == drawn.support)
            measure = partial(_beyond_support, support, drawn.workpiece, _ALONG[quantity.field])
        else:
            continue
        excesses = [measure(one.distribution.quantile((index + 0.5) / _DRAWS)) for index in range(_DRAWS)]
        outside = [excess_m for excess_m in excesses if excess_m > 0.0]
        if outside:
            yield DrawProblem(
                quantity=one.quantity,
                object=name,
                support=drawn.support if quantity.field in _ALONG else "",
                share=len(outside) / _DRAWS,
                farthest_m=max(outside),
            )


def _bodies(scene: Scene) -> Iterator[Solid]:
    """Fixed bodies and objects of a scene."""
    for body in scene.bodies:
        yield Solid(name=body.id, shape=body.shape, pose=body.pose)
    for one in scene.objects:
        yield Solid(name=one.workpiece.id, shape=one.workpiece.shape, pose=one.workpiece.pose)


def _beyond_ends(workpiece: Workpiece, height_m: float) -> float:
    """Distance of a drawn centre of mass above the top or below the foot of its object."""
    return max(0.0, abs(height_m) - workpiece.shape.half_height_m)


def _beyond_support(support: Solid, workpiece: Workpiece, along: tuple[float, float], offset_m: float) -> float:
    """Distance of the centre of mass of an object with a drawn offset beyond the edge of its support."""
    across = Pose(position_m=(*workpiece.centre_of_mass_across_m, 0.0))
    x, y, z = (workpiece.pose @ across).position_m
    return beyond_edge(support, Pose(position_m=(x + along[0] * offset_m, y + along[1] * offset_m, z)))
