"""Bond of a suction cup and an object in MuJoCo: a weld of the model, activated at the present poses."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.physics.mujoco.contact_reader import MujocoContactReader
from rgss.physics.mujoco.engine import mujoco
from rgss.physics.mujoco.hand_model import CUP_BIT
from rgss.physics.suction_seal import Vector3


class MujocoBond:
    """Implementation of `SuctionBond`, by the weld between the cup and one object."""

    def __init__(
        self, model: Any, data: Any, reader: MujocoContactReader, *, body: str, lip_m: Vector3, friction: float
    ) -> None:
        """Start detached.

        Args:
            model: The engine's model.
            data: Its state.
            reader: Reader of the contacts of the object, which is the workpiece.
            body: Name of the object's body and of its weld.
            lip_m: Centre of the lip in the cup's frame.
            friction: Coefficient of cup and object while they are in contact without a vacuum.
        """
        self._model, self._data, self._reader = model, data, reader
        self._weld = int(model.equality(body).id)
        self._cup, self._object = int(model.body("suction_cup").id), int(model.body(body).id)
        self._dofs = slice(first := int(model.body_dofadr[self._object]), first + 6)
        self._lip_m = np.array(lip_m)
        self._shapes = np.flatnonzero(model.geom_bodyid == self._object)
        model.geom_friction[int(model.geom("suction_cup").id), 0] = friction

    @property
    def is_attached(self) -> bool:
        """True while the bond holds cup and workpiece together."""
        return bool(self._data.eq_active[self._weld])

    def attach(self) -> None:
        """Bond the workpiece to the cup at their present poses."""
        model, data, engine = self._model, self._data, mujoco()
        turn, held = data.xmat[self._cup].reshape(3, 3), data.xmat[self._object].reshape(3, 3)
        lip_m = data.xpos[self._cup] + turn @ self._lip_m
        back, relative = np.empty(4), np.empty(4)
        engine.mju_negQuat(back, data.xquat[self._cup])
        engine.mju_mulQuat(relative, back, data.xquat[self._object])
        # The point of the weld in the second body, then in the first, and the orientation of the second in the first.
        model.eq_data[self._weld, :3] = held.T @ (lip_m - data.xpos[self._object])
        model.eq_data[self._weld, 3:6] = self._lip_m
        model.eq_data[self._weld, 6:10] = relative
        data.eq_active[self._weld] = 1
        model.geom_conaffinity[self._shapes] = 0

    def detach(self) -> None:
        """Remove the bond."""
        self._data.eq_active[self._weld] = 0
        self._model.geom_conaffinity[self._shapes] = CUP_BIT

    def is_borne(self) -> bool:
        """True if anything but the robot pressed on the workpiece in the last step."""
        return self._reader.scene_force_n() > 0.0

    def reaction(self, about_m: Vector3) -> tuple[Vector3, Vector3]:
        """Force of the workpiece on the cup and its moment; see `SuctionBond.reaction`."""
        data = self._data
        welds = int(mujoco().mjtConstraint.mjCNSTR_EQUALITY)
        rows = np.flatnonzero((data.efc_type == welds) & (data.efc_id == self._weld))
        jacobian = data.efc_J.reshape(data.nefc, self._model.nv)[rows, self._dofs]
        generalised: NDArray[np.float64] = jacobian.T @ data.efc_force[rows]
        # On the object: the force in the world, the moment about the origin of its body in the axes of that.
        force, moment = generalised[:3], data.xmat[self._object].reshape(3, 3) @ generalised[3:]
        moment = moment + np.cross(data.xpos[self._object] - np.array(about_m), force)
        return _triple(-force), _triple(-moment)


def _triple(vector: NDArray[np.float64]) -> Vector3:
    x, y, z = vector.tolist()
    return x, y, z
