"""Periodic orbits: the problem, its solution, the certificate."""
