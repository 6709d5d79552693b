"""Nonlinear sway-roll-yaw motion of a ship in regular oblique waves, and its stability."""
