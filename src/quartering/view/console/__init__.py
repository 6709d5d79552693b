"""What every command shares: options and values as typed, the answer printed and written, errors, progress."""
