"""Which error source contributes how much."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..reading import Share, Shown, shares
from ..wording import meters, percent, source_name
from .style import color, draw, shortened


def attribution_figure(formations: Sequence[Shown]) -> bytes:
    """Contribution of each source to the region error, a panel for each formation.

    Parameters
    ----------
    formations : those that measure a height, at most three.
    """
    found = [shares(f.assessment) for f in formations]
    sources = list(dict.fromkeys(share.source for one in reversed(found) for share in one))
    largest = [max(share.contribution for share in one) for one in found]
    comparable = max(largest) <= 4.0 * min(largest)

    def paint(figure: Figure) -> None:
        panels = figure.subplots(1, len(formations), sharey=True, squeeze=False)[0]
        for axes, formation, one, reach in zip(panels, formations, found, largest, strict=True):
            _paint_bars(axes, one, sources, shade=color(formation.style))
            axes.set_xlim(0.0, 1.5 * (max(largest) if comparable else reach))
            axes.set_title(shortened(formation.name, 40), loc="left")
        panels[0].set_yticks(range(len(sources)), [source_name(source) for source in sources])
        panels[0].invert_yaxis()

    return draw(paint, height=0.75 + 0.27 * len(sources))


def _paint_bars(axes: Axes, found: Sequence[Share], sources: Sequence[str], *, shade: str) -> None:
    by_source = {share.source: share for share in found}
    for row, source in enumerate(sources):
        share = by_source.get(source)
        if share is None:
            continue
        axes.barh(row, share.contribution, height=0.62, color=shade)
        axes.annotate(
            f"{meters(share.contribution)} ({percent(share.variance_share)})",
            (share.contribution, row),
            xytext=(3, 0),
            textcoords="offset points",
            va="center_baseline",
            fontsize=8.0,
        )
    axes.set_xlabel("contribution to the height error [m]")
    axes.grid(visible=False, axis="y")
    axes.tick_params(axis="y", length=0)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.locator_params(axis="x", nbins=5)
