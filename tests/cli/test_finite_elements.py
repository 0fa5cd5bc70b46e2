"""Finite elements in a drop: couplings, drivers, results; and recorded growth."""

import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, ProgramTest, settings, start  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").exists()
BOTH = 'thermal.models=["lumped", "fe"]'


class Recorded(ProgramTest):
    def test_recorded_growth_drives_to_the_same_drop(self):
        first = self.run_case(self.case(""), output="first", run__end_time="12 ms")
        second = self.run_case("drop.toml", output="second", run__end_time="12 ms", thermal__driver="recorded", thermal__recorded="first/results.h5")
        for name in ("TB1", "TB2"):
            with h5py.File(self.folder / "first/results.h5") as a, h5py.File(self.folder / "second/results.h5") as b:
                # Linear between records 50 us apart, while the rub of an impact heats at up to 29 kW: a few per cent of what grows in 50 us.
                numpy.testing.assert_allclose(b[f"bearings/{name}/expansion"], a[f"bearings/{name}/expansion"], rtol=0, atol=1e-12)
            peaks = [run["bearings"][name]["peak_contact_force"] for run in (first, second)]
            self.assertAlmostEqual(*peaks, delta=2e-4 * peaks[0], msg="what error control leaves between runs whose steps differ")
        self.assertNotIn("recorded-growth", [w["code"] for w in second["warnings"]])

    def test_a_recording_that_ends_before_the_run_is_told(self):
        self.run_case(self.case(""), output="first", run__end_time="0.2 ms")
        second = self.run_case("drop.toml", output="second", run__end_time="0.3 ms", thermal__driver="recorded", thermal__recorded="first/results.h5")
        told = [(w["worst"], w["limit"]) for w in second["warnings"] if w["code"] == "recorded-growth"]
        self.assertEqual(len(told), 1, second["warnings"])
        numpy.testing.assert_allclose(told[0], (3e-4, 2e-4), rtol=1e-12)

    def test_a_recording_of_other_bearings_is_refused(self):
        self.run_case(self.case(""), output="first", run__end_time="0.2 ms")
        self.write("other.toml", (self.folder / "reference.toml").read_text().replace("bearings.TB2", "bearings.DE"))
        done = self.call("check", "other.toml", *settings(thermal__driver="recorded", thermal__recorded="first/results.h5"))
        self.assertEqual(done.returncode, 2)
        self.assertIn('it has no growth of a bearing "DE"', done.stderr)
        self.assertIn("TB1, TB2", done.stderr)

    def test_a_recording_that_is_not_there_is_named_with_its_key(self):
        self.write("drop.toml", 'base = "reference.toml"\n[thermal]\ndriver = "recorded"\nrecorded = "nowhere/results.h5"\n')
        done = self.call("run", "drop.toml", "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"drop.toml:4:\d+: thermal.recorded = \".*nowhere/results.h5\"")
        self.assertFalse((self.folder / "out").exists())

    def test_the_recording_is_looked_for_beside_the_case(self):
        self.run_case(self.case(""), output="sub/first", run__end_time="0.2 ms")
        self.write("sub/drop.toml", 'base = "../reference.toml"\n[thermal]\ndriver = "recorded"\nrecorded = "first/results.h5"\n')
        self.run_case("sub/drop.toml", output="second", run__end_time="0.2 ms")

    def test_a_driver_needs_its_model(self):
        done = self.call("check", self.case('thermal.driver = "fe"\n'))
        self.assertEqual(done.returncode, 2)
        self.assertIn("thermal.driver names a model that is not in thermal.models", done.stderr)


@unittest.skipIf(HAS_ROOM, "built with finite elements")
class WithoutTheRoom(ProgramTest):
    def test_the_message_says_how_to_get_it(self):
        done = self.call("run", self.case('thermal.models = ["fe"]\n'), "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("built without", done.stderr)
        self.assertFalse((self.folder / "out").exists())


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class InADrop(ProgramTest):
    def drop(self, output, *, models='["fe"]', until="0.3 s", **keys):
        return self.run_case("settling.toml", output=output, thermal__models=models, run__end_time=until, **keys)

    def setUp(self):
        super().setUp()
        self.write("settling.toml", 'base = "reference.toml"\nrotor.mass_proportional_alpha = "30 1/s"\n')

    def growth(self, output):
        with h5py.File(self.folder / output / "results.h5") as file:
            return {name: file[f"bearings/{name}/expansion"][()] for name in ("TB1", "TB2")}

    def test_reduced_and_windowed_agree_over_the_whole_drop(self):
        reduced, windowed = self.drop("reduced"), self.drop("windowed", thermal__fe__coupling="windowed")
        a, b = self.growth("reduced"), self.growth("windowed")
        largest = max(numpy.abs(growth).max() for growth in b.values())
        self.assertGreater(largest, 1e-6, "m: a drop that warms")
        for name in a:
            self.assertLess(numpy.abs(a[name] - b[name]).max(), 1e-3 * largest, name)
            fe = [run["bearings"][name]["fe"] for run in (reduced, windowed)]
            # A reduction weighs what its modes lose by the watts: the outer ring, which gets a hundredth of them, may be less exact.
            for body in ("inner_ring", "outer_ring", "shaft"):
                rises = [f["temperature_rise_end"][body] for f in fe]
                self.assertAlmostEqual(*rises, delta=1e-3 * fe[1]["temperature_rise_end"]["inner_ring"], msg=body)
        windows = windowed["windows"]
        self.assertLess(windows["largest_growth_error"], 1e-3 * windows["largest_growth"])
        self.assertLess(abs(windows["heat_residual"]), 1e-9 * windows["heat_input"])
        self.assertAlmostEqual(windows["heat_input"], windowed["energy"]["heat_deposited"], delta=1e-9 * windows["heat_input"])

    def test_windows_beyond_their_tolerance_are_told(self):
        for tolerance, name in (("0.5 nm", "kept"), ("0.001 nm", "beyond")):
            printed = self.succeed("run", "settling.toml", "-o", name, *settings(thermal__models='["fe"]', thermal__fe__coupling="windowed", thermal__fe__section="plain", thermal__fe__window_tolerance=tolerance, run__end_time="15 ms")).stdout
            windows = self.summary(name)["windows"]
            self.assertAlmostEqual(windows["tolerance"], float(tolerance.split()[0]) * 1e-9, delta=1e-20)
            with h5py.File(self.folder / name / "results.h5") as file:
                # Rows of windows are some of them; the largest may be another.
                self.assertLessEqual(file["windows/error"][()].max(), windows["largest_growth_error"])
            self.assertEqual(windows["beyond_tolerance"] > 0, windows["largest_growth_error"] > windows["tolerance"])
            self.assertLessEqual(windows["beyond_tolerance"], windows["count"])
            self.assertEqual("windows left more than thermal.fe.window_tolerance" in printed, name == "beyond", printed)
            if name == "beyond":
                self.assertIn(f"{windows['beyond_tolerance']} windows left more than thermal.fe.window_tolerance = 0.001 nm, the most at {windows['largest_growth_error_time'] * 1e3:.4g} ms", printed)

    TABLES = ("--set", 'materials.steel.k_table=[["293 K", 46], ["303 K", 20]]', "--set", 'materials.steel.c_table=[["293 K", 460], ["303 K", 900]]')

    def test_windows_follow_tables_of_k_and_c(self):
        """The same joules through `rotordrop heat` on the same mesh, by another method in time with error control and heat spread over 0.5 ms. Without
        the tables the ring gets warmer by a few per cent."""
        small = {"thermal__fe__coupling": "windowed", "thermal__fe__section": "plain", "thermal__fe__refinement": 0.5}
        self.succeed("run", "settling.toml", "-o", "drop", *self.TABLES, *settings(thermal__models='["fe"]', **small, run__end_time="15 ms"))
        windows = self.summary("drop")["windows"]
        self.assertLess(abs(windows["heat_residual"]), 1e-9 * windows["heat_input"])
        alone = ("settling.toml", *settings(**small, heat__bearing="TB1", heat__models='["fe"]', heat__end_time="15 ms",
                                            heat__source="[{port = 'all', recorded = 'drop/results.h5', interval = '0.5 ms'}]"))
        self.succeed("heat", *alone, "-o", "same", *self.TABLES)
        self.succeed("heat", *alone, "-o", "constant", *settings(materials__steel__k=46, materials__steel__c=460))
        drop = self.summary("drop")["bearings"]["TB1"]["fe"]["temperature_rise_end"]["inner_ring"]
        same, constant = (self.summary(name)["probes"]["fe.inner_ring"]["temperature"][-1] - 293.15 for name in ("same", "constant"))
        self.assertAlmostEqual(same / drop, 1, delta=2e-3)
        self.assertGreater(constant / drop, 1.02)

    def test_tables_that_are_constant_change_nothing(self):
        plain = self.drop("plain", until="10 ms", thermal__fe__coupling="windowed")
        tables = self.drop("tables", until="10 ms", thermal__fe__coupling="windowed", materials__steel__k_table=[[273, 70], [373, 70]], materials__steel__c_table=[[273, 510]])
        self.assertEqual(plain["bearings"], tables["bearings"])
        self.assertEqual(plain["bearings"]["TB1"]["fe"]["temperature_rise_end"], tables["bearings"]["TB1"]["fe"]["temperature_rise_end"])

    def test_modes_refuse_tables_and_name_the_key(self):
        for coupling in ("reduced", "monolithic"):
            done = self.call("check", self.case("[materials.steel]\nk_table = [[293, 46], [393, 42]]\n"), "--set", BOTH, *settings(thermal__fe__coupling=coupling))
            self.assertEqual(done.returncode, 2)
            self.assertIn(f'drop.toml:4:1: materials.steel.k_table depends on temperature, but thermal.fe.coupling = "{coupling}"', done.stderr)
            self.assertIn('Take thermal.fe.coupling = "windowed"', done.stderr)
        self.assertEqual(self.call("check", "drop.toml").returncode, 0, "the circuit takes the value at ambient")

    def test_both_models_run_side_by_side_and_either_drives(self):
        forces = {}
        for driver in ("lumped", "fe", "none"):
            summary = self.drop(driver, models='["lumped", "fe"]', until="20 ms", thermal__driver=driver)
            forces[driver] = summary["bearings"]["TB2"]["peak_contact_force"]
            energy = summary["energy"]
            for key in ("heat_residual", "fe_heat_residual"):
                # Temperatures are absolute: 293 K of 1000 J/K leave 1e-10 J of roundoff in every one of some thousand steps.
                self.assertLess(abs(energy[key]), 1e-7, key)
            with h5py.File(self.folder / driver / "results.h5") as file:
                fed_back = file["bearings/TB1/expansion"][()]
                if driver == "none":
                    self.assertEqual(numpy.abs(fed_back).max(), 0)
                else:
                    numpy.testing.assert_allclose(fed_back, file[f"growth/{driver}/TB1"][()], rtol=0, atol=1e-15)
        self.assertNotEqual(forces["lumped"], forces["none"])

    def test_surfaces_enclose_their_means_and_the_bore_is_the_hottest(self):
        self.drop("out", until="20 ms")
        with h5py.File(self.folder / "out/results.h5") as file:
            for surface in ("bore", "inner_raceway", "outer_raceway"):
                mean, lowest, highest = file[f"fe/TB1/{surface}"][()].T
                self.assertTrue((lowest <= mean + 1e-9).all() and (mean <= highest + 1e-9).all(), surface)
            bore, ring = file["fe/TB1/bore"][:, 0], file["fe/TB1/inner_ring"][()]
            self.assertGreater(bore.max() - 293.15, 10 * (ring[bore.argmax()] - 293.15), "a layer that an impact heats")

    def test_kept_sections_give_the_same_drop_to_the_last_bit(self):
        def scalars(name, cache):
            environment = dict(os.environ, ROTORDROP_CACHE=str(cache))
            subprocess.run([PROGRAM, "run", "settling.toml", "-o", name, "--quiet", *settings(thermal__models='["lumped", "fe"]', run__end_time="9 ms", thermal__fe__field_interval="5 ms")], cwd=self.folder, env=environment, check=True)
            summary = self.summary(name)
            for key in ("wall_time", "cpu_time"):
                del summary["run"][key]
            return summary

        fresh = scalars("fresh", "off")
        self.assertEqual(scalars("first", self.folder / "cache"), fresh)
        kept = {file: file.stat().st_size for file in (self.folder / "cache").iterdir()}
        self.assertGreater(len(kept), 2)
        self.assertEqual(scalars("second", self.folder / "cache"), fresh)
        self.assertEqual({file: file.stat().st_size for file in (self.folder / "cache").iterdir()}, kept, "the second run finds everything there")
        fields = list((self.folder / "fresh/fields").glob("**/*.vtu"))
        self.assertGreater(len(fields), 1)
        for field in fields:
            self.assertEqual(field.read_bytes(), (self.folder / "second" / field.relative_to(self.folder / "fresh")).read_bytes())
        for file in kept:
            file.write_bytes(file.read_bytes()[:-9])
        self.assertEqual(scalars("third", self.folder / "cache"), fresh)
        (self.folder / "no-folder").write_text("a file")
        self.assertEqual(scalars("fourth", self.folder / "no-folder"), fresh)

    def test_own_rectangles_and_finer_meshes_may_be_chosen(self):
        plain = self.drop("plain", until="12 ms", thermal__fe__section="plain")["bearings"]["TB1"]["fe"]
        fine = self.drop("fine", until="12 ms", thermal__fe__refinement="2")["bearings"]["TB1"]["fe"]
        usual = self.drop("usual", until="12 ms")["bearings"]["TB1"]["fe"]
        self.assertGreater(fine["unknowns"], 2 * usual["unknowns"])
        # Mesh and modes resolve the bore's mean: a coarser mesh must not change it by more than the modes' own error at the start of a contact.
        self.assertAlmostEqual(fine["surface_rise"]["bore"]["highest_mean"], usual["surface_rise"]["bore"]["highest_mean"], delta=0.02 * usual["surface_rise"]["bore"]["highest_mean"])
        # Rectangles of the rings' diameters in the circuit: a closed form, with the mean diameters that the circuit has.
        self.assertNotEqual(plain["cells"], usual["cells"])

    def test_a_windowed_drop_that_was_killed_resumes_to_the_same_result(self):
        keys = settings(thermal__models='["fe"]', thermal__fe__coupling="windowed", run__end_time="40 ms", integration__method="runge-kutta-4", integration__step="1 us", output__checkpoint_interval="0.05 s")
        process = start("run", "settling.toml", "-o", "out", *keys, cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 60
        while len(list((self.folder / "out").glob("checkpoints/checkpoint-*.h5"))) < 2:
            self.assertIsNone(process.poll(), "it ended before it could be killed")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=30)
        self.succeed("run", "settling.toml", "-o", "out", "--resume", *keys)
        self.succeed("run", "settling.toml", "-o", "whole", *keys)
        resumed, whole = self.summary("out"), self.summary("whole")
        self.assertEqual(resumed["bearings"], whole["bearings"])
        for key in ("count", "largest_growth_error", "heat_input", "heat_lost"):
            self.assertEqual(resumed["windows"][key], whole["windows"][key], key)
        with h5py.File(self.folder / "out/results.h5") as a, h5py.File(self.folder / "whole/results.h5") as b:
            for path in ("windows/time", "windows/TB1/bore", "bearings/TB1/expansion", "time"):
                numpy.testing.assert_array_equal(a[path][()], b[path][()], path)

    def test_faults_are_named(self):
        for setting, message in (
            ('thermal.models=["lumpt"]', "must be a list"),
            ("thermal.fe.coupling=window", "Did you mean"),
            ("thermal.fe.modes=3", "modes"),
            ("thermal.fe.modes=12", "on 12 modes answers heat with an error of"),  # 41 are needed
            ("thermal.fe.window_tolerance=1 s", "window_tolerance"),
        ):
            done = self.call("run", "settling.toml", "-o", "out", "--set", BOTH, "--set", setting)
            self.assertEqual(done.returncode, 2, setting)
            self.assertIn(message, done.stderr)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
