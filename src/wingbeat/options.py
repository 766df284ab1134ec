"""Every tuning number of the solvers, with the measurement behind its default, in one place.

>>> import wingbeat as wb
>>> wb.options.SolverOptions().search.max_iterations > 0
True
"""

__all__ = [
    *("CertificateOptions", "ChangeOptions", "ContinuationOptions", "DiagnosisOptions", "FeedbackOptions"),
    *("LeastSquaresOptions", "LinearOptions", "ManoeuvreOptions", "ManyOptions", "NewtonOptions", "SearchOptions"),
    *("SensitivityOptions", "SolverOptions", "StartFamily"),
]
