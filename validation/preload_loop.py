#!/usr/bin/env python3
"""Thermal preload of the reference case's angular-contact pair (TB2), written again from the equations, for tests to compare with.

    /usr/bin/python3 validation/preload_loop.py            # a minute

Shares no code with the program; of its data it reads the rotor's dimensions. The pair is symmetric and unloaded, so its inner ring stays in the
middle: rows in closed form instead of an equilibrium. Growth moves the two contact points of a ball and the centres of the grooves, as vectors in
the plane of the axis. The circuit keeps its contacts without mass as algebraic unknowns (the program eliminates them). Balls conduct as they roll,
heat spreads from their strips, and the shaft is a fin of two-ports; each of the three may be the published circuit's. Needs numpy and scipy.
"""

import json
import pathlib
from dataclasses import dataclass
from math import cos, cosh, hypot, log, pi, radians, sin, sinh, sqrt, tan

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, fsolve, minimize_scalar
from scipy.special import ellipk, gamma

E, NU, RHO, CONDUCTIVITY, HEAT, ALPHA = 2.0e11, 0.30, 7800.0, 70.0, 510.0, 11.8e-6
Z, D, D_M, PHI, F = 23, 9.525e-3, 85e-3, radians(25), 0.52
WIDTH, BORE, INNER, OUTER, OUTSIDE, HOUSING, LENGTH, RING_MASS, GAP = 32e-3, 70e-3, 78e-3, 92e-3, 100e-3, 120e-3, 50e-3, 0.21, 250e-6
F1_Z, F1_Y, C0, F2, VISCOSITY, H_SHAFT, H_BALL, FIT, HALF_WIDTH, AMBIENT = 0.001, 0.33, 31e3, 0.25, 15.0, 50.0, 50.0, 0.005, 0.4e-3, 293.15
A = (2 * F - 1) * D


def hertz(race_radius, sign):
    """K, semi-major axis over Q^(1/3), ellipticity; Brewe and Hamrock's fits."""
    R_x, R_y = 1 / (2 / D + sign / race_radius), 1 / (2 / D - 1 / (F * D))
    R = 1 / (1 / R_x + 1 / R_y)
    k, second, first = 1.0339 * (R_y / R_x) ** 0.636, 1.0003 + 0.5968 * R_x / R_y, 1.5277 + 0.6023 * log(R_y / R_x)
    modulus = E / (1 - NU**2)
    return pi * k * modulus * (2 * second * R / (9 * first**3)) ** 0.5, (6 * k**2 * second * R / (pi * modulus)) ** (1 / 3), k


INNER_RACE, OUTER_RACE = hertz(D_M / 2 - D / 2 * cos(PHI), 1), hertz(D_M / 2 + D / 2 * cos(PHI), -1)
K = (INNER_RACE[0] ** (-2 / 3) + OUTER_RACE[0] ** (-2 / 3)) ** -1.5


@dataclass
class Growth:
    """Radial growth of the raceways at the contact points, axial strains of the rings, growth of a ball's radius."""

    inner: float = 0.0
    outer: float = 0.0
    inner_strain: float = 0.0
    outer_strain: float = 0.0
    ball: float = 0.0

    def __add__(self, other):
        return Growth(*(getattr(self, name) + getattr(other, name) for name in self.__dataclass_fields__))


def even(inner=0.0, outer=0.0, ball=0.0, ball_alpha=ALPHA):
    """Of parts that are warm throughout, by so many kelvin."""
    return Growth(ALPHA * inner * (D_M / 2 - D / 2 * cos(PHI)), ALPHA * outer * (D_M / 2 + D / 2 * cos(PHI)), ALPHA * inner, ALPHA * outer, ball_alpha * ball * D / 2)


def row(offset, growth=Growth(), lean=1, place=WIDTH / 4):
    """Axial force of a row and load of a ball. The outer contact lies on the side `lean` of the ball: away from the other row (1) or towards it (-1)."""
    n = np.array([lean * sin(PHI), cos(PHI)])
    ball = np.array([place, D_M / 2])
    inner, outer = ball - D / 2 * n, ball + D / 2 * n
    groove_i, groove_o = F * D * (1 + growth.inner_strain), F * D * (1 + growth.outer_strain)
    centre_i = inner + [growth.inner_strain * inner[0], growth.inner] + groove_i * n
    centre_o = outer + [growth.outer_strain * outer[0], growth.outer] - groove_o * n
    B = centre_i - centre_o + [lean * offset, 0]
    distance = np.hypot(*B)
    Q = K * max(distance - (groove_i + groove_o - D - 2 * growth.ball), 0) ** 1.5
    return Z * Q * lean * B[0] / distance, Q


def offset_of(preload):
    return brentq(lambda offset: row(offset)[0] - preload, 0, 1e-4, xtol=1e-18, rtol=1e-14)


def pressure(Q):
    return max(3 * Q / (2 * pi * (axis * Q ** (1 / 3)) ** 2 / k) for _, axis, k in (INNER_RACE, OUTER_RACE))


def speed_growth(omega):
    """Of the inner ring as a thin spinning disc with a hole: radially where the balls touch it, and its width, as Poisson's ratio has it."""
    a, b, r = BORE / 2, INNER / 2, D_M / 2 - D / 2 * cos(PHI)
    radial = lambda x: (3 + NU) / 8 * RHO * omega**2 * (a**2 + b**2 - a**2 * b**2 / x**2 - x**2)
    hoop = lambda x: (3 + NU) / 8 * RHO * omega**2 * (a**2 + b**2 + a**2 * b**2 / x**2 - (1 + 3 * NU) / (3 + NU) * x**2)
    mean = quad(lambda x: (radial(x) + hoop(x)) * x, a, b, epsabs=0, epsrel=1e-12)[0] / quad(lambda x: x, a, b)[0]
    return Growth(inner=r / E * (hoop(r) - NU * radial(r)), inner_strain=-NU / E * mean)


def friction_heat(axial, omega):
    P1, P0 = 0.9 * axial / tan(PHI), 0.38 * axial  # of each row, without radial load; Y0 of ISO 76 at 25 deg
    load = 2 * F1_Z * (P0 / C0) ** F1_Y * P1 * D_M
    nu_n = VISCOSITY * omega * 30 / pi
    drag = F2 * (D_M * 1e3) ** 3 * (1e-7 * nu_n ** (2 / 3) if nu_n > 2000 else 160e-7) * 1e-3
    return (load + drag) * omega


# The circuit: shaft, inner ring, inner contact, ball, outer contact, outer ring, housing; rises over ambient.
D_S = BORE - 2 * GAP
D_MI, D_OM, D_HM = (BORE + INNER) / 2, (OUTER + OUTSIDE) / 2, (OUTSIDE + HOUSING) / 2
R1, R23 = 1 / (H_SHAFT * pi * D_S * WIDTH), 1 / (4 * pi * CONDUCTIVITY * WIDTH) + log(D_MI / D_S) / (2 * pi * CONDUCTIVITY * WIDTH)
R4, R5 = log(INNER / D_MI) / (2 * pi * CONDUCTIVITY * WIDTH), 2 / (pi * CONDUCTIVITY * D * 2 * Z) + 2 / (4 * CONDUCTIVITY * HALF_WIDTH * 2 * Z)
R6, R7 = 1 / (H_BALL * 2 * Z * pi * D**2), log(D_OM / OUTER) / (2 * pi * CONDUCTIVITY * WIDTH)
R8 = log(OUTSIDE / D_OM) / (2 * pi * CONDUCTIVITY * WIDTH) + FIT + log(D_HM / OUTSIDE) / (2 * pi * CONDUCTIVITY * LENGTH)
INNER_SHARE = 0.5 * (D_M - D * cos(PHI)) / D_M


def disc(diameter):
    return pi / 4 * diameter**2


CAPACITY = [RHO * HEAT * disc(D_S) * WIDTH, RING_MASS * HEAT, 2 * Z * pi / 6 * D**3 * RHO * HEAT,
            RHO * HEAT * (disc(OUTSIDE) - disc(OUTER)) * WIDTH, RHO * HEAT * (disc(HOUSING) - disc(OUTSIDE)) * LENGTH]

# Spreading from strips on the raceways.
R_INNER, R_OUTER = D_M / 2 - D / 2 * cos(PHI), D_M / 2 + D / 2 * cos(PHI)
SIDE = D / 2 * sin(PHI)  # rows of an X pair lean outwards: strips of the inner race towards the middle, of the outer one away from it


def spreading(thickness, middles, behind=None):
    """Strip over surface of a slab as wide as the pair, per length and conductivity 1; cosine series. behind: resistance times conductivity, thickness."""
    l = np.arange(1, 40001) * pi / WIDTH
    c = np.mean([np.cos(l * x) for x in middles], axis=0) * np.sin(l * HALF_WIDTH) / (l * HALF_WIDTH)
    far = 1 / (l * behind[0] + 1 / np.tanh(l * behind[1])) if behind else 0.0
    near = np.tanh(l * thickness)
    return float(np.sum(2 / (WIDTH * l) * c**2 * (1 + far * near) / (far + near)))


# Of the wall under the groove instead of the ring's up to its shoulder.
R4_WALL = log(R_INNER / ((R_INNER + BORE / 2) / 2)) / (2 * pi * CONDUCTIVITY * WIDTH)
R7_WALL = log((R_OUTER + OUTSIDE / 2) / 2 / R_OUTER) / (2 * pi * CONDUCTIVITY * WIDTH)
R4_SPREADING = spreading(R_INNER - BORE / 2, [WIDTH / 4 + SIDE, 3 * WIDTH / 4 - SIDE]) / (2 * pi * R_INNER * CONDUCTIVITY)
R7_SPREADING = spreading(OUTSIDE / 2 - R_OUTER, [WIDTH / 4 - SIDE, 3 * WIDTH / 4 + SIDE],
                         (FIT * pi * OUTSIDE * WIDTH * CONDUCTIVITY, (HOUSING - OUTSIDE) / 2)) / (2 * pi * R_OUTER * CONDUCTIVITY)

# The shaft beside its lump.
NODE, OTHER_NODE = 28, 2
ROTOR = json.loads((pathlib.Path(__file__).resolve().parents[1] / "params/neisi2019-rotor.json").read_text())
STATION = {node["id"]: node["x"] for node in ROTOR["nodes"]}


def fin_side(sign):
    """Two-ports [T; flow] -> [T; flow] of the pieces of one side, from the bearing outwards, with their volumes. No heat leaves the far end."""
    face = STATION[NODE] + sign * WIDTH / 2
    end = max(STATION.values()) if sign > 0 else (STATION[NODE] + STATION[OTHER_NODE]) / 2
    left, length, at, pieces = abs(end - face), 0.15 * D_S, face, []
    assert left < 4 / sqrt(4 * H_SHAFT / (CONDUCTIVITY * D_S))  # else it would be cut there
    while left > 1e-9:
        length = left if left < 1.5 * length else length
        low, high = sorted((at, at + sign * length))
        bars = [(min(high, STATION[e["n2"]]) - max(low, STATION[e["n1"]]), e["od"]) for e in ROTOR["elements"][::sign]]
        port, volume = np.eye(2), 0.0
        for part, d in bars:
            if part > 1e-9:
                s, ml = sqrt(H_SHAFT * pi * d * CONDUCTIVITY * disc(d)), part * sqrt(H_SHAFT * pi * d / (CONDUCTIVITY * disc(d)))
                port = port @ np.array([[cosh(ml), sinh(ml) / s], [s * sinh(ml), cosh(ml)]])
                volume += disc(d) * part
        pieces.append((port, volume))
        at, left, length = at + sign * length, left - length, 2.2 * length
    return pieces


# Heat that enters the lump evenly along its length leaves at both faces.
TO_FACE = WIDTH / 2 / (3 * CONDUCTIVITY * disc(D_S))


def fin_chain(sign):
    """Each two-port as a T: arms to its neighbours, a shunt to ambient at the middle, where its capacity is. (capacity, to the node before, to ambient)."""
    nodes, arm = [], TO_FACE
    for port, volume in fin_side(sign):
        nodes.append((RHO * HEAT * volume, arm + (port[0, 0] - 1) / port[1, 0], 1 / port[1, 0]))
        arm = (port[1, 1] - 1) / port[1, 0]
    return nodes


def fin_conductance(sign):
    """From the lump into one side in steady heat, by multiplying two-ports."""
    whole = np.linalg.multi_dot([port for port, _ in fin_side(sign)] + [np.eye(2)])
    return 1 / (TO_FACE + whole[0, 0] / whole[1, 0])


def rolling_contact(axis, k, Q, speed, oil):
    """A ball and a race of one material in series: static and rolling conductance of an ellipse, mixed by squares; a film of oil behind them."""
    a = axis * Q ** (1 / 3)
    at_rest = 2 * pi * CONDUCTIVITY * a / ellipk(1 - 1 / k**2)
    effusivity = (CONDUCTIVITY * RHO * HEAT) ** 0.5
    rolling = 2 * (2 * a / k * speed) ** 0.5 * effusivity * a * gamma(1.25) / gamma(1.75)
    return 1 / (2 / hypot(at_rest, rolling) + oil / (OIL_CONDUCTIVITY * pi * a * a / k))


OIL_CONDUCTIVITY, LIMIT = 0.14, 150 + 273.15 - AMBIENT


@dataclass
class Pair:
    """The pair at a speed [rad/s] and its circuit. Temperatures: shaft, inner ring, balls, outer ring, housing, then the fin from the bearing to the left, to the right."""

    omega: float
    preload: float = 290.0
    cooling: float = 1.0
    rolls: bool = True
    strips: bool = True
    fin: bool = True
    oil: float = 0.0

    def __post_init__(self):
        self.offset = offset_of(self.preload)
        self.speed_growth = speed_growth(self.omega)
        self.R4, self.R7 = (R4_WALL + R4_SPREADING, R7_WALL + R7_SPREADING) if self.strips else (R4, R7)
        self.on_strips = R4_WALL / (R4_WALL + R4_SPREADING) if self.strips else 1.0
        sides = [fin_chain(-1), fin_chain(1)] if self.fin else []
        self.capacity = np.array(CAPACITY + [capacity for side in sides for capacity, _, _ in side])
        self.links, n = [], 5  # (node, node before, resistance, to ambient)
        for side in sides:
            for k, (_, before, shunt) in enumerate(side):
                self.links.append((n, n - 1 if k else 0, before, shunt))
                n += 1

    def growth(self, T):
        s, i, b, o, h = T[:5]
        # A contact counts with what its neighbours give it, without its own heat; contacts that roll do not count.
        strip = i if self.rolls else (i / self.R4 + b / R5) / (1 / self.R4 + 1 / R5)
        raceway = i + self.on_strips * (strip - i)
        mean = lambda r_in, r_out, T_in, T_out: (T_in * (2 * r_in + r_out) + T_out * (2 * r_out + r_in)) / (3 * (r_in + r_out))
        ring, housing = (disc(OUTSIDE) - disc(OUTER)) * WIDTH, (disc(HOUSING) - disc(OUTSIDE)) * LENGTH  # one body: its mean rise
        growth = even(mean(BORE / 2, INNER / 2, i, raceway), (ring * o + housing * h) / (ring + housing), b)
        growth.outer_strain = ALPHA * o  # the housing does not hold the ring along the axis
        return growth + self.speed_growth

    def state(self, T):
        """Preload, load of a ball."""
        return row(self.offset, self.growth(T))

    def made(self, T):
        return friction_heat(self.state(T)[0], self.omega)

    def balls(self, T):
        """Star of both contacts and the way into the ball as a triangle, all balls alike: inner race to ball, outer race to ball, race to race [W/K]."""
        if not self.rolls:
            return 1 / R5, 1 / R5, 0.0
        Q = self.state(T)[1]
        if Q <= 0:
            return 0.0, 0.0, 0.0
        turn = D * cos(PHI) / D_M
        speed = self.omega * D_M / 4 * (1 - turn**2)
        G_i, G_o = (rolling_contact(axis, k, Q, speed, self.oil) for _, axis, k in (INNER_RACE, OUTER_RACE))
        G_b = 2 * pi**2 * CONDUCTIVITY * D / 2 / (log(D / 2 / HALF_WIDTH) + 0.43)
        per = 2 * Z / (G_i + G_o + G_b)
        return per * G_i * G_b, per * G_o * G_b, per * G_i * G_o

    def contacts(self, T, heat, balls=None):
        """Rises of the two contacts, which hold no heat."""
        s, i, b, o, h = T[:5]
        G_ib, G_ob, G_io = balls or self.balls(T)
        return np.linalg.solve([[1 / self.R4 + G_ib + G_io, -G_io], [-G_io, 1 / self.R7 + G_ob + G_io]],
                               [i / self.R4 + G_ib * b + INNER_SHARE * heat, o / self.R7 + G_ob * b + (1 - INNER_SHARE) * heat])

    def flows(self, T, heat):
        """Heat into each node [W]."""
        s, i, b, o, h = T[:5]
        balls = self.balls(T)
        ci, co = self.contacts(T, heat, balls)
        q = np.zeros(len(T))
        q[:5] = [(i - s) / R23 - self.cooling * s / R1, (s - i) / R23 + (ci - i) / self.R4, balls[0] * (ci - b) + balls[1] * (co - b) - self.cooling * b / R6,
                 (co - o) / self.R7 + (h - o) / R8, (o - h) / R8 - self.cooling * 23 * max(h, 0) ** 0.25 * pi * HOUSING * LENGTH * h]
        for node, before, resistance, to_ambient in self.links:
            flow = (T[before] - T[node]) / resistance
            q[before] -= flow
            q[node] += flow - self.cooling * T[node] / to_ambient
        return q

    def rates(self, T, heat):
        return self.flows(T, heat) / self.capacity

    def steady(self, heat, guess=None):
        start = np.full(len(self.capacity), 0.3 * heat) if guess is None else guess
        T, _, done, message = fsolve(lambda T: self.flows(T, heat), start, xtol=1e-13, full_output=True)
        assert done == 1 or np.abs(self.flows(T, heat)).max() < 1e-9 * (1 + heat), message
        return T

    def excess(self, heat, guess=None):
        """Heat that is made over the heat that is given away in a steady state."""
        return self.made(self.steady(heat, guess)) - heat

    def all_points(self):
        """Temperatures of all operating points; of circuits with fixed contacts, which have one steady state for a heat."""
        heats = np.geomspace(1, 400, 60)
        excess = [self.excess(Q) for Q in heats]
        return [self.steady(brentq(self.excess, heats[k], heats[k + 1], xtol=1e-12, rtol=1e-14)) for k in range(len(heats) - 1) if excess[k] * excess[k + 1] < 0]

    def settled(self, guess=None):
        """Temperatures of the operating point that is reached from cold: in time, then exactly. With a guess the point near it."""
        if guess is None:
            way = solve_ivp(lambda t, T: self.rates(T, self.made(T)), (0, 1e5), np.zeros(len(self.capacity)), method="Radau", rtol=1e-6, atol=1e-6)
            guess = way.y[:, -1]
        T, _, done, message = fsolve(lambda T: self.flows(T, self.made(T)), guess, xtol=1e-13, full_output=True)
        assert done == 1 or np.abs(self.flows(T, self.made(T))).max() < 1e-9 * self.made(T), message
        return T

    def hottest(self, T):
        return max(*T, *self.contacts(T, self.made(T)))

    def loop(self, T):
        """Gain of the loop and its largest eigenvalue, by differences."""
        heat, n = self.made(T), len(self.capacity)
        gain = (self.excess(heat * 1.0001, T) - self.excess(heat * 0.9999, T)) / (2e-4 * heat) + 1
        J = np.empty((n, n))
        for k in range(n):
            step = np.zeros(n)
            step[k] = 1e-4
            J[:, k] = (self.rates(T + step, self.made(T + step)) - self.rates(T - step, self.made(T - step))) / 2e-4
        return gain, max(np.linalg.eigvals(J).real)

    def runaway(self):
        """From cold to 150 degC anywhere or 4.2 GPa: what, when, preload then."""
        hot = lambda t, T: LIMIT - self.hottest(T)
        pressed = lambda t, T: 4.2e9 - pressure(self.state(T)[1])
        hot.terminal = pressed.terminal = True
        way = solve_ivp(lambda t, T: self.rates(T, self.made(T)), (0, 1e6), np.zeros(len(self.capacity)), method="Radau", rtol=1e-9, atol=1e-9, events=(hot, pressed))
        return "temperature" if len(way.t_events[0]) else "pressure", way.t[-1], self.state(way.y[:, -1])[0]


def largest_shortfall(pair):
    """The most by which heat can leave faster than it is made; an operating point exists if it is positive."""
    grid = np.geomspace(1, 400, 40)
    values = [-pair.excess(Q) for Q in grid]
    best = int(np.argmax(values))
    found = minimize_scalar(pair.excess, bounds=(grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]), method="bounded", options={"xatol": 1e-6})
    return -found.fun


def limit_reached(pair_with, low, high):
    """Where between two values the operating point's hottest place reaches the limit; the loop leaves it stable until then."""
    last = [pair_with(low).settled()]

    def over(value):
        pair = pair_with(value)
        T = pair.settled(last[0])
        return pair.hottest(T) - LIMIT

    for value in np.geomspace(low, high, 12)[1:]:  # step by step, so that the guess stays near
        T = pair_with(value).settled(last[0])
        if pair_with(value).hottest(T) > LIMIT:
            break
        low, last[0] = value, T
    found = brentq(over, low, value, xtol=1e-7 * low)
    gain, eigenvalue = pair_with(found).loop(pair_with(found).settled(last[0]))
    assert eigenvalue < 0 and gain < 1
    return found


CIRCUITS = {"physical": {}, "rolling and strips, no fin": {"fin": False}, "oil film 0.1 um": {"oil": 0.1e-6}, "published": {"rolls": False, "strips": False, "fin": False}}
SPEEDS = {"physical": (3000, 15200), "rolling and strips, no fin": (2000, 3000), "oil film 0.1 um": (3000,), "published": (3000, 4000)}  # rpm


def main():
    offset, rpm = offset_of(290), pi / 30
    print(f"K_b = {K:.6e} N/m^1.5, preload under 1.4 and 5 um: {row(offset, Growth(1.4e-6))[0]:.6f} {row(offset, Growth(5e-6))[0]:.6f} N")
    for name, growth in (("even, -50 K", even(-50, -50, -50)), ("even, +50 K", even(50, 50, 50)), ("even, +150 K", even(150, 150, 150)),
                         ("inner ring 5 K warmer", even(5)), ("even, +15 K, Si3N4 balls", even(15, 15, 15, ball_alpha=3.2e-6)),
                         ("even, +25 K, Si3N4 balls", even(25, 25, 25, ball_alpha=3.2e-6))):
        print(f"{name}: X {row(offset, growth)[0]:.6f} N, O {row(offset, growth, -1)[0]:.6f} N")
    for sign, side in ((-1, "left"), (1, "right")):
        print(f"fin to the {side}: {len(fin_side(sign))} nodes, {fin_conductance(sign):.9f} W/K in steady heat")
    for circuit, options in CIRCUITS.items():
        for speed in SPEEDS[circuit]:
            pair = Pair(speed * rpm, **options)
            for T in pair.all_points() if circuit == "published" else [pair.settled()]:
                axial, load = pair.state(T)
                gain, eigenvalue = pair.loop(T)
                print(f"{circuit}, {speed} rpm: heat {pair.made(T):.8f} W, preload {axial:.6f} N, ball load {load:.7f} N, pressure {pressure(load):.6e} Pa, gain {gain:.6f}, "
                      f"eigenvalue {eigenvalue:.7e} 1/s, balls {' '.join(f'{G:.9f}' for G in pair.balls(T))} W/K, rises s i b o h {np.array2string(T[:5], precision=7)}"
                      + (f", fin {np.array2string(T[5:], precision=7)}" if pair.fin else ""), flush=True)
    published = CIRCUITS["published"]
    print(f"published: critical speed {brentq(lambda n: largest_shortfall(Pair(n * rpm, **published)), 2500, 6000, xtol=1e-3):.3f} rpm")
    print(f"published: critical preload at 3000 rpm {brentq(lambda P: largest_shortfall(Pair(3000 * rpm, P, **published)), 290, 1500, xtol=1e-4):.4f} N")
    print(f"published: the limit at 3000 rpm with {1 / limit_reached(lambda f: Pair(3000 * rpm, 290, 1 / f, **published), 1, 30):.6f} of the cooling", flush=True)
    print(f"physical: the limit at {limit_reached(lambda n: Pair(n * rpm), 15200, 30000):.3f} rpm")
    print(f"physical: the limit at 15200 rpm with {limit_reached(lambda P: Pair(15200 * rpm, P), 290, 6000):.4f} N mounted")
    print(f"physical: the limit at 15200 rpm with {1 / limit_reached(lambda f: Pair(15200 * rpm, 290, 1 / f), 1, 20):.6f} of the cooling", flush=True)
    for circuit, speed in (("physical", 24000), ("published", 6000), ("published", 15200)):
        what, time, preload = Pair(speed * rpm, **CIRCUITS[circuit]).runaway()
        print(f"{circuit}, {speed} rpm: {what} after {time:.6f} s, preload {preload:.5f} N", flush=True)


if __name__ == "__main__":
    main()
