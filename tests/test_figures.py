"""Numbers in texts."""

from __future__ import annotations

import pytest

from rgss.figures import exact_figure, rounded_figure


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (-85.239, "-85.24"),
        (9999.96, "10,000"),
        (43000.0, "43,000"),
        (1234567.8, "1,234,568"),
        (2e9, "2e9"),
        (-1.256127e9, "-1.256e9"),
        (1.25e-9, "1.25e-9"),
        (0.00012345, "0.0001234"),
    ],
)
def test_a_rounded_figure(value, text):
    assert rounded_figure(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (43000.0, "43,000"),
        (1.1 * 43000.0, "47,300"),
        (12345.5, "12,345.5"),
        (1234567.0, "1,234,567"),
        (1234567890.0, "1,234,567,890"),
        (2e9, "2e9"),
        (2e-9, "2e-9"),
        (0.123456, "0.123456"),
        (0.1 + 0.2, "0.3"),
    ],
)
def test_a_stated_figure_keeps_its_digits(value, text):
    assert exact_figure(value) == text
