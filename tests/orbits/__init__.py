"""From a problem to a certified orbit."""
