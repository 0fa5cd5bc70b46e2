"""What needs no drop, from Python: closed forms, and the same numbers as the program's commands."""

import json
import math
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from package import GRAVITY, HAS_FE, PARAMS, SETTLING, PackageTest, flat, rd  # noqa: E402
from program import call  # noqa: E402

SPRING = 1e4  # of one support [N/m]
LENGTH, DIAMETER, E, RHO = 1.0, 0.1, 2e11, 7800.0


class ShaftOnSprings(PackageTest):
    """A uniform shaft on two equal soft springs at its ends: the shaft's first bending frequency is 160 times that of its rigid motions, so that it bends by a few times 1 / 160^2 of them.

    m = rho pi d^2/4 L;  lift: w = sqrt(2 k / m);  tilt: w = sqrt(2 k (L/2)^2 / I), I = m (L^2/12 + d^2/16), split by the spin through I_p = m d^2/8.
    """

    def setUp(self):
        super().setUp()
        nodes = [{"id": i + 1, "x": LENGTH * i / 10} for i in range(11)]
        elements = [{"n1": i + 1, "n2": i + 2, "od": DIAMETER} for i in range(10)]
        shaft = {"material": {"E": E, "nu": 0.3, "rho": RHO}, "nodes": nodes, "elements": elements}
        (self.folder / "shaft.json").write_text(json.dumps(shaft))
        support = {"type": "linear", "stiffness": [[SPRING, 0], [0, SPRING]], "damping": [[0, 0], [0, 0]]}
        self.case = rd.Case({"run": {"initial_speed": "3000 rpm", "end_time": "1 ms"}, "rotor": {"geometry": str(self.folder / "shaft.json")},
                             "bearings": {"A": {**support, "node": 1}, "B": {**support, "node": 11}}}, name="shaft")
        self.mass = RHO * math.pi / 4 * DIAMETER**2 * LENGTH
        inertia = self.mass * (LENGTH**2 / 12 + DIAMETER**2 / 16)
        self.lift = math.sqrt(2 * SPRING / self.mass)
        self.tilt = math.sqrt(2 * SPRING * (LENGTH / 2) ** 2 / inertia)

    def test_frequencies_shapes_and_names(self):
        modes = self.case.modes([0, "3000 rpm"])
        frequency = modes.frequency.sel(speed=0).values[:4] * 2 * math.pi
        for found, expected in zip(frequency, [self.lift] * 2 + [self.tilt] * 2):
            self.assertAlmostEqual(found / expected, 1, delta=1e-3)
        self.assertEqual((modes.frequency.attrs["units"], modes.speed.attrs["units"]), ("Hz", "rad/s"))
        self.assertAlmostEqual(float(modes.speed[1]), 3000 * math.pi / 30, delta=1e-9)
        self.assertEqual(modes.attrs["supports"], "linear")
        lift, tilt = (np.abs(modes["shape"].sel(speed=0, mode=k)).max("axis") for k in (1, 3))
        self.assertTrue(np.allclose(lift, lift[0], rtol=1e-2))
        self.assertLess(float(tilt.sel(node=LENGTH / 2)), 1e-3)
        self.assertTrue(np.allclose(tilt[0], tilt[-1], rtol=1e-6))
        # The spin splits the tilting motions into a backward and a faster forward one.
        at_speed = modes.isel(speed=1)
        whirl = {str(w) for w in at_speed.whirl.values[:4]}
        self.assertLessEqual({"forward", "backward"}, whirl)

    def test_critical_speeds(self):
        found = self.case.critical_speeds(up_to="3000 rpm")
        speeds = [one["speed"] for one in found["critical_speeds"]]
        self.assertAlmostEqual(min(speeds) / self.lift, 1, delta=1e-3)
        self.assertEqual(found["units"]["speed"], "rad/s")
        stiffer = self.case.critical_speeds("3000 rpm", stiffness=4 * SPRING / 2)
        self.assertAlmostEqual(min(one["speed"] for one in stiffer["critical_speeds"]) / self.lift, math.sqrt(2), delta=2e-3)
        mapped = self.case.critical_speeds("3000 rpm", stiffness_map=["5e3 N/m", 1e4])["map"]
        self.assertAlmostEqual(mapped[1]["speeds"][0] / mapped[0]["speeds"][0], math.sqrt(2), delta=2e-3)

    def test_numbers_without_meaning_are_refused(self):
        for call, message in (
            (lambda: self.case.critical_speeds(float("nan")), "up_to: nan is not a finite number"),
            (lambda: self.case.critical_speeds(-1), "up_to: must be larger than 0 and is -1"),
            (lambda: self.case.critical_speeds("3000 rpm", stiffness=float("inf")), "stiffness: inf is not a finite number"),
            (lambda: self.case.critical_speeds("3000 rpm", stiffness_map=[1e6, 0]), "stiffness_map: must be larger than 0 and is 0"),
            (lambda: self.case.modes([0.0, float("nan")]), "speeds: nan is not a finite number"),
            (lambda: self.case.modes(n_modes=-1), "n_modes: must be at least 0 and is -1"),
        ):
            with self.subTest(message), self.assertRaises(rd.InputError) as caught:
                call()
            self.assertIn(message, str(caught.exception))
            self.assertEqual(caught.exception.faults[0].key, message.partition(":")[0])

    def test_statics_carry_the_weight(self):
        found = self.case.statics()["shaft"]
        self.assertAlmostEqual(found["weight"], self.mass * GRAVITY, delta=1e-3 * self.mass * GRAVITY)
        for support in found["supports"].values():
            self.assertAlmostEqual(support["force_on_rotor"]["y"], self.mass * GRAVITY / 2, delta=1e-3 * self.mass * GRAVITY)


class Commands(PackageTest):
    """Wrappers hand on everything that the program's commands say, and nothing else."""

    def json_of(self, *arguments):
        done = call(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_modes(self):
        program = self.json_of("modes", SETTLING, "--json", "--speeds", "0 rpm, 9000 rpm")
        here = rd.Case(SETTLING).modes([0, "9000 rpm"])
        for i, speed in enumerate(program["speeds"]):
            n = len(speed["modes"])
            self.assertEqual(n, 10)
            for name in ("frequency", "natural_frequency", "damping_ratio", "whirl"):
                self.assertEqual(list(here[name][i].values[:n]), [mode[name] for mode in speed["modes"]])

    def test_statics(self):
        for bearing in (None, "TB2"):
            program = self.json_of("statics", SETTLING, "--json", *(["--bearing", bearing] if bearing else []))
            here = rd.Case(SETTLING).statics(bearing)
            self.assertEqual(dict(flat(here)), dict(flat(program)))
        with self.assertRaisesRegex(rd.InputError, "TB2"):
            rd.Case(SETTLING).statics("TB3")

    def test_critical_speeds(self):
        program = self.json_of("critical-speeds", SETTLING, "--json", "--stiffness", "5e7 N/m")
        here = rd.Case(SETTLING).critical_speeds(stiffness="5e7 N/m")
        self.assertEqual(dict(flat(here)), dict(flat(program)))

    def test_preload(self):
        file = PARAMS / "neisi2019-preload.toml"
        program = self.json_of("preload", file, "--json", "-o", "out", "--bearing", "TB1")
        here = rd.Case(file).preload("TB1")
        self.assertEqual(dict(flat(here.report)), dict(flat(program)))
        running, growth = here.tables["TB1.running"], here.tables["TB1.maps.growth"]
        self.assertEqual(growth.preload.dims, ("growth", "speed"))
        self.assertEqual((growth.preload.attrs["units"], growth.speed.attrs["units"]), ("N", "rad/s"))
        self.assertAlmostEqual(float(growth.speed[-1]), 15200 * math.pi / 30, delta=1e-9)
        with h5py.File(self.folder / "out/preload.h5") as results:
            self.assertTrue(np.array_equal(running.preload, results["TB1/running/preload"][()], equal_nan=True))
            self.assertTrue(np.array_equal(growth.radial_clearance, results["TB1/maps/growth/radial_clearance"][()], equal_nan=True))

    @unittest.skipUnless(HAS_FE, "built without finite elements")
    def test_comparison(self):
        overrides = {"run.end_time": "10 ms", "thermal.models": ["lumped", "fe"], "thermal.fe.section": "plain", "thermal.fe.degree": 1, "thermal.fe.refinement": 0.5}
        result = rd.Case(SETTLING, overrides).run(self.folder / "out")
        here = rd.compare(result)
        written = json.loads((self.folder / "out/comparison.json").read_text())
        self.assertEqual(written["in_short"], here["in_short"])
        self.assertTrue((self.folder / "out/comparison.h5").is_file())
        done = call("compare", self.folder / "out", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        program = json.loads((self.folder / "out/comparison.json").read_text())
        self.assertEqual(written, program)
        same = {key: value for key, value in flat(here) if not key.startswith(("run", "drop", "against"))}
        self.assertEqual(same, {key: value for key, value in flat(program) if key in same})
        self.assertGreater(len(same), 100)
        strict = rd.compare(result, tolerance="0.001 K", growth_tolerance="1 nm", instants=["5 ms"])
        self.assertEqual((strict["tolerances"]["temperature"], strict["tolerances"]["temperature_unit"]), (0.001, "K"))
        self.assertAlmostEqual(strict["bearings"]["TB1"]["temperatures"]["shaft"]["tolerance"], 0.001)
        times = [at["time"] for at in strict["bearings"]["TB1"]["temperatures"]["shaft"]["at"]]
        self.assertTrue(any(abs(time - 5e-3) < 1e-9 for time in times), times)
        with self.assertRaisesRegex(rd.InputError, "instants: must be larger than 0 and is -1"):
            rd.compare(result, instants=["5 ms", -1])
        with self.assertWarnsRegex(rd.CaseWarning, "instants: 5 s lies beyond the end at 0.01 s") as told:
            beyond = rd.compare(result, instants=[5.0])
        self.assertEqual(told.filename, __file__)
        self.assertEqual([at["instant"] for at in beyond["bearings"]["TB1"]["temperatures"]["shaft"]["at"]], ["first impact's peak", "end"])
        memory = rd.compare(rd.Case(SETTLING, overrides).run())
        self.assertEqual(memory["in_short"], here["in_short"])
        with self.assertRaisesRegex(rd.InputError, "tolerance: must be a text with its unit.*'5 %'.*0.05"):
            rd.compare(result, tolerance=0.05)
        alone = rd.Case(SETTLING, {"run.end_time": "5 ms"}).run()
        with self.assertRaises(rd.InputError):
            rd.compare(alone)


if __name__ == "__main__":
    unittest.main()
