"""The command `formation-opt`.

Exit codes: 0 done, 2 the input is wrong, 3 no feasible design was found, 130 interrupted.
Heavy packages are imported where they are used, so that `--help` answers at once.
"""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from . import __version__
from .one_place import intruder
from .output import complain, prepare, say

if TYPE_CHECKING:
    from configs import LoadedStudy

DONE, WRONG_INPUT, INFEASIBLE, INTERRUPTED = 0, 2, 3, 130
FORMATS = ("html", "pdf")
_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")

_DESCRIPTION = """\
Design and optimize a distributed-InSAR formation: reads a study (YAML), runs it and writes a
report with figures (HTML, PDF), result.json and tables (CSV).
"""

_EPILOG = """\
examples:
  formation-opt configs/three_sat.yaml       run a study file
  formation-opt three_sat                    run a shipped example
  formation-opt --new three_sat > my.yaml    start a study of your own

exit codes: 0 done, 2 wrong input, 3 no feasible design found, 130 interrupted (the report
holds the best so far; --resume goes on)
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    arguments : of the command line; those of the process if None.

    Returns
    -------
    The exit code.
    """
    prepare()
    # The arrays here are small: BLAS threads only cost time, and the last digits of a sum, and
    # with them the result of a seed, would depend on their number. NumPy is not imported yet.
    os.environ.update(dict.fromkeys(_THREADS, "1"))
    shadow = intruder(Path(__file__).resolve().parent.parent)
    if shadow is not None:
        return _fail(shadow)
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        if options.list:
            return _list()
        if options.schema:
            return _schema()
        if options.new is not None:
            return _new(options.new)
        if options.study is None:
            parser.print_usage(sys.stderr)
            return _fail("give a study: a YAML file, or an example's name (see --list)")
        return _run(options)
    except KeyboardInterrupt:
        return _fail("interrupted", INTERRUPTED)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="formation-opt",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "study",
        nargs="?",
        metavar="STUDY",
        help="a study file (with a '/' or ending in .yaml), or the name of a shipped example",
    )
    parser.add_argument(
        "--out", type=_folder, metavar="DIR", help="output folder (default: out/<study name>)"
    )
    parser.add_argument(
        "--seed", type=_seed, metavar="N", help="random seed, instead of the study's"
    )
    parser.add_argument(
        "--format",
        type=_formats,
        default=FORMATS,
        metavar="html,pdf",
        help="report formats, or 'none' (result.json and the tables are always written)",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="go on with the search of an earlier run that did not end, to the same result",
    )
    parser.add_argument(
        "--check", action="store_true", help="only check that the study is valid, and stop"
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--list", action="store_true", help="list the shipped examples")
    parser.add_argument("--new", metavar="NAME", help="print a shipped example to start from")
    parser.add_argument(
        "--schema", action="store_true", help="print the JSON schema of a study file"
    )
    parser.add_argument("--version", action="version", version=f"formation-opt {__version__}")
    return parser


def _folder(text: str) -> Path:
    if not text.strip():
        raise argparse.ArgumentTypeError("the folder's name is empty; '.' is the current one")
    return Path(text)


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and int(text) < 2**32):
        raise argparse.ArgumentTypeError(f"{text!r} must be a whole number from 0 to {2**32 - 1}")
    return int(text)


def _formats(text: str) -> tuple[str, ...]:
    if text.strip() == "none":
        return ()
    formats = tuple(part.strip() for part in text.split(","))
    for name in formats:
        if name not in FORMATS:
            raise argparse.ArgumentTypeError(
                f"{name!r} is no report format; choose of {', '.join(FORMATS)}, or none"
            )
    return formats


def _fail(message: str, code: int = WRONG_INPUT) -> int:
    complain(message)
    return code


def _list() -> int:
    """Examples by kind, each with the first sentence of its description."""
    import shutil
    import textwrap

    from configs import STUDIES, example_names, example_path, load_study

    by_kind: dict[str, list[str]] = {kind: [] for kind in STUDIES}
    width = min(shutil.get_terminal_size().columns, 100)
    for name in example_names():
        study = load_study(example_path(name)).study
        sentence = study.description.split(". ")[0].rstrip(".")
        text = textwrap.fill(
            f"{name:20} {sentence}", width, initial_indent="  ", subsequent_indent=" " * 23
        )
        by_kind[study.kind].append(text)
    for kind, texts in by_kind.items():
        say("\n".join([f"{kind}:", *texts]))
    return DONE


def _new(name: str) -> int:
    from configs import StudyError, example_text

    try:
        say(example_text(name).rstrip("\n"))
    except StudyError as error:
        return _fail(str(error))
    return DONE


def _schema() -> int:
    import json

    from configs import json_schema

    say(json.dumps(json_schema(), indent=2, ensure_ascii=False))
    return DONE


def _run(options: argparse.Namespace) -> int:
    from configs import StudyError

    from .checkpoint import CheckpointError
    from .execution import OutputError, build, execute

    try:
        loaded = _load(options.study)
        if options.check:
            build(loaded)
            if not options.quiet:
                say(f"{options.study}: a valid study of kind {loaded.study.kind}")
            return DONE
        outcome = execute(
            loaded,
            out=options.out if options.out is not None else Path("out") / loaded.study.name,
            seed=options.seed,
            formats=options.format,
            quiet=options.quiet,
            resume=options.resume,
            command=_command(options),
        )
    except (StudyError, OutputError, CheckpointError) as error:
        return _fail(str(error))
    if outcome.interrupted:
        return _fail("interrupted; the report holds the best so far, --resume goes on", INTERRUPTED)
    if outcome.blocked is not None:
        return _fail(f"no feasible design was found: {outcome.blocked}", INFEASIBLE)
    return DONE


def _load(name: str) -> LoadedStudy:
    """The study that a file or an example holds; a `StudyError` if it holds none."""
    from configs import StudyError, example_path, load_study

    is_file = os.sep in name or "/" in name or name.endswith((".yaml", ".yml"))
    if not is_file and Path(name).is_file():
        raise StudyError(
            f"{name} is a file, but a name without '/' and .yaml is a shipped example's; "
            f"write ./{name}"
        )
    return load_study(Path(name) if is_file else example_path(name))


def _command(options: argparse.Namespace) -> str:
    """The command that repeats this run, whatever the folder it is started in."""
    parts = ["formation-opt", str(options.study)]
    if options.seed is not None:
        parts += ["--seed", str(options.seed)]
    return shlex.join(parts)
