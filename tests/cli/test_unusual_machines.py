"""Slips that need a look at the machine: long elements of a shaft, inertia of rings, magnets, thin journals, the way of heat. Warnings, each with its reason."""

import json
import math
import pathlib
import re
import sys
import tomllib
import unittest

import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest  # noqa: E402

MANY_PARTS = pathlib.Path(__file__).resolve().parents[1] / "faults/many-parts.toml"
MACHINE = """
[run]
initial_speed = "9000 rpm"
end_time = "0.1 s"
[rotor]
geometry = "shaft.csv"
[contact]
air_gap = "0.25 mm"
friction_coefficient = 0.2
[bearings]
housing_length = "25 mm"
housing_diameters = ["125 mm", "180 mm"]
support = { mass = "3 kg", K_y = "2e8 N/m", K_z = "2e8 N/m", C_y = "4e3 N s/m", C_z = "4e3 N s/m" }
"""


class UnusualMachines(ProgramTest):
    def said(self, *arguments, code=0):
        done = self.call(*arguments)
        if code is not None:
            self.assertEqual(done.returncode, code, done.stderr)
        return re.sub(r"\s+", " ", done.stderr)

    def machine(self, rows, nodes=(1, None), text="", bore=0):
        """A shaft of rows [length, diameter] in mm on two bearings 6016."""
        self.write("shaft.csv", "length [mm], outer_diameter [mm], bore [mm]\n" + "".join(f"{length}, {od}, {bore}\n" for length, od in rows))
        nodes = [node or len(rows) + 1 for node in nodes]
        return self.write("machine.toml", MACHINE + "".join(f'[bearings.TB{k}]\ntype = "touchdown"\ncatalogue = "6016"\nnode = {node}\n' for k, node in enumerate(nodes, 1)) + text)

    # -- long elements

    def test_a_shaft_of_three_rows_is_told_with_the_error_of_its_modes(self):
        """The frequencies are those of beams assembled here: as given, and of 40 elements."""
        coarse = self.machine([(60, 79.5), (1000, 90), (60, 79.5)])
        said = self.said("check", coarse)
        found = re.search(r"shaft\.csv:3.*elements of the rotor are too long for its bending: mode (\d) of the free shaft lies at ([0-9.]+) Hz, and ([0-9.]+) % lower, at ([0-9.]+) Hz", said)
        self.assertTrue(found, said)
        self.assertIn("element 2 (1000 mm: ", said)
        pieces = int(re.search(r"element 2 \(1000 mm: (\d+) pieces\)", said)[1])
        for command in (["modes", coarse, "--shapes", "m.h5"], ["critical-speeds", coarse]):
            self.assertIn("too long for its bending", self.said(*command))
        # As many rows as it says: silent, and the mode lies where it said, and where a beam of 40 elements has it.
        fine = self.machine([(60, 79.5)] + [(1000 / pieces, 90)] * pieces + [(60, 79.5)])
        self.assertEqual(self.said("check", fine), "")
        mode = int(found[1])
        self.assertAlmostEqual(beam_frequencies([(60, 79.5), (1000, 90), (60, 79.5)])[mode - 1] / float(found[2]), 1, delta=1e-3)
        exact = beam_frequencies([(60, 79.5)] + [(25, 90)] * 40 + [(60, 79.5)])[mode - 1]
        self.assertAlmostEqual(float(found[4]) / exact, 1, delta=2e-3)
        self.assertAlmostEqual(float(found[3]) / 100, 1 - exact / float(found[2]), delta=6e-3)

    def test_the_advice_on_long_elements_is_of_the_file_that_has_them(self):
        rows = [(60, 79.5), (1000, 90), (60, 79.5)]
        case = self.machine(rows)
        self.assertIn("A row of the shaft's table is one beam element", self.said("check", case))
        nodes = [{"id": k + 1, "x": 1e-3 * sum(length for length, _ in rows[:k])} for k in range(len(rows) + 1)]
        elements = [{"id": k, "n1": k, "n2": k + 1, "length": 1e-3 * length, "od": 1e-3 * od, "id_": 0} for k, (length, od) in enumerate(rows, 1)]
        self.write("shaft.json", json.dumps({"material": {"E": 2.1e11, "nu": 0.3, "rho": 7850}, "nodes": nodes, "elements": elements, "mass_points": []}))
        text = (self.folder / case).read_text()
        self.assertIn('"shaft.csv"', text)
        said = self.said("check", self.write("json.toml", text.replace('"shaft.csv"', '"shaft.json"')))
        self.assertIn("Cut them into several elements of the same diameter, with nodes between, here element 2", said)
        self.assertNotIn("table", said)

    def test_elements_long_for_a_fast_rotor_alone_are_told(self):
        # Seven elements are fine for the first two modes, not for the sixth, which is below twice 60 000 rpm.
        case = self.machine([(160, 30)] * 7)
        self.assertNotIn("too long", self.said("check", case, "--set", 'run.initial_speed="600 rpm"'))
        said = self.said("check", case, "--set", 'run.initial_speed="60000 rpm"')
        found = re.search(r"too long for its bending: mode (\d) of the free shaft lies at ([0-9.]+) Hz", said)
        frequencies = beam_frequencies([(160, 30)] * 7)
        self.assertAlmostEqual(float(found[2]) / frequencies[int(found[1]) - 1], 1, delta=1e-3)
        self.assertGreater(int(found[1]), 2)
        self.assertLess(beam_frequencies([(40, 30)] * 28)[int(found[1]) - 1], 2000)

    def test_shipped_shafts_are_fine_enough(self):
        for case in ("neisi2019.toml", "own-machine/drop.toml"):
            self.assertEqual(self.said("check", PARAMS / case), "")

    # -- rings

    def test_a_spin_inertia_that_is_not_the_rings_is_told(self):
        inertia = tomllib.loads((PARAMS / "neisi2019.toml").read_text())["bearings"]["TB1"]["ring_spin_inertia"]
        value = float(inertia.split()[0])
        # Of the ring alone: m (r1^2 + r2^2) / 2; balls add some tens of per cent.
        ring = 0.5 * 0.21 * (0.035**2 + 0.039**2)
        for factor, is_told in ((10, True), (0.1, True), (4, True), (1.5, False), (0.7, False)):
            said = self.said("check", "reference.toml", "--set", f"bearings.TB1.ring_spin_inertia={factor * value}")
            self.assertEqual("TB1.ring_spin_inertia is" in said, is_told, (factor, said))
            if is_told:
                told = float(re.search(r"of this mass and these diameters has about ([0-9.e-]+) kg m2", said)[1])
                self.assertGreater(told, 0.98 * ring)
                self.assertLess(told, 1.4 * ring)

    def test_every_bearing_of_the_catalogue_has_its_own_spin_inertia(self):
        for file in sorted((PARAMS / "bearings").glob("*.toml")):
            size = tomllib.loads(file.read_text())
            bore, outside = (float(size[key].split()[0]) for key in ("bore_diameter", "outside_diameter"))
            self.write("drop.toml", f'base = "reference.toml"\n[bearings.TB1]\ncatalogue = "{file.stem}"\nbore_radius = "{bore / 2} mm"\nhousing_diameters = ["{outside} mm", "{1.3 * outside} mm"]\n')
            self.assertNotIn("ring_spin_inertia is", self.said("check", "drop.toml"), file.stem)

    # -- magnets

    MAGNET = '[bearings.M{k}]\ntype = "magnet"\nnode = {node}\nstiffness = [["{K}", 0], [0, "{K}"]]\ndamping = [["5e3 N s/m", 0], [0, "5e3 N s/m"]]\nrelease_time = ["10 ms", "10 ms"]\n'

    def with_magnets(self, K="1e7 N/m"):
        # 12 equal elements: the centre of gravity is at node 7.
        return self.machine([(100, 79.5)] * 12, (2, 12), "".join(self.MAGNET.format(k=k, node=node, K=K) for k, node in ((1, 4), (2, 10))))

    def test_a_magnet_that_must_pull_down_is_told(self):
        case = self.with_magnets()
        self.assertEqual(self.said("check", case), "")
        weight = 7800 * math.pi / 4 * 0.0795**2 * 1.2 * 9.81
        # Half of the weight each is balance; M1 with 3 times the weight leaves -2 of it to M2.
        self.assertEqual(self.said("check", case, "--set", f'bearings.M1.holding_force=["{0.5 * weight} N", "0 N"]'), "")
        said = self.said("check", case, "--set", f'bearings.M1.holding_force=["{3 * weight} N", "0 N"]')
        found = re.search(r"bearings\.M2 must pull the rotor down with (-?[0-9.]+) N along y, where the rotor's weight is (-?[0-9.]+) N", said)
        self.assertTrue(found, said)
        self.assertAlmostEqual(float(found[1]), -2 * weight, delta=2e-3 * weight)
        self.assertAlmostEqual(float(found[2]), -weight, delta=1e-3 * weight)
        said = self.said("check", case, "--set", f'bearings.M1.holding_force=["{-4 * weight} N", "0 N"]')
        self.assertRegex(said, r"bearings\.M2 must hold the rotor with")

    def test_magnets_too_soft_for_their_rotor_are_told(self):
        said = self.said("check", self.with_magnets("1e4 N/m"))
        mass = 7800 * math.pi / 4 * 0.0795**2 * 1.2
        found = re.search(r"with 2e\+04 N/m along y, on which it swings at ([0-9.]+) Hz", said)
        self.assertAlmostEqual(float(found[1]), math.sqrt(2e4 / mass) / (2 * math.pi), delta=0.05)
        self.assertNotIn("swings", self.said("check", self.with_magnets("1e6 N/m")))

    # -- supports

    def test_supports_that_do_nothing_are_told(self):
        ribbon = 'bearings.TB1.support={{ type = "ribbon", mass = "1 kg", ribbon = {{ stiffness = 4e7, slip_force = {}, stick_stiffness = 4e8 }} }}'
        self.assertRegex(self.said("check", "reference.toml", "--set", ribbon.format(2e4)), r"slip_force = 2e\+04 N is 37\.\d times this bearing's share .* it never slips")
        self.assertNotIn("slips", self.said("check", "reference.toml", "--set", ribbon.format(5e3)))
        elastomer = 'bearings.TB1.support={{ type = "elastomer", mass = "1 kg", elastomer = {{ storage = [["10 Hz", "8 MPa"], ["1000 Hz", "13 MPa"]], loss = [["10 Hz", "0.9 MPa"], ["1000 Hz", "2 MPa"]], shape_factor = "{} m", fit_tolerance = 0.1 }} }}'
        self.assertRegex(self.said("check", "reference.toml", "--set", elastomer.format(90)), r"support\.elastomer has 7\.2e\+08 N/m at its lowest frequency; O-rings have 1e6 to 1e8 N/m")
        self.assertNotIn("O-rings", self.said("check", "reference.toml", "--set", elastomer.format(3)))
        thrust = ["check", PARAMS / "neisi2019-thrust.toml", "--set"]
        self.assertRegex(self.said(*thrust, 'bearings.TB2.shoulders.gap_plus_x="3 mm"'), r"gap_plus_x = 3 mm is unusual")
        self.assertEqual(self.said(*thrust, 'bearings.TB2.shoulders.gap_plus_x="0.5 mm"'), "")

    def test_the_way_of_heat_through_a_support_that_is_no_metal_fit(self):
        case = PARAMS / "own-machine/drop.toml"
        self.assertEqual(self.said("check", case), "", "within 0.3 s it does not matter")
        for long in ('run.end_time="100 s"', "preload.force=[0, 0, 0]"):
            said = self.said("check", case, "--set", long)
            for name in ("TB1", "TB2"):
                self.assertRegex(said, rf"the outer ring of bearings\.{name} is carried by a ribbon, but its heat goes to the housing through a metal fit: thermal\.fit_resistance is its default, 0\.005 K/W")
            self.assertEqual(self.said("check", case, "--set", long, "--set", 'thermal.fit_resistance="0.2 K/W"'), "")
        self.assertEqual(self.said("check", PARAMS / "neisi2019-coast-down.toml"), "")
        # `preload` follows heat for hours, whatever the case says.
        self.assertIn("carried by a ribbon", self.said("preload", case, "--bearing", "TB2", "-o", "out", "--set", "preload.critical_values=false", "--set", 'preload.end_time="1 s"', code=None))
        # Keys that have no part in it.
        keys = ("--set", "thermal.growth=false", "--set", 'bearings.TB2.cage="free"', "--set", "preload.critical_values=false", "--set", 'preload.end_time="1 s"')
        said = self.said("preload", case, "--bearing", "TB2", "-o", "unused", *keys, code=None)
        self.assertIn("thermal.growth = false is not for `preload`", said)
        self.assertIn('bearings.TB2.cage = "free" is not for `preload`', said)
        self.assertNotIn("is not for", self.said("check", case, *keys[:4]))
        # Nor has what rolling contacts conduct by, where they do not.
        for key in ('oil_film="0.1 um"', 'ball_track="wandering"'):
            for way, is_told in (("fixed", True), ("rolling", False)):
                said = self.said("check", case, "--set", f"thermal.{key}", "--set", f'thermal.contact_conduction="{way}"')
                self.assertEqual(f"thermal.{key.partition('=')[0]} does not count" in said, is_told)
        # O-rings have 1 to 30 K/W, a ribbon has not.
        for file, is_told in ((case, True), (MANY_PARTS, False)):
            self.assertEqual("fit_resistance = 12 K/W is unusual" in self.said("check", file, "--set", 'thermal.fit_resistance="12 K/W"'), is_told)

    # -- hollow journals

    def test_a_journal_with_a_thin_wall_is_told(self):
        rows = [(100, 79.5)] * 12
        for bore, is_told in ((0, False), (40, False), (60, True)):
            said = self.said("check", self.machine(rows, (2, 12), bore=bore))
            self.assertEqual("TB1 is a tube with a wall of" in said, is_told, said)
            if is_told:
                # The journal is the bore of 80 mm less twice the air gap.
                self.assertIn(f"a wall of {(79.5 - bore) / 2:.4g} mm, {(79.5 - bore) / 79.5:.2g} of its radius", said)
        self.assertNotIn("tube", self.said("check", "machine.toml", "--set", "bearings.contact_stiffness=8e9"))


def beam_frequencies(rows, E=2e11, nu=0.3, rho=7800.0):
    """Bending frequencies of a free Timoshenko beam of round rows [length, diameter] in mm [Hz]: Przemieniecki's element, assembled independently of the program."""
    n = 2 * (len(rows) + 1)
    K, M = numpy.zeros((n, n)), numpy.zeros((n, n))
    for k, (length, diameter) in enumerate(rows):
        L, d = length * 1e-3, diameter * 1e-3
        A, I, G = math.pi * d**2 / 4, math.pi * d**4 / 64, E / (2 * (1 + nu))
        kappa = 6 * (1 + nu) / (7 + 6 * nu)
        p = 12 * E * I / (kappa * G * A * L**2)
        stiffness = E * I / (L**3 * (1 + p)) * numpy.array([[12, 6 * L, -12, 6 * L], [6 * L, (4 + p) * L**2, -6 * L, (2 - p) * L**2], [-12, -6 * L, 12, -6 * L], [6 * L, (2 - p) * L**2, -6 * L, (4 + p) * L**2]])
        # Consistent mass by Simpson's rule on a fine grid of the element's own shape functions.
        x = numpy.linspace(0, 1, 201)
        w = numpy.full(201, 2.0)
        w[1::2], w[0], w[-1] = 4.0, 1.0, 1.0
        w *= L / 600
        N = numpy.array([1 - 3 * x**2 + 2 * x**3 + p * (1 - x), L * (x - 2 * x**2 + x**3 + p / 2 * (x - x**2)), 3 * x**2 - 2 * x**3 + p * x, L * (x**3 - x**2 - p / 2 * (x - x**2))]) / (1 + p)
        T = numpy.array([6 / L * (x**2 - x), 1 - 4 * x + 3 * x**2 + p * (1 - x), 6 / L * (x - x**2), 3 * x**2 - 2 * x + p * x]) / (1 + p)
        mass = rho * (A * (N * w) @ N.T + I * (T * w) @ T.T)
        at = slice(2 * k, 2 * k + 4)
        K[at, at] += stiffness
        M[at, at] += mass
    values = numpy.sort(numpy.linalg.eigvals(numpy.linalg.solve(M, K)).real)
    return numpy.sqrt(values[2:]) / (2 * math.pi)


if __name__ == "__main__":
    unittest.main()
