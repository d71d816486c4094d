"""Joints of an arm: kinds, limits, and the mimic joints that follow driven ones."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.joints.follower import Follower
    from rgss.scenes.joints.joint import Joint
    from rgss.scenes.joints.joint_kind import JointKind
    from rgss.scenes.joints.mimic import follows, is_number, mimic_problems
    from rgss.scenes.joints.urdf_followers import (
        DriverLimits,
        driven_of,
        driver_limits,
        follower_problems,
        followers_of,
    )
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
