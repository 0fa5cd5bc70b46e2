#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Rotor drop on two touchdown bearings: an independent implementation of the same statement, for comparison.

It reads the statement of values (--case, TOML) and the rotor (--rotor, JSON), integrates the drop with the classical
Runge-Kutta method of order 4 at a fixed step and writes a summary (--out, JSON) and, if asked, a time series (--series, NPZ).

    drop_peer.py --case reference-case.toml --rotor rotor.json --alpha 30 --out settling.json --series settling.npz

Model in short.  x along the rotor, y up, z horizontal; angles from +y towards +z; spin positive about +x.
  rotor     Timoshenko elements (Nelson), consistent mass, rotary inertia, Cowper shear; free-free modes of the rotor at rest
            up to a cut-off in two planes, gyroscopic matrix projected; spin angle and speed are states.
            Plane coordinates are v, v' and w, w' (theta_z = v', theta_y = -w'), so that
            M v'' + omega G w' + K v = F_y  and  M w'' - omega G v' + K w = F_z  with one symmetric G (polar inertia).
  contact   F = K delta^n (1 + 1.5 lambda delta'), regularised Coulomb friction at the rotor's and the bore's own radii.
  bearing   balls on the cage angle, F = K_b delta^0.5 (delta + 1.5 beta delta'), inner ring with two translations and a spin,
            outer ring on a support mass.
  friction  load and velocity term (Palmgren), heat M omega_i split by race radii.
  thermal   nodes shaft, inner ring, balls, outer ring, housing; the contacts have no capacity and are eliminated.
Every dissipation, heat and work has a ledger among the states.  SI units, kelvin.
numba is used if there is one; without it the program gives the same numbers, slowly.
"""
import argparse
import json
import math
import time

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

try:
    import tomllib
except ImportError:                                    # Python < 3.11
    import tomli as tomllib
try:
    from numba import njit
except ImportError:
    def njit(*args, **kwargs):
        return args[0] if args and callable(args[0]) else (lambda f: f)


def quantity(value):
    """A plain number, or a string with a unit such as "15200 rpm" or "25 deg", in SI."""
    if isinstance(value, str):
        number, unit = value.split()
        return float(number) * {"rpm": math.pi / 30, "deg": math.pi / 180, "rad": 1.0, "rad/s": 1.0}[unit]
    return float(value)


# ---------------------------------------------------------------------------------------------------------------- rotor
def beam_plane_matrices(length, outer, inner, E, nu, rho):
    """Mass, polar (gyroscopic) and stiffness matrix of one element in one plane, coordinates v1, v1', v2, v2'."""
    if inner == 0.0:
        kappa = 6 * (1 + nu) / (7 + 6 * nu)
    else:
        m2 = (inner / outer) ** 2
        kappa = 6 * (1 + nu) * (1 + m2) ** 2 / ((7 + 6 * nu) * (1 + m2) ** 2 + (20 + 12 * nu) * m2)
    area = math.pi / 4 * (outer**2 - inner**2)
    second = math.pi / 64 * (outer**4 - inner**4)
    shear = E / (2 * (1 + nu))
    phi = 12 * E * second / (kappa * shear * area * length**2)
    points, weights = np.polynomial.legendre.leggauss(5)
    mass, polar, stiff = np.zeros((4, 4)), np.zeros((4, 4)), np.zeros((4, 4))
    for point, weight in zip(points, weights):
        s, w = (point + 1) / 2, weight * length / 2
        # displacement, slope of the displacement, rotation of the section, curvature
        N = np.array([1 - 3 * s**2 + 2 * s**3 + phi * (1 - s), length * (s - 2 * s**2 + s**3 + phi / 2 * (s - s**2)),
                      3 * s**2 - 2 * s**3 + phi * s, length * (-s**2 + s**3 + phi / 2 * (s**2 - s))]) / (1 + phi)
        Nx = np.array([(-6 * s + 6 * s**2 - phi) / length, 1 - 4 * s + 3 * s**2 + phi / 2 * (1 - 2 * s),
                       (6 * s - 6 * s**2 + phi) / length, -2 * s + 3 * s**2 + phi / 2 * (2 * s - 1)]) / (1 + phi)
        D = np.array([6 * (s**2 - s) / length, 1 - 4 * s + 3 * s**2 + phi * (1 - s),
                      6 * (s - s**2) / length, -2 * s + 3 * s**2 + phi * s]) / (1 + phi)
        Dx = np.array([6 * (2 * s - 1) / length, -4 + 6 * s - phi, 6 * (1 - 2 * s) / length, -2 + 6 * s + phi]) / (
            (1 + phi) * length)
        mass += w * rho * (area * np.outer(N, N) + second * np.outer(D, D))
        polar += w * rho * 2 * second * np.outer(D, D)
        stiff += w * (E * second * np.outer(Dx, Dx) + kappa * shear * area * np.outer(Nx - D, Nx - D))
    return mass, polar, stiff


class Rotor:
    def __init__(self, data, cut_off):
        mat = data["material"]
        x = np.array([n["x"] for n in data["nodes"]])
        self.index = {n["id"]: i for i, n in enumerate(data["nodes"])}
        size = 2 * len(x)
        M, G, K = np.zeros((size, size)), np.zeros((size, size)), np.zeros((size, size))
        self.polar_inertia = 0.0
        for e in data["elements"]:
            i, j = self.index[e["n1"]], self.index[e["n2"]]
            d = np.array([2 * i, 2 * i + 1, 2 * j, 2 * j + 1])
            m, g, k = beam_plane_matrices(e["length"], e["od"], e["id_"], mat["E"], mat["nu"], mat["rho"])
            M[np.ix_(d, d)] += m
            G[np.ix_(d, d)] += g
            K[np.ix_(d, d)] += k
            self.polar_inertia += mat["rho"] * math.pi / 32 * (e["od"] ** 4 - e["id_"] ** 4) * e["length"]
        for p in data["mass_points"]:
            i = self.index[p["node"]]
            M[2 * i, 2 * i] += p["mass"]
            M[2 * i + 1, 2 * i + 1] += p["Id"]
            G[2 * i + 1, 2 * i + 1] += p["Ip"]
            self.polar_inertia += p["Ip"]
        shift, turn = np.zeros(size), np.zeros(size)
        shift[0::2] = 1.0
        self.mass = shift @ M @ shift
        lever = np.zeros(size)
        lever[0::2], lever[1::2] = x, 1.0
        self.x, self.centre = x, (shift @ M @ lever) / self.mass
        turn[0::2], turn[1::2] = x - self.centre, 1.0
        self.diametral_inertia = turn @ M @ turn
        values, vectors = eigh(K, M)
        flexible = np.sqrt(np.maximum(values[2:], 0.0)) / (2 * math.pi)
        keep = flexible <= cut_off
        self.frequencies, self.next_frequency = flexible[keep], flexible[~keep][0]
        self.shapes = np.column_stack([shift / math.sqrt(self.mass), turn / math.sqrt(self.diametral_inertia),
                                       vectors[:, 2:][:, keep]])
        self.omega = np.concatenate([[0.0, 0.0], 2 * math.pi * self.frequencies])
        self.gyro = self.shapes.T @ G @ self.shapes
        self.weight = self.shapes.T @ M @ shift            # times -g: modal gravity force
        self.M = M

    def row(self, node):
        """Modal participation of a node's lateral displacement."""
        return self.shapes[2 * self.index[node]].copy()


# -------------------------------------------------------------------------------------------------------------- bearing
class HertzContact:
    """Ball on a race groove after the fits of Brewe and Hamrock."""

    def __init__(self, ball, race_radius, groove, outside, ball_mat, race_mat):
        rx = 1 / (2 / ball + (-1 if outside else 1) / race_radius)
        ry = 1 / (2 / ball - 1 / groove)
        self.R = 1 / (1 / rx + 1 / ry)
        self.k = 1.0339 * (ry / rx) ** 0.636
        self.E = 1.0003 + 0.5968 * rx / ry
        self.F = 1.5277 + 0.6023 * math.log(ry / rx)
        self.modulus = 2 / ((1 - ball_mat["nu"] ** 2) / ball_mat["E"] + (1 - race_mat["nu"] ** 2) / race_mat["E"])
        self.stiffness = math.pi * self.k * self.modulus * math.sqrt(self.R * self.E / (4.5 * self.F**3))
        # semi-major axis = axis_factor * F^(1/3)
        self.axis_factor = (6 * self.k**2 * self.E * self.R / (math.pi * self.modulus)) ** (1 / 3)


# indices into the parameter row of a bearing
(P_KC, P_RB, P_RR, P_GAP, P_LAMBDA, P_NEXP, P_MU, P_VREG, P_A, P_BR0, P_BX, P_KB, P_BETA, P_CAGE, P_MR, P_J, P_MS, P_KY, P_KZ,
 P_CY, P_CZ, P_F1Z, P_F1Y, P_C0, P_DM, P_MV0, P_MV1, P_NUN, P_WREG, P_SPLIT, P_SPIN, P_SHARE, P_AMB, P_G1, P_G23, P_G4, P_G5, P_G6,
 P_G7, P_G8, P_AH, P_CS, P_CI, P_CB, P_CO, P_CH, P_UBI, P_UBC, P_URI, P_URC, P_UOO, P_UOH, P_US, P_UB, P_COUNT) = range(55)
# state of a bearing
(S_Y, S_Z, S_VY, S_VZ, S_ANGLE, S_SPEED, S_CAGE, S_SY, S_SZ, S_SVY, S_SVZ, S_TS, S_TI, S_TB, S_TO, S_TH,
 S_HR, S_HI, S_HO, S_DN, S_DB, S_DS, S_WG, S_WC, S_LOST, S_COUNT) = range(26)
# recorded quantities of a bearing
(O_Y, O_Z, O_PEN, O_FORCE, O_HR, O_HI, O_HO, O_ML, O_MS, O_TCI, O_TCO, O_SPEED, O_RY, O_RZ, O_COUNT) = range(15)


class Bearing:
    def __init__(self, name, case, mu):
        c, con, mat, th, all_ = case[name], case["contact"], case["materials"], case["thermal"], case["bearings"]
        self.name, self.node = name, c["node"]
        steel, ball = mat["steel"], mat[c["ball"]]
        d, dm, Z, rows = c["ball_diameter"], c["pitch_diameter"], c["balls_per_row"], c["rows"]
        phi = quantity(c["contact_angle"])
        f_in, f_out = c["conformity"]
        A = (f_in + f_out - 1) * d
        r_in, r_out = dm / 2 - d / 2 * math.cos(phi), dm / 2 + d / 2 * math.cos(phi)
        inner = HertzContact(d, r_in, f_in * d, False, ball, steel)
        outer = HertzContact(d, r_out, f_out * d, True, ball, steel)
        self.Kb = (inner.stiffness ** (-2 / 3) + outer.stiffness ** (-2 / 3)) ** -1.5
        br0 = A * math.cos(phi) - c.get("radial_clearance", 0.0)
        self.preload_offset = 0.0
        if c.get("preload", 0.0) > 0.0:
            def excess(offset):
                bx = A * math.sin(phi) + offset
                dist = math.hypot(br0, bx)
                return Z * self.Kb * max(dist - A, 0.0) ** 1.5 * bx / dist - c["preload"]
            self.preload_offset = brentq(excess, 0.0, 1e-3, xtol=1e-18, rtol=1e-15)
        bx = A * math.sin(phi) + self.preload_offset if phi != 0.0 else 0.0
        step = 2 * math.pi / Z
        self.azimuth = np.concatenate([(np.arange(Z) + r * c.get("row_phase", 0.0)) * step for r in range(rows)])

        p = np.zeros(P_COUNT)
        p[P_KC], p[P_NEXP], p[P_LAMBDA], p[P_MU] = c["contact_stiffness"], con["exponent"], con["lambda"], mu
        p[P_RB], p[P_GAP], p[P_VREG] = con["bore_radius"], con["air_gap"], con["regularisation_speed"]
        p[P_RR] = con["bore_radius"] - con["air_gap"]
        p[P_A], p[P_BR0], p[P_BX], p[P_KB], p[P_BETA] = A, br0, bx, self.Kb, all_["ball_damping_beta"]
        p[P_CAGE] = (1 - d * math.cos(phi) / dm) / 2
        p[P_MR], p[P_J] = c["ring_mass"], c["ring_spin_inertia"]
        s = c["support"]
        p[P_MS], p[P_KY], p[P_KZ], p[P_CY], p[P_CZ] = s["mass"], s["K_y"], s["K_z"], s["C_y"], s["C_z"]
        p[P_F1Z], p[P_F1Y], p[P_C0], p[P_DM] = c["f1_z"], c["f1_y"], c["C0"], dm
        newton_metre = c["f2"] * (1e3 * dm) ** 3 * 1e-7 * 1e-3      # N mm per unit of (nu N)^(2/3), in N m
        p[P_MV0], p[P_MV1] = 160 * newton_metre, newton_metre
        p[P_NUN] = all_["drag_viscosity"] * 1e6 * 30 / math.pi      # cSt rpm per rad/s
        p[P_WREG], p[P_SPLIT] = all_["drag_regularisation"], r_in / (r_in + r_out)
        p[P_SPIN] = 3 / 8 * mu * inner.axis_factor * inner.E        # times F^(4/3)

        # thermal circuit
        W, L, Lh, balls = c["width"], th["shaft_lump_length"][name], th["housing_length"][name], Z * rows
        bore, d_i = th["inner_ring_diameters"]
        rings = th["outer_ring_diameters"]             # a list is TB2's; the statement gives TB1's in that line's comment
        d_o, d_oo = rings[name] if isinstance(rings, dict) else {"TB1": [0.0972, 0.110]}.get(name, rings)
        d_hi, d_h = th["housing_diameters"][name]
        d_s, d_mi, d_om, d_hm = 2 * p[P_RR], (bore + d_i) / 2, (d_o + d_oo) / 2, (d_hi + d_h) / 2
        k, kb, a = steel["k"], ball["k"], th["contact_half_width"]
        self.resistance = {
            "R1": 1 / (th["h_shaft"] * math.pi * d_s * W),
            "R2": 1 / (4 * math.pi * k * W),
            "R3": math.log(d_mi / d_s) / (2 * math.pi * k * W),
            "R4": math.log(d_i / d_mi) / (2 * math.pi * k * W),
            "R5": 2 / (math.pi * kb * d * balls) + 2 / (4 * kb * a * balls),
            "R6": 1 / (th["h_ball"] * balls * math.pi * d**2),
            "R7": math.log(d_om / d_o) / (2 * math.pi * k * W),
            "R8": math.log(d_oo / d_om) / (2 * math.pi * k * W) + th["fit_resistance"]
                  + math.log(d_hm / d_oo) / (2 * math.pi * k * Lh)}
        R = self.resistance
        p[P_G1], p[P_G23], p[P_G4], p[P_G5] = 1 / R["R1"], 1 / (R["R2"] + R["R3"]), 1 / R["R4"], 1 / R["R5"]
        p[P_G6], p[P_G7], p[P_G8], p[P_AH] = 1 / R["R6"], 1 / R["R7"], 1 / R["R8"], math.pi * d_h * Lh
        p[P_SHARE], p[P_AMB] = th["share_to_ring"], case["run"]["ambient"]
        rho_c = steel["rho"] * steel["c"]
        p[P_CS] = rho_c * math.pi / 4 * d_s**2 * L
        p[P_CI] = c["ring_mass"] * steel["c"]
        p[P_CB] = ball["rho"] * ball["c"] * balls * math.pi / 6 * d**3
        p[P_CO] = rho_c * math.pi / 4 * (d_oo**2 - d_o**2) * W
        p[P_CH] = rho_c * math.pi / 4 * (d_h**2 - d_hi**2) * Lh

        # growth: free annulus a..b with a linear temperature, factors on the two temperature rises
        def annulus(r, a_, b_):
            f = steel["alpha"] * r / (3 * (a_ + b_))
            return f * (2 * a_ + b_), f * (2 * b_ + a_)
        p[P_UBI], p[P_UBC] = annulus(bore / 2, bore / 2, d_i / 2)       # bore, from T_i and T_ci
        p[P_URI], p[P_URC] = annulus(d_i / 2, bore / 2, d_i / 2)        # raceway, taken at the ring's outer diameter
        p[P_UOO], p[P_UOH] = annulus(d_o / 2, d_o / 2, d_h / 2)         # outer raceway, taken at the outer ring's bore
        p[P_US] = steel["alpha"] * p[P_RR]
        p[P_UB] = ball["alpha"] * d / 2
        self.p = p

    def static_ring(self, gravity):
        """Ring and support at rest under the ring's weight alone: displacements along y from the unloaded position."""
        p, load = self.p, self.p[P_MR] * gravity

        def excess(e):
            br = p[P_BR0] + e * np.cos(self.azimuth)
            dist = np.hypot(br, p[P_BX])
            force = p[P_KB] * np.maximum(dist - p[P_A], 0.0) ** 1.5
            return -np.sum(force * br / dist * np.cos(self.azimuth)) - load
        e = brentq(excess, -1e-4, 1e-4, xtol=1e-20, rtol=1e-15)
        support = -load / p[P_KY]
        return support + e, support


# -------------------------------------------------------------------------------------------------------- right-hand side
@njit(cache=False)
def derivative(x, dx, out, n, modal, gyro, weight, rows, unb_rows, unb, bear, azimuth, balls, glob):
    """dx/dt of the state x; out[b] receives the recorded quantities of bearing b.

    modal[0] = circular frequencies squared, modal[1] = 2 zeta omega.  glob = gravity, alpha, polar inertia.
    """
    g, alpha, polar = glob[0], glob[1], glob[2]
    base = 4 * n + 5
    spin, omega = x[4 * n], x[4 * n + 1]
    fv, fw = np.zeros(n), np.zeros(n)
    torque = 0.0
    nb = bear.shape[0]
    push = np.zeros((nb, 6))           # contact force on the ring (y, z), torque, elastic force, normal dissipation, heat

    # rotor on the inner rings
    for b in range(nb):
        p = bear[b]
        s = base + b * S_COUNT
        ry, rz, rvy, rvz = 0.0, 0.0, 0.0, 0.0
        for m in range(n):
            ry += rows[b, m] * x[m]
            rz += rows[b, m] * x[n + m]
            rvy += rows[b, m] * x[2 * n + m]
            rvz += rows[b, m] * x[3 * n + m]
        rise_s, rise_i = x[s + S_TS] - p[P_AMB], x[s + S_TI] - p[P_AMB]
        rise_b = x[s + S_TB] - p[P_AMB]
        rise_c = (p[P_G4] * rise_i + p[P_G5] * rise_b) / (p[P_G4] + p[P_G5])
        gap = p[P_GAP] + p[P_UBI] * rise_i + p[P_UBC] * rise_c - p[P_US] * rise_s
        ey, ez = ry - x[s + S_Y], rz - x[s + S_Z]
        er = math.sqrt(ey * ey + ez * ez)
        pen = er - gap
        force, heat = 0.0, 0.0
        if pen > 0.0:
            ny, nz = ey / er, ez / er
            dvy, dvz = rvy - x[s + S_VY], rvz - x[s + S_VZ]
            rate = dvy * ny + dvz * nz
            elastic = p[P_KC] * pen ** p[P_NEXP]
            force = max(elastic * (1.0 + 1.5 * p[P_LAMBDA] * rate), 0.0)
            slip = omega * p[P_RR] - x[s + S_SPEED] * p[P_RB] - dvy * nz + dvz * ny
            fric = p[P_MU] * slip / math.sqrt(slip * slip + p[P_VREG] ** 2) * force
            heat = fric * slip
            fy, fz = force * ny - fric * nz, force * nz + fric * ny     # on the ring
            for m in range(n):
                fv[m] -= rows[b, m] * fy
                fw[m] -= rows[b, m] * fz
            torque -= fric * p[P_RR]
            push[b, 0], push[b, 1], push[b, 2] = fy, fz, fric * p[P_RB]
            push[b, 3], push[b, 4], push[b, 5] = elastic, (force - elastic) * rate, heat
        out[b, O_Y], out[b, O_Z], out[b, O_PEN], out[b, O_FORCE], out[b, O_HR] = ry, rz, pen, force, heat
        out[b, O_RY], out[b, O_RZ], out[b, O_SPEED] = x[s + S_Y], x[s + S_Z], x[s + S_SPEED]

    # rotor
    omega_dot = torque / polar
    dx[4 * n], dx[4 * n + 1] = omega, omega_dot
    work_unb = 0.0
    for u in range(unb.shape[0]):
        c, si = math.cos(spin + unb[u, 1]), math.sin(spin + unb[u, 1])
        uy = unb[u, 0] * (omega * omega * c + omega_dot * si)
        uz = unb[u, 0] * (omega * omega * si - omega_dot * c)
        for m in range(n):
            fv[m] += unb_rows[u, m] * uy
            fw[m] += unb_rows[u, m] * uz
            work_unb += unb_rows[u, m] * (uy * x[2 * n + m] + uz * x[3 * n + m])
    loss_modal, loss_alpha = 0.0, 0.0
    for m in range(n):
        pv, pw = x[2 * n + m], x[3 * n + m]
        gv, gw = 0.0, 0.0
        for k in range(n):
            gv += gyro[m, k] * x[3 * n + k]
            gw += gyro[m, k] * x[2 * n + k]
        dx[m], dx[n + m] = pv, pw
        dx[2 * n + m] = fv[m] - weight[m] * g - (alpha + modal[1, m]) * pv - modal[0, m] * x[m] - omega * gv
        dx[3 * n + m] = fw[m] - (alpha + modal[1, m]) * pw - modal[0, m] * x[n + m] + omega * gw
        loss_modal += modal[1, m] * (pv * pv + pw * pw)
        loss_alpha += alpha * (pv * pv + pw * pw)
    dx[4 * n + 2], dx[4 * n + 3], dx[4 * n + 4] = loss_modal, loss_alpha, work_unb

    # bearings
    for b in range(nb):
        p = bear[b]
        s = base + b * S_COUNT
        rise_i, rise_b = x[s + S_TI] - p[P_AMB], x[s + S_TB] - p[P_AMB]
        rise_o, rise_h, rise_s = x[s + S_TO] - p[P_AMB], x[s + S_TH] - p[P_AMB], x[s + S_TS] - p[P_AMB]
        rise_c = (p[P_G4] * rise_i + p[P_G5] * rise_b) / (p[P_G4] + p[P_G5])
        eps_race = p[P_URI] * rise_i + p[P_URC] * rise_c - p[P_UOO] * rise_o - p[P_UOH] * rise_h
        eps_ball = p[P_UB] * rise_b
        ey, ez = x[s + S_Y] - x[s + S_SY], x[s + S_Z] - x[s + S_SZ]
        vy, vz = x[s + S_VY] - x[s + S_SVY], x[s + S_VZ] - x[s + S_SVZ]
        speed = x[s + S_SPEED]
        cage = speed * p[P_CAGE]
        by, bz, loss_ball, largest = 0.0, 0.0, 0.0, 0.0
        sum_race, sum_ball, sum_cage = 0.0, 0.0, 0.0        # elastic force times change of delta per unit of each cause
        for j in range(balls[b]):
            angle = x[s + S_CAGE] + azimuth[b, j]
            c, si = math.cos(angle), math.sin(angle)
            br = p[P_BR0] + ey * c + ez * si + eps_race
            dist = math.sqrt(br * br + p[P_BX] ** 2)
            delta = dist - p[P_A] + 2.0 * eps_ball
            if delta > 0.0:
                cos_phi = br / dist
                rate = cos_phi * (vy * c + vz * si)
                root = p[P_KB] * math.sqrt(delta)
                elastic = root * delta
                f = max(elastic + root * 1.5 * p[P_BETA] * rate, 0.0)
                by -= f * cos_phi * c
                bz -= f * cos_phi * si
                loss_ball += (f - elastic) * rate
                sum_race += elastic * cos_phi
                sum_ball += elastic * 2.0
                sum_cage += elastic * cos_phi * (ez * c - ey * si)
                largest = max(largest, f)
        # friction inside the bearing
        load = math.sqrt(by * by + bz * bz)
        m_load = p[P_F1Z] * (load / p[P_C0]) ** p[P_F1Y] * load * p[P_DM]
        nun = abs(speed) * p[P_NUN]
        m_visc = p[P_MV1] * nun ** (2.0 / 3.0) if nun > 2000.0 else p[P_MV0]
        drag = (m_load + m_visc) * math.tanh(speed / p[P_WREG])
        h_in, h_out = p[P_SPLIT] * drag * speed, (1.0 - p[P_SPLIT]) * drag * speed

        dx[s + S_Y], dx[s + S_Z], dx[s + S_ANGLE], dx[s + S_CAGE] = x[s + S_VY], x[s + S_VZ], speed, cage
        dx[s + S_VY] = (push[b, 0] + by) / p[P_MR] - g
        dx[s + S_VZ] = (push[b, 1] + bz) / p[P_MR]
        dx[s + S_SPEED] = (push[b, 2] - drag) / p[P_J]
        svy, svz = x[s + S_SVY], x[s + S_SVZ]
        dx[s + S_SY], dx[s + S_SZ] = svy, svz
        dx[s + S_SVY] = (-by - p[P_KY] * x[s + S_SY] - p[P_CY] * svy) / p[P_MS]
        dx[s + S_SVZ] = (-bz - p[P_KZ] * x[s + S_SZ] - p[P_CZ] * svz) / p[P_MS]

        # heat; ci and co without capacity
        rise_ci = (p[P_G4] * rise_i + p[P_G5] * rise_b + h_in) / (p[P_G4] + p[P_G5])
        rise_co = (p[P_G5] * rise_b + p[P_G7] * rise_o + h_out) / (p[P_G5] + p[P_G7])
        h_r = push[b, 5]
        air_s, air_b = p[P_G1] * rise_s, p[P_G6] * rise_b
        air_h = 23.0 * max(rise_h, 0.0) ** 0.25 * p[P_AH] * rise_h
        flow_si = p[P_G23] * (rise_s - rise_i)
        flow_oh = p[P_G8] * (rise_o - rise_h)
        dts = ((1.0 - p[P_SHARE]) * h_r - air_s - flow_si) / p[P_CS]
        dti = (p[P_SHARE] * h_r + flow_si + p[P_G4] * (rise_ci - rise_i)) / p[P_CI]
        dtb = (p[P_G5] * (rise_ci - rise_b) + p[P_G5] * (rise_co - rise_b) - air_b) / p[P_CB]
        dto = (p[P_G7] * (rise_co - rise_o) - flow_oh) / p[P_CO]
        dth = (flow_oh - air_h) / p[P_CH]
        dx[s + S_TS], dx[s + S_TI], dx[s + S_TB], dx[s + S_TO], dx[s + S_TH] = dts, dti, dtb, dto, dth

        # ledgers
        dtc = (p[P_G4] * dti + p[P_G5] * dtb) / (p[P_G4] + p[P_G5])
        race_rate = p[P_URI] * dti + p[P_URC] * dtc - p[P_UOO] * dto - p[P_UOH] * dth
        gap_rate = p[P_UBI] * dti + p[P_UBC] * dtc - p[P_US] * dts
        dx[s + S_HR], dx[s + S_HI], dx[s + S_HO] = h_r, h_in, h_out
        dx[s + S_DN], dx[s + S_DB] = push[b, 4], loss_ball
        dx[s + S_DS] = p[P_CY] * svy * svy + p[P_CZ] * svz * svz
        dx[s + S_WG] = sum_race * race_rate + sum_ball * p[P_UB] * dtb - push[b, 3] * gap_rate
        dx[s + S_WC] = sum_cage * cage
        dx[s + S_LOST] = air_s + air_b + air_h

        out[b, O_HI], out[b, O_HO], out[b, O_ML] = h_in, h_out, m_load
        out[b, O_MS] = p[P_SPIN] * largest ** (4.0 / 3.0)
        out[b, O_TCI], out[b, O_TCO] = rise_ci, rise_co


@njit(cache=False)
def integrate(x, step, steps, record, spin_record, n, modal, gyro, weight, rows, unb_rows, unb, bear, azimuth, balls, glob):
    size = x.shape[0]
    k1, k2, k3, k4 = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
    scratch = np.zeros((bear.shape[0], O_COUNT))
    for i in range(steps + 1):
        derivative(x, k1, record[i], n, modal, gyro, weight, rows, unb_rows, unb, bear, azimuth, balls, glob)
        spin_record[i] = x[4 * n + 1]
        if i == steps:
            break
        derivative(x + 0.5 * step * k1, k2, scratch, n, modal, gyro, weight, rows, unb_rows, unb, bear, azimuth, balls, glob)
        derivative(x + 0.5 * step * k2, k3, scratch, n, modal, gyro, weight, rows, unb_rows, unb, bear, azimuth, balls, glob)
        derivative(x + step * k3, k4, scratch, n, modal, gyro, weight, rows, unb_rows, unb, bear, azimuth, balls, glob)
        for m in range(size):
            x[m] += step / 6.0 * (k1[m] + 2.0 * k2[m] + 2.0 * k3[m] + k4[m])
    return x


# ------------------------------------------------------------------------------------------------------------ simulation
class Drop:
    def __init__(self, case, rotor_data, alpha=None, mu=None):
        run, r = case["run"], case["rotor"]
        self.gravity = run["gravity"]
        self.speed = quantity(run["initial_speed"])
        self.alpha = r["mass_proportional_alpha"] if alpha is None else alpha
        self.mu = case["contact"]["friction_coefficient"] if mu is None else mu
        self.rotor = Rotor(rotor_data, r["cut_off_frequency"])
        self.names = [k for k in case if k.startswith("TB")]
        self.bearings = [Bearing(k, case, self.mu) for k in self.names]
        self.unb_rows = np.array([self.rotor.row(u["node"]) for u in r["unbalance"]])
        self.unb = np.array([[u["me"], quantity(u["angle"])] for u in r["unbalance"]])
        damping = 2 * r["modal_damping"] * self.rotor.omega          # zero for the rigid modes
        self.modal = np.array([self.rotor.omega**2, damping])
        self.rows = np.array([self.rotor.row(b.node) for b in self.bearings])
        self.n = len(self.rotor.omega)

    def initial_state(self):
        n, rotor = self.n, self.rotor
        base = 4 * n + 5
        x = np.zeros(base + len(self.bearings) * S_COUNT)
        rest = [b.static_ring(self.gravity) for b in self.bearings]
        self.static = dict(zip(self.names, rest))
        xa, xb = (rotor.x[rotor.index[b.node]] for b in self.bearings)
        slope = (rest[1][0] - rest[0][0]) / (xb - xa)
        line = np.zeros(2 * len(rotor.x))
        line[0::2], line[1::2] = rest[0][0] + slope * (rotor.x - xa), slope
        x[:2] = (rotor.shapes.T @ rotor.M @ line)[:2]                # a straight line has no flexible part
        x[4 * n + 1] = self.speed
        for i, b in enumerate(self.bearings):
            s = base + i * S_COUNT
            x[s + S_Y], x[s + S_SY] = rest[i]
            x[s + S_TS:s + S_TH + 1] = b.p[P_AMB]
        return x

    def mechanical_energy(self, x):
        n, base = self.n, 4 * self.n + 5
        q, v = x[:2 * n].reshape(2, n), x[2 * n:4 * n].reshape(2, n)
        energy = 0.5 * np.sum(v**2) + 0.5 * np.sum(self.modal[0] * q**2) + self.gravity * self.rotor.weight @ q[0]
        energy += 0.5 * self.rotor.polar_inertia * x[4 * n + 1] ** 2
        for i, b in enumerate(self.bearings):
            p, s = b.p, x[base + i * S_COUNT:base + (i + 1) * S_COUNT]
            energy += 0.5 * p[P_MR] * (s[S_VY] ** 2 + s[S_VZ] ** 2) + p[P_MR] * self.gravity * s[S_Y]
            energy += 0.5 * p[P_J] * s[S_SPEED] ** 2 + 0.5 * p[P_MS] * (s[S_SVY] ** 2 + s[S_SVZ] ** 2)
            energy += 0.5 * p[P_KY] * s[S_SY] ** 2 + 0.5 * p[P_KZ] * s[S_SZ] ** 2
            ts, ti, tb, to, th = s[S_TS:S_TH + 1] - p[P_AMB]
            tc = (p[P_G4] * ti + p[P_G5] * tb) / (p[P_G4] + p[P_G5])
            angle = s[S_CAGE] + b.azimuth
            br = (p[P_BR0] + (s[S_Y] - s[S_SY]) * np.cos(angle) + (s[S_Z] - s[S_SZ]) * np.sin(angle)
                  + p[P_URI] * ti + p[P_URC] * tc - p[P_UOO] * to - p[P_UOH] * th)
            delta = np.maximum(np.hypot(br, p[P_BX]) - p[P_A] + 2 * p[P_UB] * tb, 0.0)
            energy += 0.4 * p[P_KB] * np.sum(delta**2.5)
            gap = p[P_GAP] + p[P_UBI] * ti + p[P_UBC] * tc - p[P_US] * ts
            pen = max(math.hypot(self.rows[i] @ q[0] - s[S_Y], self.rows[i] @ q[1] - s[S_Z]) - gap, 0.0)
            energy += p[P_KC] * pen ** (p[P_NEXP] + 1) / (p[P_NEXP] + 1)
        return energy

    def run(self, step, end):
        n = self.n
        steps = int(round(end / step))
        x = self.initial_state()
        self.x0 = x.copy()
        most = max(len(b.azimuth) for b in self.bearings)
        azimuth = np.zeros((len(self.bearings), most))
        for i, b in enumerate(self.bearings):
            azimuth[i, :len(b.azimuth)] = b.azimuth
        balls = np.array([len(b.azimuth) for b in self.bearings])
        record = np.zeros((steps + 1, len(self.bearings), O_COUNT))
        spin = np.zeros(steps + 1)
        glob = np.array([self.gravity, self.alpha, self.rotor.polar_inertia])
        self.x1 = integrate(x, step, steps, record, spin, n, self.modal, self.rotor.gyro, self.rotor.weight, self.rows,
                            self.unb_rows, self.unb, np.array([b.p for b in self.bearings]), azimuth, balls, glob)
        self.time, self.record, self.spin = np.arange(steps + 1) * step, record, spin

    # ------------------------------------------------------------------------------------------------------- evaluation
    def episodes(self, i):
        """Contacts of bearing i as pairs of indices: first step inside, first step outside again (None if none)."""
        inside = self.record[:, i, O_PEN] > 0.0
        change = np.flatnonzero(inside[1:] != inside[:-1]) + 1
        starts, ends = change[0::2], list(change[1::2])
        if len(ends) < len(starts):
            ends.append(None)
        return list(zip(starts, ends))

    def crossing(self, values, k):
        """Time at which values, of different sign at k - 1 and k, is zero (linear)."""
        a, b = values[k - 1], values[k]
        return float(self.time[k - 1] + (self.time[k] - self.time[k - 1]) * a / (a - b))

    def bearing_summary(self, i):
        b, r, t = self.bearings[i], self.record[:, i], self.time
        p, s = b.p, self.x1[4 * self.n + 5 + i * S_COUNT:][:S_COUNT]
        spells = self.episodes(i)
        peak = int(np.argmax(r[:, O_FORCE]))
        apex = None
        if len(spells) > 1:
            apex = float(np.max(r[spells[0][1]:spells[1][0] + 1, O_Y]))
        lag = self.spin * p[P_RR] - r[:, O_SPEED] * p[P_RB] - 0.01 * self.spin * p[P_RR]
        caught = np.flatnonzero(lag < 0.0)
        tail = t >= t[-1] - 0.05 - 1e-9
        force = r[tail, O_FORCE]
        mean = float(np.sum((force[1:] + force[:-1]) / 2) / (len(force) - 1))
        rise = s[S_TS:S_TH + 1] - p[P_AMB]
        result = {
            "first_contact_time": self.crossing(r[:, O_PEN], spells[0][0]) if spells else None,
            "peak_contact_force": float(r[peak, O_FORCE]),
            "peak_contact_force_time": float(t[peak]),
            "first_bounce_apex": apex,
            "peak_friction_heat_rate": float(np.max(r[:, O_HR])),
            "friction_heat": float(s[S_HR]),
            "catch_up_time": self.crossing(lag, caught[0]) if len(caught) else None,
            "ring_speed_end": float(s[S_SPEED]),
            "mean_contact_force_end": mean,
            "load_torque_peak": float(np.max(r[:, O_ML])),
            "spin_torque_peak": float(np.max(r[:, O_MS])),
            "inner_heat_rate_max": float(np.max(r[:, O_HI])),
            "outer_heat_rate_max": float(np.max(r[:, O_HO])),
            "temperature_rise_end": {
                "shaft": float(rise[0]), "inner_ring": float(rise[1]), "inner_contact": float(r[-1, O_TCI]),
                "ball": float(rise[2]), "outer_contact": float(r[-1, O_TCO]), "outer_ring": float(rise[3]),
                "housing": float(rise[4])}}
        checks = {
            "ball_stiffness": b.Kb, "preload_offset": b.preload_offset, "ring_y_initial": self.static[b.name][0],
            "thermal_resistance": b.resistance, "capacity": [float(v) for v in p[P_CS:P_CH + 1]],
            "contacts": len(spells),
            "first_contacts": [[float(t[a]), None if z is None else float(t[z])] for a, z in spells[:6]],
            "internal_heat": float(s[S_HI] + s[S_HO]), "normal_contact_loss": float(s[S_DN]), "ball_loss": float(s[S_DB]),
            "support_loss": float(s[S_DS]), "growth_work": float(s[S_WG]), "cage_work": float(s[S_WC])}
        return result, checks

    def summary(self, step, end):
        n, base = self.n, 4 * self.n + 5
        blocks = [self.x1[base + i * S_COUNT:][:S_COUNT] for i in range(len(self.bearings))]
        first, last = self.mechanical_energy(self.x0), self.mechanical_energy(self.x1)
        deposited = sum(s[S_HR] + s[S_HI] + s[S_HO] for s in blocks)
        loss = self.x1[4 * n + 2] + self.x1[4 * n + 3] + deposited + sum(s[S_DN] + s[S_DB] + s[S_DS] for s in blocks)
        work_unb = self.x1[4 * n + 4]
        growth, cage = sum(s[S_WG] for s in blocks), sum(s[S_WC] for s in blocks)
        stored = sum(np.dot(b.p[P_CS:P_CH + 1], s[S_TS:S_TH + 1] - b.p[P_AMB]) for b, s in zip(self.bearings, blocks))
        lost = sum(s[S_LOST] for s in blocks)
        parts = [self.bearing_summary(i) for i in range(len(self.bearings))]
        return {
            "options": {"alpha": self.alpha, "mu": self.mu, "step": step, "end": end},
            "rotor": {"mass": float(self.rotor.mass), "polar_inertia": float(self.rotor.polar_inertia),
                      "diametral_inertia": float(self.rotor.diametral_inertia),
                      "free_free_frequencies": [float(f) for f in self.rotor.frequencies]},
            "bearings": {k: part[0] for k, part in zip(self.names, parts)},
            "rotor_speed_end": float(self.spin[-1]),
            "energy": {"mechanical_initial": float(first), "mechanical_final": float(last), "dissipated": float(loss),
                       "residual": float(first - last - loss + growth + cage + work_unb),
                       "heat_deposited": float(deposited), "heat_stored": float(stored), "heat_lost": float(lost),
                       "heat_residual": float(deposited - stored - lost)},
            "checks": {"next_frequency": float(self.rotor.next_frequency), "centre_of_mass": float(self.rotor.centre),
                       "modal_loss": float(self.x1[4 * n + 2]), "alpha_loss": float(self.x1[4 * n + 3]),
                       "unbalance_work": float(work_unb), "growth_work": float(growth), "cage_work": float(cage),
                       "bearings": {k: part[1] for k, part in zip(self.names, parts)}}}

    def save_series(self, path, interval=1e-4):
        every = max(1, int(round(interval / (self.time[1] - self.time[0]))))
        data = {"time": self.time[::every], "rotor_speed": self.spin[::every]}
        for i, name in enumerate(self.names):
            r = self.record[::every, i]
            data[name + "_y"], data[name + "_z"] = r[:, O_Y], r[:, O_Z]
            data[name + "_ring_y"], data[name + "_ring_z"] = r[:, O_RY], r[:, O_RZ]
            data[name + "_contact_force"], data[name + "_ring_speed"] = r[:, O_FORCE], r[:, O_SPEED]
        np.savez_compressed(path, **data)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--case", required=True, help="statement of values, TOML")
    parser.add_argument("--rotor", required=True, help="rotor, JSON")
    parser.add_argument("--alpha", type=float, help="mass-proportional damping, 1/s (default: the statement's)")
    parser.add_argument("--mu", type=float, help="friction coefficient (default: the statement's)")
    parser.add_argument("--step", type=float, default=5e-6, help="step, s (default 5e-6)")
    parser.add_argument("--end", type=float, help="end time, s (default: the statement's)")
    parser.add_argument("--out", help="summary, JSON (default: standard output)")
    parser.add_argument("--series", help="time series every 100 us, NPZ")
    args = parser.parse_args()
    with open(args.case, "rb") as f:
        case = tomllib.load(f)
    with open(args.rotor) as f:
        rotor = json.load(f)
    drop = Drop(case, rotor, args.alpha, args.mu)
    end = case["run"]["end_time"] if args.end is None else args.end
    began = time.time()
    drop.run(args.step, end)
    summary = drop.summary(args.step, end)
    text = json.dumps(summary, indent=2)
    if args.out:
        with open(args.out, "w") as f:
            f.write(text + "\n")
    else:
        print(text)
    if args.series:
        drop.save_series(args.series)
    e = summary["energy"]
    print(f"{time.time() - began:.1f} s; energy residual {e['residual']:.3e} J, heat residual {e['heat_residual']:.3e} J")


if __name__ == "__main__":
    main()
