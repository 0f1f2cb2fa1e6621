"""How a result was computed: the equations, and where they come from."""

from __future__ import annotations

from collections.abc import Sequence

from insar import BaselineDecorrelation, HeldConstant, PhaseStatistics, Weighting
from insar.observe import Observation
from insar.observe.agile.staring import StaringScene
from optimize import Assessment, Problem, SearchMethod, SearchResult

from ..document import Block, Equation, Paragraph, Reference, References, Section, Strong, Symbol
from .citations import Citations

_CLOHESSY = Reference(
    "W. H. Clohessy and R. S. Wiltshire, “Terminal guidance system for satellite rendezvous,” "
    "J. Aerospace Sci. 27(9), 653–658, 1960.",
    "10.2514/8.8704",
)
_LI = Reference(
    "F. Li, Y. Wang and H. Yan, “Formation optimization for distributed satellites SAR based on "
    "height error,” J. Electronics & Information Technology 31(4), 808–812, 2009.",
    "",
)
_RODRIGUEZ = Reference(
    "E. Rodriguez and J. M. Martin, “Theory and design of interferometric synthetic aperture "
    "radars,” IEE Proc. F 139(2), 147–159, 1992.",
    "10.1049/ip-f-2.1992.0018",
)
_LEE = Reference(
    "J.-S. Lee, K. W. Hoppel, S. A. Mango and A. R. Miller, “Intensity and phase statistics of "
    "multilook polarimetric and interferometric SAR imagery,” IEEE Trans. Geosci. Remote Sens. "
    "32(5), 1017–1028, 1994.",
    "10.1109/36.312890",
)
_GATELLI = Reference(
    "F. Gatelli et al., “The wavenumber shift in SAR interferometry,” IEEE Trans. Geosci. Remote "
    "Sens. 32(4), 855–865, 1994.",
    "10.1109/36.298013",
)
_TEUNISSEN = Reference(
    "P. J. G. Teunissen, “Success probability of integer GPS ambiguity rounding and "
    "bootstrapping,” J. Geodesy 72, 606–612, 1998.",
    "10.1007/s001900050199",
)
_DEB = Reference(
    "K. Deb, “An efficient constraint handling method for genetic algorithms,” Comput. Methods "
    "Appl. Mech. Eng. 186(2–4), 311–338, 2000.",
    "10.1016/S0045-7825(99)00389-8",
)
_STORN = Reference(
    "R. Storn and K. Price, “Differential evolution: a simple and efficient heuristic for global "
    "optimization over continuous spaces,” J. Global Optim. 11, 341–359, 1997.",
    "10.1023/A:1008202821328",
)
_HANSEN = Reference(
    "N. Hansen and A. Ostermeier, “Completely derandomized self-adaptation in evolution "
    "strategies,” Evol. Comput. 9(2), 159–195, 2001.",
    "10.1162/106365601750190398",
)
_FORTIN = Reference(
    "F.-A. Fortin et al., “DEAP: evolutionary algorithms made easy,” J. Mach. Learn. Res. 13, "
    "2171–2175, 2012.",
    "",
)

_SENSITIVITY = Equation(
    latex=r"k_{z,ij} = \frac{2\pi}{\lambda}\,"
    r"\frac{(\mathbf{q}_j - \mathbf{q}_i)\cdot\mathbf{e}_h}{r\,(\mathbf{e}_h\cdot\mathbf{u})},"
    r"\qquad \mathbf{q} = \mathbf{p}_\mathrm{tx} + \mathbf{p}_\mathrm{rx}",
    typst="k_(z,i j) = (2 pi) / lambda ((bold(q)_j - bold(q)_i) dot bold(e)_h) "
    '/ (r thin (bold(e)_h dot bold(u))), quad bold(q) = bold(p)_"tx" + bold(p)_"rx"',
)
_INFORMATION = Equation(
    latex=r"J = \mathbf{k}_z^{T}\left(X^{-1} + F F^{T}\right)^{-1}\mathbf{k}_z,"
    r"\qquad e^2 = \frac{1}{J} + \cos^2\theta_\mathrm{inc}\,\sigma_r^2",
    typst="J = bold(k)_z^sans(T) (X^(-1) + F F^sans(T))^(-1) bold(k)_z, quad "
    'e^2 = 1 / J + cos^2 theta_"inc" thin sigma_r^2',
)
_REGION = Equation(
    latex=r"E = \sqrt{\frac{1}{S}\sum\limits_{s=1}^{S} e_s^2}",
    typst="E = sqrt(1 / S sum_(s=1)^S e_s^2)",
)
_BOOTSTRAP = Equation(
    latex=r"P = \prod\limits_i \left[2\,\Phi\!\left(\frac{1}{2\sigma_i}\right) - 1\right]",
    typst="P = product_i [2 Phi(1 / (2 sigma_i)) - 1]",
)


def methods_section(
    problem: Problem,
    *,
    search: SearchResult | None,
    observation: Observation | StaringScene | None = None,
    formations: Sequence[Assessment] = (),
) -> Section:
    """Methods and references.

    Parameters
    ----------
    problem : whose model and limits decide what was used.
    search : the search; None where nothing was searched.
    observation : where the scene comes from; None if the study gives it.
    formations : those of the report; where none is given, all are on orbits.
    """
    cite = Citations()
    blocks: list[Block] = [
        *_motion(formations, cite),
        *_geometry(observation),
        *_sensitivity(problem),
        *_height(problem, cite),
        Paragraph(
            (
                "The error of the region is the RMS over its ",
                Symbol("S"),
                f" segments {cite(_LI)}:",
            )
        ),
        _REGION,
    ]
    if problem.constraints.prior_height_std is not None:
        blocks += [
            Paragraph(
                (
                    "The probability of unwrapping is that of integer bootstrapping along the "
                    f"ladder of pairs {cite(_TEUNISSEN)}, ",
                    Symbol("σ_i"),
                    " the deviation in cycles of a rung's phase given the prior height and the "
                    "rungs below:",
                )
            ),
            _BOOTSTRAP,
        ]
    if search is not None:
        blocks.append(
            Paragraph(
                f"{_algorithm(search, cite)} It ranks by feasibility first {cite(_DEB)}; its best, "
                "mutually distant designs, and structured ones (dumbbells and ladders), are then "
                "refined by sequential quadratic programming (SLSQP). How far the result is from "
                "the best possible is proven apart. Only differences of the satellites' positions "
                "enter: other formations with the same projected baselines are as good, so another "
                "seed may return other orbits with the same error."
            )
        )
    return Section("methods", "How it was computed", (*blocks, References(tuple(cite.works))))


def _algorithm(search: SearchResult, cite: Citations) -> str:
    """The algorithm of the populations, and how many there are."""
    count = search.settings.islands.number
    islands = "" if count == 1 else f", on {count} islands that exchange their best designs"
    if search.method is SearchMethod.DIFFERENTIAL_EVOLUTION:
        return f"The search is differential evolution {cite(_STORN)}{islands}."
    if search.method is SearchMethod.CMA_ES:
        apart = "" if count == 1 else f", {count} times side by side"
        return (
            f"The search adapts the covariance of a normal distribution (CMA-ES {cite(_HANSEN)}, "
            f"DEAP {cite(_FORTIN)}){apart}."
        )
    return f"The search is a genetic algorithm (DEAP {cite(_FORTIN)}){islands}."


def _motion(formations: Sequence[Assessment], cite: Citations) -> tuple[Block, ...]:
    """How the satellites move, where they do, and how acquisitions are combined."""
    blocks = []
    if not formations or any(one.motion is not None for one in formations):
        blocks.append(
            Paragraph(
                f"The satellites move as the Clohessy-Wiltshire equations say {cite(_CLOHESSY)}: "
                "linear motion about a circular reference orbit, without perturbations."
            )
        )
    if any(one.motion is None for one in formations):
        blocks.append(
            Paragraph(
                "Satellites of a table are where the study places them. A baseline is laid in the "
                "direction in which a rising target moves at constant range and Doppler; its part "
                "along the line of sight changes no sensitivity."
            )
        )
    if any(one.acquisitions for one in formations):
        blocks.append(
            Paragraph(
                "Acquisitions are combined by their images: each measures phases against a "
                "reference of its own, with noise and errors of its own, and the height is common. "
                "The unwrapping ladder may join interferograms of two acquisitions, whose "
                "difference has a longer height of ambiguity than either."
            )
        )
    return tuple(blocks)


def _geometry(observation: Observation | StaringScene | None) -> tuple[Block, ...]:
    """How the scene follows from an orbit."""
    if observation is None:
        return ()
    seen = (
        "A segment is seen when the line of sight to it is at right angles to the antenna's "
        "azimuth axis"
        if isinstance(observation, Observation)
        else "A segment is the place itself, at a moment of the time in which the beam stays on it"
    )
    return (
        Paragraph(
            f"The scene follows from the orbit's Earth-fixed states. {seen}; slant range, "
            "look angle from the geocentric nadir and azimuth are those of that moment in the "
            "radial, along-track and normal axes of the orbit, the incidence is the angle to the "
            "normal of the WGS84 ellipsoid, and the Doppler at which the height sensitivity is "
            "taken is that of the Earth-fixed velocity."
        ),
    )


def _sensitivity(problem: Problem) -> tuple[Block, ...]:
    held = {
        HeldConstant.DOPPLER: "at constant range and Doppler, as in a SAR image",
        HeldConstant.AZIMUTH: "at constant range and azimuth angle, the form of Li 2009",
    }[problem.errors.held_constant]
    return (
        Paragraph(
            (
                "An image has the phase center ",
                Strong("q"),
                " of its transmitter and receiver. The height sensitivity of the phase between "
                "two images is",
            )
        ),
        _SENSITIVITY,
        Paragraph(
            (
                "with the wavelength λ, the slant range ",
                Symbol("r"),
                ", the vertical ",
                Strong("u"),
                " at the target and ",
                Strong("e"),
                Symbol("_h"),
                f" the direction in which the line of sight turns when the target rises {held}.",
            )
        ),
    )


_DECORRELATION: dict[BaselineDecorrelation, tuple[str, tuple[Reference, ...]]] = {
    BaselineDecorrelation.FILTERED: (
        "Images are filtered to the range band that they have in common: a baseline costs looks, "
        "not coherence",
        (_GATELLI,),
    ),
    BaselineDecorrelation.UNFILTERED: (
        "Images are not filtered to their common range band: a baseline costs coherence",
        (_GATELLI,),
    ),
    BaselineDecorrelation.NONE: ("The loss of coherence with the baseline is neglected", ()),
}


def _height(problem: Problem, cite: Citations) -> tuple[Block, ...]:
    errors = problem.errors
    if errors.weighting is Weighting.JOINT:
        weighting = "is the joint Fisher information of the image phases"
    else:
        weighting = (
            f"takes the pairs of images as if each were measured independently {cite(_LI)}, which "
            "for more than two images is more than can be known"
        )
    if errors.phase_std is None:
        noise = f"by the Cramér-Rao bound of their coherence and looks {cite(_RODRIGUEZ)}"
        if errors.phase_statistics is PhaseStatistics.EXACT:
            noise += (
                ", each pair's part lessened to what the exact multilook phase distribution "
                f"{cite(_LEE)} has"
            )
    else:
        noise = "with the phase noise that the study states"
    decorrelation, works = _DECORRELATION[errors.baseline_decorrelation]
    source = f" {cite(*works)}" if works else ""
    return (
        Paragraph(
            (
                "The error ",
                Symbol("e"),
                " of the least-squares height in one segment follows from",
            )
        ),
        _INFORMATION,
        Paragraph(
            (
                "where ",
                Symbol("X"),
                f" {weighting}, {noise}; ",
                Symbol("F"),
                " holds the errors that images share (position, azimuth, synchronization), and ",
                Symbol("σ_r"),
                f" is the error of the slant range. {decorrelation}{source}. The relative error "
                "counts only what varies from pixel to pixel. All of it holds while phase noise "
                "is small and the phase is unwrapped rightly.",
            )
        ),
    )
