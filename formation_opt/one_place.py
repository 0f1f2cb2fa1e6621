"""Checks that the project's packages, whose names are generic, all come from one place."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

PACKAGES = ("configs", "reports", "optimize", "insar", "formation")


def intruder(home: Path) -> str | None:
    """Describe the package that another distribution shadows, if any.

    Parameters
    ----------
    home : folder that holds the package `formation_opt`.

    Returns
    -------
    One message, or None if all packages are ours.
    """
    for package in PACKAGES:
        spec = find_spec(package)
        origin = Path(spec.origin) if spec is not None and spec.origin else None
        if origin is None:
            return (
                f"the package {package!r} is missing beside {home / 'formation_opt'}; install "
                "formation-opt again"
            )
        if origin.parent.parent.resolve() != home.resolve():
            return (
                f"{origin} hides formation-opt's own package {package!r}, which is in {home}; "
                "install formation-opt in an environment of its own, or start it in a folder "
                "without that name"
            )
    return None
