"""Ships in a sea: response, largest motions, stability, one sea or many."""
