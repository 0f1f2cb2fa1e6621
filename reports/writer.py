"""Writes every file of a report."""

from __future__ import annotations

import io
import os
import tempfile
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any

from .study import Provenance, StudyInfo

FORMATS = ("html", "pdf")
"""Formats that can be asked for; JSON and CSV are always written."""

_SOMETIMES = (
    *("segments.csv", "selection.csv", "compensation.csv", "claims.csv"),
    *("coverage.csv", "candidates.csv", "maps.npz"),
)
"""Tables that a study of the same kind may have, or not."""


def write_report(
    result: object,
    *,
    study: StudyInfo,
    provenance: Provenance,
    out: Path,
    formats: Collection[str] = FORMATS,
) -> tuple[Path, ...]:
    """Write the report of a result.

    Parameters
    ----------
    result : of a kind that `reports.pages` knows, such as `optimize.OptimizeResult`.
    study : the study that was run.
    provenance : how it was run.
    out : folder of the files; made if it does not exist.
    formats : of ``html`` and ``pdf``; ``result.json`` and the tables are written in any case.

    Returns
    -------
    Paths of the files written. Each is complete or absent, never half written; a report of an
    earlier run in a format that is not asked for, or a table that this one has not, is removed.

    Raises
    ------
    ValueError
        If a format is unknown.
    TypeError
        If there is no page for this type of result.
    """
    unknown = sorted(set(formats) - set(FORMATS))
    if unknown:
        raise ValueError(f"formats = {unknown!r} is unknown; choose of {', '.join(FORMATS)}")
    # All is rendered before anything is replaced: results and reports of two runs never mix.
    files = list(_files(result, study, provenance, formats))
    out.mkdir(parents=True, exist_ok=True)
    optional = {f"report.{name}" for name in FORMATS}.union(_SOMETIMES)
    for stale in optional - {name for name, _ in files}:
        (out / stale).unlink(missing_ok=True)
    for name, content in files:
        _replace(out / name, content)
    return tuple(out / name for name, _ in files)


def _files(
    result: object, study: StudyInfo, provenance: Provenance, formats: Collection[str]
) -> Iterator[tuple[str, bytes]]:
    """Names and contents, the cheapest first: a failing figure loses no numbers."""
    # Imported here: matplotlib and pandas take longer than the command's --help may.
    from .json_result import result_json
    from .pages import page_of
    from .tables import csv_bytes
    from .tables_observation import observation_tables

    page = page_of(result)
    yield "result.json", result_json(page.json(result), study=study, provenance=provenance)
    for name, frame in {**page.csv(result), **observation_tables(study.observation)}.items():
        yield name, csv_bytes(frame)
    arrays = page.arrays(result)
    if arrays:
        yield "maps.npz", _npz_bytes(arrays)
    if not formats:
        return
    document = page.document(result, study, provenance)
    if "html" in formats:
        from .html import html_bytes

        yield "report.html", html_bytes(document)
    if "pdf" in formats:
        from .pdf import pdf_bytes

        yield "report.pdf", pdf_bytes(document)


def _npz_bytes(arrays: Mapping[str, Any]) -> bytes:
    import numpy as np

    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    return buffer.getvalue()


def _replace(path: Path, content: bytes) -> None:
    """Write a file in one step, so that a reader never sees half of it."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        temporary.chmod(0o644)  # mkstemp makes it private
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
