"""Equations of first variation: their matrix over a cycle, transition matrices, multipliers, exponents by two methods."""
