"""Results from a directory: the same object as from memory, also of a run that goes on or was killed; and files for MATLAB."""

import os
import pathlib
import shutil
import signal
import sys
import time
import unittest

import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from package import PARAMS, SETTLING, PackageTest, flat, rd  # noqa: E402
from program import call, start  # noqa: E402

CLOCKS = ("wall_time", "cpu_time")


class Directory(PackageTest):
    def test_a_directory_and_memory_give_the_same(self):
        done = call("run", SETTLING, "-o", self.folder / "out", "--quiet", "--set", "run.end_time=10 ms")
        self.assertEqual(done.returncode, 0, done.stderr)
        result = rd.read(self.folder / "out")
        here = rd.Case(SETTLING, {"run.end_time": "10 ms"}).run()
        self.assertTrue(result.completed)
        self.assertTrue(result.series.identical(here.series), "with names, dimensions, units and meanings")
        numbers = [{key: value for key, value in flat(one.summary) if not key.endswith(CLOCKS)} for one in (result, here)]
        self.assertEqual(*numbers)
        self.assertEqual(result.directory, self.folder / "out")
        self.assertIsNone(here.directory)
        self.assertEqual(result.text.splitlines()[0], here.text.splitlines()[0])

    def test_a_summary_that_the_program_did_not_write_has_no_text(self):
        rd.Case(SETTLING, {"run.end_time": "1 ms"}).run(self.folder / "out")
        for summary in ("{}", "[]", "no JSON", '{"run": {"completed": true}}', '{"run": {"completed": true}, "bearings": {"TB1": 1}}'):
            (self.folder / "out/summary.json").write_text(summary)
            with self.assertRaisesRegex(rd.InputError, "not what the program wrote"):
                rd.read(self.folder / "out").text

    def test_python_writes_what_the_program_writes(self):
        result = rd.Case(SETTLING, {"run.end_time": "10 ms"}).run(self.folder / "out")
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()}, {"results.h5", "summary.json", "parameters.toml"})
        self.assertTrue(result.series.identical(rd.read(self.folder / "out").series))
        report = result.report()
        self.assertIn("peak contact force", report.read_text(encoding="utf-8").lower())
        with self.assertRaises(rd.InputError):
            rd.Case(SETTLING, {"run.end_time": "10 ms"}).run(self.folder / "out")
        rd.Case(SETTLING, {"run.end_time": "5 ms"}).run(self.folder / "out", force=True)
        self.assertAlmostEqual(float(rd.read(self.folder / "out").series["time"][-1]), 5e-3, delta=1e-12)
        with self.assertRaisesRegex(ValueError, "directory"):
            rd.Case(SETTLING).run(force=True)

    def test_a_run_that_goes_on_and_one_that_was_killed(self):
        process = start("run", SETTLING, "-o", self.folder / "out", "--quiet", "--set", "run.end_time=1000 s", "--set", "output.interval=1 ms")
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        limit = time.monotonic() + 60
        while time.monotonic() < limit:
            time.sleep(0.3)
            if (self.folder / "out/results.h5").is_file() and rd.read(self.folder / "out").series.sizes["time"] > 10:
                break
        live = rd.read(self.folder / "out")
        self.assertFalse(live.completed)
        self.assertGreater(live.series.sizes["time"], 10)
        self.assertTrue(np.all(np.diff(live.series["time"]) > 0))
        with self.assertRaisesRegex(FileNotFoundError, "no summary.json"):
            live.summary  # noqa: B018
        process.kill()
        process.wait()
        killed = rd.read(self.folder / "out")
        self.assertGreaterEqual(killed.series.sizes["time"], live.series.sizes["time"])
        self.assertTrue(np.all(np.isfinite(killed["bearings.TB1.orbit"])))

    def test_a_result_is_of_one_run_alone(self):
        directory = self.folder / "out"
        result = rd.Case(SETTLING, {"run.end_time": "5 ms"}).run(directory)
        orbit = result["bearings.TB1.orbit"].values.copy()
        rd.Case(SETTLING, {"run.end_time": "5 ms", "contact.air_gap": "100 um"}).run(directory, force=True)
        self.assertTrue(np.array_equal(result["bearings.TB1.orbit"], orbit), "what was read stays")
        with self.assertRaisesRegex(rd.InputError, "another one than when its drop was opened"):
            result["bearings.TB1.contact_force"]
        self.assertGreater(len(rd.read(directory)["bearings.TB1.contact_force"]), 0)

    def test_a_directory_is_found_wherever_the_program_is_later(self):
        here = os.getcwd()
        try:
            os.chdir(self.folder)
            result = rd.Case(SETTLING, {"run.end_time": "5 ms"}).run("out")
            os.chdir(here)
            self.assertEqual(len(result["bearings.TB1.orbit"]), result.series.sizes["time"])
            self.assertTrue(result.report().is_file())
        finally:
            os.chdir(here)

    def test_times_and_the_root_are_told_what_they_are(self):
        result = rd.Case(SETTLING, {"run.end_time": "2 ms"}).run()
        with self.assertRaisesRegex(KeyError, "result.series.detail_time"):
            result["detail.time"]
        self.assertEqual(set(result.select("/")), set(result.series))

    def test_directories_without_results(self):
        for path, words in ((self.folder / "nowhere", "no such directory"), (self.folder, "does not contain results.h5")):
            with self.assertRaisesRegex(rd.InputError, words):
                rd.read(path)


class Matlab(PackageTest):
    def test_series_units_and_summary_come_back(self):
        import scipy.io

        result = rd.Case(SETTLING, {"run.end_time": "10 ms"}).run()
        result.to_mat(self.folder / "drop.mat")
        read = scipy.io.loadmat(self.folder / "drop.mat", squeeze_me=False, struct_as_record=False)["results"][0, 0]

        def at(path):
            value = read
            for word in path.split("."):
                value = getattr(value, word)
                value = value[0, 0] if value.shape == (1, 1) and value.dtype == object else value
            return value

        n = result.series.sizes["time"]
        self.assertEqual(at("bearings.TB1.contact_force").shape, (n, 1))
        self.assertEqual(at("bearings.TB1.ball_force").shape, (n, 1))
        self.assertEqual(at("bearings.TB2.orbit").shape, (n, 2))
        self.assertTrue(np.array_equal(at("bearings.TB2.orbit"), result["bearings.TB2.orbit"]))
        self.assertTrue(np.array_equal(at("time")[:, 0], result.series["time"]))
        self.assertEqual(at("units.bearings.TB2.orbit")[0], "m")
        self.assertEqual(at("columns.bearings.TB2.orbit").ravel()[1][0], "z")
        self.assertEqual(at("summary.bearings.TB1.peak_contact_force")[0, 0], result.summary["bearings"]["TB1"]["peak_contact_force"])
        self.assertTrue(np.isnan(at("summary.bearings.TB1.catch_up_time")[0, 0]), "has not happened")
        self.assertTrue(at("ledger.TB1.spin_up_centres").size)

    def test_an_interrupted_run_has_its_summary(self):
        import scipy.io

        process = start("run", SETTLING, "-o", self.folder / "out", "--quiet", "--set", "run.end_time=1000 s", "--set", "output.interval=1 ms")
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        limit = time.monotonic() + 60
        while not (self.folder / "out/results.h5").is_file() and time.monotonic() < limit:
            time.sleep(0.1)
        live = rd.read(self.folder / "out")
        live.to_mat(self.folder / "live.mat")
        self.assertFalse(live.has_summary)
        self.assertNotIn("summary", scipy.io.loadmat(self.folder / "live.mat", simplify_cells=True)["results"])
        process.send_signal(signal.SIGINT)
        process.wait()
        result = rd.read(self.folder / "out")
        self.assertFalse(result.completed)
        result.to_mat(self.folder / "drop.mat")
        summary = scipy.io.loadmat(self.folder / "drop.mat", simplify_cells=True)["results"]["summary"]
        self.assertEqual(summary["run"]["end_time"], result.summary["run"]["end_time"])

    def test_names_that_look_alike_are_different_fields(self):
        import scipy.io

        bearings = rd.Case(SETTLING).parameters["bearings"]
        text = SETTLING.parent / "neisi2019.toml"
        (self.folder / "own.toml").write_text(text.read_text().replace("[bearings.TB1]", "[bearings.A-B]").replace("[bearings.TB2]", "[bearings.A_B]"))
        shutil.copy(PARAMS / "neisi2019-rotor.json", self.folder)
        result = rd.Case(self.folder / "own.toml", {"run.end_time": "5 ms"}).run()
        self.assertEqual((len(bearings), set(result.case.bearings)), (2, {"A-B", "A_B"}))
        result.to_mat(self.folder / "drop.mat")
        read = scipy.io.loadmat(self.folder / "drop.mat", simplify_cells=True)["results"]
        for name, field in zip(sorted(result.case.bearings), ("A_B", "A_B_2")):
            self.assertTrue(np.array_equal(read["bearings"][field]["orbit"], result[f"bearings.{name}.orbit"]), name)
            self.assertEqual(read["units"]["bearings"][field]["orbit"], "m")
            self.assertEqual(read["summary"]["bearings"][field]["peak_contact_force"], result.summary["bearings"][name]["peak_contact_force"])

    def test_octave_reads_it(self):
        import shutil
        import subprocess

        octave = shutil.which("octave-cli") or shutil.which("octave")
        if octave is None:
            self.skipTest("octave is not installed: ./install-dependencies --tests")
        result = rd.Case(SETTLING, {"run.end_time": "10 ms"}).run(keep=["bearings.TB1.contact_force"])
        result.to_mat(self.folder / "drop.mat")
        script = 'load drop.mat; f = results.bearings.TB1.contact_force; printf("%d %d %.17g %.17g %s", size(f), max(f), results.summary.bearings.TB1.peak_contact_force, results.units.bearings.TB1.contact_force)'
        done = subprocess.run([octave, "--no-gui", "--no-history", "--eval", script], cwd=self.folder, capture_output=True, text=True, timeout=120)
        n, columns, largest, peak, unit = done.stdout.split()
        force = result["bearings.TB1.contact_force"]
        self.assertEqual((int(n), int(columns), float(largest), float(peak), unit),
                         (len(force), 1, float(force.max()), result.summary["bearings"]["TB1"]["peak_contact_force"], "N"))


if __name__ == "__main__":
    unittest.main()
