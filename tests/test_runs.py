"""What the terminal shows of a run."""

import numpy as np
import pytest

from formation_opt.runs.shown import agility, hertz, largest_degrees

RATES = np.full((3, 3), 0.01)


@pytest.mark.parametrize(
    ("exceeded", "rates", "limited", "text"),
    [
        (False, RATES, True, "kept"),
        (True, RATES, True, "exceeded"),
        (False, RATES, False, "no limits given"),
        (False, np.full((3, 3), np.nan), True, "not known"),
    ],
)
def test_agility(exceeded, rates, limited, text):
    assert agility(np.full(3, exceeded), rates, limited=limited) == text


def test_rounding_is_zero():
    assert hertz(4e-10) == "0 Hz"
    assert hertz(0.00566) == "0.00566 Hz"
    assert hertz(16579.6) == "16580 Hz"
    assert largest_degrees(np.radians([1e-9, -1e-8])) == "0"
    assert largest_degrees(np.radians([1.0, -3.7216])) == "3.722"
