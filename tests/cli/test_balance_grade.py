"""Balance grade of ISO 21940-11 instead of a list of unbalances: U = m e_per, e_per = G / omega, in two planes by the lever about the centre of gravity."""

import math
import re
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest, settings  # noqa: E402


class BalanceGrade(ProgramTest):
    def graded(self, more=""):
        return self.case('[rotor]\nunbalance = []\nbalance_grade = "G2.5"\n' + more)

    def shown(self, case, *options):
        out = self.succeed("check", case, *options).stdout
        mass, centre = map(float, re.search(r"rotor: ([\d.]+) kg, .* centre of gravity at ([\d.]+) m", out).groups())
        (line,) = re.findall(r"^unbalance: .*$", out, re.M)
        total, e_per = float(re.search(r"unbalance: (\S+) g mm", line)[1]), float(re.search(r"e_per (\S+) um", line)[1])
        planes = [(int(node), float(U), float(angle)) for U, node, angle in re.findall(r"(\S+) g mm at node (\d+), (\S+) deg", line)]
        return line, mass, centre, total, e_per, planes

    def positions(self):
        import json

        rotor = json.loads((self.folder / "neisi2019-rotor.json").read_text())
        return {node["id"]: node["x"] for node in rotor["nodes"]}

    def test_check_shows_the_permissible_unbalance_in_its_planes(self):
        line, mass, centre, total, e_per, planes = self.shown(self.graded())
        omega = 15200 * math.pi / 30  # of the case at the start
        self.assertIn("G2.5 at 15200 rpm", line)
        self.assertAlmostEqual(e_per, 2.5e-3 / omega * 1e6, delta=1e-3 * e_per)
        self.assertAlmostEqual(total, mass * 2.5e-3 / omega * 1e6, delta=1e-3 * total)
        x = self.positions()
        (a, U_a, angle_a), (b, U_b, angle_b) = planes
        self.assertEqual((a, b), (2, 28), "the bearings' nodes")
        self.assertEqual((angle_a, angle_b), (0, 0))
        self.assertAlmostEqual(U_a, total * (x[b] - centre) / (x[b] - x[a]), delta=2e-3 * total)
        self.assertAlmostEqual(U_a + U_b, total, delta=2e-3 * total)

    def test_speed_planes_and_angles_are_the_cases(self):
        _, mass, _, total, _, planes = self.shown(self.graded('balance_speed = "6000 rpm"\nbalance_planes = [5, 24]\nbalance_angles = ["30 deg", "210 deg"]\n'))
        self.assertAlmostEqual(total, mass * 2.5e-3 / (200 * math.pi) * 1e6, delta=1e-3 * total)
        self.assertEqual([(node, angle) for node, _, angle in planes], [(5, 30), (24, 210)])
        *_, total, _, planes = self.shown(self.graded("balance_planes = [16]\n"))
        self.assertEqual(planes, [(16, total, 0)])

    def test_a_run_has_the_unbalance_of_the_same_list(self):
        # A single plane, so that the list can say it with all digits.
        out = self.succeed("check", "reference.toml").stdout
        self.assertNotIn("unbalance:", out)
        self.succeed("run", self.graded("balance_planes = [16]\n"), "-o", "grade", *settings(run__end_time="3 ms"))
        mass = self.summary("grade")["rotor"]["mass"]
        U = mass * 2.5e-3 / (15200 * math.pi / 30)
        case = self.case(f"[rotor]\nunbalance = [{{ node = 16, me = {U!r} }}]\n", "list.toml")
        self.succeed("run", case, "-o", "list", *settings(run__end_time="3 ms"))
        again, same = (self.summary(name)["energy"]["unbalance_work"] for name in ("grade", "list"))
        self.assertNotEqual(again, 0)
        self.assertAlmostEqual(again, same, delta=1e-9 * abs(same))
        self.succeed("report", "grade")

    def refused(self, case, *words):
        done = self.call("check", case)
        self.assertEqual(done.returncode, 2, done.stdout)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_both_ways_contradict(self):
        self.refused(self.case('[rotor]\nbalance_grade = "G2.5"\n'), "drop.toml:4:", "rotor.unbalance (at ", "both say how unbalanced", "unbalance = []")

    def test_what_is_no_grade(self):
        for text in ('"2.5"', '"G"', '"G-1"', '"G0"', '"Gold"', "2.5", '"G2.5 mm/s"'):
            with self.subTest(text):
                self.refused(self.case(f"[rotor]\nunbalance = []\nbalance_grade = {text}\n"), "drop.toml:5:", "is not a balance grade", '"G2.5"')

    def test_speed_and_planes_must_make_sense(self):
        self.refused(self.case('run.initial_speed = 0\n[rotor]\nunbalance = []\nbalance_grade = "G2.5"\n'), "rotor.balance_speed")
        self.refused(self.graded("balance_planes = [2, 3]\n"), "is not between the balance planes")
        self.refused(self.graded("balance_planes = [2, 2]\n"), "one node or two different nodes")
        self.refused(self.graded("balance_planes = [2, 2000]\n"), "the rotor has nodes 1 to")
        self.refused(self.case('[rotor]\nbalance_speed = "6000 rpm"\n'), "rotor.balance_grade, which is not given")
        self.refused(self.graded("balance_sped = 3\n"), 'Did you mean "balance_speed"?')


if __name__ == "__main__":
    unittest.main()
