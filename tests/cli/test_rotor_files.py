"""Rotors from ROSS and from tables: frequencies that ROSS publishes, a round trip, and what cannot be taken over."""

import json
import math
import subprocess
import sys
import tomllib
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import SOURCE, ProgramTest  # noqa: E402

SCRIPT = SOURCE / "examples/rotor_files.py"

# rotor_example() of ROSS (its ross/rotor_assembly.py), in the layout of its Rotor.save().
SHAFT = """["ShaftElement_Shaft {n}"]
L = 0.25
idl = 0.0
odl = 0.05
idr = 0.0
odr = 0.05
n = {n}
axial_force = 0
torque = 0
shear_effects = true
rotary_inertia = true
gyroscopic = true
shear_method_calc = "cowper"
tag = "Shaft {n}"
alpha = 0.0
beta = 0.0
["ShaftElement_Shaft {n}".material]
name = "Steel"
rho = 7810.0
E = 211000000000.0
G_s = 81200000000.0
color = "#525252"
"""
# DiskElement.from_geometry(n, steel, width=0.07, i_d=0.05, o_d=0.28), two of them, of rotor_example().
DISK = '["DiskElement_Disk {k}"]\nn = {n}\nm = 32.58972765304033\nId = 0.17808928257067666\nIp = 0.32956362089137037\ntag = "Disk {k}"\nscale_factor = 1.0\n'
BEARING = '["BearingElement_Bearing {k}"]\nkxx = [1e6]\nkxy = [0]\nkyx = [0]\nkyy = [8e5]\ncxx = [0]\ncxy = [0]\ncyx = [0]\ncyy = [0]\nn = {n}\ntag = "Bearing {k}"\n'
ROSS = 'ross_version = "2.0.0"\n[parameters]\n' + "".join(SHAFT.format(n=n) for n in range(6)) + "".join(DISK.format(k=k, n=n) for k, n in enumerate((2, 4))) + "".join(
    BEARING.format(k=k, n=n) for k, n in enumerate((0, 6)))
# "modal.wn[:2]" at rest, in the documentation of Rotor.run_modal [rad/s].
PUBLISHED = [91.79655318, 96.28899977]


class RotorFiles(ProgramTest):
    def convert(self, *arguments, code=0):
        done = subprocess.run(["/usr/bin/python3", str(SCRIPT), *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def frequencies(self, case):
        report = json.loads(self.succeed("modes", case, "--speeds", "0 rpm", "--json").stdout)
        return [2 * math.pi * mode["frequency"] for mode in report["speeds"][0]["modes"]]

    def test_a_rotor_of_ross_has_the_frequencies_that_ross_publishes(self):
        self.write("rotor.toml", ROSS)
        self.assertIn("7 nodes, 6 elements, 2 disks, 2 supports", self.convert("import", "rotor.toml", "rotor"))
        for found, published in zip(self.frequencies("rotor/drop.toml"), PUBLISHED):
            self.assertLess(abs(found / published - 1), 1e-9)  # published with ten digits

    def test_the_way_back_gives_the_same_rotor(self):
        self.write("rotor.toml", ROSS)
        self.convert("import", "rotor.toml", "rotor")
        self.convert("export", "rotor/drop.toml", "back.toml")
        given, back = tomllib.loads(ROSS), tomllib.loads((self.folder / "back.toml").read_text())
        for n in range(6):
            for key, value in given[f"ShaftElement_Shaft {n}"].items():
                self.assertEqual(json.loads(json.dumps(back[f"ShaftElement_Shaft {n}"][key]), parse_float=lambda x: round(float(x), 3)),
                                 json.loads(json.dumps(value), parse_float=lambda x: round(float(x), 3)), key)
        for k in range(2):
            self.assertEqual(back[f"DiskElement_Disk {k}"], given[f"DiskElement_Disk {k}"])
            self.assertEqual({key: value for key, value in back[f"BearingElement_Bearing_{k}"].items() if key != "tag"},
                             {key: value for key, value in given[f"BearingElement_Bearing {k}"].items() if key != "tag"})
        self.convert("import", "back.toml", "again")
        for a, b in zip(self.frequencies("rotor/drop.toml"), self.frequencies("again/drop.toml")):
            self.assertLess(abs(a / b - 1), 1e-9)

    def test_cross_coupling_keeps_its_sense_of_turning(self):
        # kxy > 0 > kyx of ROSS drives forward whirl for a spin about +z: -(F . v) on a forward circle is kxy - kyx. Here that is K_yz of the rotated axes.
        self.write("rotor.toml", ROSS.replace("kxy = [0]", "kxy = [1e5]").replace("kyx = [0]", "kyx = [-1e5]"))
        self.convert("import", "rotor.toml", "rotor", "--speed", "3000 rpm")
        bearing = tomllib.loads((self.folder / "rotor/drop.toml").read_text())["bearings"]["Bearing_0"]
        self.assertEqual(bearing["stiffness"], [[8e5, 1e5], [-1e5, 1e6]])
        report = json.loads(self.succeed("modes", "rotor/drop.toml", "--speeds", "3000 rpm", "--json").stdout)
        damping = {mode["whirl"]: mode["damping_ratio"] for mode in report["speeds"][0]["modes"][:2]}
        self.assertLess(damping["forward"], 0)
        self.assertGreater(damping["backward"], 0)

    def test_tables_over_speed_are_read_at_the_speed(self):
        self.write("rotor.toml", ROSS.replace("kxx = [1e6]", "kxx = [1e6, 3e6]\nspeed = [0.0, 200.0]").replace("kyy = [8e5]", "kyy = [8e5, 8e5]"))
        self.convert("import", "rotor.toml", "rotor", "--speed", "50 rad/s")
        bearing = tomllib.loads((self.folder / "rotor/drop.toml").read_text())["bearings"]["Bearing_0"]
        self.assertAlmostEqual(bearing["stiffness"][1][1], 1.5e6)

    def test_what_is_not_taken_over_is_told_and_stands_in_the_case(self):
        self.write("rotor.toml", ROSS.replace("odr = 0.05", "odr = 0.06", 1).replace("axial_force = 0", "axial_force = 10", 1))
        said = self.convert("import", "rotor.toml", "rotor")
        for note in ("Shaft 0: a cone", "Shaft 0: axial_force is left out"):
            self.assertIn(note, said)
            self.assertIn(note, (self.folder / "rotor/drop.toml").read_text())

    def test_a_table_is_the_same_rotor(self):
        # Young's modulus and density of ROSS's steel; its Poisson's ratio from E / (2 G) - 1.
        row = f"250, 50, 0, 211, {211 / 162.4 - 1!r}, 7810, {{}}\n"
        disk = "32.58972765304033, 0.32956362089137037, 0.17808928257067666"
        table = "length [mm], outer_diameter [mm], bore [mm], E [GPa], nu, rho [kg/m3], mass [kg], Ip [kg m2], Id [kg m2]\n"
        table += "".join(row.format(disk if k in (2, 4) else ", , ") for k in range(6))
        self.write("shaft.csv", table)
        self.convert("import", "shaft.csv", "table")
        case = (self.folder / "table/drop.toml").read_text()
        for name, node in (("A", 1), ("B", 7)):
            case += f'\n[bearings.{name}]\ntype = "linear"\nnode = {node}\nstiffness = [[8e5, 0], [0, 1e6]]\n'
        self.write("table/drop.toml", case)
        for found, published in zip(self.frequencies("table/drop.toml"), PUBLISHED):
            self.assertLess(abs(found / published - 1), 1e-9)

    def test_a_case_with_a_table_as_its_rotor_is_exported(self):
        self.write("shaft.csv", "length [mm], outer_diameter [mm], mass [kg], Ip [kg m2], Id [kg m2]\n250, 50, , ,\n250, 50, 30, 0.3, 0.17\n250, 60, , ,\n")
        self.write("own.toml", '[run]\ninitial_speed = 0\n[rotor]\ngeometry = "shaft.csv"\nmodal_damping = 0\n[bearings.A]\ntype = "linear"\nnode = 1\nstiffness = [[8e5, 0], [0, 1e6]]\n'
                               '[bearings.B]\ntype = "linear"\nnode = 4\nstiffness = [[8e5, 0], [0, 1e6]]\n')
        for name in ("back.toml", "back.json"):
            self.convert("export", "own.toml", name)
            self.convert("import", name, name[5:])
            for a, b in zip(self.frequencies("own.toml"), self.frequencies(f"{name[5:]}/drop.toml")):
                self.assertLess(abs(a / b - 1), 1e-9)
        self.assertEqual(json.loads((self.folder / "back.json").read_text()), tomllib.loads((self.folder / "back.toml").read_text()))
        self.assertIn("must end in .toml or .json", self.convert("export", "own.toml", "back.rot", code=2))

    def test_nothing_of_a_case_is_lost_on_the_way_to_ross(self):
        """Bores by either key, quantities with units, names that are there twice, a default material beside one that is called material."""
        self.write("own.toml", """
rotor.modal_damping = 0
run.initial_speed = 0
rotor.unbalance = [{ node = 1, me = "1 g mm" }]
[rotor.geometry]
material = { E = "200 GPa", nu = 0.3, rho = "7.8 g/cm3" }
materials = { material = { E = 7e10, nu = 0.33, rho = 2700 } }
nodes = [{ id = 1, x = 0 }, { id = 2, x = "200 mm" }, { id = 3, x = 0.4 }, { id = 4, x = 0.6 }]
elements = [{ n1 = 1, n2 = 2, od = "50 mm", bore = "20 mm", name = "a" }, { n1 = 2, n2 = 3, od = 0.06, id_ = 0.03, name = "a" }, { n1 = 3, n2 = 4, od = 0.05, material = "material" }]
mass_points = [{ node = 2, mass = "3 kg", Ip = 0.01, Id = 0.006, name = "disk" }, { node = 3, mass = 1, name = "disk" }]
[bearings.A]
type = "linear"
node = 1
stiffness = [["10 N/um", 0], [0, 1e7]]
[bearings.B]
type = "linear"
node = 4
stiffness = [["1e7 N/m", 0], [0, "10 kN/mm"]]
[bearings.AMB]
type = "magnet"
node = 2
stiffness = [[1e6, 0], [0, 1e6]]
damping = [[100, 0], [0, 100]]
release_time = ["0 s", "0 s"]
""")
        said = self.convert("export", "own.toml", "back.toml")
        for note in ("a second element by the name a is called a (2)", "a second mass point by the name disk is called disk (2)", "the unbalance is left out", 'bearings.AMB, of type "magnet", is left out'):
            self.assertIn(note, said)
        self.convert("import", "back.toml", "again")
        # pi/4 (D^2 - d^2) L rho of the three, and the disks.
        mass = math.pi / 4 * 0.2 * (7800 * (0.05**2 - 0.02**2 + 0.06**2 - 0.03**2) + 2700 * 0.05**2) + 4
        text = (self.folder / "own.toml").read_text()
        self.write("linear.toml", text[:text.index("[bearings.AMB]")])
        back = tomllib.loads((self.folder / "back.toml").read_text())
        elements = [value for key, value in back.items() if key.startswith("ShaftElement")]
        self.assertEqual([(e["odl"], e["idr"], e["material"]["E"], e["material"]["name"]) for e in elements], [(0.05, 0.02, 2e11, "material (2)"), (0.06, 0.03, 2e11, "material (2)"), (0.05, 0, 7e10, "material")])
        self.assertAlmostEqual(sum(math.pi / 4 * e["L"] * (e["odl"] ** 2 - e["idl"] ** 2) * e["material"]["rho"] for e in elements) + sum(value["m"] for key, value in back.items() if key.startswith("Disk")), mass, delta=1e-9)
        for a, b in zip(self.frequencies("linear.toml"), self.frequencies("again/drop.toml")):
            self.assertLess(abs(a / b - 1), 1e-9)
        for wrong, right, says in (('"20 mm"', '"20 furlong"', "bore of element 1 = '20 furlong': write a number in SI, or one of the units cm, in, m, mm, um"), ("\nrotor.modal", '\nbase = "x.toml"\nrotor.modal', "it has a base, which is not followed here")):
            self.write("wrong.toml", text.replace(wrong, right, 1))
            self.assertIn(says, self.convert("export", "wrong.toml", "wrong.json", code=2))
            self.assertFalse((self.folder / "wrong.json").exists())

    def test_the_parameters_beside_results_are_exported_with_all_layers(self):
        self.run_case("reference.toml", run__end_time="1 us")
        said = self.convert("export", "out/parameters.toml", "back.json")
        self.assertIn('bearings.TB1, of type "touchdown", is left out', said)
        self.convert("export", "reference.toml", "direct.json")
        self.assertEqual(json.loads((self.folder / "back.json").read_text()), json.loads((self.folder / "direct.json").read_text()))

    def test_names_that_are_there_twice_replace_nothing_of_ross(self):
        text = ROSS.replace("rho = 7810.0\nE = 211000000000.0\nG_s = 81200000000.0", "rho = 2700.0\nE = 7e10\nG_s = 2.63e10", 1)
        text += BEARING.format(k=0, n=3).replace("BearingElement_Bearing", "SealElement_Bearing").replace("kyy = [8e5]\n", "").replace("1e6", "2e5")
        self.write("rotor.toml", text)
        said = self.convert("import", "rotor.toml", "rotor")
        self.assertIn("another material by the name Steel, called Steel (2) here", said)
        self.assertIn("a second support by this name, called Bearing_0_2 here", said)
        case, rotor = tomllib.loads((self.folder / "rotor/drop.toml").read_text()), json.loads((self.folder / "rotor/rotor.json").read_text())
        self.assertEqual({name: b["node"] for name, b in case["bearings"].items()}, {"Bearing_0": 1, "Bearing_1": 7, "Bearing_0_2": 4})
        self.assertEqual(case["bearings"]["Bearing_0_2"]["stiffness"], [[2e5, 0], [0, 2e5]], "kyy is kxx where it is not given")
        self.assertEqual([rotor["materials"][e["material"]]["rho"] for e in rotor["elements"]], [2700.0] + 5 * [7810.0])

    def test_faults_of_tables_are_told(self):
        for text, said in (("length [mm], diameter [mm]\n10, 20\n", 'unknown column "diameter [mm]"'), ("length [kg], outer_diameter [mm]\n10, 20\n", "allowed: cm, in, m, mm, um"),
                           ("length [mm], outer_diameter [mm]\n10\n", "section 1 has 1 values"), ("length [mm], outer_diameter [mm]\nx, 20\n", "section 1"),
                           ("length [mm]\n10\n", "outer_diameter is missing"), ("length [mm], outer_diameter [mm]\n0, 20\n10, 20\n", "larger than 0")):
            self.write("shaft.csv", text)
            self.assertIn(said, self.convert("import", "shaft.csv", "table", code=2))


if __name__ == "__main__":
    unittest.main()
