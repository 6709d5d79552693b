"""What floats: lines, hydrostatics, righting arm, loading; the built-in ships as data."""
