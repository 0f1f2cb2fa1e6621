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

from optimize import GenerationRecord

from .output import say
from .runs import Options, Summary
from .runs.formation_summary import meters


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
        # The first generation may wait for the compiler: some 20 s, once after an installation.
        task = bar.add_task("preparing", total=None, best="")

        def start(generations: int) -> None:
            bar.update(task, total=generations + 2)  # the first one, and the refinement

        def advance(record: GenerationRecord) -> None:
            best = f"best {meters(record.best)}" if np.isfinite(record.best) else "none feasible"
            bar.update(task, advance=1, best=best, description="searching")
            if bar.tasks[task].remaining == 1:
                bar.update(task, description="refining")

        yield Options(seed=seed, on_start=start, on_generation=advance, should_stop=should_stop)


def summary(table: Summary, paths: Sequence[Path], *, seconds: float) -> None:
    """Print the compact table and the paths.

    Parameters
    ----------
    table : what the run found.
    paths : the files written.
    seconds : duration of the run.
    """
    drawn = Table(box=None, pad_edge=False, header_style="bold")
    drawn.add_column("")
    for heading in table.headings:
        drawn.add_column(heading, justify="right")
    for label, values in table.rows:
        drawn.add_row(label, *values)
    console = Console(file=io.StringIO(), width=100, color_system=None)
    with console.capture() as captured:
        console.print(drawn)
    warnings = "".join(f"\nwarning: {text}" for text in table.warnings)
    folder = paths[0].parent
    names = ", ".join(path.name for path in paths)
    say(f"{captured.get()}{warnings}\n{folder}: {names}  ({seconds:.1f} s)")
