"""What is said where no orbit is found: which law fails, by how much, and which changes would fly."""
