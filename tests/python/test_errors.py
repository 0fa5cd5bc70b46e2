"""Wrong input from Python: all faults at once, each with its parameter, its place and what is probably meant."""

import json
import os
import pathlib
import pickle
import shutil
import sys
import unittest
import warnings

import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from package import PARAMS, SETTLING, PackageTest, rd  # noqa: E402


class Faults(PackageTest):
    def faults_of(self, *arguments, **options):
        with self.assertRaises(rd.InputError) as caught:
            rd.Case(*arguments, **options)
        error = caught.exception
        for fault in error.faults:
            self.assertIn(fault.message, str(error))
        return error.faults

    def test_all_faults_of_a_file_with_their_lines_and_keys(self):
        file = self.folder / "drop.toml"
        file.write_text(f'base = "{PARAMS}/neisi2019.toml"\n[contact]\nair_gpa = "200 um"\nfriction_coefficient = -1\n\n[run]\nend_time = "5 kg"\n')
        faults = self.faults_of(file)
        by_key = {fault.key: fault for fault in faults}
        self.assertEqual(list(by_key), ["contact.air_gpa", "contact.friction_coefficient", "run.end_time"])
        self.assertEqual([fault.line for fault in faults], [3, 4, 7])
        self.assertEqual({fault.file for fault in faults}, {str(file)})
        self.assertIn('Did you mean "air_gap"', by_key["contact.air_gpa"].advice)
        self.assertGreater(by_key["run.end_time"].column, 1)
        self.assertIsInstance(faults, tuple)

    def test_overrides_are_values_of_python(self):
        faults = self.faults_of(SETTLING, {"contact.friction_coefficent": 0.05, "contact.air_gap": "3 kg", "run.end_time": -1})
        self.assertEqual({fault.key for fault in faults}, {"contact.friction_coefficent", "contact.air_gap", "run.end_time"})
        for fault in faults:
            self.assertEqual((fault.file, fault.line), ("", 0))
            self.assertNotIn("--set", fault.message + fault.advice)
        (misspelt,) = [fault for fault in faults if fault.key.endswith("efficent")]
        self.assertIn("friction_coefficient", misspelt.advice)

    def test_entries_of_lists_are_overridden(self):
        case = rd.Case(SETTLING, {"rotor.unbalance[0].me": 2e-6, "bearings.TB1.node": 3})
        self.assertEqual(case.parameters["rotor"]["unbalance"][0]["me"], 2e-6)
        self.assertEqual(case.parameters["bearings"]["TB1"]["node"], 3)
        (fault,) = self.faults_of(SETTLING, {"rotor.unbalance[7].me": 2e-6})
        self.assertEqual(fault.key, "rotor.unbalance[7].me")

    def test_single_quantities_stand_for_lists(self):
        case = rd.Case(SETTLING)
        for speed in (100, 100.0, numpy.int64(100), numpy.float32(100), "100 rad/s", [100], numpy.array([100.0])):
            self.assertEqual(case.modes(speed, 1).speed.values.tolist(), [100.0])
        found = case.critical_speeds("2000 rpm", stiffness_map="5e7 N/m")["map"]
        self.assertEqual([one["stiffness"] for one in found], [5e7])
        for wrong in (lambda: case.run(""), lambda: rd.study("s.toml", self.folder / "out", jobs=-1), lambda: case.critical_speeds(stiffness_map=["-1 N/m"])):
            with self.assertRaises(rd.InputError):
                wrong()

    def test_later_overrides_go_before_earlier_ones(self):
        def found(*overrides):
            case = rd.Case(SETTLING)
            for one in overrides:
                case = case.with_overrides(one)
            return case.parameters

        gaps = [{"contact": {"air_gap": "100 um"}}, {"contact.air_gap": "200 um"}, {"contact": {"air_gap": "300 um"}}]
        self.assertEqual(found(*gaps)["contact"]["air_gap"], "300 um")
        # A dictionary sets its own keys and leaves the others.
        together = found({"contact.air_gap": "200 um"}, {"contact": {"friction_coefficient": 0.2}})["contact"]
        self.assertEqual((together["air_gap"], together["friction_coefficient"]), ("200 um", 0.2))
        self.assertEqual(together["friction_law"], found()["contact"]["friction_law"])
        self.assertEqual(found({"contact": {"air_gap": "200 um"}}, {"contact": {"friction_coefficient": 0.2}})["contact"], together)
        rings = found({"bearings": {"TB1": {"ring_mass": 0.2}}}, {"bearings": {"TB2": {"ring_mass": 0.22}}}, {"bearings": {"TB1": {"f2": 0.3}}})["bearings"]
        self.assertEqual((rings["TB1"]["ring_mass"], rings["TB2"]["ring_mass"], rings["TB1"]["f2"]), (0.2, 0.22, 0.3))
        mixed = found({"contact": {"air_gap": "200 um", "friction_coefficient": 0.2}}, {"contact.air_gap": "250 um"}, {"contact": {"friction_coefficient": 0.1}})
        self.assertEqual((mixed["contact"]["air_gap"], mixed["contact"]["friction_coefficient"]), ("250 um", 0.1))
        # Also against an entry of a list, which the new list need not have.
        unbalance = {"rotor.unbalance": [{"node": 16, "me": 1e-6}]}
        for entry in ("rotor.unbalance[0].me", "rotor.unbalance[1].me"):
            older = {"rotor.unbalance": [{"node": 5, "me": 1e-6}, {"node": 6, "me": 1e-6}], entry: 9e-6}
            self.assertEqual([one["me"] for one in found(older, unbalance)["rotor"]["unbalance"]], [1e-6])
        self.assertEqual(found({"rotor.unbalance[0].me": 9e-6}, {"rotor": {"unbalance": unbalance["rotor.unbalance"]}})["rotor"]["unbalance"][0]["me"], 1e-6)
        self.assertEqual(found(unbalance, {"rotor.unbalance[0].me": 9e-6})["rotor"]["unbalance"][0]["me"], 9e-6)

    def test_layers_of_overrides_are_pickled_and_do_not_pile_up(self):
        case = rd.Case(SETTLING, {"run": {"end_time": "20 ms"}}).with_overrides({"run": {"initial_speed": "8000 rpm"}})
        self.assertEqual(pickle.loads(pickle.dumps(case)).parameters["run"], case.parameters["run"])
        n_bytes = []
        for k in range(1, 4):
            case = case.with_overrides({"run": {"end_time": f"{k} ms"}, "contact.air_gap": f"20{k} um"})
            n_bytes.append(len(pickle.dumps(case)))
        self.assertEqual(len(set(n_bytes)), 1, n_bytes)
        self.assertEqual((case.parameters["run"]["end_time"], case.parameters["run"]["initial_speed"]), ("3 ms", "8000 rpm"))

    def test_files_are_beside_what_names_them_wherever_the_program_is_later(self):
        (self.folder / "own").mkdir()
        shutil.copy(PARAMS / "neisi2019-rotor.json", self.folder / "own/r.json")
        base = {"base": str(SETTLING)}
        for case in (rd.Case({**base, "rotor": {"geometry": "r.json"}}, folder=self.folder / "own"), rd.Case(base, {"rotor.geometry": "r.json"}, folder=self.folder / "own"),
                     rd.Case({"base": pathlib.Path(SETTLING.name)}, folder=PARAMS)):
            self.assertIn("TB1", case.bearings)
        here = os.getcwd()
        try:
            os.chdir(self.folder)
            case = rd.Case(SETTLING, {"rotor.geometry": "own/r.json"})
            os.chdir(here)
            for same in (case.with_overrides({}), pickle.loads(pickle.dumps(case))):
                self.assertEqual(same.parameters["rotor"]["geometry"], case.parameters["rotor"]["geometry"])
            shutil.copytree(self.folder / "own", self.folder / "else/own")
            shaft = json.loads((self.folder / "own/r.json").read_text())
            shaft["elements"][0]["od"] *= 0.9
            (self.folder / "else/own/r.json").write_text(json.dumps(shaft))
            os.chdir(self.folder / "else")
            modes = [one.modes("0 rpm", 3).frequency.values.tolist() for one in (case, case.with_overrides({}), rd.Case(SETTLING, {"rotor.geometry": "own/r.json"}))]
            self.assertEqual(modes[0], modes[1])
            self.assertNotEqual(modes[0], modes[2], "the other shaft is another one")
        finally:
            os.chdir(here)

    def test_a_text_and_a_dictionary_are_cases(self):
        gap = 200e-6
        by_text = rd.Case(f'base = "{SETTLING}"\n[contact]\nair_gap = "200 um"\n', name="mine")
        by_dict = rd.Case({"base": str(SETTLING), "contact": {"air_gap": gap}}, name="mine")
        beside = rd.Case({"base": SETTLING.name, "contact": {"air_gap": gap}}, folder=PARAMS)
        self.assertEqual([case.name for case in (by_text, by_dict, beside)], ["mine", "mine", "case"])
        for case in (by_text, by_dict, beside):
            self.assertAlmostEqual(rd.si(case.parameters["contact"]["air_gap"], "m"), gap, delta=1e-18)
            self.assertEqual(case.parameters["bearings"], rd.Case(SETTLING).parameters["bearings"])
        (fault,) = self.faults_of(f'base = "{SETTLING}"\n[contact]\nair_gpa = 1e-4\n', name="mine", folder=self.folder)
        self.assertEqual((fault.key, fault.line, pathlib.Path(fault.file).name), ("contact.air_gpa", 3, "mine.toml"))
        (fault,) = self.faults_of({"base": str(SETTLING), "contact": {"air_gpa": gap}})
        self.assertEqual((fault.key, fault.file, fault.line), ("contact.air_gpa", "", 0))
        self.assertIn("air_gap", fault.advice)

    def test_arrays_of_numpy_and_nested_values(self):
        import numpy as np

        case = rd.Case(SETTLING, {"rotor.initial_offset": np.array([1e-6, 2e-6]), "run.end_time": np.float32(0.25), "thermal.growth": np.bool_(False), "bearings.TB1.node": np.int64(2)})
        self.assertEqual(case.parameters["rotor"]["initial_offset"], [1e-6, 2e-6])
        self.assertEqual(case.parameters["run"]["end_time"], 0.25)
        self.assertIs(case.parameters["thermal"]["growth"], False)
        self.assertEqual(case.parameters["bearings"]["TB1"]["node"], 2)

    def test_values_that_no_case_can_have(self):
        for value in (None, object(), b"bytes", {1: 2}):
            with self.subTest(value=value):
                (fault, *_) = self.faults_of(SETTLING, {"contact.air_gap": value})
                self.assertEqual(fault.key, "contact.air_gap")
        (fault,) = self.faults_of(SETTLING, {5: 1})
        self.assertIn("is no text", fault.message)
        (fault,) = self.faults_of(SETTLING, {"contact air_gap": 1})
        self.assertNotIn("--set", fault.advice)

    def test_files_that_are_not_there(self):
        (fault,) = self.faults_of(self.folder / "nothing.toml")
        self.assertIn("nothing.toml", str(fault))
        (fault,) = self.faults_of({"base": "nowhere.toml"}, folder=self.folder)
        self.assertIn("nowhere.toml", str(fault))
        (fault,) = self.faults_of('[contact]\nair_gap = 5 um\n')
        self.assertEqual(fault.line, 2)

    def test_what_nests_in_itself_is_refused(self):
        endless_list, endless_table, deep = [], {}, {}
        endless_list.append(endless_list)
        endless_table["a"] = endless_table
        at = deep
        for _ in range(20000):
            at = at.setdefault("a", {})
        for given in ((SETTLING, {"rotor.initial_offset": endless_list}), (endless_table,), (deep,)):
            with self.assertRaisesRegex(rd.InputError, "nested"):
                rd.Case(*given)

    def test_errors_are_pickled_with_their_faults(self):
        with self.assertRaises(rd.InputError) as caught:
            rd.Case(SETTLING, {"contact.air_gpa": 1})
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((again.faults, str(again)), (caught.exception.faults, str(caught.exception)))
        self.assertIsInstance(again, ValueError)

    def test_what_is_unusual_is_a_warning(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            case = rd.Case(SETTLING, {"rotor.unbalance[0].me": "1 kg m"})
        self.assertGreater(len(case.warnings), 0)
        self.assertEqual([w.category for w in caught], [rd.CaseWarning] * len(case.warnings))
        self.assertEqual(caught[0].filename, __file__)
        self.assertIn("rotor.unbalance[0].me", str(caught[0].message))
        self.assertEqual(case.warnings[0].key, "rotor.unbalance[0].me")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(rd.Case(SETTLING).warnings, ())

    def test_a_warning_points_at_the_line_that_called_the_package(self):
        case = rd.Case(SETTLING)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            case.with_overrides({"rotor.unbalance[0].me": "1 kg m"})
        self.assertEqual({w.filename for w in caught}, {__file__})

    def test_a_whole_number_that_is_no_integer_is_refused_with_the_reason(self):
        (fault,) = self.faults_of(SETTLING, {"bearings.TB1.node": numpy.float64(2)})
        self.assertEqual((fault.message, fault.advice), ("bearings.TB1.node = 2.0; it must be an integer >= 1.", "Write 2, without a decimal point."))

    def test_arguments_of_another_kind_are_named(self):
        case = rd.Case(SETTLING, {"run.end_time": "1 ms"})
        result = case.run()
        for wrong, words in ((lambda: case.run(keep=[5]), "keep must be paths of series"), (lambda: result[5], "name of a series must be a text"), (lambda: result.select(5), "name of a series"),
                             (lambda: rd.add_support(int), "derived from rotordrop.Support"), (lambda: rd.add_thermal_model(5), "derived from rotordrop.ThermalModel"),
                             (lambda: rd.compare("out"), "drop must be a Result"), (lambda: rd.compare(result, "out"), "against must be a Result"), (lambda: case.preload(drop="out"), "drop must be a Result"),
                             (lambda: rd.Case(SETTLING, "contact.air_gap=1e-4"), "overrides must be a dictionary, such as")):
            with self.subTest(words), self.assertRaisesRegex(TypeError, words):
                wrong()

    def test_quantities(self):
        self.assertEqual((rd.si(5, "mm"), rd.si("5 m", "mm"), rd.si("5", "mm")), (5, 5000, 5))
        self.assertAlmostEqual(rd.si("15200 rpm", "rad/s"), 15200 * 3.141592653589793 / 30, delta=1e-9)
        self.assertEqual(rd.si(5, "m"), 5.0)
        with self.assertRaises(rd.InputError) as caught:
            rd.si("3 kg", "m", "stiffness")
        self.assertIn("stiffness", str(caught.exception))
        for quantity in (5, "5 m"):
            with self.subTest(quantity), self.assertRaisesRegex(rd.InputError, "'foo' is not known"):
                rd.si(quantity, "foo")

    def test_units_that_count_from_another_zero_are_no_targets(self):
        """As a rise or as a temperature: 68 degF would be 37.8 or 20 degC."""
        for unit in ("degC", "degF"):
            for quantity in ("68 degF", 20.0):
                with self.subTest(unit), self.assertRaisesRegex(rd.InputError, "counts from another zero than 0 K"):
                    rd.si(quantity, unit)
        self.assertAlmostEqual(rd.si("68 degF", "K"), 293.15, delta=1e-9)
        self.assertEqual(rd.si("1 K", "mK"), 1000)

    def test_bounds_of_a_comparison_need_their_units(self):
        result = rd.Case(SETTLING, {"run.end_time": "1 ms"}).run()
        for name in ("tolerance", "floor", "growth_tolerance", "band_length"):
            for bare in ("5", " 5e-3 "):
                with self.subTest(name), self.assertRaisesRegex(rd.InputError, f"{name}: must have its unit, such as"):
                    rd.compare(result, result, **{name: bare})

    def test_numbers_and_texts_that_a_case_cannot_hold_are_refused_with_their_key(self):
        for value in (10**400, "\ud800 um"):
            with self.assertRaisesRegex(rd.InputError, "contact.air_gap"):
                rd.Case(SETTLING, {"contact.air_gap": value})
        case = rd.Case(SETTLING, {"contact.air_gap": numpy.longdouble(2e-4)})
        self.assertEqual(case.parameters["contact"]["air_gap"], 2e-4)


if __name__ == "__main__":
    unittest.main()
