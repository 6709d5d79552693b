"""A ship on a steady course whose restoring and Froude-Krylov force are the pressure over its instantaneous wetted hull."""
