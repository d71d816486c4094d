"""Grasp analysis from contacts."""
