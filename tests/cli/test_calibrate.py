"""rotordrop calibrate: the circuit fitted to the finite elements, as a parameter file."""

import pathlib
import re
import sys
import tomllib
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, ProgramTest, settings  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").exists()


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class Calibrate(ProgramTest):
    def test_the_file_holds_factors_that_bring_the_circuit_closer(self):
        text = self.succeed("calibrate", "reference.toml", "-o", "fit/calibrated.toml").stdout
        written = tomllib.loads((self.folder / "fit/calibrated.toml").read_text())
        self.assertEqual(written["base"], "../reference.toml")
        self.assertEqual(set(written["bearings"]), {"TB1", "TB2"})
        for name in written["bearings"]:
            before, after = map(float, re.search(rf"^{name}: .*rms ([\d.]+) % -> ([\d.]+) %", text, re.MULTILINE).groups())
            self.assertLess(after, before)
            # Resistances that both models do not share, and nothing else.
            self.assertEqual(set(written["bearings"][name]["circuit"]), {"shaft_ring", "inner_race", "outer_race", "fit"})
            self.assertRegex(text, r"Of the error that the fit removes, R\d[^\n]* carries most")
        lines = re.findall(r"^\w+ = ([\d.]+)  # R.*, ([\d.]+) to ([\d.]+)(.*)$", (self.folder / "fit/calibrated.toml").read_text(), re.MULTILINE)
        self.assertEqual(len(lines), 8)
        for value, low, high, words in lines:
            value, low, high = float(value), float(low), float(high)
            self.assertTrue(low * 0.995 <= value <= high * 1.005, "bounds are printed with three digits")
            self.assertEqual("AT ITS" in words, abs(value / low - 1) < 0.006 or abs(value / high - 1) < 0.006)
            if "AT ITS" in words:
                self.assertIn("bound, ", text)
        differences = {}
        both = settings(thermal__models='["lumped", "fe"]', thermal__driver="fe", run__end_time="60 ms")
        for case in ("reference.toml", "fit/calibrated.toml"):
            self.succeed("run", case, "-o", "out", "--force", *both)
            with h5py.File(self.folder / "out/results.h5") as file:
                nodes = ("inner_ring", "shaft")  # what the outer ring is off by is its volume, which no resistance mends
                differences[case] = [numpy.abs(file[f"thermal/TB2/{node}"][()] - file[f"fe/TB2/{node}"][()]).max() for node in nodes]
        for before, after in zip(differences["reference.toml"], differences["fit/calibrated.toml"]):
            self.assertLess(after, before)

    def test_a_file_holds_what_the_command_line_has_set(self):
        """The same fit from a case that says so itself; with base and factors alone the circuit would be another one."""
        keys = {"thermal.spreading": '"strip"', "bearings.TB2.preload": '"20 N"', "bearings.TB1.circuit.inner_ring_capacity": "1.5"}
        self.write("own.toml", 'base = "reference.toml"\n' + "".join(f"{key} = {value}\n" for key, value in keys.items()))
        self.succeed("calibrate", "own.toml", "-o", "own-fit.toml", "--until", "20 ms")
        arguments = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
        self.succeed("calibrate", "reference.toml", "-o", "fit/set.toml", "--until", "20 ms", "--set", "thermal.spreading=none", *arguments)
        own, given = (tomllib.loads((self.folder / name).read_text()) for name in ("own-fit.toml", "fit/set.toml"))
        self.assertEqual(given["thermal"], {"spreading": "strip"})
        self.assertEqual(given["bearings"]["TB2"]["preload"], "20 N")
        self.assertEqual(given["bearings"]["TB1"]["circuit"].pop("inner_ring_capacity"), 1.5)
        self.assertEqual(given["bearings"]["TB1"]["circuit"], own["bearings"]["TB1"]["circuit"])
        self.succeed("check", "fit/set.toml")

    def test_a_link_in_contact_has_the_fit_of_a_permanent_one(self):
        """Both resistances are the contact's while it lasts."""
        factors = []
        for link in ("permanent", "in-contact"):
            self.succeed("calibrate", "reference.toml", "-o", f"{link}.toml", "--until", "20 ms", "--set", f"thermal.shaft_ring_link={link}")
            factors.append({name: bearing["circuit"] for name, bearing in tomllib.loads((self.folder / f"{link}.toml").read_text())["bearings"].items()})
        self.assertEqual(factors[0], factors[1])

    def test_a_file_that_is_there_stays(self):
        self.write("mine.toml", "precious")
        done = self.call("calibrate", "reference.toml", "-o", "mine.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("already exists", done.stderr)
        self.assertEqual((self.folder / "mine.toml").read_text(), "precious")

    def test_faults_are_named(self):
        for arguments, message in ((["--until", "1 m"], "a time"), (["--until", "1 ms"], "2 ms at least"), (["--set", "thermal.fe.modes=1"], "thermal.fe.modes")):
            done = self.call("calibrate", "reference.toml", "-o", "out.toml", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(message, done.stderr)
            self.assertFalse((self.folder / "out.toml").exists())

    def test_it_takes_what_a_drop_takes(self):
        """Growth has no part in a calibration, and a shaft beside the bearing is answered within the case's tolerance, which is told where modes do not reach the 0.2 % that they aim at."""
        elastic = settings(thermal__models='["lumped", "fe"]', thermal__expansion="elastic", thermal__fe__coupling="windowed", bearings__TB1__housing_fit="-5 um")
        self.succeed("calibrate", "reference.toml", "-o", "elastic.toml", *elastic)
        formula = settings(bearings__TB1__housing_fit="-5 um")
        self.succeed("calibrate", "reference.toml", "-o", "formula.toml", *formula)
        by_elasticity, by_formula = (tomllib.loads((self.folder / name).read_text())["bearings"] for name in ("elastic.toml", "formula.toml"))
        self.assertEqual(by_elasticity, by_formula)
        text = self.succeed("calibrate", "reference.toml", "-o", "beyond.toml", *settings(thermal__fe__shaft="beyond")).stdout
        errors = [float(e) for e in re.findall(r"answer heat with an error of up to ([\d.]+) %", text)]
        self.assertTrue(errors)
        for error in errors:
            self.assertTrue(0.2 < error <= 0.5, error)
        # Another coupling would be of no use: modes are what a calibration is made with.
        refused = self.call("calibrate", "reference.toml", "-o", "refused.toml", *settings(thermal__fe__shaft="beyond", thermal__fe__response_tolerance="1e-3"))
        self.assertEqual(refused.returncode, 2)
        self.assertIn("allow a larger error.", refused.stderr)
        self.assertNotIn("windowed", refused.stderr)

    def test_there_must_be_a_circuit(self):
        text = (self.folder / "reference.toml").read_text()
        text = re.sub(r"\[bearings\].*?(?=\[materials\])", '[bearings.L]\ntype = "linear"\nnode = 2\nstiffness = [[1e8, 0], [0, 1e8]]\n', text, flags=re.DOTALL)
        done = self.call("calibrate", self.write("linear.toml", text), "-o", "out.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no touchdown bearing", done.stderr)


class Factors(ProgramTest):
    def test_a_factor_of_the_inner_rings_capacity_scales_its_rise(self):
        rises = [self.run_case("reference.toml", "--force", run__end_time="9 ms", thermal__growth="false", bearings__TB1__circuit__inner_ring_capacity=factor)["bearings"]["TB1"]["temperature_rise_end"]["inner_ring"] for factor in (1, 2)]
        # A hundredth of its heat is conducted away in the first 2 ms of contact.
        self.assertAlmostEqual(rises[0] / rises[1], 2, delta=0.02)

    def test_factors_have_bounds(self):
        done = self.call("check", "reference.toml", "--set", "bearings.TB1.circuit.fit=0")
        self.assertEqual(done.returncode, 2)
        self.assertIn("bearings.TB1.circuit.fit", done.stderr)


if __name__ == "__main__":
    unittest.main()
