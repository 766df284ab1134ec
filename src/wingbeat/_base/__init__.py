"""What every package of wingbeat stands on: errors, files, names and units, tables, the style of figures."""
