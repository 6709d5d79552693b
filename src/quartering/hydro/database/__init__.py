"""Hydrodynamic results of other codes: Capytaine and WAMIT files in our axes, checked."""
