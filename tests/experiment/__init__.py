"""From load-cell records to coefficient models."""
