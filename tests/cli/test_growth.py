"""thermal.expansion = "elastic" in drops: growth by elasticity of the meshed sections, centrifugal growth, fits.

ROTORDROP_PROGRAM is the program under test. What needs the finite-element room is skipped where its module is not beside the program.
"""

import json
import pathlib
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, PROGRAM, ProgramTest, content_of, settings  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
ELASTIC = 'thermal.models = ["lumped", "fe"]\nthermal.driver = "fe"\nthermal.expansion = "elastic"\nthermal.growth_by_speed = "closed-form"\n'
AMBIENT = 293.15
SHAFT, BORE, INNER, OUTER, BALL, INNER_WIDTH, OUTER_WIDTH = range(7)  # columns of a growth
# Where balls touch, d_m / 2 -+ d / 2 cos phi [m], and the sides of plain sections, the shoulders; widths.
INNER_CONTACT = {"TB1": 45e-3 - 5.953e-3, "TB2": 42.5e-3 - 4.7625e-3 * np.cos(np.radians(25))}
OUTER_CONTACT = {"TB1": 45e-3 + 5.953e-3, "TB2": 42.5e-3 + 4.7625e-3 * np.cos(np.radians(25))}
INNER_SIDE, OUTER_SIDE, WIDTH = 39e-3, {"TB1": 48.6e-3, "TB2": 46e-3}, {"TB1": 20e-3, "TB2": 32e-3}


def find(tree, key):
    """The first value of a key, however deep."""
    if isinstance(tree, dict):
        if key in tree:
            return tree[key]
        for value in tree.values():
            if (found := find(value, key)) is not None:
                return found
    return None


def rotor_growth(speed):
    """Solid shaft of the reference rotor's steel, 34.75 mm under both bearings: rho w^2 b^3 (1 - nu)/(4 E), mean over any length."""
    rotor = json.loads((PARAMS / "neisi2019-rotor.json").read_text())
    material = rotor["materials"]["steel"] if "steel" in rotor.get("materials", {}) else rotor["material"]
    E, nu, rho = material["E"], material["nu"], material["rho"]
    return rho * speed**2 * 34.75e-3**3 * (1 - nu) / (4 * E)


class GrowthBySpeed(ProgramTest):
    """Without finite elements: closed forms, their energy and the preload."""

    def run_case(self, output="out", **keys):
        words = {"thermal__growth_by_speed": "closed-form", "thermal__expansion": "formula", "rotor__mass_proportional_alpha": "30 1/s", "run__end_time": "80 ms", **keys}
        self.succeed("run", self.case(""), "-o", output, "--quiet", *settings(**words))
        file = h5py.File(self.folder / output / "results.h5")
        self.addCleanup(file.close)
        return self.summary(output), file

    def test_rings_and_rotor_grow_as_thin_discs(self):
        _, file = self.run_case()
        E, nu, rho, a = 2.0e11, 0.30, 7800.0, 35e-3
        for bearing, b in ("TB1", 41.45e-3), ("TB2", 39e-3):  # m: up to the shoulder, where the case gives one
            speed, by_speed = file[f"bearings/{bearing}/ring_speed"][:], file[f"bearings/{bearing}/expansion"][:] - file[f"growth/lumped/{bearing}"][:]
            self.assertGreater(speed[-1], 350.0)
            r, factor = INNER_CONTACT[bearing], rho * speed**2 / (8 * E)
            np.testing.assert_allclose(by_speed[:, BORE], 2 * factor * a * ((3 + nu) * b**2 + (1 - nu) * a**2), rtol=0, atol=1e-15)
            race = factor * r * ((3 + nu) * ((1 - nu) * (a**2 + b**2) + (1 + nu) * a**2 * b**2 / r**2) - (1 - nu**2) * r**2)
            np.testing.assert_allclose(by_speed[:, INNER], race, rtol=0, atol=1e-15)
            np.testing.assert_allclose(by_speed[:, INNER_WIDTH], -4 * nu * factor * WIDTH[bearing] * (a**2 + b**2), rtol=0, atol=1e-15)
            np.testing.assert_allclose(by_speed[:, SHAFT], rotor_growth(file["rotor/spin_speed"][:]), rtol=0, atol=1e-15)

    def test_a_braked_rotor_that_shrinks_keeps_the_energy(self):
        """At 3 kN m the rotor loses its speed in 0.2 s, and 0.7 um of radius, under some kN: of the order of a mJ."""
        summary, file = self.run_case(rotor__torque="-3000 N m", run__end_time="150 ms")
        self.assertLess(file["rotor/spin_speed"][-1], 600.0)
        self.assertLess(abs(summary["energy"]["residual"]), 3e-5)

    def test_preload_at_the_end_is_that_of_the_bearing_by_itself(self):
        """For the same growth and speed, under the force of the balls: by the history of the drop, and by the growth given to a drop without heat."""
        _, file = self.run_case(run__end_time="0.15 s")
        keys = settings(thermal__growth_by_speed="closed-form", thermal__expansion="formula", preload__history_under_load="true")
        axes = [word for axis in ("growth", "interference", "inner_rise", "outer_rise") for word in ("--set", f"preload.map.{axis}=[]")]
        done = self.succeed("preload", "reference.toml", "--bearing", "TB2", "-o", "alone", "--results", "out", *keys, *axes)
        history = json.loads((self.folder / "alone/preload.json").read_text())["bearings"]["TB2"]["history"]
        self.assertEqual(history["growth_by_speed"], "recorded", done.stdout)
        self.assertGreater(file["bearings/TB2/ring_speed"][-1], 700.0)
        recorded = file["bearings/TB2/preload"][-1]
        self.assertAlmostEqual(history["preload"]["end"] / recorded, 1, delta=1e-3)


    def test_preload_at_the_end_is_that_of_growth_and_speed_given_by_hand(self):
        """What a user does: growth by heat at the end, the ring's speed and the balls' force from the results, by hand into `statics` and `preload`. Temperatures of rings
        that grow evenly give the widths; what the raceways grow besides is a growth of its own. `preload` adds growth by speed itself; `statics` gets it by the closed form."""
        _, file = self.run_case(run__end_time="0.15 s")
        keys = settings(thermal__growth_by_speed="closed-form", thermal__expansion="formula", statics__subject="bearings")
        alpha, d, phi, width = 11.8e-6, 9.525e-3, np.radians(25), WIDTH["TB2"]
        heat, felt = file["growth/lumped/TB2"][-1], file["bearings/TB2/expansion"][-1]
        speed, force = file["bearings/TB2/ring_speed"][-1], -file["bearings/TB2/bearing_force"][-1]
        recorded = file["bearings/TB2/preload"][-1]
        self.assertGreater(felt[INNER] - heat[INNER], 0.9e-6, "m by speed")
        self.assertGreater(heat[INNER], 0.2e-6, "m by heat")
        self.assertGreater(recorded, 2 * 290)

        def by_hand(table, growth, extra):
            rises = {"inner": growth[INNER_WIDTH] / (alpha * width), "outer": growth[OUTER_WIDTH] / (alpha * width)}
            words = {f"{table}__inner_growth": growth[INNER] - alpha * rises["inner"] * INNER_CONTACT["TB2"] + extra(rises),
                     f"{table}__outer_growth": growth[OUTER] - alpha * rises["outer"] * OUTER_CONTACT["TB2"], f"{table}__force": [0.0, *map(float, force)]}
            return rises, settings(**{key: value if isinstance(value, list) else f"{value!r} m" for key, value in words.items()})

        rises, words = by_hand("statics", felt, lambda rises: 0.0)
        more = settings(statics__inner_rise=f"{rises['inner']!r} K", statics__outer_rise=f"{rises['outer']!r} K", statics__ball_rise=f"{felt[BALL] / (alpha * d / 2)!r} K")
        rest = json.loads(self.succeed("statics", "reference.toml", "--bearing", "TB2", "--json", *keys, *words, *more).stdout)["bearings"]["TB2"]
        self.assertAlmostEqual(rest["preload"] / recorded, 1, delta=1e-3)

        # Maps of `preload` take balls between the rings' temperatures: what they lack to that, along the contact normal, is taken from the inner raceway.
        balls = lambda rises: 2 * (heat[BALL] - alpha * d / 2 * 0.5 * (rises["inner"] + rises["outer"])) / np.cos(phi)
        rises, words = by_hand("preload", heat, balls)
        more = settings(preload__speed=f"{speed!r} rad/s", preload__map__growth="[]", preload__map__interference="[]",
                        preload__map__inner_rise=f"[\"{rises['inner']!r} K\", \"{rises['inner'] + 1!r} K\"]", preload__map__outer_rise=f"[\"{rises['outer']!r} K\", \"{rises['outer'] + 1!r} K\"]",
                        preload__critical_values="false", preload__end_time="1 s")
        self.succeed("preload", "reference.toml", "--bearing", "TB2", "-o", "by-hand", *keys, *words, *more)
        maps = json.loads((self.folder / "by-hand/preload.json").read_text())["bearings"]["TB2"]["maps"]["rise"]
        self.assertAlmostEqual(maps["corners"][0]["preload"] / recorded, 1, delta=1e-3)


class FaultyCases(ProgramTest):
    def fault(self, text):
        case = self.case(text)
        before = content_of(self.folder)
        done = self.call("check", case)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(content_of(self.folder), before)
        return " ".join(done.stderr.split())

    def test_elastic_growth_without_finite_elements_is_refused(self):
        self.assertIn('thermal.expansion = "elastic" needs the finite elements, which are not in thermal.models', self.fault('thermal.expansion = "elastic"\nthermal.growth_by_speed = "closed-form"\n'))

    def test_a_clearance_needs_windows(self):
        message = self.fault(ELASTIC + 'bearings.TB2.housing_fit = "-5 um"\n')
        self.assertIn("bearings.TB2.housing_fit = -5 um is a clearance", message)
        self.assertIn('thermal.fe.coupling = "windowed"', message)

    def test_a_factor_of_formulas_is_refused(self):
        self.assertIn("thermal.plane_strain_growth applies to the paper's formulas, and thermal.expansion is \"elastic\"", self.fault(ELASTIC + "thermal.plane_strain_growth = true\n"))

    def test_an_interference_of_millimetres_is_refused(self):
        self.assertIn("housing_fit", self.fault(ELASTIC + 'bearings.TB1.housing_fit = "2 mm"\n'))


@unittest.skipUnless(HAS_ROOM, "built without finite elements")
class ElasticGrowth(ProgramTest):
    def series(self, output="out"):
        file = h5py.File(self.folder / output / "results.h5")
        self.addCleanup(file.close)
        return file

    def run_elastic(self, text="", output="out", **keys):
        done = self.succeed("run", self.case(ELASTIC + text, f"{output}.toml"), "-o", output, *settings(run__end_time="40 ms", **keys))
        return done, self.summary(output), self.series(output)

    def test_a_plain_free_ring_grows_by_its_volume_mean_and_its_speed(self):
        """Betti: the mean growth of bore and outside of a free ring of rectangular section is alpha r times its mean rise, whatever the field.
        The thin disc, in the mean over the length exact too: u(a) = rho w^2 a/(4 E) [(3 + nu) b^2 + (1 - nu) a^2], u(b) = rho w^2 b/(4 E) [(1 - nu) b^2 + (3 + nu) a^2].
        A raceway's growth is the side's hoop strain at the contact points. Likewise by Betti the width grows by alpha W times the mean rise, and shrinks by nu rho w^2 (a^2 + b^2)/(2 E) W."""
        done, summary, file = self.run_elastic('thermal.fe.section = "plain"\n')
        alpha, E, nu, rho, a, b = 11.8e-6, 2.0e11, 0.30, 7800.0, 35e-3, 39e-3
        for bearing in ("TB1", "TB2"):
            rise = file[f"fe/{bearing}/inner_ring"][:] - AMBIENT
            growth = file[f"growth/fe/{bearing}"][:]
            self.assertGreater(rise[-1], 0.5)
            # 1e-4: the modes that are left out, of a surface layer; the mesh alone leaves 1e-6.
            np.testing.assert_allclose(growth[:, BORE], alpha * a * rise, rtol=0, atol=1e-4 * alpha * a * rise.max())
            contact, width = INNER_CONTACT[bearing], WIDTH[bearing]
            np.testing.assert_allclose(growth[:, INNER], alpha * contact * rise, rtol=0, atol=1e-4 * alpha * b * rise.max())
            np.testing.assert_allclose(growth[:, INNER_WIDTH], alpha * width * rise, rtol=0, atol=1e-4 * alpha * b * rise.max())
            speed = file[f"bearings/{bearing}/ring_speed"][:]
            self.assertGreater(speed[-1], 200.0)
            by_speed = file[f"bearings/{bearing}/expansion"][:] - growth
            factor = rho * speed**2 / (4 * E)
            bore, race = factor * a * ((3 + nu) * b**2 + (1 - nu) * a**2), factor * contact * ((1 - nu) * b**2 + (3 + nu) * a**2)
            narrower = -2 * nu * factor * width * (a**2 + b**2)
            np.testing.assert_allclose(by_speed[:, INNER_WIDTH], narrower, rtol=0, atol=1e-6 * bore.max())
            np.testing.assert_allclose(by_speed[:, BORE], bore, rtol=0, atol=1e-6 * bore.max())
            np.testing.assert_allclose(by_speed[:, INNER], race, rtol=0, atol=1e-6 * race.max())
            for surface in (OUTER, BALL, OUTER_WIDTH):
                np.testing.assert_array_equal(by_speed[:, surface], 0.0)
            rotor = rotor_growth(file["rotor/spin_speed"][:])
            np.testing.assert_allclose(by_speed[:, SHAFT], rotor, rtol=0, atol=1e-12)
        # What the ring's growth by its speed does to the contacts is booked, or this balance would miss it.
        self.assertLess(abs(summary["energy"]["residual"]), 1e-5)

    def test_stresses_at_the_end_are_those_of_lames_press_fit(self):
        """Ring a < r < b in a housing b < r < c of the same material and width, interference d by radius:
        p = E d (b^2 - a^2)(c^2 - b^2) / (2 b^3 (c^2 - a^2)); hoop stress p (c^2 + b^2)/(c^2 - b^2) outside, -p (b^2 + a^2)/(b^2 - a^2) inside."""
        text = 'thermal.fe.section = "plain"\nbearings.TB1.housing_fit = "10 um"\nbearings.TB1.housing_length = "20 mm"\n'
        for coupling in ("reduced", "windowed"):
            with self.subTest(coupling):
                self.succeed("run", self.case(ELASTIC + text, "press.toml"), "-o", coupling, *settings(run__end_time="0.2 ms", thermal__fe__coupling=coupling))
                state = self.summary(coupling)["bearings"]["TB1"]["fe"]["elastic_end"]
                a, b, c, E, d = 0.0486, 0.055, 0.065, 2.0e11, 10e-6
                p = E * d * (b**2 - a**2) * (c**2 - b**2) / (2 * b**3 * (c**2 - a**2))
                self.assertAlmostEqual(state["fit_pressure"]["mean"], p, delta=1e-6 * p)
                self.assertEqual(state["fit_pressure"]["open"], 0.0)
                for key, value in (("housing_bore", p * (c**2 + b**2) / (c**2 - b**2)), ("outer_ring_outside", -p * (b**2 + a**2) / (b**2 - a**2))):
                    for at in ("mean", "lowest", "highest"):
                        # Stresses come from derivatives of u and stand at quadrature points a little off the side: second order of some 0.5 mm of 55.
                        self.assertAlmostEqual(state["hoop_stress"][key][at], value, delta=2e-3 * abs(value), msg=f"Pa, {key} {at}")
                self.assertLess(abs(state["hoop_stress"]["inner_ring_bore"]["mean"]), 1e-4 * p, "Pa: cold and at rest")

    def test_raceways_at_the_end_grow_as_the_drop_felt(self):
        _, summary, file = self.run_elastic('thermal.fe.section = "plain"\n')
        for bearing in ("TB1", "TB2"):
            state = summary["bearings"][bearing]["fe"]["elastic_end"]
            felt = file[f"bearings/{bearing}/expansion"][-1]
            self.assertEqual(state["ring_speed"], summary["bearings"][bearing]["ring_speed_end"])
            for race, surface, scale in (("inner", INNER, INNER_CONTACT[bearing] / INNER_SIDE), ("outer", OUTER, OUTER_CONTACT[bearing] / OUTER_SIDE[bearing])):
                (row,) = state["raceway_growth"][race]  # of a plain section: one side
                # What the modes leave out of a surface layer, and fits that the modes take as closed.
                self.assertAlmostEqual(row["radial"] * scale, felt[surface], delta=2e-9, msg=f"m, {bearing} {race}")
                # Even along the axis; the modes of a mesh that is symmetric but for roundoff are symmetric to some 1e-6.
                self.assertLess(abs(row["axial"]), 1e-5 * abs(row["radial"]) + 1e-12, "m")

    def test_windows_and_modes_agree_while_the_fits_stay_closed(self):
        fits = 'bearings.TB1.housing_fit = "10 um"\nbearings.TB2.housing_fit = "10 um"\n'
        reduced, _, modes = self.run_elastic(fits, "reduced")
        windowed, _, windows = self.run_elastic(fits + 'thermal.fe.coupling = "windowed"\n', "windowed")
        for done in (reduced, windowed):
            self.assertNotIn("begins to open", done.stderr)
        time = windows["windows/time"][:]
        for bearing in ("TB1", "TB2"):
            by_windows = windows[f"windows/{bearing}/growth"][:]
            by_modes = np.array([np.interp(time, modes["time"][:], column) for column in modes[f"growth/fe/{bearing}"][:].T]).T
            # The modes leave about a nanometre of the strips' displacements; the bore's mean is among them. A width is the slope of the strips' axial displacements
            # times the width of the rings, 32 mm over 6 mm from the pair's middle.
            np.testing.assert_allclose(by_modes[:, :INNER_WIDTH], by_windows[:, :INNER_WIDTH], rtol=0, atol=2e-9)
            np.testing.assert_allclose(by_modes[:, INNER_WIDTH:], by_windows[:, INNER_WIDTH:], rtol=0, atol=32 / 6 * 2e-9)
            np.testing.assert_allclose(by_modes[:, BORE], by_windows[:, BORE], rtol=0, atol=3e-10)
            self.assertGreater(by_windows[-1, BORE], 2e-7)
            for file, path in ((modes, "fe"), (windows, "windows")):
                self.assertEqual(file[f"{path}/{bearing}/housing_fit_open"][:].max(), 0.0)
                mean = file[f"{path}/{bearing}/housing_fit_pressure"][:, 0]
                self.assertGreater(mean.min(), 1e6)

    def test_a_fit_that_opens_is_told_with_its_time(self):
        done, summary, file = self.run_elastic()  # no interference: what bulges lifts off
        self.assertRegex(done.stderr, r"the fit of TB1's outer ring in its housing begins to open before t = [\d.]+ ms: \d+ % of its area would have to pull")
        open_part = file["fe/TB1/housing_fit_open"][:]
        told = float(done.stderr.partition("the fit of TB1's")[2].partition("before t = ")[2].split()[0]) * 1e-3
        first = file["time"][:][np.argmax(open_part > 0)]
        self.assertAlmostEqual(told, first, delta=1e-3 * first)
        fit = find(summary, "housing_fit")
        self.assertEqual(fit["largest_open"], open_part.max())
        pressure = file["fe/TB1/housing_fit_pressure"][:]
        self.assertEqual((fit["mean_pressure_end"], fit["lowest_pressure"]), (pressure[-1, 0], pressure[:, 1].min()))


if __name__ == "__main__":
    unittest.main()
