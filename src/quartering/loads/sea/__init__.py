"""A real sea: frequency spectra, spreading, seas of several systems, measured spectra, and the grid of wave cells."""
