"""Executes a loaded study: runs its kind, and writes and prints what came of it."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Collection
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from configs import BuildError, LoadedStudy, SourcedStudy, effective_text
from reports import Provenance, StudyInfo, write_report

from . import provenance, terminal
from .checkpoint import Checkpoint, CheckpointError, Identity, has_checkpoint
from .interrupts import interrupts
from .kinds import KINDS
from .output import say
from .runs import Outcome


class OutputError(Exception):
    """The output folder cannot be written; the message says why and what to do."""


def execute(
    loaded: LoadedStudy,
    *,
    out: Path,
    seed: int | None,
    formats: Collection[str],
    quiet: bool,
    command: str,
    resume: bool = False,
) -> Outcome:
    """Run a study and write its report.

    Parameters
    ----------
    loaded : the study with its source.
    out : output folder, made if it does not exist.
    seed : instead of the study's, if given.
    formats : of the report.
    quiet : whether to print nothing.
    command : the command that repeats the run.
    resume : whether to go on with the unfinished search that the folder holds.

    Returns
    -------
    Outcome

    Raises
    ------
    StudyError
        If the study turns out to make no sense, before anything is written.
    OutputError
        If the folder cannot be written, before anything is computed or when the disk fills up.
    CheckpointError
        If `resume` asks for a search that is not there to go on with.
    """
    searches = KINDS[loaded.study.kind].searches
    if resume and not searches:
        raise CheckpointError(
            f"--resume goes on with a search, and a study of kind {loaded.study.kind} has none"
        )
    setup = build(loaded)
    _make_writable(out)
    if searches and not quiet:
        if resume and not has_checkpoint(out):
            say(f"{out} holds no unfinished search: starting from the beginning")
        if not resume and has_checkpoint(out):
            say(f"{out} held an unfinished search: starting anew (--resume would have gone on)")
    with interrupts() as should_stop:
        try:
            return _execute(loaded, setup, out, seed, formats, quiet, command, should_stop, resume)
        except OSError as error:  # of a checkpoint
            raise OutputError(_unwritable(out, error)) from error


def build(loaded: LoadedStudy) -> Any:
    """Build what a study is computed with; whatever is wrong with it comes to light here.

    Parameters
    ----------
    loaded : the study with its source.

    Raises
    ------
    StudyError
        If it cannot be built: a target that is never seen, an ephemeris that ends too early.
    """
    try:
        return KINDS[loaded.study.kind].build(loaded.study)
    except BuildError as error:
        raise loaded.located(error) from None


def _execute(
    loaded: LoadedStudy,
    setup: Any,
    out: Path,
    seed: int | None,
    formats: Collection[str],
    quiet: bool,
    command: str,
    should_stop: Callable[[], bool],
    resume: bool,
) -> Outcome:
    started, clock = datetime.now(UTC), time.perf_counter()
    checkpoints: list[Checkpoint] = []

    def keeper(seed_used: int, compiled: bool) -> Checkpoint:
        identity = _identity(loaded, seed_used, compiled=compiled)
        checkpoints.append(Checkpoint(out, identity, resume=resume))
        return checkpoints[-1]

    with terminal.progress(seed=seed, quiet=quiet, should_stop=should_stop) as options:
        try:
            outcome = KINDS[loaded.study.kind].run(
                loaded.study, setup, replace(options, keeper=keeper)
            )
        except BuildError as error:  # an ephemeris with a gap, found when asked for its states
            raise loaded.located(error) from None
    how = _provenance(outcome, command, started, seconds=time.perf_counter() - clock)
    try:
        paths = write_report(
            outcome.result, study=_info(loaded, outcome), provenance=how, out=out, formats=formats
        )
    except OSError as error:
        raise OutputError(_unwritable(out, error)) from error
    if not outcome.interrupted:
        for checkpoint in checkpoints:
            checkpoint.remove()
    if not quiet:
        terminal.summary(outcome.summary, paths, seconds=time.perf_counter() - clock)
    return outcome


def _info(loaded: LoadedStudy, outcome: Outcome) -> StudyInfo:
    """What a report says of the study itself."""
    study, orbit = loaded.study, outcome.orbit
    return StudyInfo(
        name=study.name,
        kind=study.kind,
        description=study.description,
        source_text=loaded.source_text,
        config_sha256=loaded.sha256,
        effective=effective_text(study),
        orbit_altitude=None if orbit is None else orbit.altitude,
        inclination=None if orbit is None else orbit.inclination,
        observation=outcome.observation,
        inputs=tuple((file.name, file.sha256) for file in loaded.files),
        inferred=study.inferred_inputs if isinstance(study, SourcedStudy) else (),
    )


def _provenance(outcome: Outcome, command: str, started: datetime, *, seconds: float) -> Provenance:
    """What a report says of the run."""
    return Provenance(
        version=provenance.program(),
        seed=outcome.seed,
        python=provenance.python(),
        platform=provenance.machine(),
        packages=provenance.packages(),
        started=started.isoformat(timespec="seconds"),
        wall_s=seconds,
        evaluations=outcome.evaluations,
        compiled=outcome.compiled,
        command=command,
    )


def _identity(loaded: LoadedStudy, seed: int, *, compiled: bool) -> Identity:
    return Identity(
        study=loaded.study.model_dump(mode="json"),
        seed=seed,
        inputs={file.name: file.sha256 for file in loaded.files},
        packages={"formation-opt": provenance.program()} | provenance.packages(),
        compiled=compiled,
    )


def _make_writable(out: Path) -> None:
    """Find out before the search, not after it, that the results have a place."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=out, prefix=".formation-opt.")
        os.close(handle)
        Path(name).unlink()
    except OSError as error:
        raise OutputError(_unwritable(out, error)) from error


def _unwritable(out: Path, error: OSError) -> str:
    reason = error.strerror or str(error)
    if isinstance(error, FileExistsError | NotADirectoryError):
        reason = "a file of that name is in the way"
    return f"the output folder {out} cannot be written: {reason}; choose another with --out"
