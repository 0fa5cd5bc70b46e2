"""A run that is interrupted, terminated or killed leaves whole results, and --resume ends it as if nothing had been."""

import json
import pathlib
import re
import shlex
import shutil
import signal
import sys
import time
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HAS_MESH_ROOM, PARAMS, ProgramTest, content_of, settings, start  # noqa: E402

# Some 160000 steps: a third of a second on the quickest machine so far, so that the file is there and a signal finds the program at work.
LONG = settings(run__end_time="80 ms", integration__method="runge-kutta-4", integration__step="0.5 us", output__detail_interval="0.1 ms")


def flat(tree, prefix=""):
    """Pairs ("bearings.TB1.friction_heat", value)."""
    if not isinstance(tree, dict):
        return [(prefix, tree)]
    return [pair for key, value in tree.items() for pair in flat(value, f"{prefix}.{key}")]


def series_of(path):
    """Every dataset of numbers in a results file."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" else None)
    return found


def catches(process, sign):
    """Whether a process has a handler for a signal."""
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"SigCgt:\s*(\w+)", status)[1], 16) >> (sign - 1) & 1 == 1


class Interruption(ProgramTest):
    def begin(self, *options, until):
        """Starts a long run and waits until `until()`; the process."""
        process = start("run", "reference.toml", "-o", "out", *LONG, *options, cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 30
        while not until():
            self.assertIsNone(process.poll(), "the run ended before it could be interrupted: make LONG longer")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return process

    def is_under_way(self):
        if not (self.folder / "out/results.h5").exists():
            return False
        time.sleep(0.1)
        return True

    def is_checkpointed(self):
        return len(list((self.folder / "out").glob("checkpoints/checkpoint-*.h5"))) > 1

    def n_rows(self):
        with h5py.File(self.folder / "out/results.h5", "r", swmr=True) as file:
            return len(file["time"])

    def stop(self, process, sign):
        # A signal that comes before the program catches it ends the program without a word.
        deadline = time.monotonic() + 30
        while sign in (signal.SIGINT, signal.SIGTERM) and process.poll() is None and not catches(process, sign):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        process.send_signal(sign)
        out, err = process.communicate(timeout=30)
        return process.returncode, out, err

    def resume(self, *options):
        return self.succeed("run", "reference.toml", "-o", "out", *LONG, *options, "--resume")

    def assert_equals_an_uninterrupted_run(self, *options, roundoff=0.0):
        """`roundoff` is for rows that lie within steps: interpolation sees the step's ends, whose times were added up from elsewhere."""
        self.succeed("run", "reference.toml", "-o", "whole", *LONG, *options)
        resumed, whole = self.summary("out"), self.summary("whole")
        for summary in (resumed, whole):
            self.assertTrue(summary["run"]["completed"])
            for key in ("wall_time", "cpu_time", "rhs_evaluations"):
                del summary["run"][key]
        self.assertEqual({key: value for key, value in flat(resumed) if (key, value) not in flat(whole)}, {})
        self.assertEqual(resumed, whole)
        resumed, whole = series_of(self.folder / "out/results.h5"), series_of(self.folder / "whole/results.h5")
        self.assertEqual(resumed.keys(), whole.keys())
        for name, expected in whole.items():
            same = resumed[name].shape == expected.shape and numpy.allclose(resumed[name], expected, rtol=roundoff, atol=roundoff)
            self.assertTrue(same, f"{name} differs by {self.difference(resumed[name], expected)}")

    @staticmethod
    def difference(a, b):
        return f"shape {a.shape} to {b.shape}" if a.shape != b.shape else f"{numpy.abs(a - b).max()}"

    def test_a_report_of_the_interrupted_run_is_made_again(self):
        process = self.begin(until=self.is_under_way)
        self.stop(process, signal.SIGINT)
        self.succeed("report", "out")
        self.write("out/measured.html", (self.folder / "out/report.html").read_text())
        part = (self.folder / "out/report.html").read_text()
        done = self.resume()
        self.assertIn("report of reference in out/report.html", done.stdout)
        self.assertIn("out/measured.html and measured.json are of the interrupted run", done.stderr)
        resumed = (self.folder / "out/report.html").read_text()
        self.assertNotEqual(resumed, part)
        (self.folder / "out/report.html").unlink()
        self.succeed("report", "out")
        self.assertEqual((self.folder / "out/report.html").read_text(), resumed)

    def assert_partial_results(self):
        """What an interrupted run leaves: rows up to where it stopped, none of them half written."""
        series = series_of(self.folder / "out/results.h5")
        times = series["time"]
        self.assertGreater(len(times), 5)
        self.assertLess(times[-1], 0.08)  # where LONG ends
        self.assertTrue(numpy.all(numpy.diff(times) > 0))
        for name, values in series.items():
            self.assertTrue(numpy.all(numpy.isfinite(values)), name)
            if not name.startswith("detail") and name not in ("bearings/TB1/ball_loads", "bearings/TB2/ball_loads"):
                self.assertEqual(len(values), len(times), name)
        return times[-1]

    def test_an_interrupted_run_ends_with_130_and_resumes_bit_for_bit(self):
        code, _, err = self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        self.assertEqual(code, 130, err)
        self.assertRegex(err, r"interrupted at t = [\d.e-]+ s")
        self.assertIn("rotordrop run reference.toml -o out --resume", err)
        last = self.assert_partial_results()
        summary = self.summary()
        self.assertFalse(summary["run"]["completed"])
        self.assertAlmostEqual(summary["run"]["end_time"], last, delta=51e-6)
        self.resume()
        self.assert_equals_an_uninterrupted_run()

    def test_a_terminated_run_ends_with_143_and_resumes_bit_for_bit(self):
        code, _, err = self.stop(self.begin(until=self.is_under_way), signal.SIGTERM)
        self.assertEqual(code, 143, err)
        self.assertIn("--resume", err)
        self.assert_partial_results()
        self.resume()
        self.assert_equals_an_uninterrupted_run()

    def test_a_closed_terminal_ends_a_run_in_good_order_unless_that_is_ignored(self):
        code, _, err = self.stop(self.begin(until=self.is_under_way), signal.SIGHUP)
        self.assertEqual(code, 129, err)
        self.assertIn("--resume", err)
        self.assert_partial_results()
        shutil.rmtree(self.folder / "out")
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does; a child inherits it
        try:
            process = self.begin(until=self.is_under_way)
            process.send_signal(signal.SIGHUP)
            self.assertEqual(self.stop(process, signal.SIGINT)[0], 130)
        finally:
            signal.signal(signal.SIGHUP, before)

    def test_a_killed_run_resumes_bit_for_bit_from_its_last_checkpoint(self):
        often = settings(output__checkpoint_interval="0.05 s")
        code, _, _ = self.stop(self.begin(*often, until=lambda: self.is_checkpointed() and self.n_rows() > 5), signal.SIGKILL)
        self.assertEqual(code, -signal.SIGKILL)
        self.assertGreater(self.n_rows(), 5)
        self.assertFalse((self.folder / "out/summary.json").exists())
        self.resume(*often)
        self.assert_equals_an_uninterrupted_run(*often)

    def test_a_run_killed_before_its_first_checkpoint_starts_anew(self):
        self.stop(self.begin(until=lambda: (self.folder / "out/results.h5").exists()), signal.SIGKILL)
        self.resume()
        self.assert_equals_an_uninterrupted_run()

    def test_a_damaged_checkpoint_is_passed_over(self):
        often = settings(output__checkpoint_interval="0.05 s")
        self.stop(self.begin(*often, until=self.is_checkpointed), signal.SIGKILL)
        newest = sorted((self.folder / "out/checkpoints").glob("*.h5"))[-1]
        newest.write_bytes(newest.read_bytes()[:1000])
        self.resume(*often)
        self.assert_equals_an_uninterrupted_run(*often)

    def test_a_run_can_be_interrupted_and_resumed_again_and_again(self):
        # The end is no whole number of steps: the last one is shorter, and must be so after resuming too.
        odd = settings(run__end_time="20.0003 ms", integration__step="0.11 us")
        self.stop(self.begin(*odd, until=self.is_under_way), signal.SIGINT)
        for _ in range(20):
            process = self.begin(*odd, "--resume", until=lambda: time.sleep(0.25) or True)
            code, _, err = self.stop(process, signal.SIGINT)
            if code == 0:
                break
            self.assertEqual(code, 130, err)
        else:
            self.resume(*odd)
        # Places differ by 1e-16 of themselves; balls of 100 um displacement are pressed by a hundredth of that, so their loads by some 1e-14, and by how much
        # depends on where the run was stopped.
        self.assert_equals_an_uninterrupted_run(*odd, roundoff=1e-12)

    def test_a_run_with_error_control_resumes_to_the_same_result(self):
        # Its steps start anew at the checkpoint, so it is not the same bit for bit: within the tolerance instead.
        # Differences grow from bounce to bounce: as many steps as in LONG, but over half of its time.
        fine = settings(integration__method="dormand-prince", integration__tolerance="1e-9", integration__step="0.25 us", run__end_time="40 ms")
        self.stop(self.begin(*fine, until=self.is_under_way), signal.SIGINT)
        self.resume(*fine)
        self.succeed("run", "reference.toml", "-o", "whole", *LONG, *fine)
        resumed, whole = series_of(self.folder / "out/results.h5"), series_of(self.folder / "whole/results.h5")
        self.assertEqual(len(resumed["time"]), len(whole["time"]))
        numpy.testing.assert_allclose(resumed["bearings/TB1/orbit"], whole["bearings/TB1/orbit"], rtol=0, atol=1e-9)

    def test_no_row_of_the_step_before_the_interruption_is_lost(self):
        # Some ten rows in each step: whenever the signal comes, rows of its step are still to be written.
        dense = settings(integration__method="dormand-prince", integration__step="50 us", output__interval="1 us", output__longest_interval="1 us", run__end_time="150 ms")
        self.stop(self.begin(*dense, until=self.is_under_way), signal.SIGINT)
        times = series_of(self.folder / "out/results.h5")["time"]
        interrupted_at = self.summary()["run"]["end_time"]
        self.assertGreater(times[-1], interrupted_at - 1.01e-6)
        self.resume(*dense)
        times = series_of(self.folder / "out/results.h5")["time"]
        self.assertLess(numpy.diff(times).max(), 1.01e-6)

    def test_resumes_with_the_same_values_in_other_units(self):
        self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        same = settings(run__end_time="0.08", integration__method="runge-kutta-4", integration__step="0.5 us", output__detail_interval="100 us")
        self.succeed("run", "reference.toml", "-o", "out", *same, "--resume")
        self.assertTrue(self.summary()["run"]["completed"])
        self.assertIn("there is nothing to resume", self.resume().stdout)

    def test_refuses_to_resume_with_other_parameters(self):
        self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        before = content_of(self.folder / "out")
        done = self.call("run", "reference.toml", "-o", "out", *LONG, *settings(contact__friction_coefficient="0.2"), "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "parameters")
        self.assertEqual(content_of(self.folder / "out"), before)

    @unittest.skipUnless(HAS_MESH_ROOM, "built without the mesh room")
    def test_refuses_to_resume_with_another_mesh(self):
        self.succeed("mesh", "reference.toml", "-o", "mine.msh", "--set", "thermal.fe.largest_cell=4 mm")
        own = ["--set", 'thermal.models=["lumped", "fe"]', "--set", "thermal.fe.mesh=mine-NAME.msh"]
        self.stop(self.begin(*own, until=self.is_under_way), signal.SIGINT)
        mine = self.folder / "mine-TB2.msh"
        good = mine.read_bytes()
        mine.write_bytes(good + b"$Comments\nby another hand\n$EndComments\n")
        before = content_of(self.folder / "out")
        done = self.call("run", "reference.toml", "-o", "out", *LONG, *own, "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("A mesh, a recording or a module of parts that the case names", " ".join(done.stderr.split()))
        self.assertEqual(content_of(self.folder / "out"), before)
        mine.write_bytes(good)
        self.succeed("run", "reference.toml", "-o", "out", *LONG, *own, "--resume")

    def test_refuses_to_start_over_an_interrupted_run(self):
        self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        before = content_of(self.folder / "out")
        done = self.call("run", "reference.toml", "-o", "out", *LONG)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "--resume")
        self.assertEqual(content_of(self.folder / "out"), before)

    def test_a_finished_run_is_not_resumed(self):
        short = settings(run__end_time="1 ms")
        self.succeed("run", "reference.toml", "-o", "out", *short)
        before = content_of(self.folder / "out")
        done = self.call("run", "reference.toml", "-o", "out", *short, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the run in out is finished, at t = 0.001 s: there is nothing to resume", done.stdout)
        self.assertEqual(content_of(self.folder / "out"), before)

    def test_a_finished_run_whose_results_were_damaged_is_not_called_finished(self):
        short = settings(run__end_time="20 ms")
        self.succeed("run", "reference.toml", "-o", "out", *short)
        file = self.folder / "out/results.h5"
        whole = file.read_bytes()
        n = len(whole)
        n_refused = 0
        for part in range(1, 10):  # zeros over each tenth, as after a power cut
            file.write_bytes(whole[:n * part // 10] + bytes(n // 10) + whole[n * part // 10 + n // 10:])
            done = self.call("run", "reference.toml", "-o", "out", *short, "--resume")
            self.assertIn(done.returncode, (0, 2), part)  # zeros for numbers alone are not noticed (docs/reference/reliability.md)
            if done.returncode == 2:
                n_refused += 1
                self.assertIn("its checkpoints are gone: run it again with --force, without --resume", " ".join(done.stderr.split()))
        self.assertGreater(n_refused, 3)
        file.write_bytes(whole)
        self.assertIn("there is nothing to resume", self.succeed("run", "reference.toml", "-o", "out", *short, "--resume").stdout)

    def test_a_run_killed_while_it_removed_its_checkpoints_is_finished(self):
        short = settings(run__end_time="1 ms")
        self.succeed("run", "reference.toml", "-o", "out", *short)
        (self.folder / "out/checkpoints").mkdir()
        for _ in range(2):
            done = self.succeed("run", "reference.toml", "-o", "out", *short, "--resume")
            self.assertIn("there is nothing to resume", done.stdout)
            (self.folder / "out/checkpoints/checkpoint-000002.h5.new").write_bytes(b"begun")

    def test_what_a_killed_writer_left_goes_when_the_run_goes_on(self):
        self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        left = ["results.h5.123.new", "results.h5.resuming.123.new", "summary.json.writing"]
        for name in left:
            self.write(f"out/{name}", "begun")
        self.resume()
        self.assertEqual([name for name in left if (self.folder / "out" / name).exists()], [])

    def test_two_runs_do_not_write_into_one_directory(self):
        process = self.begin(until=self.is_under_way)
        done = self.call("run", "reference.toml", "-o", "out", *LONG, "--force")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "another run is writing into the directory")
        self.stop(process, signal.SIGINT)
        self.resume()

    def test_the_command_that_an_interrupted_run_names_goes_on(self):
        overrides = settings(rotor__initial_offset='["1 um", 0]')
        code, _, err = self.stop(self.begin(*overrides, until=self.is_under_way), signal.SIGINT)
        self.assertEqual(code, 130, err)
        command = shlex.split(err.split("Continue with: rotordrop ")[1])
        self.succeed(*command)
        self.assertTrue(json.loads((self.folder / "out/summary.json").read_text())["run"]["completed"])

    def test_a_run_killed_before_its_first_checkpoint_is_not_replaced_by_another_case(self):
        self.stop(self.begin(until=self.is_under_way), signal.SIGKILL)
        done = self.call("run", "reference.toml", "-o", "out", *LONG, *settings(contact__friction_coefficient="0.2"), "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"the run of another case: contact\.friction_coefficient \(0\.1, now 0\.2\)")

    def test_what_differs_from_the_case_of_a_checkpoint_is_named(self):
        code, _, err = self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        self.assertEqual(code, 130, err)
        done = self.call("run", "reference.toml", "-o", "out", *LONG, "--set", 'limits."bearings.*.peak_contact_force".max="6 kN"', "--set", "contact.friction_coefficient=0.2", "--resume")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, r"written with other parameters: contact\.friction_coefficient \(0\.1, now 0\.2\), limits\.bearings\.\*\.peak_contact_force\.max \(none, now 6 kN\)\.")
        # However a number is written, it is the same; and the run goes on.
        self.resume("--set", "contact.friction_coefficient=1e-1")

    def test_checkpoints_that_cannot_be_read_are_named(self):
        self.stop(self.begin(until=self.is_under_way), signal.SIGINT)
        for file in (self.folder / "out/checkpoints").iterdir():
            file.write_bytes(b"nonsense")
        done = self.call("run", "reference.toml", "-o", "out", *LONG, "--resume")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "none of the checkpoints can be read")
        self.assertRegex(done.stderr, "checkpoint-000001.h5")

    def test_a_finished_run_leaves_no_checkpoints(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="10 ms", output__checkpoint_interval="1 ms"))
        self.assertEqual(sorted(content_of(self.folder / "out")), ["parameters.toml", "results.h5", "summary.json"])

    def test_resuming_where_nothing_was_begun_starts_a_run(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"), "--resume")
        self.assertEqual(json.loads((self.folder / "out/summary.json").read_text())["run"]["end_time"], 0.001)


@unittest.skipUnless(HAS_MESH_ROOM, "built without finite elements")
class InterruptedHeat(ProgramTest):
    def is_stopped_between_outputs(self, text, sign, code):
        """Far from the only time at which anything is wanted."""
        process = start("heat", self.write("heat.toml", text), "-o", "out", cwd=self.folder)
        self.addCleanup(process.kill)
        while not catches(process, sign) or not (self.folder / "out/parameters.toml").exists():
            self.assertIsNone(process.poll(), "it ended before it could be interrupted")
            time.sleep(0.01)
        time.sleep(0.3)
        process.send_signal(sign)
        process.communicate(timeout=60)  # of the slowest sanitized step; it would go on for minutes
        self.assertEqual(process.returncode, code)
        summary = json.loads((self.folder / "out/summary.json").read_text())
        self.assertFalse(summary["completed"])
        return summary

    def test_of_sections_ends_after_its_step(self):
        text = (PARAMS / "heat/ring-in-housing.toml").read_text()
        text = re.sub(r"(?m)^output_times = .*$", 'output_times = ["100 s"]', text)
        self.assertNotIn("[fe]", text)
        summary = self.is_stopped_between_outputs(text + "\n[fe]\ncells = 40\ntime_tolerance = 1e-9\n", signal.SIGINT, 130)
        self.assertLess(summary["end_time"], 100.)
        energy = summary["energy"]
        self.assertAlmostEqual(energy["residual"], 0., delta=1e-6 * energy["input"] + 1e-9)

    def test_of_a_bearing_ends_after_its_step(self):
        text = (PARAMS / "heat/bearing.toml").read_text()
        text = re.sub(r"(?m)^base = .*$", 'base = "reference.toml"', text)
        text = re.sub(r"(?m)^output_times = .*$", 'output_times = ["1000 s"]', text)
        # Heat that changes every millisecond: each change begins with short steps.
        n = 40_000
        text += f'[[heat.source]]\nport = "inner"\ntimes = {[round(i * 1e-3, 3) for i in range(n)]}\nvalues = {[0, 50] * (n // 2)}\n'
        summary = self.is_stopped_between_outputs(text, signal.SIGTERM, 143)
        for name, energy in summary["energy"].items():  # one model may be at the end, the other within its steps
            self.assertAlmostEqual(energy["residual"], 0., delta=1e-6 * energy["input"] + 1e-9, msg=name)


if __name__ == "__main__":
    unittest.main()
