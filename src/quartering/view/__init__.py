"""What a person sees: command line and plots. No physics inside."""
