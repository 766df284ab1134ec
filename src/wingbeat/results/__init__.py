"""Results: orbits and flights as labelled datasets, records and files."""
