"""Critical speeds of the reference rotor against a finite-element model written here, with numpy alone.

The element is built from its own description, not from formulas of the program: a Timoshenko beam's deflection under end
loads is a cubic whose section rotation is phi = v' + (EI / kGA) v''', so four cubics with unit end values give stiffness,
mass and rotary inertia by Gauss quadrature. In u = v + i w the spinning rotor on isotropic springs obeys
M u'' - i Omega G u' + K u = 0; with u = exp(+-i Omega t): (K - Omega^2 (M -+ G)) u = 0, forward with minus."""

import json
import math
import os
import shutil
import subprocess
import sys
import tomllib
import unittest
import xml.etree.ElementTree

import matplotlib.image
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, PROGRAM, ProgramTest  # noqa: E402

RPM = math.pi / 30


def element(length, outer, bore, material):
    E, nu, rho = material["E"], material["nu"], material["rho"]
    area, inertia = math.pi / 4 * (outer**2 - bore**2), math.pi / 64 * (outer**4 - bore**4)
    m = bore / outer
    # Cowper 1966, hollow circular section.
    kappa = 6 * (1 + nu) * (1 + m**2) ** 2 / ((7 + 6 * nu) * (1 + m**2) ** 2 + (20 + 12 * nu) * m**2)
    shear = kappa * E / (2 * (1 + nu)) * area
    lag = E * inertia / shear
    deflection = lambda x: numpy.array([1, x, x**2, x**3])  # noqa: E731
    rotation = lambda x: numpy.array([0, 1, 2 * x, 3 * x**2 + 6 * lag])  # noqa: E731
    ends = numpy.array([deflection(0), rotation(0), deflection(length), rotation(length)])
    shapes = numpy.linalg.inv(ends)  # columns: coefficients for a unit value of each degree of freedom
    K, M, G = numpy.zeros((4, 4)), numpy.zeros((4, 4)), numpy.zeros((4, 4))
    for s, weight in zip(*numpy.polynomial.legendre.leggauss(8)):
        x, weight = length * (s + 1) / 2, weight * length / 2
        v, phi = deflection(x) @ shapes, rotation(x) @ shapes
        bend = numpy.array([0, 0, 2, 6 * x]) @ shapes
        slip = numpy.array([0, 0, 0, -6 * lag]) @ shapes  # v' - phi
        K += weight * (E * inertia * numpy.outer(bend, bend) + shear * numpy.outer(slip, slip))
        M += weight * rho * (area * numpy.outer(v, v) + inertia * numpy.outer(phi, phi))
        G += weight * rho * 2 * inertia * numpy.outer(phi, phi)
    return K, M, G


SMALL = {
    "material": {"E": 2.07e11, "nu": 0.29, "rho": 7830.0},
    "nodes": [{"id": k + 1, "x": 0.1 * k} for k in range(5)],
    "elements": [{"n1": k, "n2": k + 1, "od": 0.04} for k in range(1, 5)],
    "mass_points": [{"node": 5, "mass": 8, "Ip": 0.25, "Id": 0.13}, {"node": 2, "mass": 4, "Ip": 0.01, "Id": 0.02}],
}


def one_plane(rotor):
    x = [node["x"] for node in rotor["nodes"]]
    n = 2 * len(x)
    K, M, G = numpy.zeros((n, n)), numpy.zeros((n, n)), numpy.zeros((n, n))
    for e in rotor["elements"]:
        at = slice(2 * e["n1"] - 2, 2 * e["n2"])
        for whole, part in zip((K, M, G), element(x[e["n2"] - 1] - x[e["n1"] - 1], e["od"], e.get("id_", 0), rotor["material"])):
            whole[at, at] += part
    for point in rotor["mass_points"]:
        at = 2 * point["node"] - 2
        M[at, at] += point["mass"]
        M[at + 1, at + 1] += point["Id"]
        G[at + 1, at + 1] += point["Ip"]
    return K, M, G


class DampedPeer:
    """The small rotor without damping of its own on supports {node: (K, C)} with full matrices, by its eigenvalues over the spin."""

    def __init__(self, supports):
        K, M, G = one_plane(SMALL)
        n = len(M)
        self.inverse = numpy.linalg.inv(numpy.kron(numpy.eye(2), M))
        self.K, self.C, self.G = numpy.kron(numpy.eye(2), K), numpy.zeros((2 * n, 2 * n)), numpy.kron([[0, 1], [-1, 0]], G)
        for node, (stiffness, damping) in supports.items():
            at = numpy.ix_([2 * node - 2, n + 2 * node - 2], [2 * node - 2, n + 2 * node - 2])
            self.K[at] += stiffness
            self.C[at] += damping

    def eigenvalues(self, spin):
        n = len(self.K)
        return numpy.linalg.eigvals(numpy.block([[numpy.zeros((n, n)), numpy.eye(n)], [-self.inverse @ self.K, -self.inverse @ (self.C + spin * self.G)]]))

    def critical_speeds(self, up_to, sense=1):
        """(speed, damping ratio): every eigenvalue that oscillates is followed to the nearest one at the next of many speeds."""
        nearest = lambda values, one: values[numpy.abs(values - one).argmin()]  # noqa: E731
        found, spins = [], numpy.concatenate([numpy.geomspace(0.07, up_to / 100, 100), numpy.linspace(up_to / 100, up_to, 900)[1:]])
        here = self.eigenvalues(sense * spins[0])
        for a, b in zip(spins, spins[1:]):
            there = self.eigenvalues(sense * b)
            for low in here[here.imag > 0.05 * abs(here)]:
                high = nearest(there, low)
                if (low.imag > a) == (high.imag > b):
                    continue
                from_, to = [a, low], [b, high]
                while to[0] - from_[0] > 1e-10 * b:
                    middle = 0.5 * (from_[0] + to[0])
                    value = nearest(self.eigenvalues(sense * middle), 0.5 * (from_[1] + to[1]))
                    (from_ if (value.imag > middle) == (low.imag > a) else to)[:] = middle, value
                speed, value = to
                self_consistent = abs(value.imag / speed - 1) < 1e-6
                if self_consistent and value.imag > 0.1 * abs(value):
                    found.append((speed, -value.real / abs(value)))
            here = there
        return sorted(found)


def peer_critical_speeds(springs):
    """(speed, direction) of the undamped reference rotor, rising; springs: stiffness by node."""
    K, M, G = one_plane(json.loads((PARAMS / "neisi2019-rotor.json").read_text()))
    for node, stiffness in springs.items():
        K[2 * node - 2, 2 * node - 2] += stiffness
    speeds = []
    for direction, inertia in (("forward", M - G), ("backward", M + G)):
        for value in numpy.linalg.eigvals(numpy.linalg.solve(K, inertia)):
            if value.real > 0:
                speeds.append((value.real**-0.5, direction))
    return sorted(speeds)


class CriticalSpeeds(ProgramTest):
    SUPPORTS = """
[bearings.A]
type = "linear"
node = 5
stiffness = [["4e7 N/m", 0], [0, "4e7 N/m"]]
[bearings.B]
type = "linear"
node = 27
stiffness = [["7e7 N/m", 0], [0, "7e7 N/m"]]
"""

    def critical(self, *arguments):
        return json.loads(self.succeed("critical-speeds", *arguments, "--json").stdout)

    def undamped(self):
        return self.case(self.SUPPORTS + "[rotor]\nmodal_damping = 0\n")

    def test_they_are_those_of_an_independent_model(self):
        found = self.critical(self.undamped(), "--up-to", "60000 rpm")
        expected = [pair for pair in peer_critical_speeds({5: 4e7, 27: 7e7}) if pair[0] < 60000 * RPM]
        self.assertGreaterEqual(len(expected), 5)
        self.assertEqual([one["whirl"] for one in found["critical_speeds"]], [direction for _, direction in expected])
        for one, (speed, _) in zip(found["critical_speeds"], expected):
            # Two double-precision eigenvalue problems; the rotor's stiffness matrix spans eight orders of magnitude.
            self.assertLess(abs(one["speed"] / speed - 1), 1e-6)
            self.assertAlmostEqual(one["frequency"], one["speed"] / (2 * math.pi), places=9)

    def test_springs_can_be_put_at_the_bearings_of_a_case_that_has_only_touchdown_bearings(self):
        found = self.critical("reference.toml", "--stiffness", "5e7 N/m", "--set", "rotor.modal_damping=0")
        self.assertEqual(found["stations"], ["TB1", "TB2"])
        self.assertEqual(self.critical("reference.toml")["supports"], "free-free")
        case = tomllib.loads((self.folder / "reference.toml").read_text())
        springs = {case["bearings"][name]["node"]: 5e7 for name in ("TB1", "TB2")}
        expected = [speed for speed, _ in peer_critical_speeds(springs) if speed < found["up_to"]]
        self.assertEqual(len(found["critical_speeds"]), len(expected))
        for one, speed in zip(found["critical_speeds"], expected):
            self.assertLess(abs(one["speed"] / speed - 1), 1e-6)

    def test_the_map_has_the_speeds_of_each_stiffness(self):
        found = self.critical("reference.toml", "--map", "1e6 N/m, 1e9 N/m", "--up-to", "40000 rpm")
        stiffness = [row["stiffness"] for row in found["map"]]
        self.assertAlmostEqual(stiffness[0], 1e6)
        self.assertAlmostEqual(stiffness[-1] / 1e9, 1)
        for row in found["map"][::20]:
            alone = self.critical("reference.toml", "--stiffness", f"{row['stiffness']} N/m", "--up-to", "40000 rpm", "--set", "rotor.modal_damping=0")
            speeds = [one["speed"] for one in alone["critical_speeds"]]
            self.assertEqual(len(speeds), len(row["speeds"]))
            for a, b in zip(speeds, row["speeds"]):
                self.assertLess(abs(a / b - 1), 1e-6)
        # Stiffer supports raise every critical speed (Rayleigh).
        for below, above in zip(found["map"], found["map"][1:]):
            for a, b in zip(below["speeds"], above["speeds"]):
                self.assertGreaterEqual(b, a * (1 - 1e-9))

    def test_the_table_and_the_picture_show_the_same(self):
        case = self.undamped()
        done = self.succeed("critical-speeds", case, "--map", "1e6 N/m, 1e9 N/m", "--diagram", "picture.svg")
        found = self.critical(case)["critical_speeds"]
        self.assertGreater(len(found), 2)
        for one in found:
            self.assertRegex(done.stdout, rf"{one['speed'] / RPM:.1f} rpm +{one['frequency']:.3f} Hz +{one['whirl']}")
        svg = xml.etree.ElementTree.parse(self.folder / "picture.svg").getroot()
        self.assertEqual(len(svg.findall("{*}circle")), len(found))
        self.assertGreater(len(svg.findall("{*}path")), 200)
        _, _, width, height = map(float, svg.get("viewBox").split())
        for circle in svg.findall("{*}circle"):
            self.assertTrue(0 < float(circle.get("cx")) < width and 0 < float(circle.get("cy")) < height)

    def test_the_picture_is_drawn_as_png(self):
        options = ("critical-speeds", "reference.toml", "--diagram", "picture.png")
        nowhere = subprocess.run([PROGRAM, *options], cwd=self.folder, env={**os.environ, "PATH": str(self.folder)}, capture_output=True, text=True)
        self.assertEqual(nowhere.returncode, 2)
        self.assertIn("Install the package librsvg2-bin", nowhere.stderr)
        if not shutil.which("rsvg-convert"):
            self.skipTest("rsvg-convert is not installed")
        self.succeed(*options)
        self.succeed("critical-speeds", "reference.toml", "--diagram", "picture.svg")
        _, _, width, height = map(float, xml.etree.ElementTree.parse(self.folder / "picture.svg").getroot().get("viewBox").split())
        picture = matplotlib.image.imread(self.folder / "picture.png")
        self.assertEqual(picture.shape[:2], (2 * height, 2 * width))
        inked = picture[:, :, :3].min(axis=2) < 0.9
        self.assertTrue(0.005 < inked.mean() < 0.2, "curves and letters on an empty ground")
        self.assertEqual(sorted(file.name for file in self.folder.glob("picture.*")), ["picture.png", "picture.svg"], "nothing is left beside it")

    def test_overdamped_motions_are_kept_apart(self):
        damped = self.SUPPORTS.replace("[bearings.B]", 'damping = [["2e6 N s/m", 0], [0, "2e6 N s/m"]]\n[bearings.B]')
        free, held = self.critical(self.undamped()), self.critical(self.case(damped, "damped.toml"))
        self.assertEqual(free["overdamped_modes"], 0)
        self.assertGreater(held["overdamped_modes"], 0)
        self.assertLess(len(held["critical_speeds"]), len(free["critical_speeds"]))

    def on_films(self, supports, *options, speed="9000 rpm"):
        """The small rotor on supports {node: (K, C)}."""
        (self.folder / "small.json").write_text(json.dumps(SMALL))
        text = f'[run]\ninitial_speed = "{speed}"\nend_time = "1 ms"\n[rotor]\ngeometry = "small.json"\nmodal_damping = 0\n'
        for node, (stiffness, damping) in supports.items():
            text += f'[bearings.N{node}]\ntype = "linear"\nnode = {node}\nstiffness = {stiffness}\ndamping = {damping}\n'
        return self.critical(self.write("films.toml", text), *options)

    # Dampers and cross-coupled springs as of journal bearings: K_yy, K_zz, K_yz = -K_zy and C at two nodes.
    FILMS = {
        "two dampers": {1: (2.5e7, 2.5e7, 0, 1.6e5), 4: (1.4e8, 1.4e8, 0, 3.85e4)},
        "a soft, slow mode": {1: (2.149706e7, 1.61e4, 0, 6.69e4), 4: (4.39e4, 4.39e4, 1.63367e6, 7.326e4)},
        "a slow pair": {1: (6.346e7, 3.2488e7, 2.33425e8, 8.27133e5), 4: (2.22565e7, 1.63905e7, 1.62461e7, 6.69384e4)},
        "unstable": {1: (2e7, 2e7, 1.2e8, 3e5), 4: (2e7, 2e7, 1.2e8, 3e5)},
        "thick films": {1: (1e6, 1e6, 4.5e8, 2e6), 4: (3e6, 1e6, 2e8, 1e6)},
        "thin dampers": {1: (1e7, 8e6, 4e5, 1e3), 4: (2e7, 2e7, 1e6, 3e3)},
    }

    def test_none_is_missed_on_damped_and_cross_coupled_supports(self):
        for name, films in self.FILMS.items():
            supports = {node: ([[K_y, K], [-K, K_z]], [[C, 0.0], [0.0, C]]) for node, (K_y, K_z, K, C) in films.items()}
            for speed, sense in (("9000 rpm", 1), ("-9000 rpm", -1)):
                if sense < 0 and name != "unstable":
                    continue
                with self.subTest(films=name, speed=speed):
                    found = self.on_films(supports, "--up-to", "20000 rpm", speed=speed)
                    expected = DampedPeer(supports).critical_speeds(20000 * RPM, sense)
                    self.assertGreater(len(expected), 0)
                    # Bisection to 1e-10; the two double-precision eigenvalue problems agree to 1e-8.
                    numpy.testing.assert_allclose([[one["speed"], one["damping_ratio"]] for one in found["critical_speeds"]], expected, rtol=1e-6, atol=1e-7)
                    self.assertEqual(found.get("spin"), "negative" if sense < 0 else None)

    def test_with_negative_spin_forward_whirl_is_that_of_the_mirrored_supports(self):
        """Mirrored at the x-y plane the rotor spins the other way, and K_yz and K_zy change their signs."""
        films = lambda K: {1: ([[1e7, K], [-K, 1e7]], [[1.5e3, 0.0], [0.0, 1.5e3]]), 4: ([[1e7, 0.0], [0.0, 1e7]], [[5e2, 0.0], [0.0, 5e2]])}  # noqa: E731
        there, back = self.on_films(films(2e6)), self.on_films(films(-2e6), speed="-9000 rpm")
        other = self.on_films(films(2e6), speed="-9000 rpm")
        whirl = [one["whirl"] for one in there["critical_speeds"]]
        self.assertTrue({"forward", "backward"} <= set(whirl))
        self.assertEqual([one["whirl"] for one in back["critical_speeds"]], whirl)
        damping = lambda found: [one["damping_ratio"] for one in found["critical_speeds"]]  # noqa: E731
        numpy.testing.assert_allclose(damping(back), damping(there), rtol=1e-6, atol=1e-9)
        self.assertTrue(any(a * b < 0 for a, b in zip(damping(other), damping(there))), "the coupling drives the other whirl")
        self.assertIn("rpm of negative spin; supports", self.succeed("critical-speeds", "films.toml").stdout)
        self.assertEqual(back["operating_speed"], there["operating_speed"])

    def test_motions_that_diverge_are_told_from_those_that_creep_back(self):
        supports = {1: ([[1e7, 2e7], [2e7, 1e7]], [[1.5e3, 0.0], [0.0, 1.5e3]]), 4: ([[1e7, 0.0], [0.0, 1e7]], [[5e2, 0.0], [0.0, 5e2]])}
        found = self.on_films(supports)
        values = DampedPeer(supports).eigenvalues(found["up_to"])
        real = values[abs(values.imag) <= 0.1 * abs(values)].real
        self.assertGreater(real.max(), 100)
        self.assertEqual(found["diverging_modes"], numpy.count_nonzero(real > 0))
        self.assertEqual(found["overdamped_modes"], numpy.count_nonzero(real < 0))
        self.assertAlmostEqual(found["divergence_rate"] / real.max(), 1, places=8)
        self.assertEqual(found["units"]["divergence_rate"], "1/s")
        screen = self.succeed("critical-speeds", "films.toml").stdout
        self.assertIn(f"1 motion diverges without oscillation, growing by up to {real.max():.4g} 1/s", screen)
        at_rest = DampedPeer(supports).eigenvalues(0).real.max()
        one = json.loads(self.succeed("modes", "films.toml", "--speeds", "0", "--json").stdout)["speeds"][0]
        self.assertEqual((one["diverging_modes"], one["overdamped_modes"]), (1, 1))
        self.assertAlmostEqual(one["divergence_rate"] / at_rest, 1, places=8)
        self.assertIn(f"growing by up to {at_rest:.4g} 1/s", self.succeed("modes", "films.toml", "--speeds", "0").stdout)

    def test_no_speed_is_lost_to_springs_that_are_too_stiff(self):
        """Where both have the speeds of a pinned rotor, springs hold it; where rounding decides, nothing is left out in silence."""
        speeds = {}
        for stiffness in ("1e14 N/m", "1e17 N/m"):
            done = self.succeed("critical-speeds", "reference.toml", "--stiffness", stiffness, "--json")
            speeds[stiffness] = [one["speed"] for one in json.loads(done.stdout)["critical_speeds"]]
            self.assertIn("it is most often <= 1e+12 N/m", done.stderr)
        self.assertGreaterEqual(len(speeds["1e14 N/m"]), 2)
        numpy.testing.assert_allclose(speeds["1e17 N/m"], speeds["1e14 N/m"], rtol=1e-5, err_msg="a part of 1e-5 of the rotor's flexibility is left at 1e14 N/m")
        for stiffness in ("5e18 N/m", "1e20 N/m", "1e25 N/m", "1e300 N/m"):
            done = self.call("critical-speeds", "reference.toml", "--stiffness", stiffness)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("lost in rounding", done.stderr)

    def test_bad_options_are_refused(self):
        for option, value, message in (("--up-to", "-5 rpm", "larger than 0"), ("--stiffness", "5 mm", "N/m"), ("--map", "1e6 N/m", "Write it as"),
                                       ("--map", "1e9 N/m, 1e6 N/m", "Exchange")):
            done = self.call("critical-speeds", "reference.toml", option, value)
            self.assertEqual(done.returncode, 2, value)
            self.assertIn(message, done.stderr)
        jpeg = self.call("critical-speeds", "reference.toml", "--diagram", "there.jpg")
        self.assertEqual(jpeg.returncode, 2)
        self.assertIn("ends in .svg or .png", jpeg.stderr)
        self.write("there.svg", "mine")
        self.assertEqual(self.call("critical-speeds", "reference.toml", "--diagram", "there.svg").returncode, 2)
        self.assertEqual((self.folder / "there.svg").read_text(), "mine")

    def test_of_its_usual_name_only_its_own_picture_is_replaced(self):
        picture = self.folder / "out/reference/campbell.svg"
        self.succeed("critical-speeds", "reference.toml")
        self.succeed("critical-speeds", "reference.toml", "--up-to", "9000 rpm")
        picture.write_text("<svg>mine</svg>")
        refused = self.call("critical-speeds", "reference.toml")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--diagram FILE", refused.stderr)
        self.assertEqual(picture.read_text(), "<svg>mine</svg>")


if __name__ == "__main__":
    unittest.main()
