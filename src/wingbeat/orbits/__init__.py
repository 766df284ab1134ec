"""Periodic orbits: the problem, the search for it, the certificate."""
