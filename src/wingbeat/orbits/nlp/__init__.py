"""The orbit problem as a nonlinear programme, and the local methods that solve it."""
