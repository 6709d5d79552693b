"""Response curves, stability boundaries and coexisting motions, judged."""
