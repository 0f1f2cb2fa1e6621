"""What the terminal shows: a progress bar, a compact table, the paths written."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn
from rich.table import Table

from optimize import Assessment, GenerationRecord

from .output import say
from .runs import Options


@contextmanager
def progress(
    *, seed: int | None, quiet: bool, should_stop: Callable[[], bool]
) -> Iterator[Options]:
    """Options whose callbacks draw a progress bar; none where the output is no terminal.

    Parameters
    ----------
    seed : seed of the command line, if any.
    quiet : whether to show nothing.
    should_stop : whether the user asked to stop.
    """
    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield Options(seed=seed, should_stop=should_stop)
        return
    with Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[best]}"),
        console=console,
        transient=True,
    ) as bar:
        task = bar.add_task("searching", total=None, best="")

        def start(generations: int) -> None:
            bar.update(task, total=generations + 2)  # the first one, and the refinement

        def advance(record: GenerationRecord) -> None:
            best = f"best {_meters(record.best)}" if np.isfinite(record.best) else "none feasible"
            bar.update(task, advance=1, best=best)
            if bar.tasks[task].remaining == 1:
                bar.update(task, description="refining")

        yield Options(seed=seed, on_start=start, on_generation=advance, should_stop=should_stop)


def summary(shown: Sequence[Assessment], paths: Sequence[Path], *, seconds: float) -> None:
    """Print the compact table and the paths.

    Parameters
    ----------
    shown : the formations, a column each.
    paths : the files written.
    seconds : duration of the run.
    """
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("")
    for assessment in shown:
        table.add_column(assessment.label, justify="right")
    rows = [
        ("height error, total (RMS)", [_meters(float(a.height_error.region)) for a in shown]),
        ("height error, relative", [_meters(float(a.height_error.relative_region)) for a in shown]),
    ]
    if all(a.unwrapping is not None for a in shown):
        rows.append(
            (
                "unwrapping probability",
                [f"{a.unwrapping.probability.min():.4f}" for a in shown if a.unwrapping],
            )
        )
    rows.append(("limits", [_limits(a) for a in shown]))
    for label, values in rows:
        table.add_row(label, *values)
    console = Console(file=io.StringIO(), width=100, color_system=None)
    with console.capture() as drawn:
        console.print(table)
    folder = paths[0].parent
    names = ", ".join(path.name for path in paths)
    say(f"{drawn.get()}\n{folder}: {names}  ({seconds:.1f} s)")


def _meters(value: float) -> str:
    return f"{value:.3f} m" if np.isfinite(value) else "none"


def _limits(assessment: Assessment) -> str:
    broken = sum(not report.satisfied for report in assessment.constraints)
    if broken:
        return f"{broken} of {len(assessment.constraints)} broken"
    return "all kept" if assessment.constraints else "none set"
