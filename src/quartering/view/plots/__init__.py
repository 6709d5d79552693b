"""Pictures, one file a kind; every function returns a matplotlib figure and computes nothing of its own."""
