"""Grasp candidates of an object, from its shape or its file, with contacts and quality."""

from rgss.grasping.candidates.hand_symmetry import has_opposed_fingers
from rgss.grasping.candidates.ranked_grasp import RankedGrasp
from rgss.grasping.candidates.ranking import OPEN_GAP_M, FrameRejection, RankedGrasps, ranked_grasps
from rgss.grasping.candidates.scoring import contact_points
from rgss.grasping.candidates.suction import given_suction_point, suction_points
from rgss.grasping.candidates.suction_ranking import ranked_suction, weight_share
from rgss.grasping.candidates.symmetry import symmetric_turns
