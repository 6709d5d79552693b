"""What each command does, one file a command; imported only when the command runs."""
