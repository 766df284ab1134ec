"""Air loads."""
