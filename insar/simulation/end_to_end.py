"""End to end: a terrain, the true paths to it, speckle, wrapped phases, and heights from them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from .comparison import Comparison, Simulated
from .nature import natural_errors
from .synthesis import at_range, draw_scene_errors, path_phase, unsupported_scales
from .terrain_flight import Flown, Points, chunks, coherence_with_first, common_shift, fly
from .terrain_results import TerrainMaps, TerrainRequest, TerrainSimulation

Array = NDArray[np.float64]


def simulate_terrain(
    request: TerrainRequest,
    *,
    rng: np.random.Generator,
    should_stop: Callable[[], bool] = lambda: False,
) -> TerrainSimulation:
    """Fly over a terrain and measure its heights.

    Parameters
    ----------
    request : what is simulated.
    rng : source of random numbers.
    should_stop : asked after each acquisition; those flown until then count.

    Raises
    ------
    ValueError
        If no point is seen, or an error of the budget is drawn anew for every pixel.

    Notes
    -----
    Phases are those of the exact paths from transmitters and to receivers, of satellites that are
    elsewhere than thought. The processor knows range and time of zero Doppler, and where the
    satellites should be; it expects at each point the phases of the prior height at the same range
    and linearizes about it: heights follow by kz, then once more by the exact paths.
    """
    natural = natural_errors(request.errors)
    errors = natural.errors
    own = unsupported_scales(errors)
    if own:
        raise ValueError(
            f"{own[0]} has the scale pixel, which is not drawn over a terrain; give it the scale "
            "scene"
        )
    parts = list(chunks(request, errors))
    if not any(points.clear.any() for points in parts):
        raise ValueError(
            "no point of the terrain is measured: all of it is layover, shadow, a gap, or beyond "
            "the critical baseline of an image; use shorter baselines, or another look angle"
        )
    maps: TerrainMaps | None = None
    sums: list[Array] = []
    for _ in range(request.acquisitions):
        wrongly = draw_scene_errors(errors, radar=request.radar, rng=rng)
        names = ("troposphere", "ionosphere", "ionosphere_gradient")
        common = dict(zip(names, rng.standard_normal(len(names)).tolist(), strict=True))
        prior = _prior_errors(request, rng)
        flown = []
        for points in parts:
            one = fly(
                request,
                errors,
                points,
                wrongly=wrongly,
                prior_error=prior[points.mask],
                rng=rng,
                likely=maps is None,
            )
            shift = common_shift(request, errors, points, common)
            flown.append(
                one._replace(
                    systematic=one.systematic + shift,
                    least_squares=one.least_squares + shift,
                    likely=one.likely + shift,
                )
            )
        if maps is None:
            maps = _maps(request, parts, flown, prior)
        sums.append(_mean_squares(parts, flown, prior))
        if should_stop():
            break
    return _result(request, parts, maps, np.array(sums), natural.departures)


def _prior_errors(request: TerrainRequest, rng: np.random.Generator) -> Array:
    """Errors of an elevation model that is known beforehand, (rows, columns) [m]."""
    terrain = request.view.terrain
    white = rng.standard_normal(terrain.shape)
    width = [
        request.prior_correlation / posting
        for posting in (terrain.posting_north, terrain.posting_east)
    ]
    smooth = gaussian_filter(white, width, mode="wrap")
    scale = request.prior_height_std / math.sqrt(float(np.mean(smooth**2)))
    return np.asarray(smooth * scale)


def _mean_squares(parts: Sequence[Points], flown: Sequence[Flown], prior: Array) -> Array:
    """Means over the clear points of what `_result` needs of one acquisition, (8,)."""
    noise, systematic, error, wrong = (
        np.concatenate(
            [getattr(one, name)[points.clear] for points, one in zip(parts, flown, strict=True)]
        )
        for name in ("noise", "systematic", "least_squares", "wrong")
    )
    prior_error = np.concatenate([prior[points.mask][points.clear] for points in parts])
    return np.array(
        [
            np.mean(noise**2),
            np.mean(noise**4),
            np.mean(systematic**2),
            np.mean((noise + systematic) ** 2),
            np.mean(systematic),
            np.mean(error**2),
            np.mean(wrong),
            np.mean(prior_error**2),
        ]
    )


def _maps(
    request: TerrainRequest, parts: Sequence[Points], flown: Sequence[Flown], prior: Array
) -> TerrainMaps:
    shape, view = request.view.terrain.shape, request.view

    def spread(values: Sequence[Array]) -> Array:
        found = np.full((*values[0].shape[1:], *shape), np.nan)
        for points, value in zip(parts, values, strict=True):
            found[..., points.mask] = value.T
        return found

    reference = float(np.mean(view.terrain.heights[view.seen]))
    phases = []
    for points, one in zip(parts, flown, strict=True):
        height = points.height + prior[points.mask]
        level = np.full(height.shape, reference)
        raised, flat = (
            path_phase(at_range(view, h, points.slant_range), points.positions, radar=request.radar)
            for h in (height, level)
        )
        phases.append(np.angle(np.exp(1j * (one.phase + raised - flat)))[:, 1:])
    predicted = spread([points.predicted.T for points in parts])
    wrong, clear = np.zeros(shape, dtype=bool), np.zeros(shape, dtype=bool)
    for points, one in zip(parts, flown, strict=True):
        wrong[points.mask] = one.wrong
        clear[points.mask] = points.clear
    return TerrainMaps(
        phase=spread(phases),
        residual_phase=spread([one.phase[:, 1:] for one in flown]),
        coherence=spread([coherence_with_first(points)[:, 1:] for points in parts]),
        predicted_total=predicted[0],
        predicted_relative=predicted[1],
        predicted_failure=predicted[2],
        prior_error=np.where(view.seen, prior, np.nan),
        random_error=spread([one.noise for one in flown]),
        least_squares_error=spread([one.least_squares for one in flown]),
        likely_error=spread([one.likely for one in flown]),
        wrong=wrong,
        clear=clear,
    )


def _result(
    request: TerrainRequest,
    parts: Sequence[Points],
    maps: TerrainMaps | None,
    sums: Array,
    departures: tuple[str, ...],
) -> TerrainSimulation:
    if maps is None:
        raise ValueError(f"acquisitions = {request.acquisitions} must be at least 1")
    predicted = np.concatenate([points.predicted[:, points.clear] for points in parts], axis=-1)
    points, flights = predicted.shape[-1], len(sums)
    noise, fourth, systematic, total, offset, error, wrong, prior = sums.T
    value = math.sqrt(noise.mean())
    # Noise is independent from point to point. An error of the scene is drawn once a flight: its
    # square has the spread 2σ⁴ of one Gaussian, with the σ that is predicted: few draws know it
    # badly.
    spread = math.sqrt(max(fourth.mean() - noise.mean() ** 2, 0.0) / (points * flights))
    all_errors = math.sqrt(total.mean())
    expected = max(_rms(predicted[0]) ** 2 - _rms(predicted[1]) ** 2, systematic.mean())
    lasting = expected * math.sqrt(2.0 / flights)
    between = float(wrong.std(ddof=1)) / math.sqrt(flights) if flights > 1 else 0.0
    chance = max(float(wrong.mean()), 1.0 / points, float(predicted[2].mean()))
    return TerrainSimulation(
        request=request,
        maps=maps,
        points=points,
        random=Comparison(_rms(predicted[1]), Simulated(value, spread / (2.0 * value))),
        total=Comparison(
            _rms(predicted[0]),
            Simulated(all_errors, math.hypot(lasting, spread) / (2.0 * all_errors)),
        ),
        wrong=Comparison(
            float(predicted[2].mean()),
            Simulated(float(wrong.mean()), max(between, math.sqrt(chance / (points * flights)))),
        ),
        least_squares=math.sqrt(error.mean()),
        most_likely=_rms(maps.likely_error[maps.clear]),
        prior=math.sqrt(prior.mean()),
        offsets=offset,
        departures=departures,
    )


def _rms(values: Array) -> float:
    return math.sqrt(float(np.mean(values**2)))
