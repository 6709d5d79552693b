"""The explorer: the ship, its map and its motion on one page in the browser, and the same answers as a service."""
