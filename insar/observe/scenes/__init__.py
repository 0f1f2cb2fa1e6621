"""Scenes from orbits: targets, the passes that see them, and the segments of a formation study."""
