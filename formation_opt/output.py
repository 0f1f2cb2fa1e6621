"""Writes to the standard streams, whatever state they are in."""

from __future__ import annotations

import io
import os
import sys


def prepare() -> None:
    """Let a terminal of any encoding show our text: what it lacks is written as an escape."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def say(text: str) -> None:
    """Print a text.

    A reader that has left (head, a closed pager) or a full disk behind a redirection must not
    change what the command did, nor its exit code.
    """
    try:
        sys.stdout.write(f"{text}\n")
        sys.stdout.flush()
    except BrokenPipeError:
        _silence()
    except OSError as error:
        _silence()
        complain(f"standard output cannot be written: {error.strerror or error}")


def complain(text: str) -> None:
    """Print an error message."""
    sys.stderr.write(f"formation-opt: {text}\n")


def _silence() -> None:
    """Send what the stream still holds nowhere, lest Python complain at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
