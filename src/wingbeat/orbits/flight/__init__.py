"""Flights of one period: in few steps with exact derivatives, by the certifier, and as a beat with quantities."""
