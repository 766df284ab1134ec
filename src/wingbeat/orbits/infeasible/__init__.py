"""Diagnosis of problems without an orbit: which balance fails, by how much, and which changes give an orbit."""
