"""Trials: one design variant through the eight states of the task."""
