"""Rates of failures over all the seas a ship meets."""
