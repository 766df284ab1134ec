"""The tuning numbers of the solvers, in frozen records that a user can pass."""
