"""Many conditions at once: sweeps, polar maps, sensitivities."""
