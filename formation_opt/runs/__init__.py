"""One module for each kind of study: from the validated study to its result."""

from .outcome import Options, Outcome, Summary

__all__ = ["Options", "Outcome", "Summary"]
