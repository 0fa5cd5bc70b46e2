"""Shaft meshed beside the bearing (thermal.fe.shaft = "beyond").

STEADY. A long shaft of small Biot number is a fin: with m = sqrt(4 h/(k d)) and an insulated end at L its rise falls as cosh(m (L - s))/cosh(m L), and it takes
sqrt(h p k A) tanh(m L) = k A m tanh(m L) per kelvin of its root. What flows into the fins is the heat given less what leaves the shaft under the bearing:
by its own surface h pi d W, and through R2 = 1/(4 pi k W) into the bore. The rise differs over a cross section by Bi/2, Bi = h d/(2 k), and its mean from that of the surface by half of it: a quarter of Bi is left for the fin.
"""

import json
import math
import pathlib
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, ProgramTest  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
AMBIENT, K, D, WATTS = 293.15, 70.0, 69.5e-3, 50.0


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class ShaftBeyond(ProgramTest):
    def uniform_rotor(self, bore=0.0):
        """The reference case with a shaft of one diameter, that of the journal."""
        rotor = json.loads((self.folder / "neisi2019-rotor.json").read_text())
        for element in rotor["elements"]:
            element.update(od=D, id_=bore)
        (self.folder / "neisi2019-rotor.json").write_text(json.dumps(rotor))

    def heat(self, text, probes, *options):
        self.write("heat.toml", 'base = "reference.toml"\n' + text + "".join(f'[[heat.probe]]\nname = "{name}"\n{place}\n' for name, place in probes.items()))
        self.succeed("heat", "heat.toml", "-o", "out", "--quiet", "--force", *options)
        summary = self.summary("out")
        return {name: probe["temperature"][-1] - AMBIENT for name, probe in summary["probes"].items()}, summary

    def steady(self, section, h, k=K, contact=None, coupling="windowed", link="permanent", within=None):
        """@param k  of the shaft; that of the ring is K
        @param contact  resistance of shaft and bore, if it is given [K/W]"""
        self.uniform_rotor()
        own = "" if k == K else f'[bearings.TB1]\njournal = "own"\n[materials]\nown = {{ E = 2.0e11, nu = 0.3, alpha = 11.8e-6, k = {k}, c = 510, rho = 7800 }}\n'
        at = {f"s{i}": f"body = \"shaft_right_1\"\nx = {10e-3 + 0.03 * i}\nr = {0.5 * D / math.sqrt(2)}" for i in range(0, 8)}
        rise, summary = self.heat(f'''
[thermal]
models = ["fe"]
h_shaft = {h}
shaft_ring_link = "{link}"
[thermal.fe]
coupling = "{coupling}"
section = "{section}"
shaft = "beyond"
shaft_reach = "0.3 m"
{f'shaft_contact_resistance = "{contact} K/W"' if contact else ""}
[heat]
bearing = "TB1"
output_times = ["4e5 s"]
time_tolerance = 1e-4
[[heat.source]]
port = "rub-into-shaft"
times = [0]
values = ["{WATTS} W"]
{own}''', {**at, "left": 'boundary = "shaft.left"', "right": 'boundary = "shaft.right"', "surface": 'boundary = "shaft.outer"', "bore": 'boundary = "inner_ring.inner"'})
        biot = h * D / (2 * k)
        m, A, W = math.sqrt(4 * h / (k * D)), math.pi * D**2 / 4, 20e-3
        # The left side ends with the rotor: node 2 is at 45 mm, the bearing's face 10 mm from it.
        lengths = {"left": 0.035, "right": 0.3}
        into_fins = sum(k * A * m * math.tanh(m * L) * rise[side] for side, L in lengths.items())
        left_over = WATTS - rise["surface"] * h * math.pi * D * W - (rise["surface"] - rise["bore"]) * (1 / contact if contact else 4 * math.pi * k * W)
        print(f"{section}, h = {h}: {into_fins:.4f} W into the fins by the closed form, {left_over:.4f} W by the balance")
        self.assertGreater(into_fins, 0.05 * WATTS)
        self.assertLess(abs(left_over / into_fins - 1), within or biot / 4)
        for i in range(8):
            expected = math.cosh(m * (0.3 - 0.03 * i)) / math.cosh(m * 0.3)
            self.assertLess(abs(rise[f"s{i}"] / rise["right"] / expected - 1), biot / 4, f"at {30 * i} mm")
        energy = summary["energy"]["fe"]
        # Roundoff of solves, of 4e5 s of modes, and of rates that span nine decades by their roots.
        self.assertLess(abs(energy["residual"]), 1e-9 * energy["input"])
        self.assertGreater(energy["lost"], 0.9 * energy["input"])

    def test_a_long_shaft_is_a_fin(self):
        self.steady("grooved", 20)

    def test_a_shaft_of_another_material_is_a_fin_of_its_own(self):
        self.steady("grooved", 20, k=35.0)

    def test_a_contact_has_the_resistance_that_is_stated(self):
        """A tenth and ten times R2 = 0.057 K/W; in contact only, as long as the heat of the rub flows. Modes leave half a percent of each rise."""
        for contact in (0.0057, 0.57):
            self.steady("grooved", 20, contact=contact)
        self.steady("grooved", 20, contact=0.57, coupling="reduced", link="in-contact", within=0.02)

    def test_a_contact_of_a_lump_is_refused(self):
        done = self.call("check", self.case('[thermal.fe]\nshaft_contact_resistance = "0.02 K/W"\n'))
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn('thermal.fe.shaft_contact_resistance is that of a meshed shaft, and thermal.fe.shaft is "lump"', done.stderr)

    def heated_shaft(self, settings, until="10 ms"):
        """Rise of the shaft under TB1 after heat of its own until an instant [K]."""
        rise, _ = self.heat(f'''{settings}
[heat]
bearing = "TB1"
output_times = ["{until}"]
[[heat.source]]
port = "rub-into-shaft"
times = [0]
values = ["{WATTS} W"]
''', {"shaft": 'node = "shaft"'})
        return rise["shaft"]

    def test_a_lump_has_the_capacity_of_its_own_material(self):
        for rho in (7800, 3900):
            rise = self.heated_shaft(f'''
[bearings.TB1]
journal = "own"
[materials]
own = {{ E = 2.0e11, nu = 0.3, alpha = 11.8e-6, k = {K}, c = 510, rho = {rho} }}
[thermal]
models = ["fe"]
shaft = "fin"''')
            # Before it flows; the fin takes 0.1 % of it by then.
            self.assertAlmostEqual(rise * rho * 510 * math.pi / 4 * D**2 * 20e-3 / (WATTS * 10e-3), 1, delta=0.005)

    def test_a_hollow_shaft_has_the_capacity_of_its_wall(self):
        self.uniform_rotor(bore=0.8 * D)
        for models, fe_shaft in (('["lumped"]', "lump"), ('["fe"]', "lump"), ('["fe"]', "bearing")):
            rise = self.heated_shaft(f'''
[thermal]
models = {models}
shaft = "lump"
[thermal.fe]
shaft = "{fe_shaft}"''')
            # Before it flows on: 1/R2 takes 2e-4 of it by then from a lump, and from a surface that is hotter than the mean 8 %.
            wall = 7800 * 510 * math.pi / 4 * (D**2 - (0.8 * D) ** 2) * 20e-3
            self.assertAlmostEqual(rise * wall / (WATTS * 10e-3), 1, delta=0.02 if fe_shaft == "lump" else 0.1, msg=f"{models}, {fe_shaft}; solid it would be 0.36")

    def test_a_longer_lump_is_cooled_over_its_length(self):
        """A uniform rod whose heat enters evenly over the lump: with m its decay, a fin's rise at the lump's faces, and a parabola-like one between, which one
        node for the lump has the mean of. Another length of the lump moves little of the mean rise; until its surface was left out, 20 % and the other way."""
        self.uniform_rotor()
        h = 50.0
        rises = {}
        for length in (20e-3, 60e-3):
            rise = self.heated_shaft(f'''
[bearings.TB1]
shaft_lump_length = {length}
circuit = {{ shaft_ring = 100, fit = 100 }}
[thermal]
models = ["lumped"]
shaft = "fin"
h_shaft = {h}''', until="4e5 s")
            rises[length] = rise, self.rod(length, h)
        for length, (rise, exact) in rises.items():
            # 5 % of the heat still go through the ring, whose resistance has its largest factor.
            self.assertAlmostEqual(rise / exact, 0.955, delta=0.02, msg=f"lump of {length} m")

    def rod(self, length, h):
        """Mean rise over the lump of a uniform rod from the rotor's end to half-way between the bearings, by finite differences."""
        rotor = json.loads((self.folder / "neisi2019-rotor.json").read_text())
        here, there = (next(node["x"] for node in rotor["nodes"] if node["id"] == number) for number in (2, 28))
        end = 0.5 * (here + there)
        n = 4000
        x = (numpy.arange(n) + 0.5) * end / n
        dx, A = end / n, math.pi * D**2 / 4
        q = numpy.where(abs(x - here) < length / 2, 1.0, 0.0)
        q *= WATTS / q.sum()
        g = K * A / dx
        diagonal = numpy.full(n, 2 * g + h * math.pi * D * dx)
        diagonal[[0, -1]] -= g
        # Thomas' algorithm
        c, d = numpy.empty(n), numpy.empty(n)
        c[0], d[0] = -g / diagonal[0], q[0] / diagonal[0]
        for i in range(1, n):
            pivot = diagonal[i] + g * c[i - 1]
            c[i], d[i] = -g / pivot, (q[i] + g * d[i - 1]) / pivot
        T = numpy.empty(n)
        T[-1] = d[-1]
        for i in range(n - 2, -1, -1):
            T[i] = d[i] - c[i] * T[i + 1]
        return T[q > 0].mean()

    def test_a_meshed_shaft_grows_by_its_own_material(self):
        growth = {}
        for alpha in ("11.8e-6", "20e-6"):
            self.write("drop.toml", f'''base = "reference.toml"
[run]
end_time = "12 ms"
[bearings.TB1]
journal = "own"
[materials]
own = {{ E = 2.0e11, nu = 0.3, alpha = {alpha}, k = {K}, c = 510, rho = 7800 }}
[thermal]
models = ["lumped", "fe"]
expansion = "elastic"
driver = "none"
[thermal.fe]
shaft = "bearing"
''')
            self.succeed("run", "drop.toml", "-o", "out", "--quiet", "--force")
            with h5py.File(self.folder / "out/results.h5") as file:
                growth[alpha] = {name: file[f"growth/fe/{name}"][-1] for name in ("TB1", "TB2")}
        self.assertGreater(growth["20e-6"]["TB1"][0], 1e-9, "m")
        self.assertAlmostEqual(growth["20e-6"]["TB1"][0] / growth["11.8e-6"]["TB1"][0], 20 / 11.8, delta=1e-6, msg="the motion is the same, growth drives nothing")
        self.assertAlmostEqual(growth["20e-6"]["TB1"][1] / growth["11.8e-6"]["TB1"][1], 1, delta=1e-9, msg="the ring is of its own material")
        self.assertEqual(growth["20e-6"]["TB2"][0], growth["11.8e-6"]["TB2"][0])

    def test_of_plain_sections_too(self):
        self.steady("plain", 20)

    def test_it_has_the_rotors_diameters(self):
        def is_inside(body, x, r):
            self.write("heat.toml", f'''base = "reference.toml"
[thermal]
models = ["fe"]
fe.shaft = "beyond"
[heat]
bearing = "TB1"
output_times = ["1 ms"]
source = [{{ port = "inner", times = [0], values = [1] }}]
probe = [{{ name = "p", body = "{body}", x = {x}, r = {r} }}]
''')
            return self.call("check", "heat.toml").returncode == 0

        # Node 2 is at x = 45 mm of neisi2019-rotor.json; diameters of its elements: 62 | 69.5, 70, 80, 108.909, 203.024 mm. The last one ends half-way to node 28.
        for body, x, r in (("shaft_left_1", -22e-3, 31e-3), ("shaft_right_1", 25e-3, 34.75e-3), ("shaft_right_2", 52e-3, 35e-3), ("shaft_right_3", 100e-3, 40e-3), ("shaft_right_4", 200e-3, 54.4545e-3), ("shaft_right_5", 370e-3, 101.512e-3)):
            self.assertTrue(is_inside(body, x, r - 1e-5), body)
            self.assertFalse(is_inside(body, x, r + 1e-5), body)

    def test_reduced_and_in_windows_take_the_same_heat(self):
        """10 s of heat, far shorter than the shaft needs to become even: on modes, in windows, and by the chain of nodes."""
        text = f'''
[thermal]
models = ["fe"]
shaft = "fin"
[thermal.fe]
shaft = "SHAFT"
coupling = "COUPLING"
[heat]
bearing = "TB2"
output_times = ["10 s"]
time_tolerance = 1e-5
[[heat.source]]
port = "rub"
times = [0]
values = ["{WATTS} W"]
'''
        rises = {}
        for shaft, coupling in (("beyond", "windowed"), ("beyond", "reduced"), ("bearing", "windowed"), ("lump", "windowed")):
            rise, summary = self.heat(text.replace("SHAFT", shaft).replace("COUPLING", coupling), {"shaft": 'node = "shaft"'})
            rises[shaft, coupling] = rise
            energy = summary["energy"]["fe"]
            self.assertLess(abs(energy["residual"]), 1e-5 * energy["input"])
            self.assertLess(energy["lost"], 0.1 * energy["input"])
            print(f"{shaft}, {coupling}: {rise}")
        meshed, few = rises["beyond", "windowed"], rises["beyond", "reduced"]
        self.assertLess(abs(few["shaft"] / meshed["shaft"] - 1), 0.005, "thermal.fe.response_tolerance")
        # A chain of nodes takes heat from a lump too slowly, and from the heated surface of a shaft that ends with the bearing too fast.
        self.assertGreater(rises["lump", "windowed"]["shaft"], meshed["shaft"])
        self.assertLess(rises["bearing", "windowed"]["shaft"], meshed["shaft"])

    def test_heat_for_days_takes_few_steps(self):
        """Explicit steps alone would be 3e9: they stay below 0.07 ms. In steady heat modes and mesh agree to thermal.fe.response_tolerance, and what goes in is lost."""
        text = f'''
[thermal]
models = ["fe"]
shaft = "fin"
fe = {{ shaft = "bearing", coupling = "COUPLING" }}
[heat]
bearing = "TB2"
output_times = ["1e5 s", "2e5 s"]
[[heat.source]]
port = "rub"
times = [0]
values = ["{WATTS} W"]
'''
        rises = {}
        for coupling in ("reduced", "windowed"):
            of_all, summary = self.heat(text.replace("COUPLING", coupling), {})
            rises[coupling] = of_all["fe.shaft"]
            energy = summary["energy"]["fe"]
            self.assertAlmostEqual(energy["input"], WATTS * 2e5, delta=1e-6 * WATTS * 2e5)
            self.assertLess(abs(energy["residual"]), 1e-7 * energy["input"])
            self.assertLess(summary["models"]["fe"]["steps"], 50_000)
        self.assertLess(abs(rises["reduced"] / rises["windowed"] - 1), 0.005, "thermal.fe.response_tolerance")

    def test_a_drop_and_steady_running_take_it(self):
        case = self.case('thermal = { models = ["fe"], fe = { shaft = "beyond" } }\n')
        for coupling in ("reduced", "windowed"):
            summary = self.run_case(case, thermal__fe__coupling=coupling, output=coupling)
            given, residual = (summary["energy"]["heat_deposited"], summary["energy"]["fe_heat_residual"]) if coupling == "reduced" else (summary["windows"]["heat_input"], summary["windows"]["heat_residual"])
            self.assertLess(abs(residual), 1e-8 * given)
            self.assertIn("shaft_right_1", summary["bearings"]["TB1"]["fe"]["temperature_rise_end"])
        self.write("running.toml", 'base = "reference.toml"\npreload = { speed = "3000 rpm", model = "fe", end_time = "100 s" }\nthermal = { expansion = "formula", fe = { shaft = "beyond" } }\n')
        self.succeed("preload", "running.toml", "-o", "running", "--bearing", "TB2", "--quiet")

    def test_its_mesh_can_be_written_and_read(self):
        case = self.case('thermal = { models = ["fe"], fe = { shaft = "beyond", shaft_reach = "80 mm" } }\n')
        self.succeed("mesh", case, "-o", "m.msh", "--bearing", "TB1")
        again = self.succeed("mesh", case, "-o", "again.msh", "--bearing", "TB1", "--set", "thermal.fe.mesh=m.msh").stdout
        self.assertIn("shaft_right_3", again)
        shorter = self.case('thermal = { models = ["fe"], fe = { shaft = "bearing", mesh = "m.msh" } }\n', "shorter.toml")
        done = self.call("mesh", shorter, "-o", "again.msh", "--force", "--bearing", "TB1")
        self.assertEqual(done.returncode, 2)
        self.assertIn('the group "shaft_left_1" is not a body of this bearing', done.stderr)

    def test_bad_settings_are_told(self):
        for settings, words in (({"thermal.fe.shaft": "bearing", "thermal.fe.shaft_reach": "0.1 m"}, 'thermal.fe.shaft is not "beyond"'), ({"thermal.fe.shaft": "beyound"}, 'Did you mean "beyond"')):
            done = self.call("check", "reference.toml", *(word for key, value in settings.items() for word in ("--set", f"{key}={value}")))
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
