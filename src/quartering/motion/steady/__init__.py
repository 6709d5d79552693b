"""Periodic motions: harmonic balance, Newton's method on many conditions, Struble's method, derivatives."""
