"""How steering was computed: conventions, equations, and where they come from."""

from __future__ import annotations

from insar.observe import Law, SteeringResult

from ..document import Block, Equation, Paragraph, Reference, References, Section, Strong, Symbol
from ..reading_steering import laws_of
from .citations import Citations

_RANEY = Reference(
    "R. K. Raney, “Doppler properties of radars in circular orbits,” Int. J. Remote Sensing 7(9), "
    "1153–1162, 1986.",
    "10.1080/01431168608948916",
)
_FIEDLER = Reference(
    "H. Fiedler, E. Boerner, J. Mittermayer and G. Krieger, “Total zero Doppler steering: a new "
    "method for minimizing the Doppler centroid,” IEEE Geosci. Remote Sens. Lett. 2(2), 141–145, "
    "2005.",
    "10.1109/LGRS.2005.844591",
)
_YU = Reference(
    "Z. Yu et al., “A new satellite attitude steering approach for zero Doppler centroid,” IET "
    "Int. Radar Conf., Guilin, 2009.",
    "10.1049/cp.2009.0410",
)
_ZHAO = Reference(
    "B. Zhao et al., “A new prompt 2-D attitude steering approach for zero Doppler centroid of "
    "geosynchronous SAR,” J. Electronics & Information Technology 41(4), 763–769, 2019.",
    "10.11999/JEIT180643",
)
_MENG = Reference(
    "Y. Meng, Q. Yin and J. Dai, “The analysis of the compensation effect of yaw steering for "
    "SAR,” J. National Univ. of Defense Technology 25(5), 18–21, 2003.",
    "",
)

_CENTROID = Equation(
    latex=r"f = -\frac{2}{\lambda}\,\frac{(\mathbf{R}_s - \mathbf{R}_t)\cdot"
    r"(\mathbf{V}_s - \boldsymbol{\omega}\times\mathbf{R}_t)}{r}"
    r" = \frac{2}{\lambda}\,\mathbf{u}\cdot(\mathbf{V}_s - \boldsymbol{\omega}\times\mathbf{R}_s)",
    typst="f = -2 / lambda ((bold(R)_s - bold(R)_t) dot (bold(V)_s - bold(omega) times bold(R)_t))"
    " / r = 2 / lambda bold(u) dot (bold(V)_s - bold(omega) times bold(R)_s)",
)
_YAW_PITCH = Equation(
    latex=r"\tan\psi = \frac{-\sin i\,\cos u}{N - \cos i},\qquad"
    r"\tan\theta_p = \frac{V_r}{\omega_e r \sqrt{(N - \cos i)^2 + \sin^2 i\,\cos^2 u}}",
    typst="tan psi = (-sin i cos u) / (N - cos i), quad tan theta_p = V_r / (omega_e r "
    "sqrt((N - cos i)^2 + sin^2 i cos^2 u))",
)
_APPROXIMATE = Equation(
    latex=r"\tan\theta_p \approx \frac{e\sin f}{1 + e\cos f}",
    typst="tan theta_p approx (e sin f) / (1 + e cos f)",
)
_PITCH_ROLL = Equation(
    latex=r"\theta_d = -k\psi + \arcsin\frac{\tan\theta_p}{\tan\gamma},\qquad"
    r"\tan\theta = \tan\gamma\,\sin\theta_d,\qquad"
    r"\tan\varphi = \frac{-k\tan\gamma\,\cos\theta_d}{\sqrt{1 + \tan^2\gamma\,\sin^2\theta_d}}",
    typst="theta_d = -k psi + arcsin (tan theta_p) / (tan gamma), quad tan theta = tan gamma "
    "sin theta_d, quad tan phi = (-k tan gamma cos theta_d) / "
    "sqrt(1 + tan^2 gamma sin^2 theta_d)",
)
_SIMPLIFIED = Equation(
    latex=r"f = -\frac{2k}{\lambda}\,R_s\,\omega_e \sin\gamma\,\sin i\,\cos u",
    typst="f = -(2 k) / lambda R_s omega_e sin gamma sin i cos u",
)


def steering_methods(result: SteeringResult) -> Section:
    """Methods and references.

    Parameters
    ----------
    result : whose laws decide what was used.
    """
    cite = Citations()
    laws = set(laws_of(result.cases)).union(*(one.laws for one in result.selections))
    blocks: list[Block] = [*_doppler(cite), *_conventions()]
    if laws - {Law.NONE, Law.PITCH_ROLL}:
        blocks += _yaw_pitch(laws, cite)
    if Law.PITCH_ROLL in laws:
        blocks += _pitch_roll(cite)
    if result.compensation is not None:
        blocks += _simplified(cite)
    return Section("methods", "How it was computed", (*blocks, References(tuple(cite.works))))


def _doppler(cite: Citations) -> tuple[Block, ...]:
    return (
        Paragraph(
            (
                "The Doppler centroid of a target at rest on the rotating Earth is exact "
                f"{cite(_MENG)}, positive where satellite and target approach:",
            )
        ),
        _CENTROID,
        Paragraph(
            (
                "with the positions ",
                Strong("R"),
                " and velocities ",
                Strong("V"),
                " of satellite and target, the distance ",
                Symbol("r"),
                ", the line of sight ",
                Strong("u"),
                " and the Earth's sidereal rotation ω. It is zero just when the line of sight is "
                "at right angles to the Earth-fixed velocity of the satellite, for every target "
                "in that plane.",
            )
        ),
    )


def _conventions() -> tuple[Block, ...]:
    return (
        Paragraph(
            "Attitude is that of the body against the orbit frame: X forward and horizontal (not "
            "along the velocity of an eccentric orbit), Y against the orbit normal, Z to the "
            "geocentric nadir. A positive yaw turns the nose to the right, a positive pitch lifts "
            "it. The antenna of a law that yaws is mounted aside from nadir by the angle that "
            "gives the boresight its look angle or incidence; this angle is no part of the roll. "
            "Rates are the angular velocity of the body, in any direction."
        ),
    )


def _yaw_pitch(laws: set[Law], cite: Citations) -> tuple[Block, ...]:
    blocks: list[Block] = [
        Paragraph(
            (
                "Yaw and pitch that lay the body's X axis along the Earth-fixed velocity follow "
                f"from the state of the instant {cite(_FIEDLER, _YU)}:",
            )
        ),
        _YAW_PITCH,
        Paragraph(
            (
                "with the inclination ",
                Symbol("i"),
                ", the argument of latitude ",
                Symbol("u"),
                ", the radial velocity ",
                Symbol("V_r"),
                " and ",
                Symbol("N"),
                " the satellite's angular rate over the Earth's. Yaw steering alone takes the "
                f"mean motion for the rate and no pitch {cite(_RANEY)}.",
            )
        ),
    ]
    if Law.YAW_PITCH_APPROXIMATE in laws:
        blocks += [
            Paragraph(
                (
                    "The approximate law has the yaw of the mean motion, and for the pitch the "
                    "flight-path angle of the eccentricity ",
                    Symbol("e"),
                    " and true anomaly ",
                    Symbol("f"),
                    f" {cite(_FIEDLER)}:",
                )
            ),
            _APPROXIMATE,
        ]
    return tuple(blocks)


def _pitch_roll(cite: Citations) -> tuple[Block, ...]:
    return (
        Paragraph(
            (
                "Pitch-roll steering leaves the yaw at zero and points only the boresight into "
                "the plane of zero Doppler, at an angle γ from nadir "
                f"{cite(_ZHAO)}; ",
                Symbol("k"),
                " is 1 for a radar that looks right and −1 for one that looks left:",
            )
        ),
        _PITCH_ROLL,
        Paragraph(
            "The printed sign holds for a radar that looks right only; the equation above holds "
            "for both sides. The roll is about the pitched axis. There is no solution where the "
            "pitch of the yaw-pitch law exceeds γ. At a fixed incidence the boresight is found on "
            "the ellipsoid instead, in the same plane."
        ),
    )


def _simplified(cite: Citations) -> tuple[Block, ...]:
    return (
        Paragraph(
            "The simplified model of the radar that is not steered, over a sphere and on a circle "
            f"{cite(_MENG)}, with the radius of the orbit, is"
        ),
        _SIMPLIFIED,
        Paragraph(
            "Compensation is one minus the norm of the difference between exact and simplified "
            "Doppler over that of the exact one. The norm matters: the largest value over the "
            "revolution judges a law by its worst moment, the root mean square does not."
        ),
    )
