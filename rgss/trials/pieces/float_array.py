"""Bit-exact arrays of floats in JSON."""

from __future__ import annotations

import base64
import binascii
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import EvidenceError

Array = NDArray[np.float64]

_KIND = np.dtype("<f8")


@dataclass(frozen=True, slots=True, kw_only=True)
class FloatArray:
    """Array in Base64: half as long as decimal numbers, and parsed ten times as fast.

    Attributes:
        shape: Its shape.
        base64: Its numbers in C order as little-endian IEEE 754 doubles, in Base64.
    """

    shape: tuple[int, ...]
    base64: str

    @classmethod
    def of(cls, array: Array) -> FloatArray:
        """Encode an array.

        Args:
            array: Numbers of any shape.
        """
        content = np.ascontiguousarray(array, dtype=_KIND).tobytes()
        return cls(shape=tuple(map(int, array.shape)), base64=base64.b64encode(content).decode("ascii"))

    def array(self) -> Array:
        """The array, bit for bit.

        Raises:
            EvidenceError: The text is not an array of that shape, or a number is not finite.
        """
        try:
            content = base64.b64decode(self.base64, validate=True)
        except binascii.Error as error:
            raise EvidenceError(f"an array is not in Base64: {error}") from error
        if min(self.shape, default=0) < 0 or len(content) != math.prod(self.shape) * _KIND.itemsize:
            raise EvidenceError(f"an array of shape {self.shape} cannot have {len(content)} bytes")
        array = np.frombuffer(content, dtype=_KIND).astype(np.float64).reshape(self.shape)
        if not np.isfinite(array).all():
            raise EvidenceError("an array holds a number that is not finite")
        return array
