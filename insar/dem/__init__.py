"""Elevation models: posting and looks, the classes that they are judged by, and the judgment."""

from .judgment import Criterion, Judgment, Quantity, judge
from .posting import Resolution, looks_of_posting, posting_of_looks
from .specifications import CLASSES, DTED2, HRTI3, HRTI4, Specification

__all__ = [
    "CLASSES",
    "DTED2",
    "HRTI3",
    "HRTI4",
    "Criterion",
    "Judgment",
    "Quantity",
    "Resolution",
    "Specification",
    "judge",
    "looks_of_posting",
    "posting_of_looks",
]
