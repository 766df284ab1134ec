"""Motion and forces."""
