"""`rotordrop preload`: verdicts of the documented cases, maps against `rotordrop statics`, histories of a drop, refusals, figures."""

import importlib
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, PROGRAM, SOURCE, ProgramTest  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()

NO_MAPS = ["--set", "preload.map.growth=[]", "--set", "preload.map.interference=[]", "--set", "preload.map.inner_rise=[]"]
RPM = np.pi / 30


class Preload(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("neisi2019.toml", "neisi2019-preload.toml", "neisi2019-preload-runaway.toml"):
            shutil.copy(PARAMS / name, self.folder)

    def preload(self, case, *options, bearing="TB2", output="out"):
        self.succeed("preload", case, "--bearing", bearing, "-o", output, "--quiet", "--force", *options)
        return json.loads((self.folder / output / "preload.json").read_text())["bearings"][bearing]

    def file(self, output="out"):
        file = h5py.File(self.folder / output / "preload.h5", "r")
        self.addCleanup(file.close)
        return file

    def statics(self, *options):
        done = self.succeed("statics", "neisi2019.toml", "--bearing", "TB2", "--json", *options)
        return json.loads(done.stdout)["bearings"]["TB2"]

    def test_the_documented_case_settles(self):
        done = self.succeed("preload", "neisi2019-preload.toml", "-o", "out")
        self.assertIn("TB1 at 15200 rpm: stable", done.stdout)
        self.assertIn("TB2 at 15200 rpm: stable. It settles in", done.stdout)
        self.assertEqual({p.name for p in (self.folder / "out").iterdir()}, {"preload.h5", "preload.json", "parameters.toml"})
        running = json.loads((self.folder / "out/preload.json").read_text())["bearings"]["TB2"]["running"]
        self.assertEqual(running["verdict"], "stable")
        stable = running["operating_points"][0]
        self.assertLess(stable["loop_gain"], 0, "the shaft takes more heat than the housing: warmer, it presses less")
        self.assertLess(stable["eigenvalue"][0], 0)
        self.assertAlmostEqual(stable["preload"], 888.428411, delta=1e-3)  # validation/preload_loop.py
        self.assertAlmostEqual(running["end"]["state"]["preload"], stable["preload"], delta=1)
        self.assertGreater(running["critical"]["speed"]["value"], running["speed"])
        file = self.file()
        before, *last_step = file["/TB2/running/time"][-3:]
        self.assertGreater(running["end"]["time"], (before + last_step[0]) / 2)
        self.assertLess(running["end"]["time"], sum(last_step) / 2)
        for dataset in ("/TB2/running/preload", "/TB2/running/temperature/TB2/inner_ring", "/TB2/maps/growth/preload", "/TB2/operating_points/preload"):
            self.assertIn("units", file[dataset].attrs, dataset)
        ledger = [file[f"/TB2/running/heat_{name}"][-1] for name in ("made", "lost", "stored")]
        self.assertAlmostEqual(ledger[0], ledger[1] + ledger[2], delta=1e-8 * ledger[0])
        # The points over speed end at the limit of 150 degC.
        self.assertAlmostEqual(file["/TB2/operating_points/speed"][-1], running["critical"]["speed"]["value"], places=6)
        self.assertAlmostEqual(file["/TB2/operating_points/highest_temperature"][-1, 0], 423.15, delta=0.1)

    def test_of_the_published_circuit_two_points_meet_at_the_critical_speed(self):
        published = ["--set", "thermal.contact_conduction=fixed", "--set", "thermal.spreading=none", "--set", "thermal.shaft=lump", "--set", "preload.speed=4000 rpm"]
        running = self.preload("neisi2019-preload.toml", *NO_MAPS, *published)["running"]
        stable, unstable = running["operating_points"]
        self.assertLess(stable["loop_gain"], 1)
        self.assertGreater(unstable["loop_gain"], 1)
        self.assertGreater(unstable["eigenvalue"][0], 0)
        self.assertAlmostEqual(running["critical"]["speed"]["value"] / RPM, 5478.458, delta=0.7)  # validation/preload_loop.py, and the end of the search
        preload = self.file()["/TB2/operating_points/preload"]
        self.assertLess(preload[-1, 1] / preload[-1, 0], 1.05)

    def test_critical_values_may_be_left_out(self):
        running = self.preload("neisi2019-preload.toml", *NO_MAPS, "--set", "preload.critical_values=false")["running"]
        self.assertEqual((running["verdict"], running["critical"]), ("stable", {}))
        self.assertNotIn("/TB2/operating_points", self.file())

    def test_a_pair_whose_balls_lose_their_load_is_told_and_has_no_false_points(self):
        oil = ["--set", "thermal.oil_film=0.1 um", "--set", "preload.critical_values=false"]
        running = self.preload("neisi2019-preload.toml", *NO_MAPS, *oil)["running"]
        self.assertAlmostEqual(running["end"]["state"]["preload"], 0, delta=1)
        for point in running["operating_points"]:
            heat = self.file()["/TB2/balance/heat"][:]
            self.assertLess(point["heat"], heat[-1])

    def test_a_ring_that_cools_over_its_balls_alone_has_operating_points_up_to_any_limit(self):
        # Without the shaft's cooling TB1's inner ring closes the gap of its balls, and steady heats far beyond the operating point have balls that just touch.
        lump = [*NO_MAPS, "--set", "thermal.shaft=lump", "--set", "preload.critical_values=false"]
        for limit in ("125 degC", "150 degC"):
            running = self.preload("neisi2019-preload.toml", *lump, "--set", "preload.speed=6000 rpm", "--set", f"preload.temperature_limit={limit}", bearing="TB1")["running"]
            self.assertEqual((running["verdict"], running["search"]["ended_by"], running["search"]["without_steady_state"]), ("stable", "temperature_limit", 0))
            # Criterion and way from cold are two computations.
            point = running["operating_points"][0]
            self.assertAlmostEqual(point["heat"], running["end"]["state"]["heat"], delta=1e-6 * point["heat"])
            for node, T in running["end"]["temperatures"].items():
                self.assertAlmostEqual(point["temperatures"][node], T, delta=0.02)  # settled_rate times the slowest time constant
        made, heat = (self.file()[f"/TB1/balance/{name}"][:] for name in ("made", "heat"))
        self.assertGreater(heat[-1], 3 * made[0])
        done = self.succeed("preload", "neisi2019-preload.toml", "-o", "both", *lump)
        self.assertIn("TB1 at 15200 rpm: runs away", done.stdout)
        self.assertIn("TB2 at 15200 rpm: runs away", done.stdout)

    def test_balls_with_inertia_have_operating_points_at_low_speeds(self):
        inertial = [*NO_MAPS, "--set", "bearings.TB1.ball_model=inertial", "--set", "preload.critical_values=false"]
        for speed in (500, 1500):
            running = self.preload("neisi2019-preload.toml", *inertial, "--set", f"preload.speed={speed} rpm", bearing="TB1")["running"]
            self.assertEqual((running["verdict"], running["search"]["ended_by"]), ("stable", "temperature_limit"))
            point = running["operating_points"][0]
            self.assertAlmostEqual(point["heat"], running["end"]["state"]["heat"], delta=1e-6 * point["heat"])

    def test_a_bearing_without_an_equilibrium_is_told_and_the_rest_is_written(self):
        done = self.call("preload", "neisi2019-preload.toml", "-o", "out", *NO_MAPS, "--set", 'preload.force=["1e300 N", 0, 0]')
        self.assertEqual(done.returncode, 1)
        self.assertIn("error: TB2: no equilibrium of TB2 was found", done.stderr)
        report = json.loads((self.folder / "out/preload.json").read_text())["bearings"]
        for name in ("TB1", "TB2"):
            self.assertEqual(report[name]["running"]["verdict"], "failed")
            self.assertIn(f"no equilibrium of {name} was found", report[name]["running"]["message"])
        self.assertTrue((self.folder / "out/preload.h5").is_file())

    def test_the_documented_runaway_is_found_by_transient_and_criterion(self):
        running = self.preload("neisi2019-preload-runaway.toml", *NO_MAPS)["running"]
        self.assertEqual(running["verdict"], "runs-away")
        self.assertEqual(running["operating_points"], [])
        self.assertEqual(running["end"]["limit"], "temperature_limit")
        self.assertAlmostEqual(max(running["end"]["temperatures"].values()), 423.15, delta=1e-4)
        self.assertLess(running["critical"]["speed"]["value"], running["speed"])
        made, heat = (self.file()[f"/TB2/balance/{name}"][:] for name in ("made", "heat"))
        self.assertTrue((made > heat).all())
        text = self.succeed("preload", "neisi2019-preload-runaway.toml", "--bearing", "TB2", "-o", "again", *NO_MAPS).stdout
        self.assertRegex(text, r"TB2 at 24000 rpm: runs away: 150 degC reached after 5\.68 s")

    def test_at_the_critical_speed_transient_and_criterion_part_together(self):
        published = ["--set", "thermal.contact_conduction=fixed", "--set", "thermal.spreading=none", "--set", "thermal.shaft=lump", "--set", "preload.speed=3000 rpm"]
        critical = self.preload("neisi2019-preload.toml", *NO_MAPS, *published)["running"]["critical"]["speed"]["value"]
        for factor, verdict in ((0.995, "stable"), (1.005, "runs-away")):
            running = self.preload("neisi2019-preload.toml", *NO_MAPS, *published, "--set", f"preload.speed={factor * critical}", "--set", "preload.critical_values=false")["running"]
            self.assertEqual(running["verdict"], verdict)

    def test_a_spring_takes_the_loop_away(self):
        running = self.preload("neisi2019.toml", *NO_MAPS, "--set", "statics.preload_by=spring")["running"]  # at 15200 rpm
        self.assertEqual(running["verdict"], "stable")
        self.assertAlmostEqual(running["operating_points"][0]["loop_gain"], 0, delta=1e-9)
        self.assertAlmostEqual(running["end"]["state"]["preload"], 290, delta=1e-3)

    def test_pressure_beyond_its_limit_when_cold_is_said(self):
        text = self.succeed("preload", "neisi2019-preload.toml", "--bearing", "TB2", "-o", "out", *NO_MAPS, "--set", "preload.pressure_limit=0.5 GPa").stdout
        self.assertIn("beyond 0.5 GPa when cold", text)

    def test_a_bearing_at_rest_makes_no_heat(self):
        running = self.preload("neisi2019-preload.toml", *NO_MAPS, "--set", "preload.speed=0 rpm")["running"]
        self.assertEqual((running["verdict"], running["end"]["time"], running["operating_points"][0]["heat"]), ("stable", 0, 0))

    def test_maps_are_those_of_statics(self):
        maps = ["--set", "preload.map.growth=[0, 3e-6]", "--set", "preload.map.interference=[0, 5e-6]", "--set", "preload.map.inner_rise=[0, 20]",
                "--set", "preload.map.outer_rise=[0, 10]", "--set", "preload.map.speed=[0, 1000]", "--set", "preload.speed=500"]
        load = ["--set", 'preload.force=["100 N", "-300 N", 0]', "--set", "preload.growth_by_speed=none", "--set", "bearings.TB2.ball_model=inertial"]
        report = self.preload("neisi2019.toml", *maps, *load)["maps"]
        same_load = ["--set", 'statics.force=["100 N", "-300 N", 0]', "--set", "bearings.TB2.ball_model=inertial"]
        closure = report["interference"]["closure_per_interference"]
        file = self.file()["/TB2/maps"]
        points = (("growth", 1, 1, ["statics.inner_growth=3e-6", "statics.speed=1000"]),
                  ("growth", 0, 0, []),
                  ("interference", 1, 0, [f"statics.outer_growth={-5e-6 * closure}"]),
                  ("rise", 1, 1, ["statics.inner_rise=20", "statics.outer_rise=10", "statics.speed=500", "statics.ball_rise=15"]),
                  ("rise", 1, 0, ["statics.inner_rise=20", "statics.ball_rise=10", "statics.speed=500"]))
        for name, i, j, settings in points:
            with self.subTest(name, row=i, column=j):
                rest = self.statics(*same_load, *(word for s in settings for word in ("--set", s)))
                self.assertAlmostEqual(file[f"{name}/preload"][i, j], rest["preload"], delta=1e-6)
                for key, among in (("largest_ball_load", "largest_ball_load"), ("largest_pressure", "largest_pressure")):
                    largest = max(row[among] for row in rest["rows"])
                    self.assertAlmostEqual(file[f"{name}/{key}"][i, j] / largest, 1, delta=1e-9)
                for key, k in (("axial_stiffness", 0), ("radial_stiffness_y", 1), ("radial_stiffness_z", 2)):
                    self.assertAlmostEqual(file[f"{name}/{key}"][i, j] / rest["stiffness"][k][k], 1, delta=1e-9)
        self.assertEqual(file["growth/growth"][1], 3e-6)
        self.assertEqual(list(file["growth/speed"]), [0, 1000])

    def test_growth_raises_the_preload_as_estimated(self):
        self.preload("neisi2019.toml", "--set", "preload.map.growth=[0, 1.4e-6, 5e-6]", "--set", "preload.map.speed=[0, 1]")
        preload = self.file()["/TB2/maps/growth/preload"][:, 0]
        np.testing.assert_allclose(preload, [290, 593.708003, 1641.956429], rtol=1e-7)  # validation/preload_loop.py

    def test_history_of_a_drop(self):
        self.succeed("run", "neisi2019.toml", "-o", "drop", "--quiet", "--set", "run.end_time=40 ms")
        history = self.preload("neisi2019.toml", *NO_MAPS, "--results", "drop", "--set", "preload.growth_by_speed=none")["history"]
        self.assertAlmostEqual(history["preload"]["start"], 290, delta=1e-3)
        self.assertGreater(history["preload"]["end"], 291)
        with h5py.File(self.folder / "drop/results.h5", "r") as drop:
            shaft, bore, inner, outer, ball, inner_width, outer_width, row_difference = drop["/bearings/TB2/expansion"][-1]
            rest = self.statics("--set", f"statics.inner_growth={inner}", "--set", f"statics.outer_growth={outer}", "--set", f"statics.ball_rise={ball / (11.8e-6 * 9.525e-3 / 2)}")
            self.assertAlmostEqual(self.file()["/TB2/history/preload"][-1], rest["preload"], delta=1e-6)
            # Under the recorded force a single row's balls carry what they did.
            self.preload("neisi2019.toml", *NO_MAPS, "--results", "drop", "--set", "preload.growth_by_speed=none", "--set", "preload.history_under_load=true", bearing="TB1")
            recorded, quasi_static = drop["/bearings/TB1/ball_force"][:], self.file()["/TB1/history/largest_ball_load"][:]
            self.assertEqual(len(recorded), len(quasi_static))
            peak = recorded.argmax()  # where the force turns, so that its damping is small
            self.assertAlmostEqual(quasi_static[peak] / recorded[peak], 1, delta=0.01)

    def test_growth_by_speed_is_that_of_a_thin_disc(self):
        self.preload("neisi2019.toml", "--set", "preload.map.growth=[0, 1e-6]", "--set", "preload.map.speed=[0, 1500]", "--set", "preload.growth_by_speed=thin-disc")
        growth = 7800 * 1500**2 * 39e-3 / (4 * 2e11) * (3.3 * 35e-3**2 + 0.7 * 39e-3**2)
        rest = self.statics("--set", f"statics.inner_growth={growth}")
        self.assertAlmostEqual(self.file()["/TB2/maps/growth/preload"][0, 1], rest["preload"], delta=1e-6)

    @unittest.skipUnless(HAS_ROOM, "built without finite elements")
    def test_finite_elements_may_take_the_circuits_place(self):
        lump = ["--set", "thermal.shaft=lump", "--set", "preload.speed=6000 rpm"]
        fe = [*lump, "--set", "preload.model=fe"]
        circuit = self.preload("neisi2019-preload.toml", *NO_MAPS, *lump, "--set", "preload.critical_values=false")["running"]["operating_points"][0]
        few = self.preload("neisi2019-preload.toml", *NO_MAPS, *fe)["running"]
        many = self.preload("neisi2019-preload.toml", *NO_MAPS, *fe, "--set", "thermal.fe.response_tolerance=1e-3", "--set", "preload.critical_values=false")["running"]
        self.assertEqual(few["verdict"], "stable")
        self.assertIsNone(few["critical"]["cooling"])
        point, energy = few["operating_points"][0], few["end"]["energy"]
        self.assertLess(abs(energy["residual"]), 1e-8 * energy["made"])
        self.assertAlmostEqual(few["end"]["state"]["preload"], point["preload"], delta=1)
        # A fifth of the tolerance changes little; the circuit is another model of the same bearing (4 %).
        self.assertAlmostEqual(many["operating_points"][0]["preload"] / point["preload"], 1, delta=0.005)
        self.assertAlmostEqual(many["operating_points"][0]["loop_gain"] / point["loop_gain"], 1, delta=0.01)
        self.assertAlmostEqual(circuit["preload"] / point["preload"], 1, delta=0.1)
        runaway = self.preload("neisi2019-preload-runaway.toml", *NO_MAPS, "--set", "preload.model=fe", "--set", "thermal.shaft=lump", "--set", "preload.critical_values=false")["running"]
        self.assertEqual((runaway["verdict"], runaway["operating_points"]), ("runs-away", []))
        added = self.call("preload", "neisi2019-preload.toml", "-o", "other", *fe, "--set", 'thermal.node=[{ name = "frame", capacity = 10.0 }]',
                          "--set", 'thermal.resistor=[{ between = ["TB2/housing", "frame"], resistance = 1.0 }]')
        self.assertEqual(added.returncode, 2)
        self.assertIn('preload.model = "fe" cannot include', added.stderr)

    @unittest.skipUnless(HAS_ROOM, "built without finite elements")
    def test_finite_elements_settle_when_the_circuit_does(self):
        """Within 2 %, by which lumps and sections may differ in the heat that they store. Rates of fast modes are no rates of temperatures."""
        def settled(*options):
            return self.preload("neisi2019-preload.toml", *NO_MAPS, "--set", "preload.critical_values=false", *options)["running"]["end"]["time"]

        circuit = settled()
        for tolerance in (0.005, 0.003, 0.001):
            self.assertAlmostEqual(settled("--set", "preload.model=fe", "--set", f"thermal.fe.response_tolerance={tolerance}") / circuit, 1, delta=0.02)

    @unittest.skipUnless(HAS_ROOM, "built without finite elements")
    def test_modes_that_answer_heat_too_coarsely_are_refused_with_what_helps(self):
        beyond = [*NO_MAPS, "--set", "preload.model=fe", "--set", "thermal.fe.shaft=beyond", "--set", "preload.critical_values=false"]
        done = self.call("preload", "neisi2019-preload.toml", "--bearing", "TB2", "-o", "out", *beyond, "--set", "thermal.fe.modes=30",
                         "--set", "thermal.fe.response_tolerance=0.001")
        self.assertEqual(done.returncode, 2)
        self.assertIn("raise it (200 if not given) or allow a larger error.", done.stderr)
        self.assertNotIn("windowed", done.stderr)  # the coupling of drops

    @unittest.skipUnless(HAS_ROOM, "built without finite elements")
    def test_modes_answer_heat_as_finely_as_can_be_asked(self):
        """Slow modes keep their digits beside fast ones, or they would leave 0.8 %."""
        beyond = [*NO_MAPS, "--set", "preload.model=fe", "--set", "thermal.fe.shaft=beyond", "--set", "preload.critical_values=false"]
        self.assertEqual(self.preload("neisi2019-preload.toml", *beyond, "--set", "thermal.fe.response_tolerance=1e-4")["running"]["verdict"], "stable")

    def test_the_screen_may_have_json(self):
        done = self.succeed("preload", "neisi2019-preload.toml", "--bearing", "TB1", "-o", "out", "--json", *NO_MAPS)
        self.assertEqual(json.loads(done.stdout), json.loads((self.folder / "out/preload.json").read_text()))

    def test_faulty_requests_are_refused(self):
        def refuse(*options):
            done = self.call("preload", "neisi2019-preload.toml", "-o", "out", *options)
            self.assertEqual(done.returncode, 2, done.stdout)
            return done.stderr

        self.assertRegex(refuse("--bearing", "TB3"), r'no touchdown bearing "TB3"[\s\S]*Did you mean')
        self.assertIn("preload.map.growth must increase", refuse("--set", "preload.map.growth=[1e-6, 0]"))
        self.assertIn('Did you mean "speed"', refuse("--set", "preload.sped=1 rpm"))
        self.assertIn("no such directory", refuse("--results", "nowhere"))
        self.assertFalse((self.folder / "out").exists())
        self.succeed("preload", "neisi2019-preload.toml", "--bearing", "TB1", "-o", "out", "--quiet", *NO_MAPS)
        before = (self.folder / "out/preload.h5").read_bytes()
        self.assertIn("--force", refuse("--bearing", "TB1"))
        self.assertEqual((self.folder / "out/preload.h5").read_bytes(), before)
        self.succeed("run", "neisi2019.toml", "-o", "drop", "--quiet", "--set", "run.end_time=1 ms")
        done = self.call("preload", "neisi2019-preload.toml", "-o", "drop", "--force")
        self.assertEqual(done.returncode, 2)
        self.assertIn("results of another kind", done.stderr)

    def test_figures_are_drawn(self):
        self.succeed("run", "neisi2019.toml", "-o", "drop", "--quiet", "--set", "run.end_time=10 ms")
        self.succeed("preload", "neisi2019-preload.toml", "-o", "out", "--quiet", "--results", "drop")
        subprocess.run([sys.executable, SOURCE / "examples/plot_preload.py", self.folder / "out"], check=True, capture_output=True)
        figures = {p.stem for p in (self.folder / "out/figures").glob("*.png")}
        self.assertEqual(figures, {f"{bearing}-{page}" for bearing in ("TB1", "TB2") for page in ("running", "maps", "history")})
        done = subprocess.run([sys.executable, SOURCE / "examples/plot_preload.py", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no", done.stderr)
        self.axes_show_their_lines()

    def axes_show_their_lines(self):
        sys.path.append(str(SOURCE / "examples"))
        try:
            script = importlib.import_module("plot_preload")
        finally:
            sys.path.pop()
        report = json.loads((self.folder / "out/preload.json").read_text())
        with h5py.File(self.folder / "out/preload.h5") as file:
            for name in ("TB1", "TB2"):
                bearing = script.Bearing(file, report, name)
                for page in (script.running_page, script.maps_page):
                    figure = page(bearing)
                    figure.canvas.draw()
                    texts = [text.get_text() for axes in figure.axes for text in axes.texts]
                    self.assertEqual("no preload" in texts, name == "TB1", "a single row holds none")
                    for axes in figure.axes:
                        low, high = axes.get_ylim()
                        left, right = axes.get_xlim()
                        for line in axes.lines:
                            x, y = (script.np.asarray(values, float) for values in line.get_data())
                            if len(x) > 2 and not axes.get_ylabel().startswith("temperature"):
                                seen = y[(x >= left) & (x <= right)]
                                self.assertLessEqual(script.np.nanmax(seen), high, (name, axes.get_ylabel()))
                                if line.get_label() == "unstable":
                                    continue  # beside a state without load it has hardly any preload
                                self.assertGreater(script.np.nanmax(seen), 0.05 * (high - low) + low, f"{name} {axes.get_ylabel()}: not a line along the axis")
                        # A legend that stands above its axes covers no line.
                        if axes.get_legend() and axes.get_ylabel() in ("heat [W]", "preload at operating point [N]"):
                            self.assertGreaterEqual(axes.get_legend().get_window_extent().y0, axes.get_window_extent().y1 - 1)
                    script.plt.close(figure)


if __name__ == "__main__":
    unittest.main()
