"""The second opinion on a drop: its numbers are those of runs that a user could make by hand."""

import re
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, content_of, page_data, settings  # noqa: E402

KEY = "bearings.TB1.peak_contact_force"


class SecondOpinion(ProgramTest):
    def peak(self, directory):
        return self.summary(directory)["bearings"]["TB1"]["peak_contact_force"]

    def opinion(self, directory="out"):
        opinion = self.summary(directory)["second_opinion"]
        return opinion, {result["key"]: result for result in opinion["results"]}

    def test_it_is_what_runs_by_hand_say(self):
        case = self.case('integration.method = "tsitouras"\nintegration.tolerance = 1e-4\nintegration.step = "50 us"\n')
        long = settings(run__end_time="40 ms")
        done = self.succeed("run", case, "-o", "out", *long, "--set", "run.second_opinion=true")
        opinion, results = self.opinion()
        # First impacts: to the second contact of the bearing that has it last.
        bearings = self.summary("out")["bearings"]
        until = max(b[key] for b in bearings.values() for key in ("first_contact_end", "second_contact_time") if b[key] is not None)
        self.assertAlmostEqual(opinion["first_impacts_until"], until, delta=1e-12)
        brief = settings(run__end_time=f"{until!r}")
        self.succeed("run", case, "-o", "same", *brief)
        self.succeed("run", case, "-o", "finer", *brief, *settings(integration__tolerance="1e-5", integration__step="25 us"))
        difference = abs(self.peak("same") - self.peak("finer")) / max(self.peak("same"), self.peak("finer"))
        self.assertAlmostEqual(results[KEY]["by_finer_steps"], difference, delta=1e-9)
        self.assertGreater(difference, 0, "such a tolerance leaves something")
        self.succeed("report", "out")
        lines = page_data((self.folder / "out/report.html").read_text())["second_opinion"]
        self.assertRegex(lines[0], "Second opinion .*2 drops that start 1 nm beside")
        self.assertTrue(any(KEY in line for line in lines), lines)
        # Neighbours: the rotor 1 nm up and down; first_offset is 0 in the reference case.
        for name, offset in (("up", "1e-9"), ("down", "-1e-9")):
            self.succeed("run", case, "-o", name, *long, *settings(rotor__initial_offset=f"[{offset}, 0]"))
        peaks = [self.peak(name) for name in ("out", "up", "down")]
        self.assertEqual((results[KEY]["lowest"], results[KEY]["highest"]), (min(peaks), max(peaks)))
        self.assertAlmostEqual(results[KEY]["spread"], 1 - min(peaks) / max(peaks), delta=1e-12)
        self.assertEqual(results[KEY]["differs_by"], max(results[KEY]["spread"], results[KEY]["by_finer_steps"]))
        # Orbits that part by 1 % of 250 um.
        with h5py.File(self.folder / "out/results.h5") as own:
            apart, largest = numpy.inf, 0
            for name in ("up", "down"):
                with h5py.File(self.folder / name / "results.h5") as other:
                    for bearing in ("TB1", "TB2"):
                        path = f"bearings/{bearing}/orbit"
                        distance = numpy.hypot(*(own[path][()] - other[path][()]).T)
                        largest, far = max(largest, distance.max()), distance > 2.5e-6
                        if far.any():
                            apart = min(apart, own["time"][int(far.argmax())])
        self.assertAlmostEqual(opinion["largest_distance"], largest, delta=1e-15)
        self.assertEqual(opinion["largest_distance_share"], opinion["largest_distance"] / 250e-6)
        self.assertEqual(opinion["apart_from"] is not None, bool(numpy.isfinite(apart)))
        if opinion["apart_from"] is not None:
            self.assertAlmostEqual(opinion["apart_from"], apart, delta=1e-12)
        # What belongs to the end is not there when the first impacts are over.
        self.assertIsNone(results["rotor_speed_end"]["by_finer_steps"])
        self.assertRegex(done.stdout, r"rotor_speed_end \(finer steps not compared, ")
        self.assertRegex(done.stdout, r"Second opinion \(a tenth of the tolerance and half the longest step up to [0-9.]+ ms; 2 drops that start 1 nm beside\):\n(  .*\n)*  differs by +[0-9.e-]+ %  bearings\.TB1\.peak_contact_force")

    def test_a_light_ring_that_is_met_again_belongs_to_the_first_impact(self):
        self.succeed("run", PARAMS / "own-machine/drop.toml", "-o", "out", *settings(run__end_time="40 ms", run__second_opinion="true", output__interval="5 us"))
        opinion, _ = self.opinion()
        until = 0
        with h5py.File(self.folder / "out/results.h5") as results:
            time = results["time"][()]
            for name, bearing in self.summary()["bearings"].items():
                depth = results[f"bearings/{name}/penetration"][()]
                distance = numpy.hypot(*results[f"bearings/{name}/orbit"][()].T)
                opens = [i for i in range(1, len(time)) if depth[i - 1] > 0 >= depth[i]]
                comes_back = next(i for i in opens if distance[i] < distance[i - 1])
                self.assertGreater(comes_back, opens[0], "the first contact knocks the ring away")
                closes = next(i for i in range(comes_back + 1, len(time)) if depth[i - 1] <= 0 < depth[i])
                until = max(until, numpy.interp(0, depth[closes - 1 : closes + 1], time[closes - 1 : closes + 1]))
                self.assertLess(bearing["second_contact_time"], bearing["first_contact_time"] + 2e-4)
        self.assertAlmostEqual(opinion["first_impacts_until"], until, delta=1e-9)

    def test_of_a_fall_a_nanometre_stays_a_nanometre(self):
        done = self.succeed("run", self.case(""), "-o", "out", *settings(run__end_time="3 ms", run__second_opinion="true"))
        opinion, results = self.opinion()
        self.assertIsNone(opinion["apart_from"])
        self.assertAlmostEqual(opinion["largest_distance"], 1e-9, delta=1e-12)
        self.assertEqual(opinion["first_impacts_until"], 0.003, "there is no impact: all of it")
        self.assertLess(results["rotor_speed_end"]["differs_by"], 1e-9)
        self.assertNotIn("bearings.TB1.friction_heat", results, "there is none")
        self.assertRegex(done.stdout, r"Orbits of neighbours differ by at most 0\.001 um \(0\.0004 % of the air gap\), at [0-9.]+ ms\.\n")

    def test_a_fixed_step_is_halved(self):
        fixed = settings(integration__method="runge-kutta-4", integration__step="20 us", run__end_time="12 ms")
        self.succeed("run", self.case(""), "-o", "out", *fixed, "--set", "run.second_opinion=true")
        opinion, results = self.opinion()
        self.assertEqual(opinion["finer_by"], "half the step")
        brief = settings(integration__method="runge-kutta-4", run__end_time=repr(opinion["first_impacts_until"]))
        for step in ("20 us", "10 us"):
            self.succeed("run", self.case(""), "-o", step.replace(" ", ""), *brief, *settings(integration__step=step))
        a, b = self.peak("20us"), self.peak("10us")
        self.assertAlmostEqual(results[KEY]["by_finer_steps"], abs(a - b) / max(a, b), delta=1e-9)

    def test_without_being_asked_nothing_changes(self):
        self.succeed("run", self.case(""), "-o", "out")
        self.assertNotIn("second_opinion", self.summary())
        self.succeed("run", self.case("run.second_opinion = true\n"), "-o", "two")
        one, two = self.summary(), self.summary("two")
        del two["second_opinion"]
        for summary in (one, two):
            del summary["run"]["wall_time"], summary["run"]["cpu_time"]
        self.assertEqual(one, two)
        self.assertEqual(sorted(content_of(self.folder / "two")), ["parameters.toml", "results.h5", "summary.json"])


if __name__ == "__main__":
    unittest.main()
