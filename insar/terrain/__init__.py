"""Terrain from an elevation model, and how a radar that looks at it from the side sees it."""

from .grid import Terrain
from .view import TerrainView, view_terrain

__all__ = ["Terrain", "TerrainView", "view_terrain"]
