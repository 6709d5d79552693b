"""The page in an irregular sea: its state, dials, map, panel and files."""
