#!/usr/bin/env python3
"""Thermal preload of the reference case's angular-contact pair (TB2), written again from the equations, for tests to compare with.

    /usr/bin/python3 validation/preload_loop.py

Shares no code with the program. The pair is symmetric and unloaded, so its inner ring stays in the middle: rows in closed form instead of an
equilibrium. Growth moves the two contact points of a ball and the centres of the grooves, as vectors in the plane of the axis. The circuit keeps
its contacts without mass as algebraic unknowns (the program eliminates them). Needs numpy and scipy.
"""

from dataclasses import dataclass
from math import cos, log, pi, radians, sin, tan

import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq, fsolve
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


def flows(s, i, ci, b, co, o, h, heat, cooling=1.0):
    """Heat into each node, the two contacts included."""
    lost = 23 * max(h, 0) ** 0.25 * pi * HOUSING * LENGTH * h * cooling
    return [(i - s) / R23 - cooling * s / R1, (s - i) / R23 + (ci - i) / R4, (i - ci) / R4 + (b - ci) / R5 + INNER_SHARE * heat,
            (ci - b) / R5 + (co - b) / R5 - cooling * b / R6, (b - co) / R5 + (o - co) / R7 + (1 - INNER_SHARE) * heat, (co - o) / R7 + (h - o) / R8,
            (o - h) / R8 - lost]


def contacts(i, b, o, heat):
    """Rises of the contacts, which hold no heat."""
    return ((i / R4 + b / R5 + INNER_SHARE * heat) / (1 / R4 + 1 / R5), (o / R7 + b / R5 + (1 - INNER_SHARE) * heat) / (1 / R7 + 1 / R5))


def growth_of(T, contact=None):
    """From shaft, ring, ball, outer ring, housing; a contact counts with what its neighbours give it, without its own heat."""
    s, i, b, o, h = T
    ci = contacts(i, b, o, 0)[0] if contact is None else contact
    mean = lambda r_in, r_out, T_in, T_out: (T_in * (2 * r_in + r_out) + T_out * (2 * r_out + r_in)) / (3 * (r_in + r_out))
    inner, outer = mean(BORE / 2, INNER / 2, i, ci), mean(OUTER / 2, HOUSING / 2, o, h)
    growth = even(inner, outer, b)
    growth.outer_strain = ALPHA * o  # the housing does not hold the ring along the axis
    return growth


def rates(T, heat, cooling=1.0):
    s, i, b, o, h = T
    ci, co = contacts(i, b, o, heat)
    q = flows(s, i, ci, b, co, o, h, heat, cooling)
    return np.array([q[0], q[1], q[3], q[5], q[6]]) / CAPACITY


def steady(heat, cooling=1.0):
    return fsolve(lambda T: rates(T, heat, cooling), np.full(5, 0.4 * heat), xtol=1e-13)


def made(T, omega, offset):
    return friction_heat(row(offset, growth_of(T) + speed_growth(omega))[0], omega)


# The same pair with contacts that conduct as they roll, and with spreading from the strips (thermal.contact_conduction = "rolling", thermal.spreading = "strip").
STRIP = HALF_WIDTH
R_INNER, R_OUTER = D_M / 2 - D / 2 * cos(PHI), D_M / 2 + D / 2 * cos(PHI)


def spreading(thickness, middles, behind=None):
    """Strip over surface of a slab as wide as the pair, per length and conductivity 1; cosine series. behind: resistance times conductivity, thickness."""
    l = np.arange(1, 40001) * pi / WIDTH
    c = np.mean([np.cos(l * x) for x in middles], axis=0) * np.sin(l * STRIP) / (l * STRIP)
    far = 1 / (l * behind[0] + 1 / np.tanh(l * behind[1])) if behind else 0.0
    near = np.tanh(l * thickness)
    return float(np.sum(2 / (WIDTH * l) * c**2 * (1 + far * near) / (far + near)))


SIDE = D / 2 * sin(PHI)  # rows of an X pair lean outwards: strips of the inner race towards the middle, of the outer one away from it
# Of the wall under the groove instead of the ring's up to its shoulder.
R4_WALL = log(R_INNER / ((R_INNER + BORE / 2) / 2)) / (2 * pi * CONDUCTIVITY * WIDTH)
R7_WALL = log((R_OUTER + OUTSIDE / 2) / 2 / R_OUTER) / (2 * pi * CONDUCTIVITY * WIDTH)
R4_STRIP = R4_WALL + spreading(R_INNER - BORE / 2, [WIDTH / 4 + SIDE, 3 * WIDTH / 4 - SIDE]) / (2 * pi * R_INNER * CONDUCTIVITY)
R7_STRIP = R7_WALL + spreading(OUTSIDE / 2 - R_OUTER, [WIDTH / 4 - SIDE, 3 * WIDTH / 4 + SIDE],
                          (FIT * pi * OUTSIDE * WIDTH * CONDUCTIVITY, (HOUSING - OUTSIDE) / 2)) / (2 * pi * R_OUTER * CONDUCTIVITY)


def rolling_contact(axis, k, Q, speed):
    """A ball and a race of one material in series: static and rolling conductance of an ellipse, mixed by squares."""
    a = axis * Q ** (1 / 3)
    at_rest = 2 * pi * CONDUCTIVITY * a / ellipk(1 - 1 / k**2)
    effusivity = (CONDUCTIVITY * RHO * HEAT) ** 0.5
    rolling = 2 * (2 * a / k * speed) ** 0.5 * effusivity * a * gamma(1.25) / gamma(1.75)
    return 0.5 * hypot(at_rest, rolling)


def rolling_balls(Q, omega):
    """Star of both contacts and the way into the ball as a triangle, all balls alike: inner race to ball, outer race to ball, race to race."""
    if Q <= 0:
        return 0.0, 0.0, 0.0
    turn = D * cos(PHI) / D_M
    speed = omega * D_M / 4 * (1 - turn**2)
    G_i, G_o = (rolling_contact(axis, k, Q, speed) for _, axis, k in (INNER_RACE, OUTER_RACE))
    G_b = 2 * pi**2 * CONDUCTIVITY * D / 2 / (log(D / 2 / HALF_WIDTH) + 0.43)
    per = 2 * Z / (G_i + G_o + G_b)
    return per * G_i * G_b, per * G_o * G_b, per * G_i * G_o


def rolling_state(T, omega, offset):
    """Axial force and ball load; the inner ring grows with its own temperature."""
    return row(offset, growth_of(T, contact=T[1]) + speed_growth(omega))


def rolling_rates(T, heat, omega, offset):
    s, i, b, o, h = T
    G_ib, G_ob, G_io = rolling_balls(rolling_state(T, omega, offset)[1], omega)
    ci, co = np.linalg.solve([[1 / R4_STRIP + G_ib + G_io, -G_io], [-G_io, 1 / R7_STRIP + G_ob + G_io]],
                             [i / R4_STRIP + G_ib * b + INNER_SHARE * heat, o / R7_STRIP + G_ob * b + (1 - INNER_SHARE) * heat])
    lost = 23 * max(h, 0) ** 0.25 * pi * HOUSING * LENGTH * h
    into = [(i - s) / R23 - s / R1, (s - i) / R23 + (ci - i) / R4_STRIP, G_ib * (ci - b) + G_ob * (co - b) - b / R6, (co - o) / R7_STRIP + (h - o) / R8,
            (o - h) / R8 - lost]
    return np.array(into) / CAPACITY


def rolling_points(rpm, brackets):
    """Operating points of the pair whose contacts roll."""
    omega, offset = rpm * pi / 30, offset_of(290)
    made_by = lambda T: friction_heat(rolling_state(T, omega, offset)[0], omega)
    steady_at = lambda Q: fsolve(lambda T: rolling_rates(T, Q, omega, offset), np.full(5, 0.4 * Q), xtol=1e-13)
    balance = lambda Q: made_by(steady_at(Q)) - Q
    for low, high in brackets:
        Q = brentq(balance, low, high, xtol=1e-12, rtol=1e-14)
        T = steady_at(Q)
        axial, load = rolling_state(T, omega, offset)
        gain = (balance(Q * 1.0001) - balance(Q * 0.9999)) / (2e-4 * Q) + 1
        J = np.empty((5, 5))
        for k in range(5):
            step = np.zeros(5)
            step[k] = 1e-4
            J[:, k] = (rolling_rates(T + step, made_by(T + step), omega, offset) - rolling_rates(T - step, made_by(T - step), omega, offset)) / 2e-4
        G = rolling_balls(load, omega)
        print(f"rolling, {rpm} rpm: heat {Q:.8f} W, preload {axial:.6f} N, ball load {load:.7f} N, gain {gain:.6f}, eigenvalue {max(np.linalg.eigvals(J).real):.7e} 1/s, "
              f"conductances {G[0]:.7f} {G[1]:.7f} {G[2]:.7f} W/K, rises s i b o h {np.array2string(T, precision=7)}")


def largest_shortfall(omega, preload=290.0, cooling=1.0):
    """The most by which heat can leave faster than it is made; an operating point exists if it is positive."""
    offset = offset_of(preload)
    grid = np.linspace(1, 400, 800)
    values = [Q - made(steady(Q, cooling), omega, offset) for Q in grid]
    best = int(np.argmax(values))
    low, high = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    for _ in range(60):  # golden section
        a, b = high - 0.618034 * (high - low), low + 0.618034 * (high - low)
        if a - made(steady(a, cooling), omega, offset) > b - made(steady(b, cooling), omega, offset):
            high = b
        else:
            low = a
    Q = (low + high) / 2
    return Q - made(steady(Q, cooling), omega, offset)


ROLLING = ((2000, ((1, 60),)), (3000, ((1, 100),)))  # rpm, brackets of heat [W]


def main():
    offset = offset_of(290)
    print(f"K_b = {K:.6e} N/m^1.5, preload under 1.4 and 5 um: {row(offset, Growth(1.4e-6))[0]:.6f} {row(offset, Growth(5e-6))[0]:.6f} N")
    for name, growth in (("even, -50 K", even(-50, -50, -50)), ("even, +50 K", even(50, 50, 50)), ("even, +150 K", even(150, 150, 150)),
                         ("inner ring 5 K warmer", even(5)), ("even, +15 K, Si3N4 balls", even(15, 15, 15, ball_alpha=3.2e-6)),
                         ("even, +25 K, Si3N4 balls", even(25, 25, 25, ball_alpha=3.2e-6))):
        print(f"{name}: X {row(offset, growth)[0]:.6f} N, O {row(offset, growth, -1)[0]:.6f} N")
    omega = 3000 * pi / 30
    balance = lambda Q: made(steady(Q), omega, offset) - Q
    heats = np.linspace(1, 400, 134)
    short = [balance(Q) for Q in heats]
    for low, high in [(heats[k], heats[k + 1]) for k in range(len(heats) - 1) if short[k] * short[k + 1] < 0]:
        Q = brentq(balance, low, high, xtol=1e-12, rtol=1e-14)
        T = steady(Q)
        axial, load = row(offset, growth_of(T) + speed_growth(omega))
        gain = (balance(Q * 1.0001) - balance(Q * 0.9999)) / (2e-4 * Q) + 1
        J = np.empty((5, 5))
        for k in range(5):
            step = np.zeros(5)
            step[k] = 1e-4
            J[:, k] = (rates(T + step, made(T + step, omega, offset)) - rates(T - step, made(T - step, omega, offset))) / 2e-4
        print(f"3000 rpm: heat {Q:.8f} W, preload {axial:.6f} N, ball load {load:.7f} N, pressure {pressure(load):.6e} Pa, gain {gain:.6f}, "
              f"eigenvalue {max(np.linalg.eigvals(J).real):.7e} 1/s, rises s i b o h {np.array2string(T, precision=7)}")
    for rpm, brackets in ROLLING:
        rolling_points(rpm, brackets)
    critical = brentq(lambda rpm: largest_shortfall(rpm * pi / 30), 2500, 6000, xtol=1e-4)
    print(f"critical speed {critical:.3f} rpm")
    print(f"critical preload at 3000 rpm {brentq(lambda P: largest_shortfall(omega, P), 290, 1500, xtol=1e-4):.4f} N")
    print(f"critical cooling at 3000 rpm {brentq(lambda f: largest_shortfall(omega, 290, f), 0.1, 1, xtol=1e-7):.6f}")
    for rpm in (6000, 15200):
        omega = rpm * pi / 30

        def hot(t, T):
            heat = made(T, omega, offset)
            i, b, o = T[1], T[2], T[3]
            return 150 + 273.15 - AMBIENT - max(max(T), *contacts(i, b, o, heat))

        def pressed(t, T):
            return 4.2e9 - pressure(row(offset, growth_of(T) + speed_growth(omega))[1])

        hot.terminal = pressed.terminal = True
        way = solve_ivp(lambda t, T: rates(T, made(T, omega, offset)), (0, 1e6), np.zeros(5), method="Radau", rtol=1e-9, atol=1e-9, events=(hot, pressed))
        T = way.y[:, -1]
        print(f"{rpm} rpm: {'temperature' if len(way.t_events[0]) else 'pressure'} after {way.t[-1]:.6f} s, preload "
              f"{row(offset, growth_of(T) + speed_growth(omega))[0]:.5f} N")


if __name__ == "__main__":
    main()
