"""Damage per drop: static safety, contact fatigue and wear of each bearing, and the allowed number of drops, computed here a second time from the series."""

import json
import math
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, page_data, settings  # noqa: E402

RATED = settings(bearings__TB1__C="39.7 kN", bearings__TB2__C="33 kN", run__end_time="30 ms", output__interval="5 us", output__detail_interval="5 us")


def rainflow(values):
    """Ranges and numbers of cycles of a history by ASTM E1049-85, 5.4.4, point by point as the standard has them."""
    points = [values[0]]
    for value in values[1:]:
        if value == points[-1]:
            continue
        if len(points) > 1 and (value - points[-1]) * (points[-1] - points[-2]) > 0:
            points[-1] = value
        else:
            points.append(value)
    read, cycles = [], []
    for point in points:
        read.append(point)
        while len(read) >= 3:
            x, y = abs(read[-1] - read[-2]), abs(read[-2] - read[-3])
            if x < y:
                break
            if len(read) == 3:
                cycles.append((y, 0.5))
                del read[0]
            else:
                cycles.append((y, 1.0))
                del read[-3:-1]
    return cycles + [(abs(b - a), 0.5) for a, b in zip(read, read[1:])]


class Damage(ProgramTest):
    def test_the_peer_counts_the_example_of_the_standard(self):
        counts = {}
        for size, n in rainflow([-2, 1, -3, 5, -1, 3, -4, 4, -2]):
            counts[size] = counts.get(size, 0) + n
        self.assertEqual(counts, {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5})

    def test_fatigue_is_that_of_the_recorded_ball_loads(self):
        self.succeed("run", "reference.toml", "-o", "out", *RATED)
        summary = self.summary()
        J_r = np.mean(np.maximum(np.cos(np.linspace(0, 2 * np.pi, 40001)[:-1]), 0) ** 2.5)
        with h5py.File(self.folder / "out/results.h5") as results:
            for name, C, Z, D, d_m, alpha, rows in (("TB1", 39.7e3, 14, 11.906e-3, 90e-3, 0, 1), ("TB2", 33e3, 23, 9.525e-3, 85e-3, math.radians(25), 2)):
                fatigue = summary["bearings"][name]["damage"]["fatigue"]
                loads = results[f"bearings/{name}/ball_loads"][:]
                self.assertEqual(loads.shape[1], Z * rows)
                of_row = C / rows**0.7
                Q_C = of_row / (Z * math.cos(alpha) * J_r)
                passages = 1e6 * Z * (1 - D * math.cos(alpha) / d_m) / 2
                shares, rolled, largest = [], [], 0
                turns = np.abs(results[f"bearings/{name}/ring_speed"][:]) / (2 * np.pi)
                J_3 = np.mean(np.maximum(np.cos(np.linspace(0, 2 * np.pi, 40001)[:-1]), 0) ** 4.5)
                for row in range(rows):
                    mean = np.mean(loads[:, row * Z : (row + 1) * Z] ** 3, axis=1)
                    rolled.append(np.interp(results["detail/time"][:], results["time"][:], turns))
                    rolled[-1] = np.trapz(rolled[-1] * mean, results["detail/time"][:]) / J_3 / Q_C**3 / 1e6
                    cycles = [cycle for ball in range(row * Z, (row + 1) * Z) for cycle in rainflow(loads[:, ball])]
                    shares.append(sum(n * size**3 for size, n in cycles) / Q_C**3 / passages)
                    largest = max(largest, *(size for size, n in cycles))
                share = sum(one ** (10 / 9) for one in shares) ** 0.9
                self.assertGreater(share, 1e-9)
                by_rolling = sum(one ** (10 / 9) for one in rolled) ** 0.9
                self.assertGreater(by_rolling, 1e-12)
                self.assertAlmostEqual(fatigue["by_rolling"], by_rolling, delta=0.02 * by_rolling)
                self.assertAlmostEqual(fatigue["by_cycles"], share, delta=0.02 * share)
                share = sum(max(pair) ** (10 / 9) for pair in zip(shares, rolled)) ** 0.9
                # Rows every 5 us find the peaks a little below those at the steps.
                self.assertAlmostEqual(fatigue["share"], share, delta=0.02 * share)
                self.assertAlmostEqual(fatigue["largest_cycle"], largest, delta=0.01 * largest)
                self.assertAlmostEqual(fatigue["load_over_rating"], fatigue["largest_cycle"] / Q_C, delta=1e-4 * fatigue["load_over_rating"])
                self.assertEqual(len(fatigue["rows"]), rows)
                self.assertEqual(fatigue["rating"], C)
                self.assertGreaterEqual(fatigue["equivalent_cycles"], 0.5)

    def test_balls_with_inertia_tire_both_races(self):
        at_speed = settings(bearings__ball_model="inertial", contact__friction_coefficient=0.4, run__end_time="0.1 s", output__interval="20 us", output__detail_interval="20 us")
        self.succeed("run", "reference.toml", "-o", "out", *RATED, *at_speed)
        fatigue = self.summary()["bearings"]["TB2"]["damage"]["fatigue"]
        Z, D, d_m, alpha, C = 23, 9.525e-3, 85e-3, math.radians(25), 33e3 / 2**0.7
        circle = np.maximum(np.cos(np.linspace(0, 2 * np.pi, 40001)[:-1]), 0)
        Q_C = C / (Z * math.cos(alpha) * np.mean(circle**2.5))
        gamma = D * math.cos(alpha) / d_m
        # ISO/TS 16281: races have the ratings Q_ci and Q_ce, and L10 = [(Q_ci/Q_i)^(-10/3) + (Q_ce/Q_e)^(-10/3)]^(-9/10). Conformities are the same.
        X = (1.044 * ((1 - gamma) / (1 + gamma)) ** 1.72) ** (10 / 3)
        inner, outer = (1 + X) ** 0.3 / 0.407, (1 + 1 / X) ** 0.3 / 0.389
        with h5py.File(self.folder / "out/results.h5") as results:
            bearing, time = results["bearings/TB2"], results["detail/time"][:]
            turns = np.interp(time, results["time"][:], np.abs(bearing["ring_speed"][:]) / (2 * np.pi))
            share, inner_alone = 0, 0
            for row in range(2):
                rolled = []
                for loads in (bearing["ball_loads"], bearing["outer_ball_loads"]):
                    cubes = np.mean(loads[:, row * Z : (row + 1) * Z] ** 3, axis=1)
                    rolled.append(np.trapz(turns * cubes, time) / np.mean(circle**4.5) / Q_C**3 / 1e6)
                both = ((rolled[0] ** (1 / 3) / inner) ** (10 / 3) + (rolled[1] ** (1 / 3) / outer) ** (10 / 3)) ** 0.9
                both /= (inner ** (-10 / 3) + outer ** (-10 / 3)) ** 0.9
                share, inner_alone = share + both ** (10 / 9), inner_alone + rolled[0] ** (10 / 9)
            largest = np.max(bearing["outer_ball_loads"][:] - bearing["ball_loads"][:])
            outer_range, inner_range = (np.ptp(bearing[name][:], axis=0).max() for name in ("outer_ball_loads", "ball_loads"))
        self.assertGreater(largest, 10, "N: centrifugal forces press the outer race")
        self.assertNotAlmostEqual(outer_range, inner_range, delta=0.02 * inner_range)
        # The largest range of a history is its largest cycle; rows every 20 us find peaks 1 % lower.
        self.assertAlmostEqual(fatigue["largest_cycle"], inner_range, delta=0.01 * inner_range)
        self.assertAlmostEqual(fatigue["load_over_rating"], max(outer_range, inner_range) / Q_C, delta=0.01 * fatigue["load_over_rating"])
        # Rows every 20 us: 2 %, as loads by cycles every 5 us; the standard's rounded factors: 0.6 %.
        self.assertAlmostEqual(fatigue["by_rolling"], share**0.9, delta=0.026 * share**0.9)
        self.assertGreater(share**0.9, 1.05 * inner_alone**0.9, "so that the outer race is seen")

    def test_the_allowed_number_is_the_least_of_all(self):
        done = self.succeed("run", "reference.toml", "-o", "out", *RATED, *settings(bearings__required_static_safety=0.01))
        for name, bearing in self.summary()["bearings"].items():
            damage = bearing["damage"]
            self.assertIs(damage["assessed"], True)
            self.assertAlmostEqual(damage["static_safety"], (4.2e9 / bearing["largest_contact_pressure"]) ** 3, delta=1e-9)
            self.assertAlmostEqual(damage["wear_share"], 1 / bearing["wear"]["drops_until_limit"], delta=1e-9 * damage["wear_share"])
            shares = {"fatigue": damage["fatigue"]["share"], "wear": damage["wear_share"]}
            governed = max(shares, key=shares.get)
            self.assertEqual((damage["governed_by"], damage["allowed_drops"]), (governed, math.floor(1 / shares[governed] * (1 + 1e-12))))
            self.assertIn("ISO 281", damage["basis"][1])
            self.assertRegex(done.stdout, rf"allowed drops: {damage['allowed_drops']} \({governed}\)")
        # A part of a drop is none, whatever its digits: the page's count until the permitted depth is whole, too.
        self.succeed("report", "out")
        rows = {row["name"]: row for row in page_data((self.folder / "out/report.html").read_text())["numbers"]["rows"]}
        drops = [bearing["wear"]["drops_until_limit"] for bearing in self.summary()["bearings"].values()]
        self.assertEqual(rows["number of such drops until the permitted wear depth"]["values"], [str(math.floor(n)) for n in drops])
        self.assertTrue(any(f"{n:.0f}" != str(math.floor(n)) for n in drops), "one of them would be rounded up")

    def test_too_little_static_safety_allows_none(self):
        done = self.succeed("run", "reference.toml", "-o", "out", *RATED, *settings(bearings__required_static_safety=1e6))
        for bearing in self.summary()["bearings"].values():
            self.assertEqual((bearing["damage"]["allowed_drops"], bearing["damage"]["governed_by"]), (0, "static safety"))
        self.assertIn("allowed drops: 0 (static safety)", done.stdout)
        self.succeed("report", "out")
        page = (self.folder / "out/report.html").read_text()
        data = page_data(page)
        rows = {row["meaning"]: row for row in data["damage"]}
        self.assertEqual(rows["TB1: static safety of the worst ball"]["state"], "warning")
        self.assertEqual(rows["TB1: allowed number of such drops, by static safety"]["state"], "warning")
        self.assertEqual(rows["TB2: contact fatigue per drop, share of the life L10"]["state"], "ok")

    def test_without_a_rating_fatigue_is_not_assessed(self):
        done = self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="12 ms"))
        damage = self.summary()["bearings"]["TB1"]["damage"]
        self.assertIsNone(damage["fatigue"])
        self.assertIn("not assessed", damage["basis"][1])
        self.assertIn("fatigue not assessed (no C)", done.stdout)

    def test_a_drop_without_contact_is_not_assessed(self):
        done = self.succeed("run", "reference.toml", "-o", "out", *RATED, *settings(run__end_time="5 ms"))
        for bearing in self.summary()["bearings"].values():
            damage = bearing["damage"]
            self.assertIs(damage["assessed"], False)
            self.assertEqual({damage[key] for key in ("static_safety", "wear_share", "allowed_drops")}, {None})
            rows = damage["fatigue"].pop("rows")
            self.assertEqual({*rows, *damage["fatigue"].values()}, {None})
            self.assertTrue(all("the rotor did not touch the bearing" in basis for basis in damage["basis"]))
        self.assertEqual(done.stdout.count("damage per drop: not assessed, the rotor did not touch the bearing"), 2)
        self.succeed("report", "out")
        rows = page_data((self.folder / "out/report.html").read_text())["damage"]
        self.assertEqual(len(rows), 8)
        self.assertEqual({row["state"] for row in rows}, {"unknown"})

    def test_an_interrupted_drop_counts_on(self):
        # Cycles that are open at the interruption are in the checkpoint. Steps are fixed: a resumed run has the same bits.
        fixed = [*RATED, *settings(integration__method="runge-kutta-4", integration__step="0.5 us", run__end_time="60 ms")]
        self.succeed("run", "reference.toml", "-o", "whole", *fixed)
        self.interrupt_run("reference.toml", "--quiet", *fixed, after=0.05)
        self.succeed("run", "reference.toml", "-o", "out", "--resume", "--quiet", *fixed)
        for name, bearing in self.summary("whole")["bearings"].items():
            self.assertEqual(self.summary()["bearings"][name]["damage"], bearing["damage"])

    def test_without_a_rating_the_report_does_not_judge_the_number(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="12 ms"))
        self.succeed("report", "out")
        rows = {row["meaning"]: row for row in page_data((self.folder / "out/report.html").read_text())["damage"]}
        self.assertEqual(rows["TB1: allowed number of such drops, by wear"]["state"], "unknown")

    def test_a_void_pressure_meets_no_limit(self):
        """Ellipses that reach over the raceway's edge press harder than Hertz' formula says: what it finds too hard is too hard, what it does not is not known."""
        self.write("thrust.toml", f'''base = "{PARAMS / 'neisi2019-thrust.toml'}"
run.end_time = "14 ms"
rotor.axial_force = [["0 ms", "4 kN"]]
bearings.TB2.C = "51.2 kN"
[limits]
"bearings.TB2.static_safety" = {{ min = 1.2 }}
"bearings.TB2.rows[0].static_safety" = {{ min = 1.2 }}
"bearings.TB2.rows[1].static_safety" = {{ min = 1e3, max = 2e3 }}
"bearings.TB2.rows[1].largest_contact_pressure" = {{ min = "1 GPa", max = "4.2 GPa" }}
"bearings.TB2.largest_contact_pressure" = {{ min = "4.2 GPa" }}
"bearings.TB2.damage.static_safety" = {{ min = 1.2 }}
"bearings.TB2.damage.allowed_drops" = {{ min = 1 }}
"bearings.TB1.static_safety" = {{ min = 1.2 }}
''')
        done = self.succeed("run", "thrust.toml", "-o", "out")
        summary = self.summary()
        pair = summary["bearings"]["TB2"]
        self.assertEqual([row["truncation"] > 0 for row in pair["rows"]], [False, True])
        damage = pair["damage"]
        self.assertIs(damage["pressure_is_void"], True)
        self.assertEqual((damage["allowed_drops"], damage["governed_by"]), (None, "nothing"))
        self.assertIn("void: contact ellipses of row 2 reach over", damage["basis"][0])
        self.assertRegex(done.stdout, r"static safety below [\d.]+ \(ellipses over the edge\).*allowed drops: not assessed")
        verdicts = {(limit["key"], limit["kind"]): limit["accepted"] for limit in summary["limits"]}
        # The true pressure is at least what is computed, the true safety at most.
        self.assertEqual(verdicts, {("bearings.TB2.static_safety", "min"): None, ("bearings.TB2.rows[0].static_safety", "min"): True,
                                    ("bearings.TB2.rows[1].static_safety", "min"): False, ("bearings.TB2.rows[1].static_safety", "max"): True,
                                    ("bearings.TB2.rows[1].largest_contact_pressure", "min"): True, ("bearings.TB2.rows[1].largest_contact_pressure", "max"): None,
                                    ("bearings.TB2.largest_contact_pressure", "min"): None, ("bearings.TB2.damage.static_safety", "min"): None,
                                    ("bearings.TB2.damage.allowed_drops", "min"): None, ("bearings.TB1.static_safety", "min"): True})
        self.assertIs(summary["bearings"]["TB1"]["damage"]["pressure_is_void"], False)
        self.succeed("report", "out")
        rows = {row["meaning"]: row for row in page_data((self.folder / "out/report.html").read_text())["damage"]}
        self.assertEqual([rows[f"TB2: {what}"]["state"] for what in ("static safety of the worst ball", "allowed number of such drops")], ["unknown", "unknown"])
        # A study counts as the run does, also where it keeps nothing else.
        self.write("s.toml", 'case = "thrust.toml"\n[vary]\ncontact.air_gap = { values = ["250 um"] }\n[design]\nkind = "list"\n[keep]\nresults = ["bearings.TB1.friction_heat"]\n')
        self.succeed("study", "s.toml", "-o", "study")
        counted = {one["result"]: (one["n"], one["broken"], one["undefined"]) for one in json.loads((self.folder / "study/study.json").read_text())["limits"]}
        broken = {key for (key, _), verdict in verdicts.items() if verdict is False}
        unclear = {key for (key, _), verdict in verdicts.items() if verdict is None} - broken
        self.assertEqual(counted, {key: (0, 0, 1) if key in unclear else (1, int(key in broken), 0) for key, _ in verdicts})
        # A search tells how many drops of its best evaluation say nothing.
        self.write("bare.toml", (self.folder / "thrust.toml").read_text().split("[limits]")[0])
        self.write("m.toml", """case = "bare.toml"
[vary]
contact.air_gap = { range = ["240 um", "260 um"] }
[limits]
"bearings.TB2.static_safety" = { min = 1.2 }
"bearings.TB1.static_safety" = { min = 1.2 }
[minimise]
result = "bearings.TB1.friction_heat"
evaluations = 1
""")
        done = self.succeed("study", "m.toml", "-o", "search")
        limits = {limit["result"]: limit["undefined"] for limit in json.loads((self.folder / "search/study.json").read_text())["minimise"]["best"]["limits"]}
        self.assertEqual((limits["bearings.TB2.static_safety"], limits["bearings.TB1.static_safety"]), (1, 0))
        self.assertRegex(done.stdout, r"bearings.TB2.static_safety: 1 of 1 drops cannot be judged")
        # Enough pressure to be sure of the worst.
        self.succeed("run", "thrust.toml", "-o", "strict", *settings(bearings__TB2__required_static_safety=1e3))
        self.assertEqual(self.summary("strict")["bearings"]["TB2"]["damage"]["allowed_drops"], 0)

    def test_limits_know_it(self):
        case = self.case("[limits]\nbearings.TB1.damage.allowed_drops.min = 20\nbearings.TB2.damage.fatigue.share.max = 1e-3\n")
        self.succeed("run", case, "-o", "out", *RATED)
        limits = {limit["key"]: limit for limit in self.summary()["limits"]}
        self.assertEqual(limits["bearings.TB2.damage.fatigue.share"]["value"], self.summary()["bearings"]["TB2"]["damage"]["fatigue"]["share"])
        self.assertIn("bearings.TB1.damage.allowed_drops", limits)


if __name__ == "__main__":
    unittest.main()
