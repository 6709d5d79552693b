"""The commands, one file each: options, work and answer; what they share is in `quartering.view.console`."""
