"""Ctrl-C as a request: the search ends, what was found is still written."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def interrupts() -> Iterator[Callable[[], bool]]:
    """Turn the first Ctrl-C into a request to stop, and a second one into KeyboardInterrupt.

    Yields
    ------
    A function that tells whether stopping was requested.
    """
    requests = 0

    def request(_number: int, _frame: FrameType | None) -> None:
        nonlocal requests
        requests += 1
        if requests > 1:
            raise KeyboardInterrupt
        sys.stderr.write("\nstopping: writing what was found (Ctrl-C again to drop it)\n")

    # Only the main thread may listen to signals; elsewhere Ctrl-C is the caller's.
    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, request)
    try:
        yield lambda: requests > 0
    finally:
        signal.signal(signal.SIGINT, before)
