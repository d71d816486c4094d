"""Choosing a robot design by evidence: requirements, simulated trials, a certified trade-off."""
