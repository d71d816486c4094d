"""Objects of a scene: their entries in the file, scenes of several objects, and a gripper's opening at an object."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.objects.foot import foot_of
    from rgss.scenes.objects.further_objects import (
        colour_of,
        name_findings,
        named_places,
        object_colour,
        other_objects,
        other_solids,
        place_limits,
        positive_values,
    )
    from rgss.scenes.objects.mesh_findings import mesh_volume_findings
    from rgss.scenes.objects.object_entry import candidates_of, object_lengths
    from rgss.scenes.objects.object_file import object_solid, workpiece_of
    from rgss.scenes.objects.opening import grasp_opening_m
    from rgss.scenes.objects.pads import finger_pads
    from rgss.scenes.objects.several_objects import (
        ObjectPlacement,
        initial_placements,
        region_now,
        scene_about,
        with_raised_stack,
    )
    from rgss.scenes.objects.supports import support_findings, supports_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
