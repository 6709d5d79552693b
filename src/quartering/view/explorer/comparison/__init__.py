"""A second ship or loading beside that of the page."""
