#!/usr/bin/python3
"""Estimate ball count and ball diameter of a ball bearing from its catalogue load ratings.

Catalogues print C and C0 but seldom the balls. Both ratings follow from the balls by standard formulas,
so we search the integer ball count Z and the standard ball diameter D that give both back:

  ISO 76   C0 = f0 i Z D^2 cos(alpha)                       [N], D in mm
  ISO 281  C  = b_m f_c (i cos(alpha))^0.7 Z^(2/3) D^1.8    [N], D in mm <= 25.4, b_m = 1.3
           (3.647 D^1.4 instead of D^1.8 above 25.4 mm)

f0 is not read from a table: it is the Hertz pressure of 4200 MPa at the most loaded ball, whose load is
Q_max = 5 C0 / (i Z cos alpha) (Stribeck), at the worse of the two races (exact elliptic integrals).
f_c is the formula behind the table of ISO 281 (ISO/TR 1281-1, once ISO/TR 8646):

  f_c = 0.41 A1 lambda {1 + [1.04 ((1-g)/(1+g))^1.72 (f_i (2 f_e - 1) / (f_e (2 f_i - 1)))^0.41]^(10/3)}^(-3/10)
        g^0.3 (1-g)^1.39 / (1+g)^(1/3) (2 f_i / (2 f_i - 1))^0.41
  with g = D cos(alpha) / d_m, A1 = 98.0665 N/mm^1.8, lambda = 0.95 for one row (radial or angular contact),
  0.90 for a double-row deep-groove bearing.

Conformity: ISO 76 refers to 0.52 inside and 0.53 outside, ISO 281 to 0.52/0.52. These references are the default
whatever the real grooves are (tighter grooves do not raise an ISO rating); --conformity overrides both. The simulator's own
0.52/0.52 leaves f0 as it is above g = 0.095, where the inner race decides, and raises it below (18.9 instead of 14.7 at g = 0).

Makers may rate above ISO: --c-factor and --c0-factor divide the catalogue's values first. NSK rates by ISO within rounding,
FAG's 71914 too; SKF Explorer bearings (the * in its catalogue) have 1.045 times ISO's C and ISO's C0: the median
SKF/NSK ratio over the sizes 6006, 6008, 6012..6020 with (nearly) equal C0. Without that factor the 6014 comes out as 13 x 12.5.

Validity: an estimate. C and C0 alone fix D^2 Z well (1 %) but Z alone badly (3 % in C is 13 % in Z): look at the runners-up.
A printed f0 (--f0, with its last digit as --f0-step: 0.1 at NSK, 1 at SKF) helps to settle D. A score above 2 says that the
maker does not rate by these formulas. Check on 60 GMN spindle bearings (series 60 and 619, bore 30..100 mm; GMN prints its balls, and
its C and C0 are typically 3 % and 7 % above ISO): with these two factors, taken from the same list, D is right for all, Z for 30, within one
for 58, within two for all; without factors D is right for 44 and Z within two for 51. So know the maker's habit first.

  estimate_balls.py --bore 70 --outside 110 --width 20 --angle 0 --C 39.7 --C0 31.0 --c-factor 1.045
  estimate_balls.py --residuals            formula against catalogue for every file of params/bearings
"""
import argparse
import math
import tomllib
from dataclasses import dataclass
from pathlib import Path

PRESSURE = 4200.0  # [MPa], ISO 76, ball bearings
YOUNG = 2.07e5  # [MPa]: gives the table of ISO 76 to 0.05; 2.06e5 would raise f0 by 1 %
POISSON = 0.3
STRIBECK = 5.0  # Q_max = 5 F / (Z cos alpha)
B_M = 1.3  # ISO 281, radial and angular contact ball bearings of today's steel
ISO76_CONFORMITY = (0.52, 0.53)
ISO281_CONFORMITY = (0.52, 0.52)
STEEL_DENSITY, NITRIDE_DENSITY = 7800.0, 3200.0  # [kg/m^3], params/neisi2019.toml
SKF_EXPLORER = 1.045  # C of SKF Explorer bearings over ISO 281, see above

# What the catalogue files cannot say themselves: the maker's factor on C, and the printed f0 with its last digit.
FIT_HINTS = {name: dict(c_factor=SKF_EXPLORER, printed_f0=f0_printed, f0_step=1.0) for name, f0_printed in
             {"6006": 15, "6008": 15, "6010": 15, "6012": 16, "6014": 16, "6014-C3-hybrid": 16, "6016": 16, "6018": 16, "6020": 16}.items()}
FIT_HINTS["61914"] = dict(printed_f0=16, f0_step=1.0)  # not an Explorer bearing
FIT_HINTS["71914-15"] = dict(printed_f0=16.4, f0_step=0.1)


def elliptic(m):
    """Complete elliptic integrals K(m), E(m) by the arithmetic-geometric mean, parameter m = k^2 in [0, 1)."""
    a, b, c = 1.0, math.sqrt(1.0 - m), math.sqrt(m)
    total, power = 0.5 * c * c, 0.5
    while abs(c) > 1e-15:
        a, b, c = 0.5 * (a + b), math.sqrt(a * b), 0.5 * (a - b)
        power *= 2.0
        total += power * c * c
    K = math.pi / (2.0 * a)
    return K, K * (1.0 - total)


def curvature_ratio(kappa):
    """F(rho) of a contact ellipse with axes ratio kappa = a/b > 1 (Harris): ((k^2+1)E - 2K) / ((k^2-1)E)."""
    K, E = elliptic(1.0 - 1.0 / kappa**2)
    return ((kappa**2 + 1.0) * E - 2.0 * K) / ((kappa**2 - 1.0) * E)


def load_at_pressure(pressure, diameter, curvature_along, curvature_across):
    """Load [N] at which a steel ball on a steel race reaches the Hertz pressure [MPa].

    The two curvatures [1/mm] are those of ball plus race: `along` the rolling direction (large) and `across` it (small).
    diameter [mm] only guards the arguments. Hertz: a^3 = 6 kappa^2 E(m) Q / (pi E' sum), E' = E / (1 - nu^2), p = 3 Q / (2 pi a b).
    """
    assert diameter > 0 and curvature_along >= curvature_across > 0
    total = curvature_along + curvature_across
    F = (curvature_along - curvature_across) / total
    low, high = 1.0 + 1e-9, 1e4
    for _ in range(200):  # F grows with kappa
        middle = math.sqrt(low * high)
        low, high = (middle, high) if curvature_ratio(middle) < F else (low, middle)
    kappa = math.sqrt(low * high)
    E = elliptic(1.0 - 1.0 / kappa**2)[1]
    a_unit = (6.0 * kappa**2 * E / (math.pi * YOUNG / (1.0 - POISSON**2) * total)) ** (1.0 / 3.0)  # at Q = 1 N
    pressure_unit = 1.5 * kappa / (math.pi * a_unit**2)
    return (pressure / pressure_unit) ** 3


def f0(gamma, conformity=ISO76_CONFORMITY):
    """Factor f0 of ISO 76 [N/mm^2] at gamma = D cos(alpha) / d_m: the weaker race decides."""
    f_i, f_e = conformity
    inner = load_at_pressure(PRESSURE, 1.0, 2.0 + 2.0 * gamma / (1.0 - gamma), 2.0 - 1.0 / f_i)
    outer = load_at_pressure(PRESSURE, 1.0, 2.0 - 2.0 * gamma / (1.0 + gamma), 2.0 - 1.0 / f_e)
    return min(inner, outer) / STRIBECK


def f_c(gamma, conformity=ISO281_CONFORMITY, reduction=0.95):
    """Factor f_c of ISO 281 [N/mm^1.8] at gamma = D cos(alpha) / d_m > 0, without b_m."""
    f_i, f_e = conformity
    races = 1.04 * ((1 - gamma) / (1 + gamma)) ** 1.72 * (f_i * (2 * f_e - 1) / (f_e * (2 * f_i - 1))) ** 0.41
    return (0.41 * 98.0665 * reduction * (1 + races ** (10 / 3)) ** -0.3
            * gamma**0.3 * (1 - gamma) ** 1.39 / (1 + gamma) ** (1 / 3) * (2 * f_i / (2 * f_i - 1)) ** 0.41)


def ratings(n_balls, diameter, pitch_diameter, angle, rows=1, conformity=None):
    """(C, C0, f0) [N, N, -] by ISO 281 and ISO 76; diameters [mm], angle [deg]."""
    cosine = math.cos(math.radians(angle))
    gamma = diameter * cosine / pitch_diameter
    factor = f0(gamma, conformity or ISO76_CONFORMITY)
    static = factor * rows * n_balls * diameter**2 * cosine
    size = diameter**1.8 if diameter <= 25.4 else 3.647 * diameter**1.4
    reduction = 0.90 if rows > 1 and angle == 0 else 0.95
    dynamic = B_M * f_c(gamma, conformity or ISO281_CONFORMITY, reduction) * (rows * cosine) ** 0.7 * n_balls ** (2 / 3) * size
    return dynamic, static, factor


@dataclass
class Fit:
    """One candidate; residuals are (formula / catalogue - 1) after the maker's factors."""

    n_balls: int
    ball_diameter: float  # [mm]
    pitch_diameter: float  # [mm]
    residual_C: float
    residual_C0: float
    f0: float
    score: float  # sum of squared, weighted residuals; below 2 is as good as rounding allows

    def __str__(self):
        return (f"Z {self.n_balls:2d}  D {self.ball_diameter:6.3f} mm  d_m {self.pitch_diameter:g} mm  C {100 * self.residual_C:+5.1f} %  "
                f"C0 {100 * self.residual_C0:+5.1f} %  f0 {self.f0:4.1f}  score {self.score:5.2f}")


def standard_ball_diameters(largest):
    """Standard ball diameters [mm] as {diameter: penalty}: steps of 1/32 in, and of 0.5 mm (rarer: penalty 1)."""
    sizes = {k / 2.0: 1.0 for k in range(6, int(2 * largest) + 1)}
    sizes.update({round(k * 25.4 / 32.0, 3): 0.0 for k in range(4, int(largest * 32.0 / 25.4) + 1)})
    return sizes


def balls_fit(n_balls, diameter, pitch_diameter, bore, outside, width, angle):
    """Geometry bounds: cage gap of 0.1 D between neighbours, ring walls of 12 % of the section under the balls, balls
    narrower than 0.75 of the width, and for a deep-groove bearing a filling angle up to 205 deg (Conrad assembly)."""
    section = 0.5 * (outside - bore)
    if pitch_diameter * math.sin(math.pi / n_balls) < 1.1 * diameter:
        return False
    if 0.5 * (section - diameter) < 0.12 * section or diameter > 0.75 * width:
        return False
    filling = (n_balls - 1) * 2.0 * math.degrees(math.asin(diameter / pitch_diameter))
    return angle > 0 or filling <= 205.0


def estimate(bore, outside, width, angle, C, C0, rows=1, c_factor=1.0, c0_factor=1.0, printed_f0=None, f0_step=0.1, pitch_diameter=None,
             conformity=None):
    """Candidates (best first) for a bearing: lengths [mm], angle [deg], C and C0 [kN] of the whole bearing.

    Weights: C0 1.5 % and C 2.5 % (makers round both, and C is rated by habit as much as by formula); f0 0.05 beyond what its rounding
    (half of f0_step) explains.
    The pitch diameter is the mean of bore and outside diameter unless given.
    """
    d_m = pitch_diameter or 0.5 * (bore + outside)
    fits = []
    for D, penalty in standard_ball_diameters(0.5 * (outside - bore)).items():
        if not balls_fit(3, D, d_m, bore, outside, width, 1.0):  # no count can make this size fit
            continue
        C_one, C0_one, factor = ratings(1, D, d_m, angle, rows, conformity)
        for Z in range(5, 60):
            if not balls_fit(Z, D, d_m, bore, outside, width, angle):
                continue
            r_C = C_one * Z ** (2 / 3) * c_factor / (1e3 * C) - 1.0
            r_C0 = C0_one * Z * c0_factor / (1e3 * C0) - 1.0
            score = (r_C / 0.025) ** 2 + (r_C0 / 0.015) ** 2 + penalty
            if printed_f0 is not None:
                score += (max(0.0, abs(factor - printed_f0) - 0.5 * f0_step) / 0.05) ** 2
            fits.append(Fit(Z, D, d_m, r_C, r_C0, factor, score))
    return sorted(fits, key=lambda fit: fit.score)


def inner_ring(bore, shoulder, width, diameter, pitch_diameter, n_balls, angle, bearing_mass, ball="steel", conformity=0.52):
    """(mass [kg], spin inertia [kg m^2]) of one inner ring, the inertia with the balls and cage it drives; lengths [mm], angle [deg], mass [kg].

    Ring: solid section bore..shoulder over the whole width, less the groove (circular segment of radius conformity * D).
    Inertia as docs/theory/model.md: J_ring + (Z m_b (d_m/2)^2 + J_cage) (w_c/w_i)^2 + Z J_b (w_b/w_i)^2, w_b the absolute ball spin.
    Cage: 6 % of the bearing's mass (pressed steel, angle 0) or 3 % (solid laminate, angular contact), on the pitch circle.
    """
    mm = 1e-3
    r1, r2, R = 0.5 * bore * mm, 0.5 * shoulder * mm, 0.5 * pitch_diameter * mm
    D, W = diameter * mm, width * mm
    groove_radius, bottom = conformity * D, R - 0.5 * D
    depth = r2 - bottom
    half_angle = math.acos(1.0 - depth / groove_radius)
    segment = groove_radius**2 * (half_angle - math.sin(half_angle) * math.cos(half_angle))
    r_groove = bottom + 0.6 * depth  # centroid of a flat segment
    solid = STEEL_DENSITY * math.pi * (r2**2 - r1**2) * W
    groove = STEEL_DENSITY * 2.0 * math.pi * r_groove * segment
    J_ring = 0.5 * solid * (r1**2 + r2**2) - groove * r_groove**2

    density = STEEL_DENSITY if ball == "steel" else NITRIDE_DENSITY
    m_b = density * math.pi / 6.0 * D**3
    cosine = math.cos(math.radians(angle))
    gamma = diameter * cosine / pitch_diameter
    w_c = 0.5 * (1.0 - gamma)
    w_s = 0.5 * pitch_diameter / diameter * (1.0 - gamma**2)  # ball spin seen from the cage
    w_b_squared = w_s**2 + w_c**2 - 2.0 * w_s * w_c * cosine
    cage = (0.06 if angle == 0 else 0.03) * bearing_mass
    J = J_ring + (n_balls * m_b + cage) * R**2 * w_c**2 + n_balls * m_b * D**2 / 10.0 * w_b_squared
    return solid - groove, J


def number(quantity):
    """Number of a catalogue quantity such as "9.525 mm" or "31.0 kN", in the unit it is written in."""
    return float(quantity.split()[0]) if isinstance(quantity, str) else float(quantity)


def read_bearing(path):
    """A file of params/bearings as the arguments of estimate(), per row, with the balls it states."""
    data = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    rows = data["rows"]
    given = dict(bore=number(data["bore_diameter"]), outside=number(data["outside_diameter"]), width=number(data["width"]) / rows,
                 angle=number(data["contact_angle"]), C=number(data["C"]) / rows**0.7, C0=number(data["C0"]) / rows,
                 pitch_diameter=number(data["pitch_diameter"]))
    return given, data["balls_per_row"], number(data["ball_diameter"])


def residuals(folder=Path(__file__).resolve().parent.parent / "params" / "bearings"):
    """Lines: formula against catalogue for the balls in each file, then the best other fit if it is nearly as good."""
    lines = ["file              Z      D  d_m     f0    C(cat)  C(ISO)   dC %   C0(cat) C0(ISO)  dC0 %   best fit of C, C0 and any printed f0 (score)"]
    for path in sorted(Path(folder).glob("*.toml")):
        given, Z, D = read_bearing(path)
        hints = FIT_HINTS.get(path.stem, {})
        C, C0, factor = ratings(Z, D, given["pitch_diameter"], given["angle"])
        C *= hints.get("c_factor", 1.0)
        best = estimate(**given, **hints)[0]
        same = best.n_balls == Z and abs(best.ball_diameter - D) < 0.01
        bearing = f"{path.stem:16s} {Z:2d} {D:6.3f} {given['pitch_diameter']:5.1f} {factor:5.1f}"
        dynamic = f"{given['C']:6.1f}  {C / 1e3:6.1f}  {100 * (C / 1e3 / given['C'] - 1):+5.1f}"
        static = f"{given['C0']:6.1f}  {C0 / 1e3:6.1f}  {100 * (C0 / 1e3 / given['C0'] - 1):+5.1f}"
        found = "the same" if same else f"{best.n_balls} x {best.ball_diameter}"
        lines.append(f"{bearing}   {dynamic}    {static}   {found} ({best.score:.1f})")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, text in (("bore", "bore diameter [mm]"), ("outside", "outside diameter [mm]"), ("width", "width of one row [mm]"),
                       ("C", "dynamic rating of the whole bearing [kN]"), ("C0", "static rating of the whole bearing [kN]")):
        parser.add_argument(f"--{name}", type=float, help=text)
    parser.add_argument("--angle", type=float, default=0.0, help="contact angle [deg], 0 for deep groove")
    parser.add_argument("--rows", type=int, default=1)
    parser.add_argument("--c-factor", type=float, default=1.0, help="maker's C over ISO 281")
    parser.add_argument("--c0-factor", type=float, default=1.0, help="maker's C0 over ISO 76")
    parser.add_argument("--f0", type=float, help="printed f0, if the catalogue has one")
    parser.add_argument("--f0-step", type=float, default=0.1, help="last digit of the printed f0")
    parser.add_argument("--pitch", type=float, help="pitch diameter [mm], default: mean of bore and outside diameter")
    parser.add_argument("--conformity", type=float, nargs=2, help="inner and outer, default: the references of the two standards")
    parser.add_argument("--candidates", type=int, default=5)
    parser.add_argument("--residuals", action="store_true", help="check the files of params/bearings")
    given = parser.parse_args()
    if given.residuals:
        print("\n".join(residuals()))
        return
    missing = [name for name in ("bore", "outside", "width", "C", "C0") if getattr(given, name) is None]
    if missing:
        parser.error("missing: " + ", ".join("--" + name for name in missing) + " (or --residuals)")
    fits = estimate(given.bore, given.outside, given.width, given.angle, given.C, given.C0, given.rows, given.c_factor, given.c0_factor, given.f0,
                    given.f0_step, given.pitch, given.conformity)
    if not fits:
        parser.error("no standard ball fits between bore and outside diameter; check which drawing the numbers come from")
    print("\n".join(str(fit) for fit in fits[: given.candidates]))


if __name__ == "__main__":
    main()
