"""Supports written in Python: the built-in spring and damper written again gives the built-in's motion, energy closes, and faults of the class come out."""

import json
import sys
import unittest

import numpy as np

sys.path.insert(0, __file__.rpartition("/")[0])
from package import PARAMS, SETTLING, PackageTest, rd  # noqa: E402

STIFFNESS, DAMPING = 5e6, 2e3  # [N/m], [N s/m]


class Spring(rd.Support):
    """Spring and damper to the ground, as the built-in type "linear"."""

    type = "python-spring"
    parameters = {"stiffness": rd.Quantity("N/m"), "damping": rd.Quantity("N s/m", "0 N s/m")}
    series = (rd.Series("position", "m", "position of the rotor", ("y", "z")), rd.Series("velocity", "m/s", "velocity of the rotor", ("y", "z")))

    def evaluate(self, seen, state):
        k, c, at = self.values["stiffness"], self.values["damping"], seen.journal
        return rd.SupportResponse(
            force_y=-k * at.y - c * at.velocity_y,
            force_z=-k * at.z - c * at.velocity_z,
            dissipation=c * (at.velocity_y**2 + at.velocity_z**2),
            observed=(at.y, at.z, at.velocity_y, at.velocity_z),
        )

    def energy(self, seen, state):
        return 0.5 * self.values["stiffness"] * (seen.journal.y**2 + seen.journal.z**2)


class Maxwell(rd.Support):
    """A spring in series with a damper: the damper's stretch is a state."""

    type = "python-maxwell"
    parameters = {"stiffness": rd.Quantity("N/m"), "damping": rd.Quantity("N s/m")}
    states = (rd.State("stretch y", "m", 1e-5), rd.State("stretch z", "m", 1e-5))

    def evaluate(self, seen, state):
        k, c = self.values["stiffness"], self.values["damping"]
        forces = [-k * (seen.journal.y - state[0]), -k * (seen.journal.z - state[1])]
        rates = [-force / c for force in forces]
        return rd.SupportResponse(*forces, dissipation=c * (rates[0] ** 2 + rates[1] ** 2), rates=rates)

    def energy(self, seen, state):
        return 0.5 * self.values["stiffness"] * ((seen.journal.y - state[0]) ** 2 + (seen.journal.z - state[1]) ** 2)


class Push(rd.Support):
    """A force that begins at a known time."""

    type = "python-push"
    parameters = {"force": rd.Quantity("N"), "begin": rd.Quantity("s")}
    series = (rd.Series("position", "m", "position of the rotor"),)

    def instants(self):
        return [self.values["begin"]]

    def evaluate(self, seen, state):
        force = self.values["force"] if seen.time >= self.values["begin"] else 0.0
        return rd.SupportResponse(force_y=force, prescribed_work=force * seen.journal.velocity_y, observed=(seen.journal.y,))

    def energy(self, seen, state):
        return 0.0


class SpringOfUnknownEnergy(Spring):
    type = "python-spring-of-unknown-energy"

    def energy(self, seen, state):
        return float("nan")


class Supports(PackageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        rd.add_support(Spring)
        rd.add_support(SpringOfUnknownEnergy)
        rd.add_support(Maxwell)
        rd.add_support(Push)

    def case(self, support, overrides=None):
        bearings = {"A": {**support, "node": 2}, "B": {**support, "node": 28}}
        tree = {"run": {"initial_speed": "6000 rpm", "end_time": "20 ms"}, "rotor": {"geometry": str(PARAMS / "neisi2019-rotor.json"), "unbalance": [{"node": 16, "me": 2e-5, "angle": 0}]},
                "bearings": bearings, "integration": {"tolerance": 1e-9}}
        return rd.Case(tree, overrides, name="own")

    def test_the_builtin_written_again_moves_likewise(self):
        square = [[STIFFNESS, 0], [0, STIFFNESS]], [[DAMPING, 0], [0, DAMPING]]
        builtin = self.case({"type": "linear", "stiffness": square[0], "damping": square[1]}).run()
        python = self.case({"type": "python-spring", "stiffness": STIFFNESS, "damping": DAMPING}).run()
        force = builtin["bearings.A.support_force"].values
        largest = float(np.abs(force).max())
        self.assertGreater(largest, 100, "N")
        # The same equations in another order of operations, with error control at 1e-9.
        again = -STIFFNESS * python["bearings.A.position"].values - DAMPING * python["bearings.A.velocity"].values
        self.assertLess(float(np.abs(again - force).max()), 1e-5 * largest)
        self.assertEqual(python["bearings.B.velocity"].attrs["units"], "m/s")
        energy = python.summary["energy"]
        self.assertGreater(energy["dissipated"], 1e-3)
        self.assertLess(abs(energy["residual"]), 1e-6 * energy["dissipated"])

    def test_states_are_integrated_and_energy_closes(self):
        result = self.case({"type": "python-maxwell", "stiffness": STIFFNESS, "damping": DAMPING}).run()
        energy = result.summary["energy"]
        self.assertGreater(energy["dissipated"], 1e-3)
        self.assertLess(abs(energy["residual"]), 1e-6 * energy["dissipated"])

    def test_steps_end_where_a_force_begins(self):
        # Two forces F at one time move a rigid rotor's centre of gravity by 2 F / m s^2 / 2, s since then.
        begin, force = 7.0123e-3, 300.0
        rigid = {"rotor.model": "rigid", "rotor.unbalance": [], "run.gravity": 0, "run.initial_speed": 0}
        for method in ("tsitouras", "runge-kutta-4", "fehlberg-8"):
            result = self.case({"type": "python-push", "force": force, "begin": begin}, {**rigid, "integration.method": method}).run()
            geometry = json.loads((PARAMS / "neisi2019-rotor.json").read_text())
            x_a, x_b = (geometry["nodes"][node - 1]["x"] for node in (2, 28))
            a, b = (np.ravel(result[f"bearings.{name}.position"].values) for name in "AB")
            rotor = result.summary["rotor"]
            centre = a + (rotor["centre_of_gravity"] - x_a) / (x_b - x_a) * (b - a)
            since = np.maximum(result.series.time.values - begin, 0)
            self.assertLess(float(np.abs(centre - force / rotor["mass"] * since**2).max()), 1e-14, f"m, of 0.5 mm, by {method}")

    def test_what_is_not_booked_shows(self):
        class Forgetful(Spring):
            type = "python-forgetful"

            def evaluate(self, seen, state):
                response = super().evaluate(seen, state)
                at, c = seen.journal, self.values["damping"]
                return rd.SupportResponse(-self.values["stiffness"] * at.y - c * at.velocity_y, -self.values["stiffness"] * at.z - c * at.velocity_z, observed=(0.0, 0.0, 0.0, 0.0)) if response else None

        rd.add_support(Forgetful)
        energy = self.case({"type": "python-forgetful", "stiffness": STIFFNESS, "damping": DAMPING}).run().summary["energy"]
        self.assertGreater(abs(energy["residual"]), 1e-3)

    def test_a_balance_that_is_no_number_is_told(self):
        unknown = {"type": "python-spring-of-unknown-energy", "stiffness": STIFFNESS, "damping": DAMPING}
        result = self.case(unknown, {"run.end_time": "1 ms"}).run()
        self.assertIn("energy-residual", [warning["code"] for warning in result.summary["warnings"]])
        self.assertIn("energy-residual", result.text)
        with self.assertRaisesRegex(rd.SolverError, "energy-residual"):
            self.case(unknown, {"run.end_time": "1 ms", "run.fatal_warnings": ["energy-residual"]}).run()

    def test_keys_are_checked_like_all_others(self):
        with self.assertRaises(rd.InputError) as caught:
            self.case({"type": "python-spring", "stifness": STIFFNESS})
        advice = " ".join(fault.message + fault.advice for fault in caught.exception.faults)
        self.assertIn("stiffness", advice)
        with self.assertRaises(rd.InputError):
            self.case({"type": "python-spring", "stiffness": "3 kg"})
        case = self.case({"type": "python-spring", "stiffness": "5000 N/mm"})
        self.assertIn("A", case.parameters["bearings"])

    def test_exceptions_and_wrong_sizes_come_out(self):
        class Faulty(Spring):
            type = "python-faulty"
            mistake = "raise"

            def evaluate(self, seen, state):
                if self.mistake == "raise":
                    raise ZeroDivisionError("in evaluate")
                return rd.SupportResponse(rates=(1.0,), observed=(0.0, 0.0, 0.0, 0.0)) if self.mistake == "rates" else rd.SupportResponse()

        rd.add_support(Faulty)
        case = self.case({"type": "python-faulty", "stiffness": 1e6})
        with self.assertRaisesRegex(ZeroDivisionError, "in evaluate"):
            case.run()
        Faulty.mistake = "rates"
        with self.assertRaisesRegex(ValueError, "return 0 rates, and returned 1"):
            case.run()
        Faulty.mistake = "observed"
        with self.assertRaisesRegex(ValueError, "return 4 observed, and returned 0"):
            case.run()

    def test_wrong_returns_and_wrong_names_are_explained(self):
        state, series = rd.State("stretch", "m", 1e-5), rd.Series("position", "m", "position", ("y",))
        for name, attributes, message in (
            ("python-none", {"evaluate": lambda self, seen, state: None}, r"A\.evaluate\(\) must return a SupportResponse, and returned None"),
            ("python-energy", {"energy": lambda self, seen, state: 1j}, r"A\.energy\(\) must return a number, and returned 1j"),
            ("python-start", {"states": [state], "initial_state": lambda self: [1j]}, r"initial_state\(\) must return 1 number, and returned \[1j\]"),
            ("python-scale", {"states": [state._replace(scale=0.0)]}, r'bearings\.A: the scale of state "stretch" must be larger than 0 and is 0'),
            ("python-no-scale", {"states": [state._replace(scale=float("nan"))]}, r"must be larger than 0 and is nan"),
            ("python-states", {"states": [state, state]}, r'bearings\.A: state "stretch" stands twice'),
            ("python-series", {"series": [series, series]}, r'bearings\.A: series "position" stands twice'),
            ("python-nameless", {"series": [series._replace(name="")]}, r"bearings\.A: the name of a series is empty"),
            ("python-complex", {"energy": lambda self, seen, state: np.complex128(1 + 2j)}, r"A\.energy\(\) must return a number"),
            ("python-letters", {"energy": lambda self, seen, state: "x" + 80 * "é"}, r"energy\(\) must return a number, and returned 'xé"),
            ("python-within", {"series": [series, series._replace(name="position/y")]}, r'"position" and "position/y" cannot both be datasets'),
            ("python-dot", {"series": [series._replace(name="./position")]}, r'"\./position" cannot be the name of a dataset'),
            ("python-path", {"series": [series._replace(name="a//b")]}, r'"a//b" cannot be the name of a dataset'),
            ("python-dotted", {"series": [series._replace(name="a.b")]}, r'"a\.b" cannot have a dot in its name'),
            ("python-time", {"series": [series._replace(name="time")]}, r'"time" cannot be called so'),
            ("python-instant", {"instants": lambda self: 0.01}, r"A\.instants\(\) must return a list of times \[s\], and returned 0\.01"),
            ("python-no-instant", {"instants": lambda self: [float("nan")]}, r"A\.instants\(\) must return times of 0 s and later, and returned nan"),
            ("python-before", {"instants": lambda self: [0.01, -1e-3]}, r"and returned -0\.001"),
            ("python-columns", {"series": [series._replace(columns=("u", "u"))]}, r'"position" has two columns "u"'),
        ):
            with self.subTest(name), self.assertRaisesRegex(ValueError, message):
                rd.add_support(type("Wrong", (Spring,), {"type": name, **attributes}))
                self.case({"type": name, "stiffness": 1e6}).run()

    def test_keys_that_no_case_can_have_are_refused_at_once(self):
        for name, quantity, message in (
            ("a.b", rd.Quantity("m"), r'wrong\.parameters: a key cannot be called "a\.b"'),
            ("", rd.Quantity("m"), r'a key cannot be called ""'),
            ("a b", rd.Quantity("m"), r'a key cannot be called "a b"'),
            ("node", rd.Quantity("m"), r'the key "node" is taken'),
            ("type", rd.Quantity("m"), r'the key "type" is taken'),
            ("gap", rd.Quantity("foo"), r'the unit "foo" of "gap" is not known'),
            ("gap", rd.Quantity("m", "3 kg"), r"gap"),
        ):
            with self.subTest(name, quantity=quantity), self.assertRaisesRegex(rd.InputError, message):
                rd.add_support(type("Wrong", (Spring,), {"type": "wrong", "parameters": {name: quantity}}))

    def test_dimensions_are_shared_only_by_series_with_the_same_columns(self):
        class Reporting(Spring):
            type = "python-reporting"
            series = (
                rd.Series("growth", "m", "two surfaces", ("shaft", "bore")),
                rd.Series("one", "N", "one row", ("row 1",)),
                rd.Series("two", "N", "two rows", ("row 1", "row 2")),
                rd.Series("row", "N", "called as a dimension", ("row 1", "row 2", "row 3")),
            )

            def evaluate(self, seen, state):
                k, at = self.values["stiffness"], seen.journal
                return rd.SupportResponse(force_y=-k * at.y, force_z=-k * at.z, observed=range(8))

        rd.add_support(Reporting)
        result = rd.Case(SETTLING, {"run.end_time": "1 ms", "bearings.S.type": "python-reporting", "bearings.S.node": 16, "bearings.S.stiffness": 1e3}).run()
        self.assertEqual(result.series["bearings.TB1.ball_force"].dims[1], "TB1.row")
        self.assertEqual(result.series["bearings.S.two"].shape[1], 2)
        self.assertEqual(result["bearings.S.two"].dims, result.series["bearings.S.two"].dims)
        own = result.bearings["S"]
        np.testing.assert_array_equal(own["row"].values[0], [5, 6, 7])
        np.testing.assert_array_equal(own["growth"].values[0], [0, 1])
        self.assertEqual(list(result.frame("bearings.S.growth").columns), ["bearings.S.growth.shaft", "bearings.S.growth.bore"])
        self.assertIn("bearings.S.two.row 2", result.frame().columns)

    def test_ctrl_c_within_a_part_ends_a_study(self):
        class Interrupted(Spring):
            type = "python-interrupted"

            def evaluate(self, seen, state):
                if seen.time > 1e-3:
                    raise KeyboardInterrupt
                return super().evaluate(seen, state)

        class InterruptedAtFirst(Spring):
            type = "python-interrupted-at-first"

            def initial_state(self):
                raise KeyboardInterrupt

        rd.add_support(InterruptedAtFirst)
        rd.add_support(Interrupted)
        case = self.case({"type": "python-interrupted", "stiffness": STIFFNESS})
        with self.assertRaises(KeyboardInterrupt):
            case.run()
        self.interrupt_a_study_of(case)
        self.interrupt_a_study_of(self.case({"type": "python-interrupted-at-first", "stiffness": STIFFNESS}))

    def interrupt_a_study_of(self, case):
        (self.folder / "case.toml").write_text(case.text, encoding="utf-8")
        study = self.folder / "study.toml"
        study.write_text('case = "case.toml"\n[vary]\nrun.initial_speed = ["5000 rpm", "6000 rpm"]\n[design]\nkind = "list"\n', encoding="utf-8")
        with self.assertRaises(KeyboardInterrupt):
            rd.study(study, self.folder / "study", jobs=1, force=True)

    def test_a_class_can_be_replaced_by_one_with_the_same_keys(self):
        class Again(Spring):
            """The same keys."""

            def energy(self, seen, state):
                raise OSError("of the new class")

        self.addCleanup(rd.add_support, Spring)
        case = self.case({"type": "python-spring", "stiffness": STIFFNESS})
        rd.add_support(Again)
        with self.assertRaisesRegex(OSError, "of the new class"):
            case.run()

        class Other(Spring):
            parameters = {"mass": rd.Quantity("kg")}

        with self.assertRaisesRegex(ValueError, "cannot change"):
            rd.add_support(Other)
        with self.assertRaises(ValueError):
            rd.add_support(type("Builtin", (Spring,), {"type": "linear"}))


if __name__ == "__main__":
    unittest.main()
