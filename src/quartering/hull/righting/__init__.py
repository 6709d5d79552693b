"""Righting arm: heeled sections, GZ, its spline or polynomial, the capsize limit."""
