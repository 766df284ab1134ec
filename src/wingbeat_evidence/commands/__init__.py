"""The commands of the shell that compare with the paper and with measurements."""
