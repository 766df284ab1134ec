"""Flights of one period: by the solver with exact derivatives, by the certifier, and as a beat with its quantities."""
