"""Records, data sets and files."""
