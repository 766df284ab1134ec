"""Pages, data and the repository as a whole."""
