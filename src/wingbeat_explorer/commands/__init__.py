"""The commands of the shell that open or write the explorer."""
