"""Ship files: YAML with units, read, checked, begun, changed."""
