"""Motion in time: histories, irregular waves, basins, the approach to a steady motion."""
