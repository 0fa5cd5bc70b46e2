"""A drop from Python: the same numbers as the program and as an independent one, in memory, without Python's lock, and ended by Ctrl-C."""

import json
import os
import pickle
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import time
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from package import GRAVITY, PACKAGE, PARAMS, SETTLING, SOURCE, PackageTest, flat, rd  # noqa: E402
from program import call  # noqa: E402

SHORT = {"run.end_time": "20 ms"}


class Drop(PackageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.result = rd.Case(SETTLING, SHORT).run()

    def test_numbers_are_those_of_an_independent_program(self):
        expected = json.loads((SOURCE / "tests/regression/settling-case.json").read_text(encoding="utf-8"))
        summary = rd.Case(SOURCE / expected["case"]).run(keep=[]).summary
        self.assertGreater(len(expected["scalars"]), 10)
        for scalar in expected["scalars"]:
            value = summary
            for key in scalar["scalar"].split("."):
                value = value[key]
            with self.subTest(scalar["scalar"]):
                self.assertAlmostEqual(value, scalar["expected"], delta=scalar["tolerance"], msg=f"{scalar['unit']}; {scalar['reason']}")

    def test_memory_and_program_agree_in_every_number_and_series(self):
        done = call("run", SETTLING, "-o", self.folder / "out", "--set", "run.end_time=20 ms")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(self.result.text, done.stdout)
        program = dict(flat(json.loads((self.folder / "out/summary.json").read_text())))
        here = dict(flat(self.result.summary))
        clocks = {"run.wall_time", "run.cpu_time"}
        self.assertEqual(list(here), list(program))
        self.assertGreater(len(here), 200)
        self.assertEqual({k: v for k, v in here.items() if k not in clocks}, {k: v for k, v in program.items() if k not in clocks})
        with h5py.File(self.folder / "out/results.h5") as file:
            paths = []
            file.visititems(lambda name, item: paths.append("/" + name) if isinstance(item, h5py.Dataset) and name not in ("parameters", "given") else None)
            self.assertEqual(self.result.recorded.datasets, sorted(paths))
            for path in paths:
                if path.endswith("/time"):
                    continue
                series, dataset = self.result[path], file[path]
                self.assertEqual(series.attrs["units"], dataset.attrs["units"], path)
                self.assertEqual(series.attrs["long_name"], dataset.attrs["long_name"], path)
                self.assertTrue(np.array_equal(series.values.reshape(dataset.shape), dataset[()]), path)
                self.assertTrue(np.array_equal(series[series.dims[0]].values, file[dataset.attrs["time"]][()]), path)

    def test_free_fall_until_the_first_contact(self):
        # Levitated in the middle of the bore, the rotor falls by the air gap: t = sqrt(2 s / g). Unbalance moves it by micrometres of 250 um.
        case = rd.Case(PARAMS / "neisi2019.toml", {"run.end_time": "10 ms", "rotor.unbalance": []})
        summary = case.run(keep=[]).summary
        for name in case.bearings:
            self.assertAlmostEqual(summary["bearings"][name]["first_contact_time"], np.sqrt(2 * 250e-6 / GRAVITY), delta=2e-5)

    def test_friction_given_as_a_number_acts(self):
        heat = [rd.Case(SETTLING, {**SHORT, "contact.friction_coefficient": mu}).run(keep=[]).summary["energy"]["heat_deposited"] for mu in (0.0, 0.05, 0.1)]
        self.assertLess(heat[0], heat[1])
        self.assertLess(heat[1], heat[2])

    def test_series_have_times_units_and_named_dimensions(self):
        series = self.result.series
        force = series["bearings.TB1.contact_force"]
        self.assertEqual((force.dims, force.attrs["units"]), (("time",), "N"))
        self.assertEqual(series["time"].attrs["units"], "s")
        self.assertEqual(series["bearings.TB1.orbit"].dims, ("time", "axis"))
        self.assertEqual(series["bearings.TB1.orbit"].sel(axis="z").attrs["units"], "m")
        loads = series["bearings.TB2.ball_loads"]
        self.assertEqual(loads.dims, ("detail_time", "TB2.ball"))
        self.assertNotEqual(series.sizes["time"], series.sizes["detail_time"])
        # One row of balls has a dimension, too.
        self.assertEqual(series["bearings.TB1.ball_force"].dims, ("time", "TB1.row"))
        self.assertEqual((series.sizes["TB1.row"], series.sizes["TB2.row"]), (1, 2))
        self.assertEqual(list(series["surface"].values[:2]), ["shaft", "bore"])
        # Sampled every 50 us, a peak of milliseconds is met within a few per cent; the summary takes it at every step.
        peak = self.result.summary["bearings"]["TB1"]["peak_contact_force"]
        self.assertLessEqual(float(force.max()), peak)
        self.assertGreater(float(force.max()), 0.97 * peak)

    def test_bearings_selections_and_tables(self):
        bearing = self.result.bearings["TB2"]
        self.assertEqual(list(self.result.bearings), ["TB1", "TB2"])
        self.assertEqual(bearing.ball_loads.dims, ("detail_time", "ball"))
        self.assertEqual(self.result.select("/thermal/TB1").inner_ring.attrs["units"], "K")
        frame = self.result.frame("bearings.TB1.orbit", "bearings.TB1.contact_force")
        self.assertEqual(list(frame.columns), ["bearings.TB1.orbit.y", "bearings.TB1.orbit.z", "bearings.TB1.contact_force"])
        self.assertEqual(frame.attrs["units"]["bearings.TB1.orbit.y"], "m")
        self.assertEqual(len(frame), self.result.series.sizes["time"])
        self.assertTrue(np.array_equal(frame["bearings.TB1.orbit.z"], self.result["bearings.TB1.orbit"].sel(axis="z")))
        self.assertGreater(len(self.result.frame().columns), 100)
        self.assertIn("bearings.TB2.ball_loads.row 1 ball 1", self.result.frame(time="detail_time").columns)
        scalars = self.result.scalars
        self.assertEqual(tuple(scalars.loc["run.cpu_time", ["unit", "meaning"]]), ("s", "computing time of the run"))
        row = scalars.loc["bearings.TB1.peak_contact_force"]
        self.assertEqual((row["value"], row["unit"]), (self.result.summary["bearings"]["TB1"]["peak_contact_force"], "N"))
        with self.assertRaisesRegex(KeyError, "no series /bearings/TB3/orbit; there is /bearings/TB1/orbit"):
            self.result["bearings.TB3.orbit"]
        with self.assertRaisesRegex(KeyError, "known: TB1, TB2"):
            self.result.bearings["TB3"]

    def test_only_what_is_asked_for_is_kept(self):
        rd.Case(SETTLING, SHORT).run(keep=["time", "bearings.TB1.orbit"])
        result = rd.Case(SETTLING, SHORT).run(keep="bearings.TB1.contact_force")
        self.assertGreater(float(result["bearings.TB1.contact_force"].max()), 0)
        with self.assertRaisesRegex(rd.InputError, "contact_forc.*\n.*contact_force"):
            rd.Case(SETTLING, SHORT).run(keep=["bearings.TB1.contact_forc"])
        result = rd.Case(SETTLING, SHORT).run(keep=["bearings.TB1.contact_force"])
        self.assertTrue(np.array_equal(result["bearings.TB1.contact_force"], self.result["bearings.TB1.contact_force"]))
        self.assertNotIn("/bearings/TB2/contact_force", result.recorded.datasets)
        self.assertEqual(result.summary["bearings"], self.result.summary["bearings"])

    def test_series_outlive_their_result_and_cannot_be_spoilt(self):
        result = rd.Case(SETTLING, SHORT).run(keep=["bearings.TB1.contact_force"])
        values = result["bearings.TB1.contact_force"].values
        copy = values.copy()
        del result
        self.assertTrue(np.array_equal(values, copy))
        with self.assertRaises(ValueError):
            values[0] = 1.0

    def test_a_result_is_pickled_where_it_has_files(self):
        case = rd.Case(SETTLING, {"run.end_time": "8 ms"})
        result = case.run(self.folder / "out")
        again = pickle.loads(pickle.dumps(result))
        self.assertEqual((again.summary, again.completed, again.notes, again.case.text), (result.summary, True, result.notes, case.text))
        self.assertTrue(again.series.identical(result.series))
        with self.assertRaisesRegex(TypeError, "in memory cannot be pickled.*result.summary"):
            pickle.dumps(case.run())

    def test_a_case_is_pickled_and_varied(self):
        case = rd.Case(SETTLING, SHORT)
        again = pickle.loads(pickle.dumps(case))
        # What differs are the places of its values.
        self.assertEqual(again.parameters, case.parameters)
        varied = case.with_overrides({"contact.friction_coefficient": 0.07})
        self.assertEqual(varied.parameters["contact"]["friction_coefficient"], 0.07)
        self.assertEqual(varied.parameters["run"]["end_time"], "20 ms")


class Running(PackageTest):
    """A run beside other threads, progress, interruption."""

    def test_other_threads_run_meanwhile(self):
        case = rd.Case(SETTLING, {"run.end_time": "0.2 s"})
        ticks, ended = [], threading.Event()

        def tick():
            while not ended.wait(0.002):
                ticks.append(time.perf_counter())

        thread = threading.Thread(target=tick)
        thread.start()
        start = time.perf_counter()
        case.run(keep=[])
        duration = time.perf_counter() - start
        ended.set()
        thread.join()
        during = [t for t in ticks if start < t < start + duration]
        # With Python's lock held there would be none but at a look for Ctrl-C every 50 ms. A busy machine may give the thread a tenth of its time.
        self.assertGreater(len(during), duration / 0.02, f"{len(during)} ticks in {duration:.2f} s")

    def test_two_threads_give_the_same_bits(self):
        case = rd.Case(SETTLING, SHORT)
        results = [None, None]

        def run(k):
            results[k] = case.run()

        threads = [threading.Thread(target=run, args=(k,)) for k in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        alone = case.run()
        for result in results:
            self.assertTrue(result.series.equals(alone.series))

    def test_progress_is_told_and_its_exception_ends_the_run(self):
        # Told every 0.2 s; 3 s of the machine take a second at least.
        seen = []
        case = rd.Case(SETTLING, {"run.end_time": "3 s"})
        case.run(keep=[], progress=seen.append)
        self.assertGreaterEqual(len(seen), 2)
        times = [p.time for p in seen]
        self.assertEqual(times, sorted(times))
        self.assertAlmostEqual(times[-1], 3, delta=1e-8)
        self.assertEqual(seen[-1].end_time, 3)
        self.assertGreater(seen[-1].largest_contact_force, 1000)

        def complain(progress):
            raise ZeroDivisionError("of the caller")

        with self.assertRaisesRegex(ZeroDivisionError, "of the caller"):
            case.run(keep=[], progress=complain)

    def interrupted(self, program):
        """Output of a Python program that gets SIGINT half a second after it has said "running"."""
        process = subprocess.Popen([sys.executable, "-c", textwrap.dedent(program)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   env={**os.environ, "PYTHONPATH": str(PACKAGE)}, cwd=self.folder)
        self.assertEqual(process.stdout.readline(), "running\n")
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        start = time.perf_counter()
        out, error = process.communicate(timeout=60)
        return out, error, time.perf_counter() - start

    def test_ctrl_c_ends_a_run_in_memory_promptly(self):
        out, error, duration = self.interrupted(f"""
            import rotordrop as rd
            case = rd.Case({str(SETTLING)!r}, {{"run.end_time": "100 s"}})
            print("running", flush=True)
            try:
                case.run(keep=[])
            except KeyboardInterrupt:
                print("interrupted", flush=True)
            """)
        self.assertEqual(out, "interrupted\n", error)
        self.assertLess(duration, 5.0)  # 50 ms and the interpreter's end, on a busy machine; the run itself would take minutes

    def test_ctrl_c_ends_the_search_for_preload(self):
        out, error, duration = self.interrupted(f"""
            import rotordrop as rd
            growths = [1e-9 * k for k in range(2000)]
            case = rd.Case({str(SETTLING.parent / "neisi2019-preload.toml")!r}, {{"preload.map.growth": growths, "preload.map.speed": growths}})
            print("running", flush=True)
            try:
                case.preload()
            except KeyboardInterrupt:
                print("interrupted", flush=True)
            """)
        self.assertEqual(out, "interrupted\n", error)
        self.assertLess(duration, 5.0)  # as above; its maps have 4 million points

    def test_ctrl_c_leaves_a_checkpoint_from_which_the_run_goes_on(self):
        out, error, _ = self.interrupted(f"""
            import rotordrop as rd
            case = rd.Case({str(SETTLING)!r}, {{"run.end_time": "100 s", "output.interval": "1 ms"}})
            print("running", flush=True)
            try:
                case.run("out")
            except KeyboardInterrupt:
                print("interrupted", flush=True)
            """)
        self.assertEqual(out, "interrupted\n", error)
        reached = float(rd.read(self.folder / "out").series["time"][-1])
        self.assertGreater(reached, 0)
        self.assertFalse(rd.read(self.folder / "out").completed)
        seen = []

        def stop_soon(progress):
            seen.append(progress.time)
            raise InterruptedError

        case = rd.Case(SETTLING, {"run.end_time": "100 s", "output.interval": "1 ms"})
        with self.assertRaises(InterruptedError):
            case.run(self.folder / "out", resume=True, progress=stop_soon)
        self.assertGreaterEqual(seen[0], reached - 1e-3)  # one row

    def test_a_report_of_the_unfinished_run_is_made_again(self):
        def stop(progress):
            if progress.time > 0:
                raise InterruptedError

        case, page = rd.Case(SETTLING, {"run.end_time": "3 s", "output.interval": "1 ms"}), self.folder / "out/report.html"
        with self.assertRaises(InterruptedError):
            case.run(self.folder / "out", progress=stop)
        part = rd.read(self.folder / "out").report().read_text(encoding="utf-8")
        (self.folder / "out/measured.html").write_text(part, encoding="utf-8")
        result = case.run(self.folder / "out", resume=True)
        made = page.read_text(encoding="utf-8")
        self.assertNotEqual(made, part)
        self.assertEqual(result.report().read_text(encoding="utf-8"), made)
        self.assertIn("measured.json are of the interrupted run", "".join(result.notes))
        # Also one that was made while the run went on to its end, but not one of other results.
        for name in ("results.h5", "summary.json", "measured.html"):
            (self.folder / "out" / name).unlink()
        page.write_text(part, encoding="utf-8")
        os.utime(page, (0, 0))
        short = rd.Case(SETTLING, SHORT)
        short.run(self.folder / "out")
        self.assertEqual(page.read_text(encoding="utf-8"), part)
        short.run(self.folder / "out", force=True, progress=lambda _: page.write_text(part, encoding="utf-8"))
        self.assertNotEqual(page.read_text(encoding="utf-8"), part)

    def test_python_ends_cleanly_while_a_thread_runs(self):
        done = subprocess.run([sys.executable, "-c", textwrap.dedent(f"""
            import threading, time
            import rotordrop as rd
            case = rd.Case({str(SETTLING)!r}, {{"run.end_time": "100 s"}})
            threading.Thread(target=lambda: case.run(keep=[]), daemon=True).start()
            time.sleep(0.3)
            print("leaving")
            """)], capture_output=True, text=True, timeout=60, env={**os.environ, "PYTHONPATH": str(PACKAGE)})
        self.assertEqual((done.returncode, done.stdout), (0, "leaving\n"), done.stderr)

    def test_python_ends_cleanly_while_threads_ask_for_what_needs_no_run(self):
        for asked in ("rd.Case(FILE)", "case.modes()", "case.critical_speeds()", "case.statics('TB2')"):
            done = subprocess.run([sys.executable, "-c", textwrap.dedent(f"""
                import threading, time
                import rotordrop as rd
                FILE = {str(SETTLING)!r}
                case = rd.Case(FILE)
                def ask():
                    while True:
                        {asked}
                for _ in range(3):
                    threading.Thread(target=ask, daemon=True).start()
                time.sleep(0.3)
                print("leaving")
                """)], capture_output=True, text=True, timeout=60, env={**os.environ, "PYTHONPATH": str(PACKAGE)})
            self.assertEqual((done.returncode, done.stdout), (0, "leaving\n"), asked + done.stderr)

    def test_a_second_opinion_needs_a_directory(self):
        with self.assertWarnsRegex(rd.CaseWarning, "second_opinion"):
            rd.Case(SETTLING, {"run.end_time": "1 ms", "run.second_opinion": True}).run(keep=[])

    def test_a_case_is_what_it_was_given(self):
        shutil.copy(PARAMS / "neisi2019-rotor.json", self.folder)
        shutil.copy(PARAMS / "neisi2019.toml", self.folder / "own.toml")
        table, overrides = {"base": str(SETTLING), "contact": {"air_gap": 2e-4}}, {"gravity": np.array([0.0, -9.81, 0.0])}
        case = rd.Case(table, {"run.gravity": overrides["gravity"]})
        table["contact"]["air_gap"] = 3e-4
        overrides["gravity"][1] = -1.0
        for same in (case, case.with_overrides({}), pickle.loads(pickle.dumps(case))):
            self.assertEqual(same.parameters["contact"]["air_gap"], 2e-4)
            self.assertEqual(same.parameters["run"]["gravity"], [0.0, -9.81, 0.0])
        here = os.getcwd()
        try:
            os.chdir(self.folder)
            cases = [rd.Case("own.toml"), rd.Case('base = "own.toml"\n'), rd.Case({"base": "own.toml"})]
            os.chdir(here)
            for one in cases:
                self.assertEqual(one.with_overrides({}).text.count("air_gap"), one.text.count("air_gap"))
        finally:
            os.chdir(here)

    def test_a_run_that_fails_is_a_solver_error(self):
        # Explicit steps of 200 us through contacts whose period is a tenth of that.
        case = rd.Case(PARAMS / "neisi2019.toml", {"run.end_time": "10 ms", "integration.method": "runge-kutta-4", "integration.step": "200 us", "output.interval": "10 us"})
        with self.assertRaisesRegex(rd.SolverError, "the step is too long for the stiffest contact|is cooled below 0 K|is not a number"):
            case.run()
        self.assertTrue(issubclass(rd.SolverError, RuntimeError))
        with self.assertRaises(rd.SolverError):
            case.run(self.folder / "out")
        failed = rd.read(self.folder / "out")
        self.assertFalse(failed.completed)
        with self.assertRaisesRegex(FileNotFoundError, "the run failed") as caught:
            failed.summary  # noqa: B018
        self.assertNotIn("goes on", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
