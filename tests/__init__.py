"""The tests, in folders as those of `src/wingbeat`."""
