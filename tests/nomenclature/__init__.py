"""Names and units."""
