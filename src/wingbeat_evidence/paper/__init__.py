"""Su et al. 2023 (doi 10.48550/arXiv.2302.09602) put to the test: its figures and its claims beside ours."""
