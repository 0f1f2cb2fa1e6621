"""What the terminal shows of a run."""

from types import SimpleNamespace

import numpy as np
import pytest

from formation_opt.runs.shown import agility, hertz, largest_degrees

NONE, SOME = np.zeros(3, bool), np.array([False, True, False])
LIMITED, FREE = SimpleNamespace(limited=True), SimpleNamespace(limited=False)


@pytest.mark.parametrize(
    ("exceeded", "solved", "limits", "why", "text"),
    [
        (NONE, ~NONE, LIMITED, None, "kept"),
        (SOME, ~NONE, LIMITED, None, "exceeded"),
        (NONE, ~NONE, FREE, None, "no limits given"),
        (NONE, ~NONE, None, None, "no limits given"),
        (NONE, NONE, LIMITED, "no beam", "not known: no beam"),
        (NONE, SOME, LIMITED, "no beam", "kept, where the attitude is known; no beam"),
    ],
)
def test_agility(exceeded, solved, limits, why, text):
    profile = SimpleNamespace(solved=solved, rate_exceeded=exceeded, acceleration_exceeded=NONE)
    assert agility(profile, limits, why) == text


def test_rounding_is_zero():
    assert hertz(4e-10) == "0 Hz"
    assert hertz(0.00566) == "0.00566 Hz"
    assert hertz(16579.6) == "16580 Hz"
    assert largest_degrees(np.radians([1e-9, -1e-8])) == "0"
    assert largest_degrees(np.radians([1.0, -3.7216])) == "3.722"
