"""Pure renderers of evidence and decisions."""
