"""Studies: many orbit problems planned, solved in pieces that survive, and kept in one file."""
