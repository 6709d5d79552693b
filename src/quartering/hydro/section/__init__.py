"""Radiation and diffraction of one section: Lewis forms and sections of any shape."""
