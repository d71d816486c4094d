"""URDFs as others write them, made into descriptions that every engine reads."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.studies.robot_project.urdf.arm import UrdfArm, UrdfJoint, arm_of_urdf
    from rgss.studies.robot_project.urdf.decomposed import (
        INSTALL,
        LARGEST_HULL_RATIO,
        can_decompose,
        decompose,
        has_concave_meshes,
    )
    from rgss.studies.robot_project.urdf.files import copy_named_files, find_named_file
    from rgss.studies.robot_project.urdf.masses import complete_masses
    from rgss.studies.robot_project.urdf.reading import NO_ARGUMENTS, Note, read_arm_urdf, snap_right_angles
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
