"""Sweeps and polar maps: executed, stored, resumed, queried."""
