"""A rotor that moves along its axis, and inner rings that follow it.

THE WAY TO THE SHOULDER: with thrust F on a mass m and the damping alpha, x = (F/m) (alpha t - 1 + exp(-alpha t)) / alpha^2; nothing else acts along
the axis before the rotor touches a bore, and afterwards only the axial part of a friction that slips at 50 m/s around the bore.
AT REST the shoulder carries the thrust, and the row that leans against it thrust and what is left of the preload.
"""

import json
import math
import pathlib
import shutil
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, content_of, settings  # noqa: E402

FREE = """[rotor]
axial_motion = "free"
[bearings]
ring_motion = "free"
"""


class Thrust(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-thrust.toml"):
            shutil.copy(PARAMS / name, self.folder)

    def test_the_pair_carries_the_thrust(self):
        summary = self.run_case("neisi2019-thrust.toml", run__end_time="0.5 s", run__initial_speed="3000 rpm")
        with h5py.File(self.folder / "out/results.h5") as file:
            pair, time = file["bearings/TB2"], file["time"][:]
            late = time > 0.48
            self.assertAlmostEqual(pair["shoulder_force"][:][late].mean(), 1500, delta=0.002 * 1500,
                                   msg="N; the swing along the axis has died to exp(-15 * 0.5), friction in the bores takes a little")
            rows = pair["row_axial_force"][:][late].mean(axis=0)
            self.assertAlmostEqual(rows.sum(), -1500, delta=0.002 * 1500)
            self.assertAlmostEqual(min(abs(rows)), pair["preload"][:][late].mean(), delta=1e-9)
            rotor, ring = pair["axial_position"][-1]
            stiffness = summary["bearings"]["TB2"]["shoulder"]["stiffness"]
            self.assertAlmostEqual(rotor - ring, 0.3e-3 + 1500 / stiffness, delta=0.02e-6, msg="m: gap, and the shoulder's own spring")
            self.assertGreater(summary["bearings"]["TB2"]["load_torque_peak"], 0.05, "N m: thrust makes friction")
            self.assertLess(abs(file["bearings/TB1/axial_force"][-1]), 30, "N: no shoulder there")
            for name in ("TB1", "TB2"):
                touching = file[f"bearings/{name}/contact_force"][:] > 0
                self.assertTrue((file[f"bearings/{name}/penetration"][:][touching] > 0).all(), "of a tilted journal that of the deeper end counts")
            axial = summary["bearings"]["TB2"]["axial"]
            self.assertGreaterEqual(axial["force"]["largest"], pair["axial_force"][:].max())
            self.assertEqual(axial["rotor_position"]["end"], rotor)

    def shoulder(self, *options):
        return json.loads(self.succeed("statics", "neisi2019-thrust.toml", "--bearing", "TB2", "--json", *options).stdout)["bearings"]["TB2"]["shoulder"]

    def test_a_shoulder_is_as_stiff_as_its_bodies(self):
        """Half space under an annulus (Boussinesq by Hankel's transform, closed with Gauss' function here) and the ring's wall from the -x face to row 2, 24 mm."""
        E, nu, a, b = 2e11, 0.3, 35e-3, 39e-3
        gauss = sum_of_series = 1.0
        for n in range(2000):  # 2F1(1/2, -1/2; 2; (a/b)^2)
            gauss *= (n + 0.5) * (n - 0.5) / ((n + 2) * (n + 1)) * (a / b) ** 2
            sum_of_series += gauss
        area = b * b - a * a
        rotor = math.pi * E * area**2 / (4 * (1 - nu * nu) * (4 * (a**3 + b**3) / (3 * math.pi) - a * a * b * sum_of_series))
        ring = E * math.pi * area / 24e-3
        found = self.shoulder()
        self.assertEqual(found["stiffness_from"], "geometry")
        self.assertAlmostEqual(found["rotor_stiffness"] / rotor, 1, delta=1e-9)
        self.assertAlmostEqual(found["ring_stiffness"] / ring, 1, delta=1e-12)
        self.assertAlmostEqual(found["stiffness"] / (1 / (1 / rotor + 1 / ring)), 1, delta=1e-9)
        given = self.shoulder("--set", "bearings.TB2.shoulders.stiffness=5e8 N/m")
        self.assertEqual((given["stiffness"], given["stiffness_from"]), (5e8, "given"))

    def test_the_force_on_the_shoulder_by_energy(self):
        """The thrust over gap and springs is the energy of the shoulder's spring and of the balls: two rows of Z = 23 balls, K = 9.9238e9 N/m^1.5, moved along the axis against
        each other from 290 N each; here by steps of the ring, forces by Hertz, energies by the trapezoidal rule."""
        A, phi, K, Z = 0.04 * 9.525e-3, math.radians(25), 9.9238e9, 23
        x = numpy.linspace(-2e-5, 2e-4, 400001)
        B_x = A * math.sin(phi) + x
        distance = numpy.hypot(A * math.cos(phi), B_x)
        row = Z * K * numpy.maximum(distance - A, 0) ** 1.5 * B_x / distance
        offset = numpy.interp(290, row, x)
        e = numpy.linspace(0, 1.5e-4, 100001)
        force = numpy.interp(offset + e, x, row) - numpy.interp(offset - e, x, row)
        work = numpy.concatenate(([0], numpy.cumsum((force[1:] + force[:-1]) / 2 * numpy.diff(e))))
        found = self.shoulder()
        for name, k in (("half_stiffness", 0.5), ("stiffness", 1.0), ("double_stiffness", 2.0)):
            k *= found["stiffness"]
            left = 1500 * (0.3e-3 + force / k + e) - force**2 / (2 * k) - work
            expected = numpy.interp(0, -left[1:], force[1:])
            side, = found["sides"]
            self.assertAlmostEqual(side["force_by_energy"][name] / expected, 1, delta=1e-3, msg="K to five digits")
        self.assertEqual(side["push"], "+x")
        self.assertAlmostEqual(side["approach_speed"], math.sqrt(2 * 1500 * 0.3e-3 / 109.7), delta=1e-5)
        check = self.succeed("check", "neisi2019-thrust.toml").stdout
        self.assertRegex(check, r"shoulder stiffness 4\.97e\+09 N/m \(from the bodies")
        self.assertRegex(check, r"kN with half, [\d.]+ kN with double that stiffness")

    def test_a_radius_beside_the_ring_is_a_fault(self):
        done = self.call("check", "neisi2019-thrust.toml", "--set", "bearings.TB2.shoulders.radius=50 mm")
        self.assertEqual(done.returncode, 2)
        self.assertIn("shoulders.radius = 50 mm is not on the inner ring's face, which reaches from 35 mm to 39 mm", done.stderr)

    def test_the_first_touch_by_free_fall_is_that_of_a_bore(self):
        self.assertIn("first touch of a bore: after about", self.succeed("check", "neisi2019-thrust.toml").stdout)
        done = self.succeed("check", "neisi2019-thrust.toml", *settings(run__end_time="3 ms"))
        self.assertIn("The run ends before, at 3 ms: no bore is touched.", done.stdout)

    def test_radial_friction_under_thrust_is_warned_of(self):
        done = self.call("check", "neisi2019-thrust.toml", "--set", "bearings.load_law=radial")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(" ".join(done.stderr.split()), r'TB2 takes axial load .* with load_law = "radial" thrust makes no friction')

    def test_the_way_to_the_shoulder_is_a_fall(self):
        self.run_case("neisi2019-thrust.toml", run__end_time="7.2 ms", output__interval="10 us")
        with h5py.File(self.folder / "out/results.h5") as file:
            time, force, x = file["time"][:], file["bearings/TB2/shoulder_force"][:], file["bearings/TB2/axial_position"][:, 0]
            a, alpha = 1500 / 109.7, 30.0
            free = time < 6.8e-3
            fall = a * (alpha * time - 1 + numpy.exp(-alpha * time)) / alpha**2
            numpy.testing.assert_allclose(x[free], fall[free], rtol=0, atol=2e-9, err_msg="m; the mass is given to 1e-5")
            reaches = numpy.interp(0.3e-3, fall, time)
            self.assertAlmostEqual(time[numpy.argmax(force > 0)], reaches, delta=20e-6, msg="s: two records")

    def resting(self, law, end):
        """The rotor lies at rest in both bores, without spin, and 20 N along the axis rise from 0.2 to 0.21 s; its way along the axis from there."""
        summary = self.run_case("neisi2019-thrust.toml", output=law, run__end_time=end, run__initial_speed="0 rpm", rotor__initial_offset='["-249.9 um", 0]', output__interval="1 ms",
                                rotor__axial_force='[["0.2 s", "0 N"], ["0.21 s", "20 N"]]', contact__friction_law=law)
        with h5py.File(self.folder / law / "results.h5") as file:
            time, x = file["time"][:], file["bearings/TB2/axial_position"][:, 0]
        way = x[time > 0.2] - x[(time > 0.19) & (time <= 0.2)].mean()
        return summary, numpy.abs(way).max(), way[-20:].mean(), way[time[time > 0.2] < 0.5][-20:].mean()

    def test_a_resting_rotor_stays_under_a_force_that_friction_holds(self):
        summary, way, end, before = self.resting("sticking", "1.21 s")
        self.assertLess(way, 1e-6, "m in one second")
        # Each bore's bristles, 1e8 N/m, in series with its ring in its balls, as statics has it: 0.30 um together.
        # The end slices of the tilted journal carry less than their share and slip first, so that fewer bristles hold.
        supports = json.loads(self.succeed("statics", "neisi2019-thrust.toml", "--json").stdout)["shaft"]["supports"].values()
        stiffness = sum(1 / (1e-8 + 1 / s["inner_ring"]["stiffness"][0][0]) for s in supports)
        self.assertGreater(end, 0.9 * 20 / stiffness, "m")
        self.assertLess(end, 2 * 20 / stiffness, "m")
        self.assertAlmostEqual(end, before, delta=2e-8, msg="m: no drift from 0.5 to 1.21 s")
        self.assertLess(abs(summary["energy"]["residual"]), 1e-5, "J")
        # The regularised law creeps towards 0.05 m/s * 20 N / (1076^2 * 0.1^2 - 20^2)^0.5 N = 9.5 mm/s within m * 0.05 m/s / 107 N = 51 ms.
        creep = self.resting("regularised", "0.24 s")[1]
        self.assertGreater(creep, 50e-6, "m in 40 ms")

    def test_energy_closes_with_axial_motion(self):
        energy = self.run_case("neisi2019-thrust.toml", run__end_time="0.1 s", run__gravity="[3, -9, 1]")["energy"]
        self.assertGreater(energy["dissipated"], 400)
        self.assertLess(abs(energy["residual"]), 1e-4, "J; without free rings 1e-6, and shoulders that bounce are as stiff as bores")
        self.assertGreater(energy["drive_work"], 0.4, "J: the thrust over 0.3 mm")

    def test_the_spin_up_balance_knows_shoulders(self):
        for name, bearing in self.run_case("neisi2019-thrust.toml", run__end_time="0.1 s")["bearings"].items():
            self.assertLess(abs(bearing["spin_up"]["residual"]), 1e-5 * bearing["friction_heat"], f"J, {name}")

    def test_the_spin_up_balance_knows_what_bristles_store(self):
        # At 9.5 ms the rotor presses on both bores: k z^2/2 is some 1e-3 J then.
        for name, bearing in self.run_case("neisi2019-settling.toml", run__end_time="9.5 ms", contact__friction_law="sticking")["bearings"].items():
            self.assertGreater(bearing["friction_heat"], 1, f"J, {name}")
            self.assertLess(abs(bearing["spin_up"]["residual"]), 1e-5, f"J, {name}")

    def test_rings_that_need_not_tilt_do_as_locked_ones(self):
        # A rigid rotor with its centre of gravity midway between two equal bearings: no tilt, no axial force.
        text = (self.folder / "neisi2019.toml").read_text()
        start, contact, pair, rest = (text.index(word) for word in ("[rotor]", "[contact]", "[bearings.TB2]", "[materials]"))
        one = text[pair:rest].replace("row_phase = 0.5", "row_phase = 0")
        nodes = ", ".join(f"{{ id = {k + 1}, x = {0.25 * k} }}" for k in range(5))
        elements = ", ".join(f"{{ n1 = {k}, n2 = {k + 1}, od = 0.1 }}" for k in range(1, 5))
        rotor = f"""[rotor]
model = "rigid"
mass_proportional_alpha = "30 1/s"
[rotor.geometry]
material = {{ E = 2e11, nu = 0.3, rho = 7800 }}
nodes = [{nodes}]
elements = [{elements}]
"""
        shared = text[contact:text.index("# 6014/HC5C3")]
        both = one.replace("node = 28", "node = 2") + one.replace("bearings.TB2", "bearings.TB3").replace("node = 28", "node = 4")
        self.write("even.toml", text[:start].replace('"0.3 s"', '"60 ms"') + rotor + shared + both + text[rest:])
        locked = self.run_case("even.toml", output="locked")["bearings"]
        free = self.run_case("even.toml", output="free", bearings__ring_motion="free")["bearings"]
        for name in ("TB2", "TB3"):
            for key in ("peak_contact_force", "friction_heat", "first_contact_end"):
                self.assertAlmostEqual(free[name][key], locked[name][key], delta=1e-4 * locked[name][key], msg="what error control leaves")

    def test_peaks_follow_the_ring_on_its_shoulder(self):
        # 0.21 kg on 5 GN/m: 25 kHz, three times as fast as anything between rotor and balls.
        shutil.copy(PARAMS / "vertical-drop.toml", self.folder)
        gaps = {f"bearings__TB1__shoulders__gap_{side}_x": "0.2 mm" for side in ("minus", "plus")}
        summary = self.run_case("vertical-drop.toml", run__end_time="12 ms", rotor__model="full", output__interval="1 us", **gaps)
        with h5py.File(self.folder / "out/results.h5") as file:
            ring = file["bearings/TB1"]
            found = summary["bearings"]["TB1"]
            self.assertGreater(-ring["axial_force"][:].min(), 2000, "N: the shoulder is reached")
            # A parabola through looks 12 times a period meets a peak within 6e-3; a range has the largest look alone, within 1 - cos(pi / 12).
            self.assertAlmostEqual(found["peak_friction_heat_rate"] / ring["rub_heat_rate"][:].max(), 1, delta=0.01)
            self.assertAlmostEqual(found["axial"]["force"]["smallest"] / ring["axial_force"][:].min(), 1, delta=0.035)


class Faults(ProgramTest):
    def fails(self, text, *says):
        before = content_of(self.folder)
        self.write("drop.toml", 'base = "reference.toml"\n' + text)
        done = self.call("run", "drop.toml")
        self.assertEqual(done.returncode, 2, done.stdout)
        for pattern in says:
            self.assertRegex(done.stderr, pattern)
        self.assertEqual(content_of(self.folder).keys() - {"drop.toml"}, before.keys())

    def test_a_rotor_that_nothing_stops(self):
        self.fails(FREE.replace("[bearings]", 'axial_force = "2 kN"\n[bearings]') , r"drop.toml:3:\d+: nothing stops the rotor, which 2000 N push towards \+x", "shoulders.gap_minus_x")

    def test_a_rotor_that_its_weight_pushes(self):
        self.fails('run.gravity = [-9.81, 0, 0]\n' + FREE, r"nothing stops the rotor, which 1076.\d+ N push towards -x", "shoulders.gap_plus_x")

    def test_rings_that_cannot_follow(self):
        self.fails('rotor.axial_motion = "free"\n', "the inner ring of TB1 cannot move axially", 'bearings.TB2.ring_motion = "free"')

    def test_thrust_on_a_locked_rotor(self):
        self.fails('rotor.axial_force = "1 N"\n', r"rotor.axial_force acts on a rotor that cannot move", 'axial_motion = "free"')

    def test_shoulders_of_a_locked_ring(self):
        self.fails('[bearings.TB1.shoulders]\ngap_plus_x = "0.1 mm"\n', "shoulders beside a ring that cannot move along the axis")

    def test_shoulders_of_a_locked_rotor(self):
        self.fails('bearings.ring_motion = "free"\n[bearings.TB1.shoulders]\ngap_plus_x = "0.1 mm"\n', "stop a rotor that cannot move along its axis")

    def test_rows_that_lean_one_way(self):
        self.fails('bearings.ring_motion = "free"\nbearings.TB2.arrangement = "tandem"\n', r"rows whose contact angles all point the same way: their balls push the ring off axially")

    def test_an_unknown_motion(self):
        self.fails('bearings.ring_motion = "fre"\n', 'Did you mean "free"')


    def test_a_shoulder_that_starts_inside_a_ring_is_refused(self):
        # Gravity along the axis: the ring of the deep-groove bearing hangs 134 um low in its balls.
        shutil.copy(PARAMS / "vertical-drop.toml", self.folder)
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-thrust.toml"):
            shutil.copy(PARAMS / name, self.folder)
        for gap, fits in ((0.1, False), (0.13, False), (0.14, True)):
            keys = settings(run__end_time="1 ms", bearings__TB1__shoulders__gap_minus_x=f"{gap} mm", bearings__TB1__shoulders__gap_plus_x=f"{gap} mm")
            done = self.call("check", "vertical-drop.toml", *keys)
            self.assertEqual(done.returncode, 0 if fits else 2, done.stdout + done.stderr)
            if not fits:
                self.assertRegex(done.stderr, f"a shoulder of the rotor starts {133.588 - 1000 * gap:.3f} um inside the ring of TB1, which hangs -133.588 um")


if __name__ == "__main__":
    unittest.main()
