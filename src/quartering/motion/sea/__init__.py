"""The response to a sea: equations over wave cells, Gaussian averages of every term, and the closure that joins them."""
