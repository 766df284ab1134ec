"""Many orbits: batches, series, branches along speed, and spreads."""
