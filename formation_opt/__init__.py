"""The command `formation-opt`: reads a study, runs it, writes its report.

Imports nothing heavy, so that the command answers at once.
"""

__version__ = "0.1.0"
