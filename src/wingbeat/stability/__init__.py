"""Stability of orbits: linear maps from beat to beat, their modes, and the averaged model beside them."""
