"""Rivals written to win: what a good engineer writes with each tool for one job, each in a file of its own."""
