"""Ships in all six degrees of freedom: responses, the metacentric height in waves, parametric roll and its maps."""
