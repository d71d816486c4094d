"""Estimators of one value from the values of trials."""

from __future__ import annotations

from enum import Enum


class Estimator(str, Enum):
    """Estimator of one value from trial values.

    A mean is the mean of the trials' values; a proportion is the share of trials with the value 1; a ratio is the sum
    of a quotient's numerators divided by the sum of its denominators.
    """

    MEAN = "mean"
    PROPORTION = "proportion"
    RATIO = "ratio"


class Population(str, Enum):
    """Population of an estimate: successful trials, or all trials."""

    SUCCESSFUL = "successful"
    ALL = "all"


class Summary(str, Enum):
    """Reduction of a row to the estimated number."""

    SUM = "sum"
    MEAN = "mean"
    MAX = "max"
