"""Dials of a page: number and slider of one value, and which there are."""
