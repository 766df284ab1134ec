"""Species: what flies and how it beats its wings by default, with the source of every number."""
