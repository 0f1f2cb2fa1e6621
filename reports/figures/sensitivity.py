"""Which items of the budget the errors of an elevation model answer to."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from optimize.sensitivity import Quantity, Sensitivity

from ..dem_words import QUANTITIES, item_name, item_value
from .style import INK, color, draw

_SHOWN = (Quantity.RELATIVE, Quantity.ABSOLUTE)

LEAST = 0.005
"""Elasticity below which an item is not drawn: half a percent of the error for all of it."""


def telling(found: Sequence[Sensitivity]) -> list[Sensitivity]:
    """Items that move the relative or the absolute error, the most telling first."""
    kept = [one for one in found if _reach(one) >= LEAST]
    return sorted(kept, key=_reach, reverse=True)


def sensitivity_figure(found: Sequence[Sensitivity]) -> bytes:
    """Elasticities as bars from zero, a pair for each item.

    Parameters
    ----------
    found : from `telling`, at least one.
    """

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        for offset, quantity in zip((-0.2, 0.2), _SHOWN, strict=True):
            _paint(axes, found, quantity, offset)
        reach = max(_reach(one) for one in found)
        axes.set_xlim(-1.18 * reach, 1.18 * reach)
        axes.axvline(0.0, color=INK, linewidth=0.6)
        axes.set_yticks(
            range(len(found)),
            [f"{item_name(one.item)} ({item_value(one.item, one.value)})" for one in found],
        )
        axes.invert_yaxis()
        axes.set_xlabel("change of the error for each percent of the item [%]")
        axes.grid(visible=False, axis="y")
        axes.tick_params(axis="y", length=0)
        for side in ("top", "right", "left"):
            axes.spines[side].set_visible(False)
        axes.legend(loc="lower right")

    return draw(paint, height=1.0 + 0.36 * len(found))


def _paint(axes: Axes, found: Sequence[Sensitivity], quantity: Quantity, offset: float) -> None:
    values = [_finite(one.elasticities.get(quantity, math.nan)) for one in found]
    rows = [row + offset for row in range(len(found))]
    shade = color(0 if quantity is Quantity.RELATIVE else 1)
    axes.barh(rows, values, height=0.36, color=shade, label=QUANTITIES[quantity])
    for row, value in zip(rows, values, strict=True):
        axes.annotate(
            f"{value:+.2f}".replace("-", "−"),
            (value, row),
            xytext=(3 if value >= 0.0 else -3, 0),
            textcoords="offset points",
            ha="left" if value >= 0.0 else "right",
            va="center_baseline",
            fontsize=7.5,
        )


def _reach(one: Sensitivity) -> float:
    return max(abs(_finite(one.elasticities.get(quantity, math.nan))) for quantity in _SHOWN)


def _finite(value: float) -> float:
    return value if math.isfinite(value) else 0.0
