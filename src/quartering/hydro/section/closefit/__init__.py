"""Sections of any shape in deep water by a boundary-element method on their own contour."""
