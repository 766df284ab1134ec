"""The orbit problem: its objective, limits and parameters, and how they are read off a flight."""
