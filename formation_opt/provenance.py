"""How a result came about, so that anyone can repeat it."""

from __future__ import annotations

import platform
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version

from . import __version__

_NUMERIC_PACKAGES = ("numpy", "scipy", "deap", "sgp4", "pyerfa", "astropy-iers-data", "shapely")


def packages() -> dict[str, str]:
    """Versions of the packages that the numbers depend on, and of numba where it is installed."""
    versions = {name: version(name) for name in _NUMERIC_PACKAGES}
    with suppress(PackageNotFoundError):
        versions["numba"] = version("numba")
    return versions


def python() -> str:
    """Version of Python."""
    return platform.python_version()


def machine() -> str:
    """System and processor architecture."""
    return f"{platform.system()} {platform.machine()}"


def program() -> str:
    """Version of formation-opt."""
    return __version__
