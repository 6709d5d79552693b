"""What a change does: variation, sensitivities, cures, uncertainty."""
