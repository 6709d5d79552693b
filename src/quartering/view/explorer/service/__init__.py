"""The same answers as a service: calls by GET and POST, their bodies, their turns and their refusals."""
