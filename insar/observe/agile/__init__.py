"""Agile modes: spotlight and video, their attitude, rates and echoes."""
