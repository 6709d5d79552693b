"""Is that motion stable: first-order indices, Floquet multipliers, verdict."""
