"""How many satellites keep a place in view: Walker constellations sized, simulated and searched."""
