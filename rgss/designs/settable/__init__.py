"""Settable quantities of a trial: their type, and those of placement, motion and planners."""

from rgss.designs.settable.motion_quantities import MOTION_QUANTITIES
from rgss.designs.settable.placement_quantities import BASE_POSITION, BASE_YAW, PLACEMENT_QUANTITIES
from rgss.designs.settable.planner_quantities import PLANNER_PREFIX, PLANNER_QUANTITIES
from rgss.designs.settable.quantity import Application, SettableQuantity
