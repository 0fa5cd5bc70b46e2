"""What balls conduct in `rotordrop heat` of a bearing: by a given load and speed, as validation/preload_loop.py has it, or as stated."""

import math
import pathlib
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, SOURCE, ProgramTest  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
MODELS = ("lumped", "fe") if HAS_ROOM else ("lumped",)
AMBIENT = 293.15


class BallConduction(ProgramTest):
    def heat(self, keys, end="4e5 s"):
        """TB2 under 20 W at the inner race until everything is steady; rises, and the summary."""
        nodes = {"lumped": ("inner_contact", "outer_contact"), "fe": ("inner_raceway", "outer_raceway")}
        probes = "".join(f'[[heat.probe]]\nname = "{model}.{node}"\nmodel = "{model}"\nnode = "{node}"\n' for model in MODELS for node in (*nodes[model], "ball"))
        self.write("heat.toml", f'''base = "reference.toml"
[thermal]
models = [{", ".join(f'"{m}"' for m in MODELS)}]
fe.coupling = "windowed"
[heat]
bearing = "TB2"
output_times = ["{end}"]
time_tolerance = 1e-5
{keys}
[[heat.source]]
port = "inner"
times = [0]
values = ["20 W"]
{probes}''')
        self.succeed("heat", "heat.toml", "-o", "out", "--quiet", "--force")
        summary = self.summary("out")
        rises = {name: probe["temperature"][-1] - AMBIENT for name, probe in summary["probes"].items()}
        return {model: (rises[f"{model}.{nodes[model][0]}"], rises[f"{model}.ball"], rises[f"{model}.{nodes[model][1]}"]) for model in MODELS}, summary

    def check_balance(self, G_ib, G_ob, rises):
        """Balls that keep their temperature give to ambient, h_b Z pi d^2 per kelvin, what both races give them."""
        to_ambient = 50 * 2 * 23 * math.pi * 9.525e-3**2
        for model, (inner, ball, outer) in rises.items():
            given = G_ib * (inner - ball) + G_ob * (outer - ball)
            self.assertLess(abs(given / (to_ambient * ball) - 1), 1e-3, model)

    def test_a_stated_conductance_is_that_of_each_race(self):
        for G in (0.3, 3.0):
            rises, summary = self.heat(f'ball_conductance = "{G} W/K"')
            self.check_balance(G, G, rises)
            self.assertEqual(summary["ball_conduction"], {"inner_to_ball": G, "outer_to_ball": G, "inner_to_outer": 0.0})

    def test_load_and_speed_give_what_rolling_contacts_conduct(self):
        sys.path.insert(0, str(SOURCE / "validation"))
        try:
            import preload_loop as peer
        except ImportError as error:
            self.skipTest(f"validation/preload_loop.py: {error}")
        for load, rpm in ((100.0, 0), (100.0, 6000), (400.0, 6000)):
            turn = peer.D * math.cos(peer.PHI) / peer.D_M
            speed = rpm * math.pi / 30 * peer.D_M / 4 * (1 - turn**2)
            G_i, G_o = (peer.rolling_contact(axis, k, load, speed, 0.0) for _, axis, k in (peer.INNER_RACE, peer.OUTER_RACE))
            G_b = 2 * math.pi**2 * peer.CONDUCTIVITY * peer.D / 2 / (math.log(peer.D / 2 / peer.HALF_WIDTH) + 0.43)
            per = 2 * peer.Z / (G_i + G_o + G_b)
            rises, summary = self.heat(f'ball_load = "{load} N"\nring_speed = "{rpm} rpm"')
            found = summary["ball_conduction"]
            for key, expected in (("inner_to_ball", per * G_i * G_b), ("outer_to_ball", per * G_o * G_b), ("inner_to_outer", per * G_i * G_o)):
                self.assertLess(abs(found[key] / expected - 1), 1e-6, key)
            self.check_balance(found["inner_to_ball"], found["outer_to_ball"], rises)

    def test_what_passes_through_the_balls_warms_the_outer_race(self):
        slow, _ = self.heat('ball_load = "100 N"', end="20 s")
        fast, _ = self.heat('ball_load = "100 N"\nring_speed = "6000 rpm"', end="20 s")
        fixed, _ = self.heat("", end="20 s")
        for model in MODELS:
            self.assertGreater(fast[model][2], 1.5 * slow[model][2], "rolling contacts conduct several times as well")
            self.assertLess(fast[model][0], fixed[model][0])

    def test_bad_settings_are_told(self):
        for keys, words in (('ball_load = "100 N"\nball_conductance = "1 W/K"', "both say what balls conduct"), ('ring_speed = "6000 rpm"', "Give heat.ball_load"), ('ball_load = "-1 N"', "ball_load")):
            self.write("heat.toml", f'base = "reference.toml"\n[heat]\nbearing = "TB2"\noutput_times = ["1 s"]\n{keys}\n[[heat.source]]\nport = "inner"\ntimes = [0]\nvalues = [1]\n')
            done = self.call("check", "heat.toml")
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
