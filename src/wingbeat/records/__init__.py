"""Pure functions of a record or a data set: what follows from them, how they become files and are read again."""
