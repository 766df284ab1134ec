"""Tests of measured motions."""
