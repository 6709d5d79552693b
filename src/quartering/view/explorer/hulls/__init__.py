"""Ships of the explorer: built-in ones, and hulls that visitors bring."""
