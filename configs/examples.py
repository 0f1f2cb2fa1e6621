"""The example studies that come with the package."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from .messages import StudyError, did_you_mean, show


def example_names() -> tuple[str, ...]:
    """Names of the shipped example studies, in alphabetical order."""
    found = (Path(entry.name) for entry in files(__package__).iterdir())
    return tuple(sorted(path.stem for path in found if path.suffix == ".yaml"))


def example_path(name: str) -> Path:
    """File of a shipped example study.

    Parameters
    ----------
    name : one of `example_names`.

    Raises
    ------
    StudyError
        If there is no example of this name.
    """
    names = example_names()
    if name not in names:
        raise StudyError(
            f"{show(name)} is not a shipped example; {did_you_mean(name, names)}the examples are "
            f"{', '.join(names)}; a file needs a name with '/' or ending in .yaml"
        )
    return Path(str(files(__package__) / f"{name}.yaml"))


def example_text(name: str) -> str:
    """Text of a shipped example study, comments included.

    Parameters
    ----------
    name : one of `example_names`.
    """
    return example_path(name).read_text(encoding="utf-8")
