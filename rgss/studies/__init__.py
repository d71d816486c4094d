"""Studies: from a project folder to trials, evidence, estimates and a decision."""
