"""Numbers for the works that a report cites."""

from __future__ import annotations

from ..document import Reference


class Citations:
    """Numbers the works in the order in which they are cited."""

    def __init__(self) -> None:
        self.works: list[Reference] = []

    def __call__(self, *works: Reference) -> str:
        """Numbers of works in brackets; a new one gets the next."""
        self.works += [work for work in works if work not in self.works]
        return ", ".join(f"[{self.works.index(work) + 1}]" for work in works)
