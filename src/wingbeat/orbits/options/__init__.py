"""The tuning numbers of the solvers, as frozen values that a user can pass."""
