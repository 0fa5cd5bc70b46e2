#!/usr/bin/env python3
"""Ball loads of a fast angular contact bearing, from mechanics alone, beside the program's ball balance.

    python3 validation/ball_balance.py

The bearing is the 218 of Harris' Rolling Bearing Analysis (16 balls of 22.23 mm on 125.26 mm, 40 deg, grooves 0.5232 d) under 17800 N of thrust; its printed
results are not repeated here. Nothing of the program is used, and none of its closed forms:
- Hertz contacts with complete elliptic integrals (scipy), the ellipticity by a root of the curvature difference.
- The ball's angular velocity and its speed round the axis come from no slip at the two contact points and no spin on the outer race, as a linear
  system of vectors.
- The moment that the ball needs is the rate of its angular momentum while the picture turns round the axis; friction at the outer
  contact gives it, or half of it at each contact.
- Balance of force of a ball and of the inner ring: scipy's fsolve in ball centre and axial displacement.

Prints what tests/verification/statics/ball_inertia_test.cpp expects; and the preload of the pair 2 x 71914 (X, 290 N) at 15200 rpm for both splits.
"""

import numpy as np
from scipy.optimize import brentq, fsolve
from scipy.special import ellipe, ellipk

E, NU, RHO = 2.0e11, 0.30, 7800.0
Z, D, D_M, ALPHA_0, F_I, F_O = 16, 22.23e-3, 125.26e-3, np.radians(40.0), 0.5232, 0.5232
THRUST = 17800.0
MASS = RHO * np.pi / 6 * D**3
INERTIA = 0.4 * MASS * (D / 2) ** 2


def hertz(race_radius, groove, inside):
    """K of Q = K delta^1.5; inside: the race is convex in the rolling direction."""
    rho = [2 / D, 2 / D, (1 if inside else -1) / race_radius, -1 / groove]
    total = sum(rho)
    difference = abs((rho[0] - rho[1]) + (rho[2] - rho[3])) / total

    def mismatch(k):
        m = 1 - 1 / k**2
        return ((k**2 + 1) * ellipe(m) - 2 * ellipk(m)) / ((k**2 - 1) * ellipe(m)) - difference

    k = brentq(mismatch, 1 + 1e-6, 1e3, xtol=1e-14)
    m = 1 - 1 / k**2
    # Semi-axes and approach of two bodies pressed by Q = 1 (Timoshenko & Goodier; Harris, chapter 6).
    modulus = E / (1 - NU**2)  # of both alike: 1/E* = 2/modulus
    a = (2 * k**2 * ellipe(m) / np.pi) ** (1 / 3) * (3 / (2 * total) * 2 / modulus) ** (1 / 3)
    delta = (2 * ellipk(m) / np.pi) * (np.pi / (2 * k**2 * ellipe(m))) ** (1 / 3) * (3 / (2 * total) * 2 / modulus) ** (2 / 3) * total / 2
    return delta**-1.5, a, k


R_INNER, R_OUTER = D_M / 2 - D / 2 * np.cos(ALPHA_0), D_M / 2 + D / 2 * np.cos(ALPHA_0)
K_I, A_I, ELL_I = hertz(R_INNER, F_I * D, True)
K_O, A_O, ELL_O = hertz(R_OUTER, F_O * D, False)
L_I, L_O = (F_I - 0.5) * D, (F_O - 0.5) * D


def direction(angle):
    """Contact normal (x, radial, tangential)."""
    return np.array([np.sin(angle), np.cos(angle), 0.0])


def motion(alpha_i, alpha_o, omega):
    """Speed round the axis and angular velocity of a ball that rolls on both races without spin on the outer one."""
    n_i, n_o = direction(alpha_i), direction(alpha_o)
    centre = np.array([0.0, D_M / 2, 0.0])
    inner_point, outer_point = -D / 2 * n_i, D / 2 * n_o
    race_speed = np.cross([omega, 0, 0], centre + inner_point)[2]
    # Unknowns: omega_m, and the ball's angular velocity (x, radial). Speeds are along the tangent.
    matrix, right = np.zeros((3, 3)), np.array([race_speed, 0.0, 0.0])
    for column, w in enumerate(np.eye(3)[:2], start=1):
        matrix[0, column] = np.cross(w, inner_point)[2]
        matrix[1, column] = np.cross(w, outer_point)[2]
        matrix[2, column] = w @ n_o
    matrix[:2, 0] = np.cross([1.0, 0, 0], centre)[2]
    omega_m, w_x, w_r = np.linalg.solve(matrix, right)
    return omega_m, np.array([w_x, w_r, 0.0])


def forces(unknowns, omega, inner_share=0.0):
    x, p_x, p_r = unknowns * 1e-6
    B = np.array([(L_I + L_O) * np.sin(ALPHA_0) + x, (L_I + L_O) * np.cos(ALPHA_0)])
    P = np.array([L_O * np.sin(ALPHA_0) + p_x, L_O * np.cos(ALPHA_0) + p_r])
    inner, outer = np.hypot(*(B - P)), np.hypot(*P)
    alpha_i, alpha_o = np.arctan2(*(B - P)), np.arctan2(*P)
    Q_i, Q_o = K_I * max(inner - L_I, 0) ** 1.5, K_O * max(outer - L_O, 0) ** 1.5
    omega_m, ball = motion(alpha_i, alpha_o, omega)
    momentum_rate = np.cross([omega_m, 0, 0], INERTIA * ball)  # along the tangent
    # Friction f = c (cos, -sin) of the outer angle at the outer contact: its moment about the centre is the rate of momentum.
    across = np.array([np.cos(alpha_o), -np.sin(alpha_o), 0.0])
    c = (1 - inner_share) * momentum_rate[2] / np.cross(D / 2 * direction(alpha_o), across)[2]
    across_inner = np.array([np.cos(alpha_i), -np.sin(alpha_i), 0.0])
    c_i = inner_share * momentum_rate[2] / np.cross(-D / 2 * direction(alpha_i), across_inner)[2]
    centrifugal = MASS * D_M / 2 * omega_m**2
    from_inner = Q_i * direction(alpha_i) + c_i * across_inner
    on_ball = from_inner - Q_o * direction(alpha_o) + c * across + centrifugal * direction(0)
    return on_ball, Z * from_inner[0], (Q_i, Q_o, alpha_i, alpha_o, omega_m, centrifugal, momentum_rate[2], x)


def solve(rpm, start, inner_share=0.0):
    omega = rpm * np.pi / 30

    def left(u):
        ball, axial, _ = forces(u, omega, inner_share)
        return [ball[0] / 100, ball[1] / 100, (axial - THRUST) / 1000]

    u, _, ok, message = fsolve(left, start, xtol=1e-13, full_output=True)
    if ok != 1 and np.abs(left(u)).max() > 1e-9:
        raise RuntimeError(message)
    return u, forces(u, omega, inner_share)[2]


def pair_preload(mounted, rpm, inner_share):
    """Axial force of each row of 2 x 71914 whose races stay at their mounted axial distance [N]."""
    global Z, D, D_M, ALPHA_0, F_I, F_O, E, NU, RHO, MASS, INERTIA, K_I, K_O, L_I, L_O
    Z, D, D_M, ALPHA_0, F_I, F_O = 23, 9.525e-3, 85e-3, np.radians(25.0), 0.52, 0.52
    E, NU, RHO = 2.0e11, 0.30, 7800.0
    MASS = RHO * np.pi / 6 * D**3
    INERTIA = 0.4 * MASS * (D / 2) ** 2
    K_I = hertz(D_M / 2 - D / 2 * np.cos(ALPHA_0), F_I * D, True)[0]
    K_O = hertz(D_M / 2 + D / 2 * np.cos(ALPHA_0), F_O * D, False)[0]
    L_I, L_O = (F_I - 0.5) * D, (F_O - 0.5) * D

    def balls(u, x, omega):
        ball, axial, _ = forces(np.array([x, u[0], u[1]]), omega, inner_share)
        return ball, axial

    def axial_at(x, omega, start):
        u, _, ok, message = fsolve(lambda u: balls(u, x, omega)[0][:2] / 100, start, xtol=1e-13, full_output=True)
        if ok != 1 and np.abs(balls(u, x, omega)[0]).max() > 1e-8:
            raise RuntimeError(message)
        return balls(u, x, omega)[1], u

    offset = brentq(lambda x: axial_at(x, 1e-6, np.array([0.5, 1.0]))[0] - mounted, 0.1, 30.0, xtol=1e-12)
    u = axial_at(offset, 1e-6, np.array([0.5, 1.0]))[1]
    for part in np.linspace(0.05, 1.0, 20):
        axial, u = axial_at(offset, part * rpm * np.pi / 30, u)
    return axial


def main():
    print(f"K_i {K_I:.10g}  K_o {K_O:.10g} N/m^1.5; a/Q^(1/3) {A_I:.8g}, {A_O:.8g}; a/b {ELL_I:.8g}, {ELL_O:.8g}")
    for inner_share in (0.0, 0.5):
        print(f"share {inner_share} of the gyroscopic moment at the inner race")
        print("  rpm        Q_i [N]        Q_o [N]   alpha_i [deg]   alpha_o [deg]   omega_m [rad/s]     F_c [N]    M_g [N m]    x [um]")
        u = np.array([30.0, 10.0, 10.0])
        for rpm in (1.0, 2500.0, 5000.0, 7500.0, 10000.0, 12500.0, 15000.0):
            u, (Q_i, Q_o, a_i, a_o, w, F, M, x) = solve(rpm, u, inner_share)
            print(f"{rpm:6.0f} {Q_i:14.7f} {Q_o:14.7f} {np.degrees(a_i):15.9f} {np.degrees(a_o):15.9f} {w:17.9f} {F:12.7f} {M:11.8f} {x * 1e6:10.6f}")
    for inner_share in (0.0, 0.5):
        print(f"pair, share {inner_share}: preload {pair_preload(290.0, 15200.0, inner_share):.6f} N at 15200 rpm")


if __name__ == "__main__":
    main()
