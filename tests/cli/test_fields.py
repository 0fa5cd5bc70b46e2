"""Fields for ParaView: times and contents of the files, initial state, interruption, pictures.

ROTORDROP_PROGRAM is the program under test. Skipped where the module of the finite-element room is not beside it.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HEATED_DISC, PROGRAM, ProgramTest, settings, start  # noqa: E402

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "examples/plot_field.py"
sys.path.insert(0, str(SCRIPT.parent))
from plot_field import RISE, TEMPERATURE, read_series, read_vtu  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()

CASE = """
output_times = ["1 ms", "3 ms", "10 ms"]
field_times = ["1 ms", "10 ms"]
field_interval = "3 ms"
""" + HEATED_DISC + """
[[fixed]]
boundary = "disc.left"
temperature = "30 degC"
[[probe]]
name = "rim"
x = "10 mm"
r = "20 mm"
[[probe]]
name = "corner"
x = 0
r = "10 mm"
"""


def value_at(field, x, r, name=TEMPERATURE):
    distance = np.hypot(field["points"][:, 0] - x, field["points"][:, 1] - r)
    assert distance.min() < 1e-9, distance.min()
    return field["data"][name][distance.argmin()]


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
class HeatFields(ProgramTest):
    def test_times_are_those_asked_for_and_the_start_is_among_them(self):
        self.succeed("heat", self.write("disc.toml", CASE), "-o", "out", "--quiet")
        series = read_series(self.folder / "out/fields/temperature.pvd")
        self.assertEqual([t for t, _ in series], [0.0, 0.001, 0.003, 0.006, 0.009, 0.01])
        self.assertEqual(len({file for _, file in series}), 6)

    def test_nodes_hold_what_probes_report(self):
        self.succeed("heat", self.write("disc.toml", CASE), "-o", "out", "--quiet")
        probes = self.summary()["probes"]
        fields = {t: read_vtu(file) for t, file in read_series(self.folder / "out/fields/temperature.pvd")}
        for i, t in enumerate(probes["rim"]["time"]):
            # Files have single precision.
            self.assertAlmostEqual(value_at(fields[t], 0.01, 0.02), probes["rim"]["temperature"][i], delta=1e-4)
            self.assertAlmostEqual(value_at(fields[t], 0.0, 0.01), 303.15, delta=1e-4)
            self.assertAlmostEqual(value_at(fields[t], 0.01, 0.02, RISE), probes["rim"]["temperature"][i] - 293.15, delta=1e-4)
        start = fields[0.0]["data"]
        self.assertAlmostEqual(value_at(fields[0.0], 0.01, 0.02), 293.15, delta=1e-4)
        self.assertEqual(set(start), {TEMPERATURE, RISE, "body"})
        self.assertGreater(probes["rim"]["temperature"][0], 294)

    def test_fields_change_no_number(self):
        # Times of fields are met exactly, so they shorten steps: to the time's tolerance, not to the bit.
        self.succeed("heat", self.write("disc.toml", CASE), "-o", "with", "--quiet")
        self.succeed("heat", "disc.toml", "-o", "without", "--quiet", "--set", "field_times=[]", "--set", "field_interval=1")
        for name, probe in self.summary("with")["probes"].items():
            for a, b in zip(probe["temperature"], self.summary("without")["probes"][name]["temperature"]):
                self.assertAlmostEqual(a, b, delta=1e-3)
        self.assertEqual([t for t, _ in read_series(self.folder / "without/fields/temperature.pvd")], [0.0])

    def test_faulty_times_are_named(self):
        done = self.call("heat", self.write("disc.toml", CASE.replace('field_times = ["1 ms", "10 ms"]', 'field_times = ["2 ms", "1 ms"]')), "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("field_times must increase", done.stderr)
        done = self.call("heat", self.write("disc.toml", CASE.replace('field_times = ["1 ms", "10 ms"]', 'field_times = ["20 ms"]')), "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("beyond the last of output_times", done.stderr)

    def test_a_new_run_leaves_no_field_of_the_one_it_replaces(self):
        self.succeed("heat", self.write("disc.toml", CASE), "-o", "out", "--quiet")
        self.succeed("heat", "disc.toml", "-o", "out", "--quiet", "--force", "--set", "field_times=[]", "--set", "field_interval=1")
        self.assertEqual(sorted(p.name for p in (self.folder / "out/fields").iterdir()), ["temperature-00000.vtu", "temperature.pvd"])

    def test_pictures_are_drawn(self):
        self.succeed("heat", self.write("disc.toml", CASE), "-o", "out", "--quiet")
        done = subprocess.run([sys.executable, SCRIPT, self.folder / "out"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        pictures = sorted(p.name for p in (self.folder / "out/figures/fields").iterdir())
        self.assertEqual(pictures, [f"temperature-{i:05d}.png" for i in range(6)] + ["temperature-sheet.png"])
        for p in (self.folder / "out/figures/fields").iterdir():
            self.assertGreater(p.stat().st_size, 5000)

    def test_a_folder_without_fields_is_named(self):
        done = subprocess.run([sys.executable, SCRIPT, self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no fields in", done.stderr)


#: Plain sections need no mesh generator.
DROP = """
[thermal]
models = ["lumped", "fe"]
[thermal.fe]
section = "plain"
coupling = "{coupling}"
field_interval = "4 ms"
field_times = ["8.5 ms"]
"""


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
class DropFields(ProgramTest):
    def fields(self, bearing, output="out"):
        return read_series(self.folder / output / f"fields/{bearing}.pvd")

    def bore_of(self, file):
        """Lowest and highest temperature of the nodes on the inner ring's bore."""
        field = read_vtu(file)
        ring = field["data"]["body"] == 0
        r = field["points"][:, 1]
        on_bore = ring & (np.abs(r - r[ring].min()) < 1e-9)
        values = field["data"][TEMPERATURE][on_bore]
        return values.min(), values.max()

    def test_a_reduced_coupling_writes_what_the_results_say_of_the_bore(self):
        self.succeed("run", self.case(DROP.format(coupling="reduced")), "-o", "out", "--quiet", "--set", "output.interval=0.5 ms")
        with h5py.File(self.folder / "out/results.h5") as results:
            for bearing in ("TB1", "TB2"):
                series = self.fields(bearing)
                self.assertEqual([t for t, _ in series], [0.0, 0.004, 0.008, 0.0085])
                for t, file in series:
                    row = np.abs(results["time"][:] - t).argmin()
                    self.assertAlmostEqual(results["time"][row], t, delta=1e-12)
                    _, lowest, highest = results[f"fe/{bearing}/bore"][row]
                    low, high = self.bore_of(file)
                    self.assertAlmostEqual(low, lowest, delta=1e-3)
                    self.assertAlmostEqual(high, highest, delta=1e-3)
            self.assertGreater(self.bore_of(self.fields("TB1")[-1][1])[1], 293.15 + 1, "nothing is warm: the test shows nothing")

    def test_fields_without_end_and_fields_that_are_not_written_are_told(self):
        def said(*keys, command=("check", "drop.toml")):
            done = self.call(*command, *[word for key in keys for word in ("--set", key)])
            return done.returncode, " ".join(done.stderr.split())

        self.case('[thermal]\nmodels = ["lumped", "fe"]\n')
        for command in (("check", "drop.toml"), ("run", "drop.toml", "-o", "out")):
            code, told = said("thermal.fe.field_interval=1e-8", command=command)
            self.assertEqual(code, 2)
            self.assertIn("thermal.fe.field_interval = 1e-08 s and an end at 0.01 s make 1e+06 fields of each section; at most 1e+05 are written", told)
        self.assertFalse((self.folder / "out").exists())
        self.assertEqual(said("thermal.fe.field_interval=1e-6"), (0, ""))
        self.assertRegex(said("thermal.fe.field_times=[5e-3, 1, 10]")[1], r"warning: .*2 of the 3 thermal\.fe\.field_times lie beyond the end of the run, 0\.01 s")
        self.assertRegex(said("thermal.fe.field_interval=1")[1], r"warning: .*field_interval = 1 s is longer than the run, 0\.01 s")
        self.assertRegex(said('thermal.models=["lumped"]', "thermal.fe.field_interval=1e-3")[1], r"warning: .*thermal\.fe\.field_interval has no effect: no finite elements run")
        self.write("disc.toml", CASE.replace('field_interval = "3 ms"', "field_interval = 1e-8"))
        code, told = said(command=("check", "disc.toml"))
        self.assertEqual(code, 2)
        self.assertIn("disc.toml:4:18: field_interval = 1e-08 s and an end at 0.01 s make 1e+06 fields", told)

    def test_a_windowed_coupling_writes_at_the_windows_end_that_follows(self):
        self.succeed("run", self.case(DROP.format(coupling="windowed")), "-o", "out", "--quiet")
        with h5py.File(self.folder / "out/results.h5") as results:
            ends = results["windows/time"][:]
            series = self.fields("TB1")
            wanted = [0.004, 0.008, 0.0085]
            expected = [0.0] + [float(ends[ends >= t * (1 - 1e-9)][0]) for t in wanted]
            self.assertEqual([t for t, _ in series], expected)
            for t, file in series[1:]:
                _, lowest, highest = results["windows/TB1/bore"][list(ends).index(t)]
                low, high = self.bore_of(file)
                self.assertAlmostEqual(low, lowest, delta=1e-3)
                self.assertAlmostEqual(high, highest, delta=1e-3)

    def test_a_killed_run_goes_on_with_its_series(self):
        for coupling in ("reduced", "windowed"):
            with self.subTest(coupling):
                case = self.case(DROP.format(coupling=coupling), name=f"{coupling}.toml")
                options = [case, "-o", f"{coupling}-out", "--quiet", *settings(run__end_time="30 ms", integration__method="runge-kutta-4", integration__step="1 us", thermal__fe__field_interval="1 ms", output__checkpoint_interval="0.05 s")]
                process = start("run", *options, cwd=self.folder)
                self.addCleanup(process.communicate)
                self.addCleanup(process.kill)
                deadline = time.monotonic() + 60
                while not (list((self.folder / f"{coupling}-out").glob("checkpoints/checkpoint-*.h5")) and (self.folder / f"{coupling}-out/fields/TB2-00003.vtu").exists()):
                    self.assertIsNone(process.poll(), "the run ended before it could be killed")
                    self.assertLess(time.monotonic(), deadline)
                    time.sleep(0.01)
                process.kill()
                process.wait()
                before = [t for t, _ in self.fields("TB1", f"{coupling}-out")]
                self.assertGreater(len(before), 2)
                self.succeed("run", *options, "--resume")
                self.succeed("run", *options[:1], "-o", f"{coupling}-whole", *options[3:])
                resumed, whole = self.fields("TB1", f"{coupling}-out"), self.fields("TB1", f"{coupling}-whole")
                self.assertEqual([t for t, _ in resumed], [t for t, _ in whole])
                for (_, a), (_, b) in zip(resumed, whole):
                    np.testing.assert_allclose(read_vtu(a)["data"][TEMPERATURE], read_vtu(b)["data"][TEMPERATURE], atol=1e-3)
                left = {p.name for p in (self.folder / f"{coupling}-out/fields").iterdir()}
                listed = {file.name for b in ("TB1", "TB2") for _, file in self.fields(b, f"{coupling}-out")}
                self.assertEqual(left, listed | {"TB1.pvd", "TB2.pvd"})


@unittest.skipUnless(HAS_ROOM, "built without the finite-element module")
class SeveralProcesses(ProgramTest):
    def mpirun(self, n, *arguments):
        program = shutil.which("mpirun")
        if not program:
            self.skipTest("mpirun is not installed (Debian: openmpi-bin)")
        command = [program, "-n", str(n), "--oversubscribe", *(["--allow-run-as-root"] if os.geteuid() == 0 else []), PROGRAM]
        return subprocess.run([*command, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=300, stdin=subprocess.DEVNULL)

    def test_two_ranks_give_the_numbers_of_one(self):
        case = self.write("disc.toml", CASE)
        self.succeed("heat", case, "-o", "one", "--quiet")
        one = self.summary("one")
        for solver in ("direct", "multigrid"):
            done = self.mpirun(2, "heat", case, "-o", solver, "--set", f"fe.solver={solver}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("results in"), 1, "both ranks talk")
            two = self.summary(solver)
            self.assertEqual((two["ranks"], two["solver"]), (2, solver))
            for name, probe in one["probes"].items():
                for a, b in zip(probe["temperature"], two["probes"][name]["temperature"]):
                    self.assertAlmostEqual(a, b, delta=1e-8, msg=f"{name}, {solver}")
            self.assertLess(abs(two["energy"]["residual"]), 1e-10 * two["energy"]["input"])
            self.assertEqual([t for t, _ in read_series(self.folder / solver / "fields/temperature.pvd")], [0.0, 0.001, 0.003, 0.006, 0.009, 0.01])

    def test_a_fault_is_told_once_with_exit_code_2(self):
        done = self.mpirun(2, "heat", self.write("disc.toml", CASE.replace('"steel"', '"stele"')), "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count('Did you mean "steel"?'), 1)


if __name__ == "__main__":
    unittest.main()
