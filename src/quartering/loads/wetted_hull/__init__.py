"""Pressure over the instantaneous wetted hull: direct integration, section tables, a ship afloat on a wave."""
