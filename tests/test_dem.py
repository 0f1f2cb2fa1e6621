"""Posting against looks, and the classes of elevation models."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insar.accuracy import Cell, HeightAccuracy
from insar.dem import (
    CLASSES,
    DTED2,
    HRTI3,
    HRTI4,
    Quantity,
    Resolution,
    Specification,
    judge,
    looks_of_posting,
    posting_of_looks,
)


def _accuracy(relative_90, absolute_90):
    relative, absolute = np.atleast_1d(relative_90), np.atleast_1d(absolute_90)
    return HeightAccuracy(
        cell=Cell(),
        random=relative,
        random_pair_90=relative,
        sources={},
        residual=None,
        relative=relative,
        absolute=absolute,
        relative_90=relative,
        absolute_90=absolute,
    )


@given(
    looks=st.floats(1.0, 1e4),
    slant=st.floats(0.2, 50.0),
    azimuth=st.floats(0.2, 50.0),
    degrees=st.floats(10.0, 80.0),
    independence=st.floats(0.5, 3.0),
)
def test_posting_and_looks_are_one_choice(looks, slant, azimuth, degrees, independence):
    given_values = {
        "resolution": Resolution(slant_range=slant, azimuth=azimuth),
        "local_incidence": np.deg2rad(degrees),
        "independence": independence,
    }
    posting = posting_of_looks(looks, **given_values)
    assert looks_of_posting(posting, **given_values) == pytest.approx(looks)


def test_looks_of_tandem_x_like_posts():
    """12 m posts at 35° from cells of 1 m (150 MHz) by 3 m: 27.5 looks."""
    cell = Resolution(slant_range=1.0, azimuth=3.0)
    looks = looks_of_posting(12.0, resolution=cell, local_incidence=np.deg2rad(35.0))
    assert looks == pytest.approx(144.0 * np.sin(np.deg2rad(35.0)) / 3.0)
    assert looks == pytest.approx(27.53, abs=0.01)


def test_published_classes():
    assert (HRTI3.posting, HRTI3.relative_90, HRTI3.absolute_90) == (12.0, 2.0, 10.0)
    assert HRTI3.relative_limit(np.arctan([0.1, 0.19, 0.21, -0.5])).tolist() == [2, 2, 4, 4]
    assert (HRTI4.posting, HRTI4.relative_90) == (6.0, 0.8)
    assert not HRTI4.confirmed
    assert (DTED2.relative_90, DTED2.absolute_90) == (12.0, 18.0)
    assert set(CLASSES) == {"hrti3", "hrti4", "dted2"}


def test_tandem_x_passes_its_own_class_and_not_the_next():
    accuracy = _accuracy(2.0, 10.0)
    assert judge(accuracy, HRTI3, slope=[0.0], posting=12.0).passed
    judged = judge(accuracy, HRTI4, slope=[0.0], posting=12.0)
    assert [criterion.passed for criterion in judged.criteria] == [False, False, False]


def test_worst_segment_is_by_the_limit_of_its_own_slope():
    """3 m on a steep slope keeps 4 m; 2.5 m on a flat one breaks 2 m."""
    accuracy = _accuracy([3.0, 2.5], [5.0, 6.0])
    slope = np.arctan([0.3, 0.0])
    relative, absolute = judge(accuracy, HRTI3, slope=slope).criteria
    assert (relative.quantity, relative.segment, relative.limit) == (Quantity.RELATIVE, 1, 2.0)
    assert not relative.passed
    assert (absolute.segment, absolute.passed) == (1, True)


def test_a_height_that_is_not_measured_fails():
    judged = judge(_accuracy([1.0, np.inf], [1.0, np.inf]), HRTI3, slope=[0.0, 0.0])
    assert not judged.passed
    assert judged.criteria[0].segment == 1


def test_posting_that_is_unknown_is_not_judged():
    assert len(judge(_accuracy(1.0, 1.0), HRTI3, slope=[0.0]).criteria) == 2


@pytest.mark.parametrize("change", [{"posting": -1.0}, {}])
def test_a_class_that_asks_nothing_is_refused(change):
    with pytest.raises(ValueError, match=r"posting|asks nothing"):
        Specification(name="mine", **change)
