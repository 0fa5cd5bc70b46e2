"""A rotor that lands on a thrust shoulder touches its bearing: params/vertical-drop.toml, a machine on end whose magnets let go after 2 ms.

It hangs 0.11 mm low in its thrust magnet, 0.2 mm above the shoulder of TB2, and lands on it after some 10 ms.
Nothing moves it across its axis but a small unbalance: the bores are not touched.
"""

import math
import shutil
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, page_data, settings  # noqa: E402


class Shoulders(ProgramTest):
    def drop(self, output, *lines, options=(), **keys):
        self.write("drop.toml", "\n".join((f'base = "{PARAMS / "vertical-drop.toml"}"', *lines)) + "\n")
        self.done = self.call("run", "drop.toml", "-o", output, *options, *settings(**({"run__end_time": "25 ms"} | keys)))
        return self.summary(output)

    def test_a_landing_on_a_shoulder_is_assessed(self):
        limits = ('[limits]', '"bearings.TB2.static_safety" = { min = 1e6 }', '"bearings.TB2.axial.force.smallest" = { min = "-10 N" }', '"bearings.TB2.damage.allowed_drops" = { min = 1 }')
        summary = self.drop("out", *limits, options=("--accept",), bearings__TB2__C="33 kN", bearings__TB2__required_static_safety="0.01")
        self.assertEqual(self.done.returncode, 3, self.done.stdout + self.done.stderr)
        pair = summary["bearings"]["TB2"]
        with h5py.File(self.folder / "out/results.h5") as file:
            t, force = file["time"][:], file["bearings/TB2/shoulder_force"][:]
            self.assertFalse((file["bearings/TB2/penetration"][:] > 0).any(), "the bore is not touched")
        self.assertAlmostEqual(pair["first_touch_time"], t[numpy.argmax(force != 0)], delta=60e-6, msg="s: rows are 50 us apart")
        self.assertEqual(pair["axial"]["first_shoulder_contact_time"], pair["first_touch_time"])
        self.assertLessEqual(pair["axial"]["shoulder_force"]["smallest"], force.min())
        self.assertLess(force.min(), -1000, "N")
        self.assertEqual((pair["first_contact_time"], pair["peak_contact_force"]), (None, 0), "of the bore")
        self.assertNotIn("no-contact", [warning["code"] for warning in summary["warnings"]])
        verdicts = {limit["key"]: limit["accepted"] for limit in summary["limits"]}
        self.assertEqual(verdicts, {"bearings.TB2.static_safety": False, "bearings.TB2.axial.force.smallest": False, "bearings.TB2.damage.allowed_drops": None}, "pressures are void where ellipses reach over the edge")
        self.assertIs(summary["accepted"], False)

        damage = pair["damage"]
        self.assertIs(damage["assessed"], True)
        self.assertAlmostEqual(damage["static_safety"], pair["static_safety"], delta=1e-9 * pair["static_safety"])
        self.assertGreater(damage["fatigue"]["share"], 0)
        self.assertIsNone(damage["wear_share"], "shoulders wear, but nobody computes it")
        self.assertIn("wear: not assessed, the rotor rubs on a shoulder", damage["basis"][2])
        self.assertIs(summary["bearings"]["TB1"]["damage"]["assessed"], False, "it has no shoulders")
        self.assertIsNone(summary["bearings"]["TB1"]["first_touch_time"])
        self.assertRegex(self.done.stdout, r"TB2: first contact in the bore never, on a shoulder 1\d(\.\d+)? ms, peak contact force in the bore 0.00 kN")
        self.assertRegex(self.done.stdout, r"damage per drop: static safety below [\d.]+ \(ellipses over the edge\), fatigue [\d.e-]+ of L10, wear of shoulders not assessed; allowed drops: not assessed")

        self.succeed("report", "out")
        checks = {check["name"]: check for check in page_data((self.folder / "out/report.html").read_text())["checks"]}
        for name, word in (("TB2: wear", "wear where a shoulder rubs is not computed"), ("TB2: local temperature where rotor and bore rub", "a shoulder rubs")):
            self.assertEqual(checks[name]["state"], "unknown")
            self.assertIn(word, checks[name]["text"])
        self.assertEqual(checks["TB1: wear"]["state"], "ok")

    def test_a_second_opinion_is_asked_of_the_landing(self):
        summary = self.drop("out", run__second_opinion="true")
        force = summary["bearings"]["TB2"]["axial"]["shoulder_force"]
        of = {result["key"]: result for result in summary["second_opinion"]["results"]}
        landing = of["bearings.TB2.axial.shoulder_force.smallest"]
        self.assertEqual((landing["value"], landing["unit"]), (force["smallest"], "N"))
        self.assertTrue(landing["lowest"] <= force["smallest"] <= landing["highest"] < -1000, landing)
        self.assertTrue(0 < landing["by_finer_steps"] < 0.05, landing)
        self.assertNotIn("bearings.TB1.axial.shoulder_force.smallest", of, "it has no shoulders")
        # Where the bores' first impacts are over before the rotor lands, finer steps have no landing to compare.
        early = self.drop("early", run__second_opinion="true", bearings__TB2__shoulders__gap_plus_x="0.6 mm", options=("--set", 'rotor.initial_offset=["-249 um", 0]'))
        self.assertLess(early["second_opinion"]["first_impacts_until"], early["bearings"]["TB2"]["axial"]["first_shoulder_contact_time"])
        landing = next(result for result in early["second_opinion"]["results"] if result["key"] == "bearings.TB2.axial.shoulder_force.smallest")
        self.assertIsNone(landing["by_finer_steps"])

    def test_the_report_shows_what_happens_along_the_axis(self):
        summary = self.drop("out")["bearings"]["TB2"]["axial"]
        self.succeed("report", "out")
        data = page_data((self.folder / "out/report.html").read_text())
        drops = next(row for row in data["damage"] if row["meaning"] == "TB2: allowed number of such drops")
        self.assertEqual((drops["value"], drops["usage"], drops["state"]), ("—", "—", "unknown"), "neither wear nor, without C, fatigue was assessed")
        charts = {chart["id"]: {line["name"]: line["y"] for line in chart["lines"]} for chart in data["charts"]}
        self.assertEqual(list(charts["axial-force"]), ["TB1", "TB2", "TB2 shoulders"])
        self.assertEqual(set(charts["axial-position"]), {f"{name} {part}" for name in ("TB1", "TB2") for part in ("rotor", "ring")})
        with h5py.File(self.folder / "out/results.h5") as file:
            pair = file["bearings/TB2"]
            self.assertAlmostEqual(min(charts["axial-force"]["TB2 shoulders"]), 1e-3 * pair["shoulder_force"][:].min(), delta=1e-3, msg="kN")
            self.assertAlmostEqual(min(charts["axial-position"]["TB2 rotor"]), 1e6 * pair["axial_position"][:, 0].min(), delta=0.1, msg="um")
        names = [row["name"] for row in data["numbers"]["rows"]]
        self.assertEqual(names[:2], ["first contact in the bore", "first contact on a shoulder"], "rows that one bearing has stand among the others")
        rows = {row["name"]: (row["unit"], row["values"][data["numbers"]["bearings"].index("TB2")]) for row in data["numbers"]["rows"]}
        for name, unit, value in (("largest shoulder force towards -x (negative)", "kN", 1e-3 * summary["shoulder_force"]["smallest"]),
                                  ("largest axial force of the rotor on the ring, towards -x (negative)", "kN", 1e-3 * summary["force"]["smallest"]),
                                  ("first contact on a shoulder", "ms", 1e3 * summary["first_shoulder_contact_time"]),
                                  ("smallest axial position of the rotor", "um", 1e6 * summary["rotor_position"]["smallest"]), ("peak contact force in the bore (0-peak)", "kN", 0)):
            self.assertEqual(rows[name][0], unit)
            self.assertAlmostEqual(float(rows[name][1]), value, delta=1e-3 * abs(value), msg=name)
        (check,) = [check for check in data["checks"] if check["name"] == "TB2: static load rating"]
        self.assertEqual(check["state"], "unknown", "C0 is a radial rating")
        self.assertRegex(check["text"], r"the axial load of up to [\d.]+ kN is larger than the radial one")
        self.assertTrue(any("shoulders of the rotor: 300 µm from the ring's face at -x, 300 µm from the ring's face at +x" in word for word in data["words"]))
        self.assertTrue(any("not local temperatures and wear" in text for text in data["assumptions"]))

    def test_a_steady_thrust_reaches_the_shoulder_when_the_closed_form_says(self):
        # m x'' = -F - m alpha x' from rest: x = -F / (m alpha) (t - (1 - exp(-alpha t)) / alpha), to the gap of 0.3 mm.
        self.succeed("run", PARAMS / "neisi2019-thrust.toml", "-o", "out", *settings(
            rotor__axial_force='[["0 ms", "-1 kN"]]', run__gravity="[0, 0, 0]", run__end_time="9 ms", rotor__unbalance="[]", contact__friction_coefficient="0", integration__step="2 us"))
        summary = self.summary()
        force, mass, alpha, gap, t = 1e3, summary["rotor"]["mass"], 30.0, 0.3e-3, 8e-3
        for _ in range(20):  # Newton's method
            t -= (force / (mass * alpha) * (t - (1 - math.exp(-alpha * t)) / alpha) - gap) / (force / (mass * alpha) * (1 - math.exp(-alpha * t)))
        bearing = summary["bearings"]["TB2"]
        self.assertEqual(bearing["first_touch_time"], bearing["axial"]["first_shoulder_contact_time"])
        late = bearing["first_touch_time"] - t
        self.assertTrue(-1e-9 < late < 2e-6, f"{late} s; it is the end of a step of at most 2 us")

    def test_run_and_study_agree_on_a_landing(self):
        limit = '"bearings.TB2.axial.force.smallest" = { min = "-10 N" }'
        one = self.drop("out", "[limits]", limit)
        self.assertIs(one["accepted"], False)
        self.write("study.toml", f'case = "drop.toml"\n[vary]\n"bearings.TB2.shoulders.gap_plus_x" = ["0.3 mm", "0.31 mm"]\n[design]\nkind = "list"\n[limits]\n{limit}\n')
        done = self.succeed("study", "study.toml", "-o", "study", *settings(run__end_time="25 ms"))
        self.assertRegex(done.stdout, r"axial\.force\.smallest below -10 N: 2 of 2 drops")

    def test_a_rotor_that_falls_and_touches_nothing_is_not_assessed(self):
        summary = self.drop("out", "[limits]", '"bearings.TB2.static_safety" = { min = 1e6 }', run__end_time="4 ms")
        self.assertIsNone(summary["accepted"])
        self.assertEqual([warning["code"] for warning in summary["warnings"]], ["no-contact"])
        self.assertIs(summary["bearings"]["TB2"]["damage"]["assessed"], False)

    def test_no_contact_does_not_end_a_run_whose_rotor_stands_on_a_shoulder(self):
        # Pushed sideways it meets the bores, too, and leaves them; it then stands and rubs on TB2's shoulder.
        summary = self.drop("out", run__until="no contact", run__end_time="0.5 s", rotor__initial_velocity='["0.2 m/s", "0 m/s"]')
        self.assertEqual(summary["run"]["ended_by"], "end_time", self.done.stdout)
        with h5py.File(self.folder / "out/results.h5") as file:
            t, pair = file["time"][:], file["bearings/TB2"]
            touched = (pair["penetration"][:] > 0) | (file["bearings/TB1/penetration"][:] > 0)
            apart = numpy.diff([*t[touched], t[-1]])
            left = t[touched][apart.argmax()]
            self.assertGreater(apart.max(), 0.1, "s: the bores were left for so long")
            self.assertTrue((pair["shoulder_force"][:][(t > left) & (t < left + apart.max())] < 0).any())

    def test_no_contact_ends_a_run_after_the_last_touch_of_a_shoulder(self):
        # Thrown onto the shoulder within sqrt(2 * 0.3 mm * 109.7 kg / 1 kN) = 8.1 ms and then left alone, without weight: it bounces off and drifts away.
        shutil.copy(PARAMS / "neisi2019-thrust.toml", self.folder / "thrust.toml")
        for name in ("neisi2019.toml", "neisi2019-settling.toml"):
            shutil.copy(PARAMS / name, self.folder)
        thrown = settings(rotor__axial_force='[["8.2 ms", "-1 kN"], ["8.3 ms", "0 N"]]', rotor__unbalance="[]", run__gravity="[0, 0, 0]", bearings__TB2__shoulders__gap_minus_x="50 mm")
        self.succeed("run", "thrust.toml", "-o", "out", *thrown, *settings(run__until="no contact", run__end_time="0.5 s"))
        self.assertEqual(self.summary()["run"]["ended_by"], "no contact")
        with h5py.File(self.folder / "out/results.h5") as file:
            t, touched = file["time"][:], file["bearings/TB2/shoulder_force"][:] != 0
            self.assertFalse((file["bearings/TB2/penetration"][:] > 0).any())
        self.assertAlmostEqual(t[-1] - t[touched][-1], 0.1, delta=110e-6, msg="s; rows are 50 us apart, and the end is a step's")

    def test_an_interrupted_landing_resumes_bit_for_bit(self):
        self.write("drop.toml", f'base = "{PARAMS / "vertical-drop.toml"}"\n')
        long = settings(run__end_time="0.13 s", run__until="no contact", integration__method="runge-kutta-4", integration__step="0.5 us")
        self.interrupt_run("drop.toml", *long, after=0.3)
        self.succeed("run", "drop.toml", "-o", "out", "--resume", *long)
        self.succeed("run", "drop.toml", "-o", "whole", *long)
        for name, bearing in self.summary("whole")["bearings"].items():
            self.assertEqual(self.summary("out")["bearings"][name], bearing)
        with h5py.File(self.folder / "out/results.h5") as parts, h5py.File(self.folder / "whole/results.h5") as whole:
            for path in ("time", "bearings/TB2/shoulder_force", "rotor/spin_speed"):
                numpy.testing.assert_array_equal(parts[path][:], whole[path][:], err_msg=path)


if __name__ == "__main__":
    unittest.main()
