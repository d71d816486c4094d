"""Guarding metrics against a baseline: the statistics, the baseline's file, and what is said of both."""
