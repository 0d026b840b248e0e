"""Coordinates, and places along axes that may turn and move."""
