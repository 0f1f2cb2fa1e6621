"""Analytic derivatives of the region height error and of the limits, by the design."""

from .design import DesignSlopes, design_slopes

__all__ = ["DesignSlopes", "design_slopes"]
