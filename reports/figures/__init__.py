"""Figures as SVG, one module for each family of them."""
