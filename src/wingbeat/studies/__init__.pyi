# What users find here, and where it lives: type checkers read this, and the package loads from it.

from .study import Study as Study
from .study import plan_study as plan_study
