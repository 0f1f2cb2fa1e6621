"""How a film was computed: conventions, equations, and where they come from."""

from __future__ import annotations

from insar.observe.agile.video_results import VideoResult

from ..document import Block, Equation, Paragraph, Reference, References, Section, Symbol
from .citations import Citations
from .spotlight_methods import conventions, misfit_paragraph

LIANG = Reference(
    "J. Liang et al., “Attitude maneuver strategy of video mode based on agile SAR satellite,” J. "
    "Univ. of Chinese Academy of Sciences, 2018.",
    "",
)

_LENGTH = Equation(
    latex=r"L_i = \frac{V_g}{V_r}\,\frac{\lambda\,(R_c^2 + V_r^2 t_i^2)^{3/2}}{2\rho R_c^2},"
    r"\qquad \alpha_i = \frac{(L_i + L_{i-1})/2 - T_f V_r}{L_i}",
    typst="L_i = V_g / V_r (lambda (R_c^2 + V_r^2 t_i^2)^(3\\/2)) / (2 rho R_c^2), quad "
    "alpha_i = ((L_i + L_(i-1)) \\/ 2 - T_f V_r) / L_i",
)
_EXACT = Equation(
    latex=r"f\!\left(t_i - \tfrac{1}{2}D_i\right) - f\!\left(t_i + \tfrac{1}{2}D_i\right) = "
    r"\frac{V_g}{\rho}",
    typst="f(t_i - 1/2 D_i) - f(t_i + 1/2 D_i) = V_g / rho",
)
_TRACE = Equation(
    latex=r"\mathbf{g}(\mathbf{e}) = r\left[\mathbf{e} - "
    r"\mathbf{u}\,\frac{\mathbf{e}\cdot\mathbf{n}}{\mathbf{u}\cdot\mathbf{n}}\right]",
    typst="bold(g)(bold(e)) = r [bold(e) - bold(u) (bold(e) dot bold(n)) / (bold(u) dot bold(n))]",
)


def video_methods(result: VideoResult) -> Section:
    """Methods and references.

    Parameters
    ----------
    result : whose orbit was made smooth.
    """
    cite = Citations()
    blocks: list[Block] = [
        Paragraph(
            (
                f"The source {cite(LIANG)} takes the slant range for a hyperbola with the closest "
                "range ",
                Symbol("R_c"),
                " and the effective speed ",
                Symbol("V_r"),
                ". A frame of resolution ρ at the time ",
                Symbol("t_i"),
                " then has the length ",
                Symbol("L_i"),
                ", and has the share ",
                Symbol("α_i"),
                " of its data in common with the one before, an interval ",
                Symbol("T_f"),
                " earlier:",
            )
        ),
        _LENGTH,
        Paragraph(
            (
                "A share below 0 is none. The printed length has no factor ",
                Symbol("V_g"),
                "/",
                Symbol("V_r"),
                ": in the time that a Doppler bandwidth resolves, the inverse of it, the line of "
                "zero Doppler moves over the ground at ",
                Symbol("V_g"),
                ", not at ",
                Symbol("V_r"),
                ". The exact duration ",
                Symbol("D_i"),
                " is that in which the Doppler ",
                Symbol("f"),
                " of the aim point on the real orbit runs through the bandwidth:",
            )
        ),
        _EXACT,
        Paragraph(
            "Roll and pitch lay the body's Z along the line of sight u. A small angle off the "
            "beam towards a body axis e moves a point over the ground, with the vertical n, by"
        ),
        _TRACE,
        Paragraph(
            "which for X is the azimuth trace, for Y the range trace. The yaw laws hold one of "
            "them, or the major axis of the footprint's ellipse; the printed yaw of the source "
            "lacks the rotation by roll and pitch. Rotations are to first order of the "
            "beamwidths, outlines are not: they are rays to the ellipsoid."
        ),
        *conventions("1-2-3 (roll, pitch, yaw)"),
        misfit_paragraph(result.orbit_misfit),
    ]
    return Section("methods", "How it was computed", (*blocks, References(tuple(cite.works))))
