"""Results as reports: figures, tables, HTML, PDF, JSON and CSV; computes no physics.

Imports nothing heavy: matplotlib, pandas and typst load when a report is written.
"""

from .study import Provenance, StudyInfo
from .writer import write_report

__all__ = ["Provenance", "StudyInfo", "write_report"]
