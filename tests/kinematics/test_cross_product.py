"""Cross products against numpy's."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.kinematics.cross_product import cross_product


@pytest.mark.parametrize(("first", "second"), [((3,), (3,)), ((7, 3), (3,)), ((5, 6, 3), (5, 6, 3)), ((0, 3), (3,))])
def test_they_are_those_of_numpy_bit_for_bit(first, second):
    generator = np.random.default_rng(1)
    one, other = (generator.standard_normal(shape) * 10.0 ** generator.integers(-9, 9) for shape in (first, second))
    assert np.array_equal(cross_product(one, other), np.cross(one, other))
