"""Bad input through the real command line."""
