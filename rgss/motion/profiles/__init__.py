"""Closed-form velocity profiles with a stop at each waypoint."""

from rgss.motion.profiles.joint_waypoints import time_move_by_joint_waypoints
from rgss.motion.profiles.trapezoid import time_move_by_trapezoids, trapezoidal_trajectory
