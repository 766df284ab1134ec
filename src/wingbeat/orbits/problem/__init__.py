"""The orbit problem: its objective, limits and parameters, and how quantities are computed from a flight."""
