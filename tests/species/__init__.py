"""Animals and their files."""
