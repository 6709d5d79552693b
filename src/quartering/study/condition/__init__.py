"""One condition of a ship examined: its motion and verdict, other motions beside it, capsizes, failure events, resonance."""
