"""Grasp analysis from contacts: contact kinematics, grasp map, closure and quality measures."""

from rgss.grasping.closure import equilibrium, force_closure, form_closure, wrench_resistance
from rgss.grasping.contact import ContactKind, ContactPoint
from rgss.grasping.geometry import GraspGeometryCache
from rgss.grasping.grasp import Grasp
from rgss.grasping.grasp_matrix import (
    grasp_map,
    grasp_matrix,
    in_friction_cone,
    net_wrench,
    partial_wrench_basis,
    primitive_wrenches,
)
from rgss.grasping.kinematics import (
    BodyMotion,
    ContactMotion,
    Curvature,
    gap_between,
    is_potential_contact,
    recorded_motion,
    relative_motion,
)
from rgss.grasping.limit_load import load_factor
from rgss.grasping.polygon import grasp_polygon
from rgss.grasping.quality import q_diff_m, q_gii, q_gpri, q_msv, q_smw_n, q_voe
from rgss.grasping.rigid_body import (
    configuration_distance_m,
    twist_inner_product,
    velocity_norm_m_s,
    wrench_inner_product,
    wrench_norm_n,
)
from rgss.grasping.screws import Twist, Wrench, reciprocal_product
from rgss.grasping.status import (
    ContactState,
    ContactTolerances,
    Sliding,
    Tendency,
    contact_normal_wrench,
    contact_status,
    twist_tendency,
)
from rgss.grasping.summary import analyse_grasp
