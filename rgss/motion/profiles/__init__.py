"""Closed-form velocity profiles with a stop at each waypoint."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.motion.profiles.joint_waypoints import time_move_by_joint_waypoints
    from rgss.motion.profiles.trapezoid import time_move_by_trapezoids, trapezoidal_trajectory
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
