"""The equations of motion: states, terms, the one right-hand side, water in motion, steering."""
