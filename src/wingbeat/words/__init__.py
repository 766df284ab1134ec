"""What records say to a reader: rows, sentences and reports."""
