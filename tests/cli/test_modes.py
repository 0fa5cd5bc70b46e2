"""Natural modes of the reference rotor, as a table, as JSON and as shapes in HDF5."""

import json
import math
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest  # noqa: E402

RPM = math.pi / 30


def linear_supports(stiffness, damping="0 N s/m"):
    """The reference rotor on two equal supports."""
    text = '[run]\ninitial_speed = "15200 rpm"\n[rotor]\ngeometry = "neisi2019-rotor.json"\nmodal_damping = 0\n'
    for name, node in (("A", 2), ("B", 28)):
        text += (f'[bearings.{name}]\ntype = "linear"\nnode = {node}\nstiffness = [["{stiffness}", 0], [0, "{stiffness}"]]\n'
                 f'damping = [["{damping}", 0], [0, "{damping}"]]\n')
    return text


class Modes(ProgramTest):
    def modes(self, case, *options, speeds="0 rpm,15200 rpm"):
        return json.loads(self.succeed("modes", case, "--json", "--speeds", speeds, *options).stdout)

    def bending(self, speed):
        return [(mode["whirl"], mode["frequency"]) for mode in speed["modes"] if mode["frequency"] > 100]

    def test_the_free_rotor_bends_at_the_published_frequencies(self):
        report = self.modes("reference.toml")
        rest, spinning = report["speeds"]
        self.assertAlmostEqual(rest["speed"], 0)
        self.assertAlmostEqual(spinning["speed"], 15200 * RPM, places=9)
        self.assertAlmostEqual(self.bending(rest)[0][1], 673.5, delta=0.1)
        self.assertAlmostEqual(self.bending(rest)[1][1], 673.5, delta=0.1)
        (first, backward), (second, forward) = self.bending(spinning)[:2]
        self.assertEqual((first, second), ("backward", "forward"))
        self.assertAlmostEqual(backward, 658.5, delta=0.5)
        self.assertAlmostEqual(forward, 688.4, delta=0.5)

    def test_every_mode_has_its_keys(self):
        for speed in self.modes("reference.toml")["speeds"]:
            self.assertGreater(len(speed["modes"]), 3)
            for mode in speed["modes"]:
                self.assertLessEqual({"frequency", "damping_ratio", "whirl"}, mode.keys())
                self.assertGreater(mode["frequency"], 0)
                self.assertLess(abs(mode["damping_ratio"]), 0.1)
                self.assertIn(mode["whirl"], ("forward", "backward", "planar", "mixed"))
            frequencies = [mode["frequency"] for mode in speed["modes"]]
            self.assertEqual(frequencies, sorted(frequencies))

    def test_spinning_backwards_mirrors_the_whirl(self):
        there, back = self.modes("reference.toml", speeds="15200 rpm,-15200 rpm")["speeds"]
        for a, b in zip(there["modes"], back["modes"]):
            self.assertAlmostEqual(a["frequency"], b["frequency"], delta=1e-5 * a["frequency"])

    def test_on_soft_supports_the_rigid_rotor_bounces_as_a_mass_on_springs(self):
        self.write("linear.toml", linear_supports("1e6 N/m"))
        report = self.modes("linear.toml", speeds="0 rpm")
        self.assertEqual(report["supports"], "linear")
        lowest = report["speeds"][0]["modes"][:4]
        # Two translations and two tilts. The supports lie nearly symmetrically about the centre of gravity (0.4152 m and 0.4115 m away),
        # so the translation is near sqrt(2 k / m) = sqrt(2e6 / 109.7) / (2 pi) = 21.49 Hz and the tilt near
        # sqrt(k (a^2 + b^2) / I) = sqrt(1e6 x 0.34173 / 4.5535) / (2 pi) = 43.60 Hz; the shaft's own bending takes 0.3 %.
        for mode, expected in zip(lowest, (21.49, 21.49, 43.60, 43.60)):
            self.assertAlmostEqual(mode["frequency"], expected, delta=4e-3 * expected)
            self.assertAlmostEqual(mode["damping_ratio"], 0, delta=1e-6)

    def test_the_screen_says_what_holds_the_rotor(self):
        linear = linear_supports("1e6 N/m")
        magnets = linear.replace('type = "linear"', 'type = "magnet"')
        both = linear.partition("[bearings.B]")[0] + "[bearings.B]" + magnets.partition("[bearings.B]")[2]
        for text, words, value in ((linear, "linear supports", "the case's linear supports"), (magnets, "magnets", "the case's linear supports and magnets"),
                                   (both, "linear supports and magnets", "the case's linear supports and magnets")):
            case = self.write("held.toml", text)
            self.assertTrue(self.succeed("modes", case).stdout.startswith(f"Natural modes on the case's {words}\n"), words)
            self.assertEqual(self.modes(case)["supports"], "linear")
            self.assertIn(f"supports: the case's {words} at A, B\n", self.succeed("critical-speeds", case).stdout)
            self.assertEqual(json.loads(self.succeed("critical-speeds", case, "--json").stdout)["supports"], value)
        self.assertIn("no linear supports or magnets", self.succeed("modes", "reference.toml").stdout)

    def test_dampers_damp_the_bounce_mode_as_a_mass_on_springs(self):
        self.write("linear.toml", linear_supports("1e6 N/m", "1000 N s/m"))
        lowest = self.modes("linear.toml", speeds="0 rpm")["speeds"][0]["modes"][0]
        # zeta = 2 c / (2 sqrt(2 k m)) = 1000 / sqrt(2e6 x 109.7) = 0.0675. Of a spring and damper in series with the shaft's bending, the
        # frequency falls by 0.3 % and zeta by three times that.
        self.assertAlmostEqual(lowest["damping_ratio"], 0.0675 * 0.99, delta=0.003 * 0.0675)

    def test_stiff_supports_are_stiffer_than_soft_ones(self):
        self.write("linear.toml", linear_supports("1e8 N/m"))
        first = self.modes("linear.toml", speeds="0 rpm")["speeds"][0]["modes"][0]["frequency"]
        self.assertGreater(first, 100)
        self.assertLess(first, math.sqrt(2e8 / 109.7) / (2 * math.pi))

    def test_touchdown_bearings_do_not_hold_the_rotor(self):
        self.assertEqual(self.modes("reference.toml")["supports"], "free-free")

    def test_without_speeds_rest_and_the_initial_speed_are_reported(self):
        report = json.loads(self.succeed("modes", "reference.toml", "--json").stdout)
        numpy.testing.assert_allclose([speed["speed"] for speed in report["speeds"]], [0, 15200 * RPM])

    def test_speeds_may_have_any_unit_of_angular_speed(self):
        report = self.modes("reference.toml", speeds="100 rad/s, 1000 rpm,  60 deg/s,0")
        numpy.testing.assert_allclose([speed["speed"] for speed in report["speeds"]], [100, 1000 * RPM, math.pi / 3, 0])
        report = self.modes("reference.toml", speeds="0,50,100")
        numpy.testing.assert_allclose([speed["speed"] for speed in report["speeds"]], [0, 50, 100])

    def test_as_many_modes_as_asked_for(self):
        for speed in self.modes("reference.toml", "--modes", "3")["speeds"]:
            self.assertEqual(len(speed["modes"]), 3)

    def test_set_changes_the_rotor(self):
        plain = self.modes("reference.toml", speeds="0 rpm")
        damped = self.modes("reference.toml", "--set", "rotor.modal_damping=0.02", speeds="0 rpm")
        self.assertAlmostEqual(plain["speeds"][0]["modes"][0]["damping_ratio"], 0.005, delta=1e-6)
        self.assertAlmostEqual(damped["speeds"][0]["modes"][0]["damping_ratio"], 0.02, delta=1e-6)

    def test_the_table_says_the_same_as_the_json(self):
        table = self.succeed("modes", "reference.toml", "--speeds", "15200 rpm").stdout
        for mode in self.modes("reference.toml", speeds="15200 rpm")["speeds"][0]["modes"][:4]:
            self.assertRegex(table, rf"{mode['frequency']:.3f} Hz.*{mode['whirl']}")
        self.assertIn("free-free", table)
        self.assertIn("15200 rpm", table)

    def test_shapes_can_be_read_and_are_those_of_the_modes(self):
        report = self.modes("reference.toml", "--shapes", "shapes.h5")
        with h5py.File(self.folder / "shapes.h5", "r") as file:
            for i, speed in enumerate(report["speeds"]):
                group = file[f"speed_{i}"]
                self.assertEqual(group["frequency"].attrs["units"], "Hz")
                numpy.testing.assert_allclose(group["frequency"][()], [mode["frequency"] for mode in speed["modes"]])
                numpy.testing.assert_allclose(group["spin_speed"][()], speed["speed"])
                self.assertEqual(group["shape_y_real"].shape, (len(speed["modes"]), 31))
                self.assertAlmostEqual(group["node_position"][0, -1], 0.961704)
                shape = group["shape_y_real"][()] + 1j * group["shape_y_imaginary"][()]
                across = group["shape_z_real"][()] + 1j * group["shape_z_imaginary"][()]
                self.assertTrue(numpy.all(numpy.isfinite(shape)))
                # The first bending, above the rigid modes, has two nodes along the shaft: its deflection changes sign twice.
                k = next(k for k, mode in enumerate(speed["modes"]) if mode["frequency"] > 100)
                first = shape[k] if numpy.abs(shape[k]).max() > numpy.abs(across[k]).max() else across[k]
                real = (first / first[numpy.abs(first).argmax()]).real
                self.assertEqual(numpy.count_nonzero(numpy.diff(numpy.sign(real[numpy.abs(real) > 1e-3]))), 2)

    def test_whirl_is_named_after_the_spin_whichever_way_that_goes(self):
        plus, minus = self.modes("reference.toml", speeds="15200 rpm,-15200 rpm")["speeds"]
        self.assertEqual([mode["whirl"] for mode in plus["modes"]], [mode["whirl"] for mode in minus["modes"]])

    def test_shapes_go_beside_the_results_of_the_case_and_nowhere_else(self):
        before = {path.name for path in self.folder.iterdir()}
        self.modes("reference.toml")
        self.assertEqual({path.name for path in self.folder.iterdir()} - before, {"out"})
        self.assertEqual([str(path.relative_to(self.folder)) for path in (self.folder / "out").rglob("*") if path.is_file()],
                         ["out/reference/modes.h5"])

    def test_a_folder_with_mode_shapes_takes_the_results_of_a_run(self):
        self.modes("reference.toml")
        self.succeed("run", "reference.toml", "--set", "run.end_time=1 ms")


if __name__ == "__main__":
    unittest.main()
