"""Added roll damping: one file a method, and the forms it is written in."""
