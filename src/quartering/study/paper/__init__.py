"""The paper itself: its figures recomputed, its modified model and the mechanism, its claims measured."""
