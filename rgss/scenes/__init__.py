"""Scenes: robot, gripper, objects, fixed bodies and waypoints."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.assembly import (
        CUP_LINK,
        GRIPPER_BASE_LINK,
        assembled_urdf,
        finger_joint,
        finger_link,
        link_names_of,
        linkage_hulls,
    )
    from rgss.scenes.convex_shapes import (
        ConvexPart,
        convex_parts,
        origin_of,
        vertices_of,
        with_mesh_files,
    )
    from rgss.scenes.document import RobotDocument, SceneDocument
    from rgss.scenes.frames import NamedFrame
    from rgss.scenes.grasps import (
        RIBS,
        Approach,
        ChosenGrasp,
        GivenGrasp,
        GraspCandidates,
        PadLayout,
        PadPatch,
        SuctionPoint,
        most_elements,
        pad_layouts,
        pad_patches,
        rotation_of,
        settled_grasp,
        surface_of,
    )
    from rgss.scenes.gripper import Gripper, GripperDrive, GripperFile, GripperGeometry, Suction, boss_height_m
    from rgss.scenes.gripper_file import load_gripper, load_gripper_file
    from rgss.scenes.hands import (
        GRIPPER_KINDS,
        FoundPads,
        MechanismError,
        at_object,
        at_opening,
        at_top,
        find_pads,
        misfit,
        object_in_hand,
        pad_limits,
        palm_fit,
        suction_point_of,
        too_narrow,
        too_wide,
        tool_with_pads_at,
        unpowered_shortfall,
        unsealed,
    )
    from rgss.scenes.joints import DriverLimits, Follower, Joint, JointKind, driven_of, driver_limits, follower_problems
    from rgss.scenes.link_solids import LinkSolid, link_solid
    from rgss.scenes.linkage import Linkage, LinkageMotion, motion_of
    from rgss.scenes.linkage_assembly import linkage_masses_kg
    from rgss.scenes.linkage_inertia import leading_joint, pad_mass_kg, reflected_inertias
    from rgss.scenes.looks import DrawnMesh, drawn_mesh
    from rgss.scenes.mass_properties import (
        Gyration,
        centre_of_mass,
        inertia_kg_m2,
        principal_frame,
        quaternion_of,
        solid_moments,
    )
    from rgss.scenes.mesh_shapes import is_empty_mesh, mesh_extent_m, mesh_summary, write_convex_parts
    from rgss.scenes.objects import (
        ObjectPlacement,
        finger_pads,
        foot_of,
        grasp_opening_m,
        initial_placements,
        mesh_volume_findings,
        region_now,
        scene_about,
        with_raised_stack,
    )
    from rgss.scenes.pose import Pose
    from rgss.scenes.robot import MOST_JOINTS, LinkLook, Robot
    from rgss.scenes.robot_file import load_robot
    from rgss.scenes.scene import (
        FORCE_WINDOW_S,
        LANDING_LIMIT_M_S,
        NamedPlace,
        PlaceRegion,
        Scene,
        SceneBody,
        SceneObject,
        Task,
        Workpiece,
    )
    from rgss.scenes.scene_file import load_scene
    from rgss.scenes.servos import Calibration, CalibrationDocument, JointServo, ServoControl, load_calibration
    from rgss.scenes.shapes import (
        Box,
        Cylinder,
        LyingCylinder,
        MeshShape,
        ObjectShape,
        Shape,
        corners_of,
        girth_radius_m,
        half_extents_m,
        least_height_m,
    )
    from rgss.scenes.urdf_chain import chain_to, kind_of, loads_without_inertia
    from rgss.scenes.urdf_file import number_problems
    from rgss.scenes.urdf_structure import carried_by, end_of, standing_links
    from rgss.scenes.waypoints import Waypoint, waypoint_poses
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
