"""Simulations of a ship in a sea: what is asked, the plan, the blocks, the answer, and what counts and tails tell."""
