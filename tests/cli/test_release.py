"""How magnets let the rotor go.

RESIDUAL FORCE: a rigid rotor of mass m whose magnets still push m g exp(-t/tau) up falls by y = -g (t^2/2 - tau t + tau^2 (1 - exp(-t/tau))).
ONE MAGNET FIRST: a rigid rotor held by the other one turns about it; just after, its centre of gravity, at the distance d from the magnet, falls with
  g d^2 / (d^2 + Id/m), for the held node is the fixed point of a stiff spring.
PHASE: turning the spin angle at the start is turning every unbalance.
LEVITATED: springs K at two nodes that are even about the centre of gravity bear a rigid rotor with sqrt(2 K / m).
"""

import json
import math
import re
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest  # noqa: E402

RIGID = '[rotor]\nmodel = "rigid"\nunbalance = []\n'
G, MASS, DIAMETRAL, CENTRE_OF_GRAVITY = 9.81, 109.6997, 4.55351, 0.4602
K = 'stiffness = [["2e7 N/m", 0], [0, "2e7 N/m"]]\ndamping = [["2e4 N s/m", 0], [0, "2e4 N s/m"]]\n'


def magnet(name, node, more="", springs=K):
    return f'[bearings.{name}]\ntype = "magnet"\nnode = {node}\n{springs}{more}\n'


class Release(ProgramTest):
    def drop(self, text, **keys):
        self.case(text)
        summary = self.run_case("drop.toml", **{"run__end_time": "6 ms", "run__initial_speed": "0 rpm", "output__interval": "20 us", **keys})
        self.assertLess(abs(summary["energy"]["residual"]), 2e-5, "J")
        return summary, h5py.File(self.folder / "out/results.h5")

    def test_a_residual_force_slows_the_fall(self):
        tau = 1.5e-3
        more = 'residual_time_constant = "1.5 ms"'
        _, file = self.drop(RIGID + '[rotor.probes]\na = { node = 12, clearance = "1 mm" }\n' + magnet("M1", 7, more) + magnet("M2", 25, more))
        with file:
            t, y = file["time"][:], file["probes/a/position"][:, 0]
            fall = G * (t**2 / 2 - tau * t + tau**2 * (1 - numpy.exp(-t / tau)))
            self.assertLess(numpy.abs(y[0] - y - fall).max(), 1e-9, "m")
            force = file["bearings/M1/magnet_force"][:, 1] + file["bearings/M2/magnet_force"][:, 1]
            self.assertLess(numpy.abs(force - MASS * G * numpy.exp(-t / tau)).max(), 1e-3 * MASS * G)

    def test_a_rotor_that_is_held_rests_until_its_release(self):
        more = 'release_time = ["3 ms", "3 ms"]'
        _, file = self.drop('[rotor]\nunbalance = []\n[rotor.probes]\na = { node = 7, clearance = "1 mm" }\nb = { node = 16, clearance = "1 mm" }\n' + magnet("M1", 7, more) + magnet("M2", 25, more))
        with file:
            t = file["time"][:]
            for name in "ab":
                y = file[f"probes/{name}/position"][:, 0]
                held = t <= 3e-3
                self.assertLess(numpy.abs(y[held] - y[0]).max(), 1e-11, "m: bent by its weight from the start, in balance")
                self.assertGreater(y[0] - y[-1], 30e-6, "m: then it falls")
            self.assertGreater(abs(file["probes/b/position"][0, 0] - file["probes/a/position"][0, 0]), 0.1e-6, "m: it sags between its magnets")
            # 4.4 um/ms^2: the fall of the last 3 ms, with the bending that comes free.
            self.assertAlmostEqual(file["probes/b/position"][0, 0] - file["probes/b/position"][-1, 0], G / 2 * 9e-6, delta=0.1 * G / 2 * 9e-6)

    def test_magnets_share_what_others_with_a_force_of_their_own_leave(self):
        more = 'release_time = ["3 ms", "3 ms"]'
        own = 'holding_force = ["200 N", "-30 N"]\n' + more
        _, file = self.drop('[rotor]\nunbalance = []\n[rotor.probes]\na = { node = 7, clearance = "1 mm" }\n' + magnet("M1", 7, more) + magnet("M2", 25, more) + magnet("M3", 12, own))
        with file:
            held = file["time"][:] < 3e-3
            for axis in (0, 1):
                q = file["probes/a/position"][:, axis]
                self.assertLess(numpy.abs(q[held] - q[0]).max(), 1e-11, "m: in balance, bent by the forces")
            forces = numpy.array([file[f"bearings/{name}/magnet_force"][0, 1:] for name in ("M1", "M2", "M3")])
            numpy.testing.assert_allclose(forces[2], [200, -30], atol=1e-9)
            numpy.testing.assert_allclose(forces.sum(axis=0), [MASS * G, 0], atol=1e-3 * MASS * G)

    def test_magnets_and_linear_supports_hold_a_rotor_at_rest_together(self):
        # In balance: the springs at nodes 16 and 31 give -K x where the bent rotor is, all forces balance the weight, and all moments its moment.
        more = 'release_time = ["1 s", "1 s"]'
        springs = {"L": (16, [[5e7, 1e7], [-4e6, 3e7]]), "E": (31, [[8e6, 0.0], [0.0, 1e6]])}
        text = "[rotor]\nunbalance = []\n[rotor.probes]\n" + "".join(f'{name} = {{ node = {node}, clearance = "1 mm" }}\n' for name, (node, _) in springs.items())
        text += magnet("M1", 7, more) + magnet("M2", 25, more) + magnet("M3", 12, 'holding_force = ["200 N", "-30 N"]\n' + more)
        text += "".join(f'[bearings.{name}]\ntype = "linear"\nnode = {node}\nstiffness = {K}\n' for name, (node, K) in springs.items())
        _, file = self.drop(text, run__gravity="[0, -9.81, 3]", run__initial_speed="3000 rpm")
        nodes = [node["x"] for node in json.loads((self.folder / "neisi2019-rotor.json").read_text())["nodes"]]
        with file:
            force, moment = numpy.zeros(2), numpy.zeros(2)
            for name, (node, K) in springs.items():
                x, f = file[f"probes/{name}/position"][:], file[f"bearings/{name}/support_force"][:]
                self.assertLess(numpy.abs(x - x[0]).max(), 1e-11, "m: it rests")
                numpy.testing.assert_allclose(f[0], -numpy.array(K) @ x[0], atol=1e-6)
                self.assertGreater(numpy.abs(f[0]).max(), 0.5, "N: it is bent")
                force, moment = force + f[0], moment + (nodes[node - 1] - CENTRE_OF_GRAVITY) * f[0]
            for name, node in (("M1", 7), ("M2", 25), ("M3", 12)):
                f = file[f"bearings/{name}/magnet_force"][:, 1:]
                force, moment = force + f[0], moment + (nodes[node - 1] - CENTRE_OF_GRAVITY) * f[0]
            numpy.testing.assert_allclose(force, [MASS * G, -MASS * 3], atol=1e-3 * MASS * G)
            numpy.testing.assert_allclose(moment, 0, atol=1e-3 * MASS * G * 0.1)

    def test_one_axis_may_go_first(self):
        more = 'release_time = ["0 ms", "4 ms"]'
        _, file = self.drop(RIGID + '[rotor.probes]\na = { node = 12, clearance = "1 mm" }\n' + magnet("M1", 7, more) + magnet("M2", 25, more), run__gravity="[0, -6, -8]")
        with file:
            t, (y, z) = file["time"][:], file["probes/a/position"][:].T
            self.assertLess(numpy.abs(y[0] - y - 3 * t**2).max(), 1e-9, "m")
            held = t <= 4e-3
            self.assertLess(numpy.abs(z[held] - z[0]).max(), 1e-10, "m, the error of the integration")
            self.assertLess(numpy.abs(z[0] - z - 4 * numpy.maximum(t - 4e-3, 0) ** 2).max(), 1e-10, "m: of 16 um")

    def test_one_magnet_may_go_first(self):
        stiff = 'stiffness = [["1e10 N/m", 0], [0, "1e10 N/m"]]\ndamping = [["1e6 N s/m", 0], [0, "1e6 N s/m"]]\n'
        _, file = self.drop(RIGID + '[rotor.probes]\nheld = { node = 7, clearance = "1 mm" }\nfree = { node = 31, clearance = "1 mm" }\n' + magnet("M1", 7, 'release_time = ["1 s", "1 s"]', stiff) + magnet("M2", 25), run__end_time="5 ms")
        with file:
            t, held, free = file["time"][:], file["probes/held/position"][:, 0], file["probes/free/position"][:, 0]
            self.assertLess(numpy.abs(held - held[0]).max(), 0.5e-6, "m: swings about its weight over 1e10 N/m")
            d = CENTRE_OF_GRAVITY - 0.175
            turning = G * d / (d**2 + DIAMETRAL / MASS)  # rad/s^2
            expected = turning * (0.961704 - 0.175) * t**2 / 2
            self.assertLess(numpy.abs(free[0] - free - expected).max(), 0.01 * expected.max())

    def test_the_angle_at_the_start_turns_the_unbalance(self):
        def run(text, name):
            # With the case's tolerance the steps leave 1e-5 of the peak, with 1e-10 still 2e-6, and a rotor that begins at another angle takes others.
            return self.run_case(self.case(text), output=name, run__end_time="9 ms", integration__tolerance="1e-12")

        turned = run('[rotor]\ninitial_angle = "90 deg"\nunbalance = [{ node = 5, me = "1e-4 kg m", angle = "20 deg" }]', "turned")
        moved = run('[rotor]\nunbalance = [{ node = 5, me = "1e-4 kg m", angle = "110 deg" }]', "moved")
        other = run('[rotor]\nunbalance = [{ node = 5, me = "1e-4 kg m", angle = "20 deg" }]', "other")
        peaks = [s["bearings"]["TB1"]["peak_contact_force"] for s in (turned, moved, other)]
        self.assertAlmostEqual(peaks[0], peaks[1], delta=1e-6 * peaks[0])
        self.assertGreater(abs(peaks[2] - peaks[0]), 1e-3 * peaks[0], "the phase matters")

    def test_a_vertical_machine_falls_on_its_shoulders(self):
        for name in ("neisi2019.toml", "neisi2019-settling.toml", "neisi2019-thrust.toml", "vertical-drop.toml"):
            (self.folder / name).write_text((PARAMS / name).read_text())
        summary = self.run_case("vertical-drop.toml", run__end_time="14 ms", rotor__mass_proportional_alpha="0 1/s", output__interval="20 us")
        self.assertLess(abs(summary["energy"]["residual"]), 2e-5, "J")
        with h5py.File(self.folder / "out/results.h5") as file:
            t, x = file["time"][:], file["bearings/TB2/axial_position"][:, 0]
            since = numpy.maximum(t - 2e-3, 0)
            tau = 1e-3
            fall = G * (since**2 / 2 - tau * since + tau**2 * (1 - numpy.exp(-since / tau)))
            free = fall < 0.29e-3
            self.assertLess(numpy.abs(x[0] - x - fall)[free].max(), 1e-8, "m: by weight and what is left of the magnet, to the shoulder")
            self.assertGreater(file["bearings/TB2/shoulder_force"][:].__abs__().max(), 1000, "N: it lands")

    def test_modes_have_the_magnets_holding(self):
        self.case(RIGID.replace("unbalance = []\n", "") + magnet("M1", 7) + magnet("M2", 25))
        (mode, *_) = json.loads(self.succeed("modes", "drop.toml", "--json").stdout)["speeds"][0]["modes"]
        self.assertGreater(mode["frequency"], 50)
        self.assertLess(mode["frequency"], 1.05 * math.sqrt(4e7 / MASS) / (2 * math.pi))

    def test_statics_has_them_released(self):
        without = json.loads(self.succeed("statics", self.case(""), "--json").stdout)["shaft"]
        held = json.loads(self.succeed("statics", self.case(magnet("M1", 7) + magnet("M2", 25)), "--json").stdout)["shaft"]
        self.assertEqual(without["supports"], held["supports"])


if __name__ == "__main__":
    unittest.main()
