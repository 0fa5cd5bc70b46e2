"""Heat that spreads from the balls' strips: the circuit's contact over ring against the finite elements', for the two reference bearings and five of the
catalogue, and the balls after 10 s."""

import pathlib
import sys
import tomllib
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, PROGRAM, ProgramTest  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
AMBIENT, WATTS = 293.15, 100.0


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class Spreading(ProgramTest):
    def temperatures(self, bearing, port, *options):
        self.write("heat.toml", self.text + f'''
[thermal]
models = ["lumped", "fe"]
spreading = "strip"
[thermal.fe]
coupling = "windowed"
[heat]
bearing = "{bearing}"
output_times = ["10 s"]
time_tolerance = 1e-4
[[heat.source]]
port = "{port}"
times = [0]
values = ["{WATTS} W"]
''')
        self.succeed("heat", "heat.toml", "-o", "out", "--quiet", "--force", *options)
        return {name: values["temperature"][0] for name, values in self.summary("out")["probes"].items()}

    def check(self, bearing, balls):
        for port in ("inner", "outer"):
            T = self.temperatures(bearing, port)
            fe = (T[f"fe.{port}_raceway"] - T[f"fe.{port}_ring"]) / WATTS
            circuit = (T[f"lumped.{port}_contact"] - T[f"lumped.{port}_ring"]) / WATTS
            ball = (T["lumped.ball"] - AMBIENT) / (T["fe.ball"] - AMBIENT)
            print(f"{self.name} {port}: contact over ring {circuit:.4f} K/W by the circuit, {fe:.4f} by finite elements; balls after 10 s {ball:.3f} of theirs")
            with self.subTest(bearing=self.name, port=port):
                self.assertLess(abs(circuit / fe - 1), 0.20)  # a slab for a ring with groove and shoulders
                self.assertLess(abs(ball - 1), balls)
            none = self.temperatures(bearing, port, "--set", "thermal.spreading=none")
            published = (none[f"lumped.{port}_contact"] - none[f"lumped.{port}_ring"]) / WATTS
            self.assertLess(published, 0.25 * fe, "the circuit as published lacks it")

    def test_reference_bearings(self):
        self.text = 'base = "reference.toml"\n'
        for self.name in ("TB1", "TB2"):
            self.check(self.name, 0.10)

    def test_bearings_of_the_catalogue(self):
        for self.name in ("6010", "7010-25", "71908-25", "71920-25", "6020"):
            data = tomllib.loads((PARAMS / f"bearings/{self.name}.toml").read_text())
            millimetres = lambda key: float(data[key].split()[0])
            outside, bore, width = millimetres("outside_diameter"), millimetres("bore_diameter"), millimetres("width")
            preload = '"100 N"' if "-25" in self.name else 0
            self.text = f'''base = "reference.toml"
[bearings.B]
type = "touchdown"
catalogue = "{self.name}"
node = 15
bore_radius = "{bore / 2} mm"
contact_stiffness = 1e9
f2 = 0.25
preload = {preload}
support = {{ mass = "50 kg", K_y = 1.5e9, K_z = 1.1e9, C_y = 2.82e3, C_z = 2.82e3 }}
housing_diameters = ["{outside} mm", "{1.2 * outside:.3f} mm"]
housing_length = "{1.4 * width:.3f} mm"
'''
            self.check("B", 0.10)


if __name__ == "__main__":
    unittest.main()
