"""Supports of outer rings in drops and at rest; contact stiffness from the bodies.

WORK: what a support takes is -(force . velocity), integrated; it must be the rise of its stored energy and its loss.
AT REST a bilinear ribbon pushed once by F moves by x with K x + k x = F while k x is below four fifths of the slip force.
CONTACT STIFFNESS: P = F/L, a = sqrt(4 P R / (pi E*)), approach = P (1-nu^2)/(pi E) (2 ln(4 R_j/a) - 1)
  + 2 P (1-nu^2)/(pi E) [asinh(s) - nu/(1-nu) (s sqrt(1+s^2) - s^2)], s = wall/a; K = F / approach^n at F = C0/10.
"""

import json
import math
import re
import shutil
import sys
import unittest

import h5py
import numpy
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest  # noqa: E402

RIBBON = 'type = "ribbon", mass = "0.6 kg", ribbon = { stiffness = "3e7 N/m", slip_force = "600 N", stick_stiffness = "1e8 N/m" }'


def simpson(values, step):
    n = (len(values) - 1) // 2 * 2
    return step / 3 * (values[0] + 4 * values[1:n:2].sum() + 2 * values[2:n:2].sum() + values[n]), n


class Supports(ProgramTest):
    def drop(self, support, more="", **keys):
        self.case(f"[bearings.TB1]\nsupport = {{ {support} }}\n" + more)
        keys = {"run__end_time": "12 ms", **keys}
        self.number = getattr(self, "number", 0) + 1
        output = f"out{self.number}"
        summary = self.run_case("drop.toml", output=output, **keys)
        self.assertLess(abs(summary["energy"]["residual"]), 2e-5, "J")
        self.results = self.folder / output / "results.h5"
        return summary, h5py.File(self.results)

    def work(self, file, start=0.0):
        """Work that the support of TB1 took, its loss and its rise of stored energy [J], from the rows."""
        time = file["time"][:]
        step = time[1] - time[0]
        rows = numpy.nonzero(time >= start)[0]
        n = (len(rows) - 6) // 2 * 2
        rows = rows[2 : 2 + n + 1]
        place, force = file["bearings/TB1/support_position"][:], file["bearings/TB1/support_force"][:]
        total = 0
        for axis in range(2):
            x = place[:, axis]
            v = (8 * (x[rows + 1] - x[rows - 1]) - (x[rows + 2] - x[rows - 2])) / (12 * step)
            total += simpson(-force[rows, axis] * v, step)[0]
        loss, stored = file["ledger/TB1/support_damping"][:], file["bearings/TB1/support_energy"][:]
        return total, loss[rows[-1]] - loss[rows[0]], stored[rows[-1]] - stored[rows[0]]

    def test_a_ribbon_takes_what_it_stores_and_loses(self):
        summary, file = self.drop(RIBBON, output__interval="0.5 us", run__end_time="10 ms", integration__tolerance="1e-9")
        with file:
            work, loss, stored = self.work(file)
            self.assertGreater(loss, 1e-3, "J: it slips")
            self.assertAlmostEqual(work - stored, loss, delta=1e-6 * loss, msg="J: area of its loops")
        support = summary["bearings"]["TB1"]["support"]
        self.assertEqual(support["type"], "ribbon")
        with h5py.File(self.results) as file:
            travel = numpy.hypot(*file["bearings/TB1/support_position"][:].T)
        self.assertAlmostEqual(support["largest_travel"], travel.max(), delta=2e-9)
        self.assertGreater(support["largest_travel"], 6e-6, "m, beyond the slip travel")

    def test_every_law_books_its_energy(self):
        moduli = 'storage = [["10 Hz", "8 MPa"], ["100 Hz", "10 MPa"], ["1000 Hz", "13 MPa"]], loss = [["10 Hz", "0.9 MPa"], ["100 Hz", "1.4 MPa"], ["1000 Hz", "2 MPa"]], shape_factor = "3 m"'
        springs = 'K_y = "5e7 N/m", K_z = "5e7 N/m", C_y = 500, C_z = 500'
        for name, support in (("elastomer", f'type = "elastomer", mass = "1 kg", elastomer = {{ {moduli} }}'),
                              ("kelvin-voigt", f'type = "elastomer", mass = "1 kg", elastomer = {{ {moduli}, model = "kelvin-voigt", frequency = "300 Hz" }}'),
                              ("squeeze film", f'type = "squeeze-film", mass = "1 kg", {springs}, squeeze_film = {{ viscosity = 0.02, clearance = "120 um" }}'),
                              ("bump stop", f'type = "bump-stop", mass = "1 kg", {springs}, stop = {{ gap = "15 um", stiffness = "4e8 N/m" }}'),
                              ("different laws", f'{RIBBON}, z = {{ type = "linear", K_z = "6e7 N/m", C_z = 800 }}')):
            with self.subTest(name):
                summary, file = self.drop(support, output__interval="1 us", run__end_time="10 ms")
                with file:
                    work, loss, stored = self.work(file)
                    self.assertAlmostEqual(work - stored, loss, delta=2e-4 * abs(work) + 1e-7, msg="J, by rows of 1 us")
                    self.assertGreater(loss, 0)
                    self.assertGreater(file["bearings/TB1/support_energy"][:].max(), 1e-3)
                if name == "bump stop":
                    self.assertTrue(summary["bearings"]["TB1"]["support"]["meets_stop"])
                if name == "different laws":
                    with h5py.File(self.results) as file:
                        z, force = file["bearings/TB1/support_position"][:, 1], file["bearings/TB1/support_force"][:, 1]
                        v = numpy.gradient(z, 1e-6)
                        self.assertLess(numpy.abs(force + 6e7 * z + 800 * v)[2:-2].max(), 0.02 * numpy.abs(force).max())

    def test_a_round_stop_acts_also_along_z(self):
        """The rotor falls along z onto a support whose z has a law of its own: springs 5e7, stop 4e8 N/m behind 20 um."""
        laws = 'type = "linear", mass = 5, K_y = 2e8, C_y = 500, {} z = {{ type = "linear", K_z = 5e7, C_z = 500 }}'
        down = {"run__gravity": "[0, 0, -9.81]", "output__interval": "2 us"}
        for name, stop, gap in (("met", 'stop = { gap = "20 um", stiffness = 4e8, lambda = 0 },', 20e-6),
                                ("not met", 'stop = { gap = "1 mm", stiffness = 4e8, lambda = 0 },', 1e-3)):
            with self.subTest(name):
                summary, file = self.drop(laws.format(stop), **down)
                with file:
                    (y, z), force = file["bearings/TB1/support_position"][:].T, file["bearings/TB1/support_force"][:, 1]
                self.assertLess(numpy.abs(y).max(), 0.5 * numpy.abs(z).max())
                self.assertEqual(summary["bearings"]["TB1"]["support"]["meets_stop"], bool(numpy.hypot(y, z).max() > gap))
                self.assertEqual(summary["bearings"]["TB1"]["support"]["meets_stop"], name == "met")
                r = numpy.hypot(y, z)
                expected = -5e7 * z - 500 * numpy.gradient(z, 2e-6) - 4e8 * numpy.maximum(r - gap, 0) * z / r.clip(1e-12)
                self.assertLess(numpy.abs(force - expected)[2:-2].max(), 0.02 * numpy.abs(force).max(), "N")

    def test_springs_by_name_are_the_springs_of_before(self):
        keys = 'mass = "85 kg", K_y = 2.7e9, K_z = 1.5e9, C_y = 3.68e3, C_z = 3.68e3'
        plain = self.run_case(self.case(""), output="plain")
        named = self.run_case(self.case(f'[bearings.TB1]\nsupport = {{ type = "linear", {keys} }}'), output="named")
        split = self.run_case(self.case(f'[bearings.TB1]\nsupport = {{ type = "linear", {keys}, z = {{ type = "linear", K_z = 1.5e9, C_z = 3.68e3 }} }}'), output="split")
        self.assertEqual(plain["bearings"], named["bearings"])
        self.assertAlmostEqual(split["bearings"]["TB1"]["peak_contact_force"], plain["bearings"]["TB1"]["peak_contact_force"], delta=1e-6 * plain["bearings"]["TB1"]["peak_contact_force"])

    def test_a_limit_of_travel_warns(self):
        self.case(f'[bearings.TB1]\nsupport = {{ {RIBBON}, travel_limit = "2 um" }}')
        done = self.succeed("run", "drop.toml", "-o", "out")
        self.assertRegex(done.stdout, r"support \(ribbon\) moves by up to [\d.]+ um and dissipates [\d.e-]+ J")
        self.assertRegex(done.stdout, r"warning: \w+: the outer ring moves by [\d.]+ um at [\d.]+ ms, beyond its travel limit of 2 um")
        self.succeed("report", "out")
        page = (self.folder / "out/report.html").read_text()
        self.assertIn("TB1: travel of the support", page)
        self.assertIn("support-loop-TB1", page)

    def test_at_rest_a_ribbon_yields_by_its_virgin_curve(self):
        def moved(support):
            self.case(f'[statics]\nsubject = "shaft"\n[bearings.TB1]\nsupport = {{ {support} }}')
            bearing = json.loads(self.succeed("statics", "drop.toml", "--json").stdout)["shaft"]["supports"]["TB1"]
            return bearing["outer_ring"]["y"], bearing["force_on_rotor"]["y"]

        place, reaction = moved(RIBBON.replace("600 N", "2000 N"))
        force = reaction + 0.21 * 9.81
        self.assertAlmostEqual(-place, force / 1.3e8, delta=1e-6 * force / 1.3e8, msg="m: sticking")
        place, reaction = moved(RIBBON.replace("600 N", "60 N"))
        self.assertAlmostEqual(-place, (reaction + 0.21 * 9.81 - 60) / 3e7, delta=1e-5 * force / 3e7, msg="m: slipping")

    def test_check_tells_what_a_law_is(self):
        loop = 'loop = { loading = [["-100 um", "-1900 N"], ["-60 um", "300 N"], ["100 um", "1900 N"]], unloading = [["-100 um", "-1900 N"], ["60 um", "-300 N"], ["100 um", "1900 N"]] }'
        done = self.succeed("check", self.case(f'[bearings.TB1]\nsupport = {{ type = "ribbon", mass = "1 kg", ribbon = {{ {loop} }} }}'))
        found = re.search(r"TB1: support: ribbon of 1e\+07 N/m .* between 100 um loses ([\d.]+) J, the measured loop ([\d.]+) J", done.stdout)
        self.assertTrue(found, done.stdout)
        self.assertEqual(found[1], found[2])
        self.assertAlmostEqual(float(found[2]), 4 * (5.5e7 - 1e7) * 20e-6 * 80e-6, delta=1e-4, msg="J: area of a bilinear loop")


class Example(ProgramTest):
    def test_the_reference_rotor_on_ribbons_answers_its_questions(self):
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-ribbon.toml"):
            shutil.copy(PARAMS / name, self.folder)
        summary = self.run_case("neisi2019-ribbon.toml", run__end_time="30 ms")
        self.assertLess(abs(summary["energy"]["residual"]), 1e-5, "J")
        self.succeed("report", "out")
        page = (self.folder / "out/report.html").read_text()
        for name in ("magnet_A", "magnet_B"):
            left = summary["probes"][name]["smallest_clearance"]
            self.assertGreater(left, 0)
            self.assertIn(f"the rotor does not touch: smallest clearance {left * 1e6:.4g} of 400", page)
        for name in ("TB1", "TB2"):
            support = summary["bearings"][name]["support"]
            self.assertLess(support["largest_travel"], 150e-6)
            self.assertIn(f"the outer ring moves by up to {support['largest_travel'] * 1e6:.4g} ", page)
            self.assertGreater(summary["bearings"][name]["static_safety"], 1)


class ContactStiffness(ProgramTest):
    @staticmethod
    def by_hand(length, C0, n=10 / 9):
        E, nu, journal, bore, wall = 2e11, 0.3, 34.75e-3, 35e-3, 4e-3
        E_shaft, nu_shaft = 2e11, 0.3
        force = 0.1 * C0
        P = force / length
        c_j, c_r = (1 - nu_shaft**2) / E_shaft, (1 - nu**2) / E
        a = math.sqrt(4 * P * journal * bore / (bore - journal) * (c_j + c_r) / math.pi)
        s = wall / a
        approach = P * c_j / math.pi * (2 * math.log(4 * journal / a) - 1)
        approach += 2 * P * c_r / math.pi * (math.asinh(s) - nu / (1 - nu) * (s * math.sqrt(1 + s * s) - s * s))
        return force / approach**n

    def without_stiffness(self):
        text = (self.folder / "reference.toml").read_text()
        (self.folder / "reference.toml").write_text(re.sub(r"(?m)^contact_stiffness = .*\n", "", text))
        geometry = json.loads((self.folder / "neisi2019-rotor.json").read_text())
        self.assertEqual((geometry["material"]["E"], geometry["material"]["nu"]), (2e11, 0.3))

    def test_a_case_without_it_gets_that_of_the_bodies(self):
        self.without_stiffness()
        done = self.succeed("check", self.case(""))
        for name, length, C0 in (("TB1", 20e-3, 31e3), ("TB2", 32e-3, 62e3)):
            found = re.search(rf"{name}: contact stiffness ([\d.e+]+) N/m\^1.111 from the bodies", done.stdout)
            self.assertTrue(found, done.stdout)
            self.assertAlmostEqual(float(found[1]), self.by_hand(length, C0), delta=6e-4 * float(found[1]), msg=f"N/m^n, {name}, printed to four digits")

    def test_a_drop_uses_it(self):
        given = self.run_case(self.case(f"[bearings.TB1]\ncontact_stiffness = {self.by_hand(20e-3, 31e3)!r}\n[bearings.TB2]\ncontact_stiffness = {self.by_hand(32e-3, 62e3)!r}"), output="given")
        self.without_stiffness()
        bodies = self.run_case(self.case(""), output="bodies")
        for name in ("TB1", "TB2"):
            force = given["bearings"][name]["peak_contact_force"]
            self.assertAlmostEqual(bodies["bearings"][name]["peak_contact_force"], force, delta=2e-4 * force, msg="N: the stiffnesses agree to rounding, the steps of a stiff contact do not")

    def test_a_given_number_wins(self):
        done = self.succeed("check", self.case(""))
        self.assertRegex(done.stdout, r"TB1: contact stiffness 1\.144e\+09 N/m\^1\.111 as given; [\d.e+]+ N/m\^1\.111 from the bodies")

    def test_a_crown_makes_it_softer(self):
        self.without_stiffness()
        values = []
        for crown in ("", 'crown_radius = "1000 m"', 'crown_radius = "0.5 m"'):
            done = self.succeed("check", self.case("[bearings.TB1]\n" + crown))
            values.append(float(re.search(r"TB1: contact stiffness ([\d.e+]+)", done.stdout)[1]))
        self.assertEqual(values[0], values[1], "a crown of a kilometre is a cylinder")
        self.assertLess(values[2], 0.9 * values[0])

    def test_a_crown_touches_in_hertz_ellipse(self):
        """Johnson (1985), eqs. 4.26 to 4.28, by the elliptic integrals of scipy: a crown of 200 mm in a bore of 70 mm with 250 um of air gap under a tenth of C0."""
        bore, gap, crown, force, E, nu = 35e-3, 250e-6, 0.2, 3.1e3, 2e11, 0.3
        across = bore * (bore - gap) / gap
        A, B = 0.5 / across, 0.5 / crown
        m = brentq(lambda m: B / A - (ellipe(m) / (1 - m) - ellipk(m)) / (ellipk(m) - ellipe(m)), 1e-9, 1 - 1e-9)
        around = (3 * force * (ellipk(m) - ellipe(m)) / (2 * math.pi * E / (2 * (1 - nu**2)) * m * A)) ** (1 / 3)
        along = around * math.sqrt(1 - m)
        done = self.succeed("check", self.case('[bearings.TB1]\ncrown_radius = "200 mm"'))
        found = re.search(r"TB1: contact stiffness .* under 3100 N, in a contact ([\d.]+) mm wide and ([\d.]+) mm long along the axis", done.stdout)
        self.assertTrue(found, done.stdout)
        self.assertAlmostEqual(float(found[1]), 2e3 * around, delta=0.06, msg="mm, printed to three digits")
        self.assertAlmostEqual(float(found[2]), 2e3 * along, delta=0.006, msg="mm")

    def test_a_free_ring_is_pressed_where_the_contact_is(self):
        """A rotor that is bent under 20 kN tilts in its free rings, and presses their ends: the less a contact reaches along the axis, the smaller the moment."""
        moment = {}
        for length in ("32 mm", "3.2 mm"):
            self.write("free.toml", f'base = "{PARAMS / "neisi2019-thrust.toml"}"\nbearings.TB1.contact_width = "{length}"\nbearings.TB2.contact_width = "{length}"\n'
                       'statics.loads = [{ node = 16, force = ["-20 kN", "0 N"] }]\n')
            report = json.loads(self.succeed("statics", "free.toml", "--json").stdout)
            moment[length] = report["shaft"]["supports"]["TB2"]["moment_on_rotor"]
        largest = {length: max(abs(value) for value in of.values()) for length, of in moment.items()}
        self.assertGreater(largest["32 mm"], 1, "N m")
        self.assertLess(largest["3.2 mm"], 0.2 * largest["32 mm"], moment)


if __name__ == "__main__":
    unittest.main()
