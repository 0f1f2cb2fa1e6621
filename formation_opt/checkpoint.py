"""A search on disk, step by step, so that a run that was killed goes on as if nothing had been.

Two files in the output folder, plain data both: `checkpoint.jsonl` is a journal with a line for
each step of the search, only ever appended to; `checkpoint.json` says which study this is, how much
of the journal counts, and the state that the next step follows from. The journal is written first
and the other file replaced in one move, so at any moment the pair describes a finished step, and
half a line behind it is cut off. A run that ends removes both.
"""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

_FORMAT = 1


class CheckpointError(Exception):
    """An unfinished search cannot be gone on with; the message says why and what to do."""


class Identity(NamedTuple):
    """What decides the result of a search: a run may go on only where all of it is the same.

    Attributes
    ----------
    study : the study with every default filled in, as plain data.
    seed : of the random generator.
    inputs : file → hash of its contents.
    packages : package → version, the program among them.
    compiled : whether compiled loops score the formations: they may be out of reach although numba
        is installed, and arrays differ in the last digits.
    """

    study: Mapping[str, Any]
    seed: int
    inputs: Mapping[str, str]
    packages: Mapping[str, str]
    compiled: bool

    def lines(self) -> list[str]:
        """As lines of text, for comparison."""
        return [
            *_flat("", self.study),
            f"seed: {self.seed}",
            *(f"file {name}: sha256 {digest}" for name, digest in sorted(self.inputs.items())),
            *(f"version of {name}: {version}" for name, version in sorted(self.packages.items())),
            f"formations scored by: {'compiled loops' if self.compiled else 'arrays'}",
        ]


class Checkpoint:
    """The `optimize.Keeper` of one output folder.

    Parameters
    ----------
    folder : the output folder.
    identity : of the study that runs.
    resume : whether to go on with what the folder holds; otherwise it is overwritten.

    Raises
    ------
    CheckpointError
        If the folder holds the search of another study, or files that cannot be read.
    """

    def __init__(self, folder: Path, identity: Identity, *, resume: bool) -> None:
        self._snapshot, self._journal = _files(folder)
        self._identity = identity.lines()
        self._steps: list[dict[str, Any]] = []
        self._state: dict[str, Any] | None = None
        self._size = 0
        self.found = resume and self._snapshot.exists()
        if self.found:
            self._read()
        else:
            self._snapshot.unlink(missing_ok=True)

    def restore(self) -> tuple[Sequence[dict[str, Any]], dict[str, Any] | None]:
        """Steps that an earlier run has behind it, oldest first, and its state."""
        return self._steps, self._state

    def keep(self, step: dict[str, Any], state: dict[str, Any] | None) -> None:
        """Write a step and the state after it to the disk.

        Parameters
        ----------
        step : plain data.
        state : plain data; None for that of the step before.
        """
        line = json.dumps(step).encode() + b"\n"
        with self._journal.open("r+b" if self._size else "wb") as file:
            file.seek(self._size)
            file.truncate()  # what a run that was killed had begun
            file.write(line)
            _flush(file.fileno(), file)
        self._size += len(line)
        self._state = self._state if state is None else state
        snapshot = {
            "format": _FORMAT,
            "identity": self._identity,
            "journal_bytes": self._size,
            "state": self._state,
        }
        partial = self._snapshot.with_name(f".{self._snapshot.name}.partial")
        with partial.open("wb") as file:
            file.write(json.dumps(snapshot).encode())
            _flush(file.fileno(), file)
        partial.replace(self._snapshot)

    def remove(self) -> None:
        """The search has ended, and its results are written."""
        for path in (self._snapshot, self._journal):
            path.unlink(missing_ok=True)

    def _read(self) -> None:
        try:
            snapshot = json.loads(self._snapshot.read_bytes())
            if not isinstance(snapshot, dict) or snapshot.get("format") != _FORMAT:
                raise ValueError("another version of formation-opt wrote it")
            identity = [str(line) for line in snapshot["identity"]]
            size, self._state = int(snapshot["journal_bytes"]), snapshot["state"]
            journal = self._journal.read_bytes()
            if len(journal) < size:
                raise ValueError(f"{self._journal.name} is shorter than it says")
            self._steps = [json.loads(line) for line in journal[:size].splitlines()]
        except (OSError, ValueError, KeyError, TypeError) as error:
            reason = error.strerror if isinstance(error, OSError) else str(error)
            raise CheckpointError(
                f"{self._snapshot} cannot be gone on with: {reason}; run without --resume to start "
                "from the beginning"
            ) from error
        self._size = size
        if identity != self._identity:
            raise CheckpointError(_refusal(self._snapshot, identity, self._identity))


def has_checkpoint(folder: Path) -> bool:
    """Whether a folder holds an unfinished search.

    Parameters
    ----------
    folder : an output folder.
    """
    return _files(folder)[0].exists()


def _files(folder: Path) -> tuple[Path, Path]:
    return folder / "checkpoint.json", folder / "checkpoint.jsonl"


def _flat(path: str, value: Any) -> Iterator[str]:
    """A line for each value, `radar.looks: 16.0`, so that a difference shows just what differs."""
    if isinstance(value, Mapping):
        for key, item in value.items():
            yield from _flat(f"{path}.{key}" if path else str(key), item)
    elif isinstance(value, list | tuple):
        for index, item in enumerate(value, start=1):
            yield from _flat(f"{path}[{index}]", item)
    else:
        yield f"{path}: {value}"


def _flush(descriptor: int, file: Any) -> None:
    file.flush()
    os.fsync(descriptor)  # a loss of power must not leave the new name with the old contents


def _refusal(path: Path, before: list[str], now: list[str]) -> str:
    difference = difflib.unified_diff(before, now, "the search begun", "this run", lineterm="", n=0)
    return "\n".join(
        [
            f"{path} is of another study, whose search this run would not repeat:",
            *(f"    {line}" for line in difference if not line.startswith("@@")),
            "give the study and the seed of that run, or leave out --resume to start from the "
            "beginning",
        ]
    )
