"""The bearing's formulas a second time, as small functions of numbers, for effects that the program offers no parameter for. SI.

Independent of the program on purpose (docs/theory/model.md has the equations). Values come from the run's parameters.toml."""

import math
import tomllib

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "kg": 1.0, "g": 1e-3, "N": 1.0, "kN": 1e3, "s": 1.0, "ms": 1e-3, "us": 1e-6, "deg": math.pi / 180, "rad": 1.0, "rpm": math.pi / 30}


def number(value):
    """A bare number, or one with a unit of length, mass, force, time or angle; other units must be SI already."""
    if not isinstance(value, str):
        return float(value)
    digits, _, unit = value.partition(" ")
    return float(digits) * UNITS.get(unit, 1.0)


class Bearing:
    """Geometry and materials of a bearing, from parameters.toml."""

    def __init__(self, parameters, name):
        table = parameters["bearings"][name]
        self.materials = parameters["materials"]
        self.Z, self.rows = int(table["balls_per_row"]), int(table.get("rows", 1))
        self.d, self.d_m = number(table["ball_diameter"]), number(table["pitch_diameter"])
        self.f_in, self.f_out = map(float, table["conformity"])
        self.phi = number(table.get("contact_angle", 0))
        self.A = (self.f_in + self.f_out - 1) * self.d
        self.preload = number(table.get("preload", 0))
        self.ball, self.ring = self.materials[table["ball"]], self.materials[table.get("ring", "steel")]
        self.ring_mass = number(table["ring_mass"])
        self.inertia = number(table["ring_spin_inertia"])
        self.inner = [number(v) for v in table["inner_ring_diameters"]]
        self.outer = [number(v) for v in table["outer_ring_diameters"]]
        self.housing = [number(v) for v in table["housing_diameters"]]
        self.contact_stiffness = float(table["contact_stiffness"])
        self.beta = number(table.get("ball_damping_beta", parameters["bearings"].get("ball_damping_beta", 2.5e-5)))
        self.K_b = self.stiffness()

    def stiffness(self):
        """K_b [N/m^1.5] of both contacts in series, Brewe & Hamrock's fits."""
        def number_of(material, name):
            return number(material[name])

        compliance = 0.0
        E = 2 / sum((1 - number_of(m, "nu") ** 2) / number_of(m, "E") for m in (self.ball, self.ring))
        for sign, f in ((-1, self.f_in), (1, self.f_out)):
            race = self.d_m / 2 + sign * (self.d / 2) * math.cos(self.phi)
            rolling = 1 / (2 / self.d - sign / race)
            across = 1 / (2 / self.d - 1 / (f * self.d))
            R = 1 / (1 / rolling + 1 / across)
            q = across / rolling
            k, Ell, F = 1.0339 * q**0.636, 1.0003 + 0.5968 / q, 1.5277 + 0.6023 * math.log(q)
            K = math.pi * k * E * math.sqrt(2 * Ell * R / (9 * F**3))
            compliance += K ** (-2 / 3)
        return compliance**-1.5

    @property
    def ball_mass(self):
        return number(self.ball["rho"]) * math.pi * self.d**3 / 6

    def axial_load(self, offset, radial=0.0):
        """Axial force of one row [N] for an axial approach of the races and a radial growth of the gap between race centres."""
        r, x = self.A * math.cos(self.phi) + radial, self.A * math.sin(self.phi) + offset
        length = math.hypot(r, x)
        delta = length - self.A
        return self.Z * self.K_b * max(delta, 0.0) ** 1.5 * x / length

    def offset_of(self, preload):
        low, high = 0.0, 1e-4
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.axial_load(middle) < preload else (low, middle)
        return low

    def preload_with(self, growth, ball=0.0):
        """Preload of an X pair [N] when the inner race has grown by `growth` more than the outer, and the balls' radius by `ball`; nothing else changes, rings rigid and not tilted."""
        offset = self.offset_of(self.preload)
        r, x = self.A * math.cos(self.phi) + growth, self.A * math.sin(self.phi) + offset
        length = math.hypot(r, x)
        return self.Z * self.K_b * max(length - self.A + 2 * ball, 0.0) ** 1.5 * x / length


def parameters_of(run):
    return tomllib.loads((run / "parameters.toml").read_text())


def impact(K, damping, mass, speed, clip=True, step=2e-7):
    """A body of `mass` hits a spring-damper: largest force, lowest force, speed after over speed before. `damping`(delta, rate) [N]."""
    delta, rate, highest, lowest = 0.0, speed, 0.0, 0.0
    n = 10 / 9

    def force(delta, rate):
        if delta <= 0:
            return 0.0
        total = K * delta**n + damping(delta, rate)
        return max(total, 0.0) if clip else total

    steps = 0
    while delta >= 0 and steps < 100_000:
        F = force(max(delta, 1e-15), rate)
        # Half a step of velocity, a step of place, half a step of velocity: 200 ns for contacts of milliseconds.
        rate_half = rate - 0.5 * step * F / mass
        delta += step * rate_half
        F_new = force(delta, rate_half)
        rate = rate_half - 0.5 * step * F_new / mass
        highest, lowest = max(highest, F, F_new), min(lowest, F, F_new)
        steps += 1
    return highest, lowest, -rate / speed


def annulus_growth(alpha, a, b, T_a, T_b, r):
    """Growth of a free ring of radii a, b with a linear rise of temperature at radius r (eqs. 26 and 27 as they should be)."""
    return alpha * r / (3 * (a + b)) * (T_a * (2 * a + b) + T_b * (2 * b + a))


def kinematics(bearing, phi_i, phi_o, omega_i):
    """Cage-fixed speeds of a ball under outer-race control: omega_ci, omega_co (race over cage), pitch angle theta, omega_b, by eqs. 13 to 15 corrected."""
    g = bearing.d / bearing.d_m
    theta = math.atan2(math.sin(phi_o), math.cos(phi_o) + g)
    # Rolling at both contacts: omega_b d/2 cos(phi - theta) = omega_c (d_m -+ d cos phi)/2.
    inner = (1 - g * math.cos(phi_i)) / (g * math.cos(phi_i - theta))
    outer = (1 + g * math.cos(phi_o)) / (g * math.cos(phi_o - theta))
    # omega_ci + omega_co = omega_i (outer ring at rest), inner omega_ci = outer omega_co = omega_b.
    omega_ci = omega_i * outer / (inner + outer)
    omega_co = omega_i - omega_ci
    return {"theta": theta, "omega_ci": omega_ci, "omega_co": omega_co, "omega_b": inner * omega_ci}
