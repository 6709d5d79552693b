"""Case files: keys, values, reading, a file to begin from."""
