"""`rotordrop heat` on plain sections: heat in interfaces, held bodies, displacements and fits, against closed forms.

Free ring under T(r): by Betti's theorem the mean of u over bore or length follows from the volume mean of the rise,
  mean u_r(a) = alpha a mean,   mean u_x(right) - mean u_x(left) = alpha L mean;
between two held radii the rise goes as the logarithm, whose mean over the volume is
  theta_a + (theta_b - theta_a) (b^2 ln(b/a) - (b^2 - a^2)/2)/((b^2 - a^2) ln(b/a)).

Two rings a < r < b < r < c of equal width, shrunk with d_0 by radius and held at their temperatures (Lame, plane stress):
  p = d/{b/E_2 [(c^2 + b^2)/(c^2 - b^2) + nu_2] + b/E_1 [(b^2 + a^2)/(b^2 - a^2) - nu_1]},  d = d_0 + b (alpha_1 theta_1 - alpha_2 theta_2),
  u(a) = alpha_1 a theta_1 - 2 p a b^2/(E_1 (b^2 - a^2)),  u(c) = alpha_2 c theta_2 + 2 p b^2 c/(E_2 (c^2 - b^2)).
"""

import math
import pathlib
import sys
import unittest

import h5py

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, ProgramTest  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()

RINGS = """
output_times = ["1 s"]
[materials.one]
rho = 7800
k = 46
c = 460
E = "205 GPa"
nu = 0.3
alpha = 11.8e-6
[materials.two]
rho = 2700
k = 150
c = 900
E = "70 GPa"
nu = 0.33
alpha = 23e-6
[[section.rectangle]]
name = "ring"
x = [0, "16 mm"]
r = ["46 mm", "50 mm"]
material = "one"
temperature = "343.15 K"
[[section.rectangle]]
name = "housing"
x = [0, "16 mm"]
r = ["50 mm", "60 mm"]
material = "two"
temperature = "303.15 K"
[[interface]]
between = ["ring.outer", "housing.inner"]
resistance = 1e-3
[[fit]]
name = "seat"
between = ["ring.outer", "housing.inner"]
interference = "10 um"
[[displacement]]
name = "bore"
boundary = "ring.inner"
[[displacement]]
name = "rim"
x = "8 mm"
r = "60 mm"
"""

FREE = """
output_times = [1000]
[[section.rectangle]]
name = "ring"
x = [0, "30 mm"]
r = ["20 mm", "45 mm"]
material = "steel"
[[fixed]]
boundary = "ring.inner"
temperature = "393.15 K"
[[fixed]]
boundary = "ring.outer"
temperature = "313.15 K"
[[displacement]]
name = "bore"
boundary = "ring.inner"
[[displacement]]
name = "outside"
boundary = "ring.outer"
[[displacement]]
name = "left"
boundary = "ring.left"
[[displacement]]
name = "right"
boundary = "ring.right"
"""

JOINT = RINGS.partition("[[fit]]")[0].replace('temperature = "343.15 K"\n', "").replace('temperature = "303.15 K"\n', "") + """
[[flux]]
between = ["ring.outer", "housing.inner"]
times = [0, 0.2]
values = [1e5, 0]
[[probe]]
name = "seat"
boundary = "ring.outer"
"""


class Faults(ProgramTest):
    def fault(self, text):
        done = self.call("check", self.write("case.toml", text))
        self.assertEqual(done.returncode, 2, done.stderr)
        return done.stderr

    def test_a_flux_into_an_interface_needs_one(self):
        self.assertIn("there is no interface between", self.fault(JOINT.replace('[[flux]]\nbetween = ["ring.outer", "housing.inner"]', '[[flux]]\nbetween = ["ring.left", "housing.inner"]')))
        self.assertIn("does not say where the heat enters", self.fault(JOINT.replace('[[flux]]\nbetween = ["ring.outer", "housing.inner"]', "[[flux]]")))
        self.assertIn("has both boundary and between", self.fault(JOINT.replace("[[flux]]", '[[flux]]\nboundary = "ring.left"')))
        self.assertIn("belongs to a flux into an interface", self.fault(JOINT.replace('[[flux]]\nbetween = ["ring.outer", "housing.inner"]', '[[flux]]\nboundary = "ring.left"\nresistance_beyond = 0.2')))

    def test_displacements_need_elastic_materials(self):
        self.assertIn('material "two" lacks what displacements need', self.fault(RINGS.replace('E = "70 GPa"\n', "")))

    def test_fits_and_holds_are_checked(self):
        fit = 'between = ["ring.outer", "housing.inner"]\ninterference'
        self.assertIn("do not face each other", self.fault(RINGS.replace(fit, fit.replace("housing.inner", "housing.outer"))))
        self.assertIn("no displacement is computed", self.fault(JOINT + '[[hold]]\nboundary = "ring.left"\n'))

    def test_a_held_body_takes_neither_flux_nor_fixed_boundary(self):
        for what in ('[[flux]]\nboundary = "ring.left"\ntimes = [0]\nvalues = [1]\n', '[[fixed]]\nboundary = "ring.left"\ntemperature = "300 K"\n'):
            self.assertIn('all of body "ring" is held at a temperature', self.fault(RINGS + what))


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class Displacements(ProgramTest):
    def heat(self, text, *options):
        self.succeed("heat", self.write("case.toml", text), "-o", "out", "--force", *options)
        return self.summary()

    def test_a_free_hollow_cylinder_grows_by_its_mean_rise(self):
        summary = self.heat(FREE)
        a, b, L, alpha, inner, outer = 20e-3, 45e-3, 30e-3, 11.8e-6, 100.0, 20.0
        log = math.log(b / a)
        mean = inner + (outer - inner) * (b * b * log - (b * b - a * a) / 2) / ((b * b - a * a) * log)
        u = {name: {part: place[part][-1] for part in ("axial", "radial")} for name, place in summary["displacements"].items()}
        self.assertAlmostEqual(u["bore"]["radial"], alpha * a * mean, delta=1e-5 * alpha * a * mean)
        self.assertAlmostEqual(u["outside"]["radial"], alpha * b * mean, delta=1e-5 * alpha * b * mean)
        self.assertAlmostEqual(u["right"]["axial"], alpha * L / 2 * mean, delta=1e-5 * alpha * L * mean)
        self.assertAlmostEqual(u["left"]["axial"], -alpha * L / 2 * mean, delta=1e-5 * alpha * L * mean)
        with h5py.File(self.folder / "out/results.h5", "r") as results:
            self.assertEqual(list(results["/displacements/bore"][-1]), [u["bore"]["axial"], u["bore"]["radial"]])
            self.assertEqual(results["/displacements/bore"].attrs["units"], "m")

    def test_a_held_end_and_the_strain_free_temperature_count(self):
        free = self.heat(FREE)["displacements"]
        held = self.heat(FREE + '[[hold]]\nboundary = "ring.left"\n[elastic]\nstrain_free_temperature = "303.15 K"\n')["displacements"]
        self.assertEqual(held["left"]["axial"][-1], 0)
        # A held plane end is not a free one's mean, but it is when the rise is even: 10 K less of it everywhere, and the left end at rest.
        even = FREE.replace("393.15 K", "333.15 K").replace("313.15 K", "333.15 K")
        moved = self.heat(even + '[[hold]]\nboundary = "ring.left"\n[elastic]\nstrain_free_temperature = "303.15 K"\n')["displacements"]
        self.assertAlmostEqual(moved["right"]["axial"][-1], 11.8e-6 * 30e-3 * 30, delta=1e-10 * 1e-3)
        self.assertAlmostEqual(moved["bore"]["radial"][-1], 11.8e-6 * 20e-3 * 30, delta=1e-10 * 1e-3)
        self.assertNotEqual(free["bore"]["radial"][-1], held["bore"]["radial"][-1])

    def test_two_shrunk_rings_are_lames(self):
        a, b, c = 46e-3, 50e-3, 60e-3
        E_1, nu_1, alpha_1, theta_1, E_2, nu_2, alpha_2, theta_2 = 205e9, 0.3, 11.8e-6, 50.0, 70e9, 0.33, 23e-6, 10.0
        d = 10e-6 + b * (alpha_1 * theta_1 - alpha_2 * theta_2)
        p = d / (b / E_2 * ((c * c + b * b) / (c * c - b * b) + nu_2) + b / E_1 * ((b * b + a * a) / (b * b - a * a) - nu_1))
        bore = alpha_1 * a * theta_1 - 2 * p * a * b * b / (E_1 * (b * b - a * a))
        rim = alpha_2 * c * theta_2 + 2 * p * b * b * c / (E_2 * (c * c - b * b))
        summary = self.heat(RINGS)
        self.assertAlmostEqual(summary["fits"]["seat"]["mean_pressure"][-1], p, delta=1e-5 * p)
        self.assertEqual(summary["fits"]["seat"]["open_fraction"][-1], 0)
        self.assertAlmostEqual(summary["displacements"]["bore"]["radial"][-1], bore, delta=1e-5 * bore)
        self.assertAlmostEqual(summary["displacements"]["rim"]["radial"][-1], rim, delta=1e-5 * rim)
        # Both bodies were brought to their temperatures at once, and 40 K drive heat across the fit for 1 s.
        capacity = lambda rho, c_p, r_1, r_2: rho * c_p * math.pi * (r_2 * r_2 - r_1 * r_1) * 16e-3
        warmed = capacity(7800, 460, a, b) * theta_1 + capacity(2700, 900, b, c) * theta_2
        passed = 2 * math.pi * b * 16e-3 * 40 / 1e-3
        energy = summary["energy"]
        self.assertAlmostEqual(energy["stored"], warmed, delta=1e-9 * warmed)
        self.assertAlmostEqual(energy["input"], warmed + passed, delta=1e-9 * warmed)
        self.assertAlmostEqual(energy["lost"], passed, delta=1e-9 * warmed)

    def test_a_cold_ring_comes_loose_in_a_warm_housing(self):
        summary = self.heat(RINGS.replace("343.15 K", "293.15 K").replace("303.15 K", "343.15 K"))
        seat = summary["fits"]["seat"]
        self.assertEqual((seat["time"], seat["mean_pressure"]), ([1], [0]))
        self.assertAlmostEqual(seat["open_fraction"][0], 1, delta=1e-12)
        self.assertAlmostEqual(summary["displacements"]["bore"]["radial"][-1], 0, delta=1e-14)
        self.assertAlmostEqual(summary["displacements"]["rim"]["radial"][-1], 23e-6 * 60e-3 * 50, delta=1e-12)

    def test_heat_in_an_interface_is_by_its_area_and_kept(self):
        energy = self.heat(JOINT)["energy"]
        self.assertAlmostEqual(energy["input"], 2 * math.pi * 50e-3 * 16e-3 * 1e5 * 0.2, delta=1e-12 * energy["input"])
        self.assertLess(abs(energy["residual"]), 1e-10 * energy["input"])
        self.assertEqual(energy["lost"], 0)

    def test_the_resolved_case_runs_to_the_same_numbers(self):
        first = self.heat(RINGS)
        self.succeed("heat", "out/parameters.toml", "-o", "again")
        self.assertEqual(first["displacements"], self.summary("again")["displacements"])


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class BelowZero(ProgramTest):
    """Heat that no boundary can give off ends with an error: on modes and on the mesh."""

    def test_a_bearing_that_is_cooled_too_much_is_named_with_the_time(self):
        text = '[heat]\nbearing = "TB1"\nmodels = ["fe"]\noutput_times = ["1 ms", "50 ms"]\n[[heat.source]]\nport = "rub-into-ring"\ntimes = [0]\nvalues = [{}]\n'
        for coupling in ("reduced", "windowed"):
            done = self.call("heat", self.case(text.format(-2e5)), "-o", coupling, "--set", f"thermal.fe.coupling={coupling}")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertRegex(done.stderr, r"cooled below 0 K (before|at) t = \S+ s")
            self.assertIn("TB1" if coupling == "reduced" else "inner_ring", done.stderr)
            self.succeed("heat", self.case(text.format(-100)), "-o", coupling + "-mild", "--set", f"thermal.fe.coupling={coupling}")


if __name__ == "__main__":
    unittest.main()
