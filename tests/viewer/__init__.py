"""Wingbeats in motion."""
