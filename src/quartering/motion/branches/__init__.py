"""Branches of periodic motions over a parameter, and all motions of one condition."""
