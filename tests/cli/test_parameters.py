"""What the program tells about its own parameters: defaults, schema, a new case, the catalogue."""

import json
import re
import shutil
import sys
import tomllib
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, settings  # noqa: E402

try:
    import jsonschema
except ImportError:
    jsonschema = None

needs_jsonschema = unittest.skipIf(jsonschema is None, "python3-jsonschema is not installed")

# What a case must add to a catalogue bearing: where it sits, what carries it, how the rotor touches it.
INSTALLATION = """type = "touchdown"
node = 2
contact_stiffness = 1.144e9
support = { mass = "85 kg", K_y = 2.7e9, K_z = 1.5e9, C_y = 3.68e3, C_z = 3.68e3 }
housing_length = "25 mm"
"""


class Defaults(ProgramTest):
    def setUp(self):
        super().setUp()
        self.text = self.succeed("defaults").stdout
        self.tree = tomllib.loads(self.text)

    def test_defaults_are_a_toml_file_with_every_section(self):
        self.assertEqual(set(self.tree), {"run", "rotor", "contact", "thermal", "statics", "preload", "integration", "output"})
        self.assertEqual(self.tree["contact"]["air_gap"], "250 um")
        self.assertEqual(self.tree["integration"]["method"], "tsitouras")

    def test_every_key_is_explained_with_unit_or_kind(self):
        lines = self.text.splitlines()
        keys = [i for i, line in enumerate(lines) if re.match(r"#?\w+ = ", line)]
        self.assertGreater(len(keys), 100)
        for i in keys:
            if lines[i].startswith("#type"):
                continue
            comment = []
            for line in reversed(lines[:i]):
                if not line.startswith("# "):
                    break
                comment.insert(0, line[2:])
            explanation = " ".join(comment)
            self.assertRegex(explanation, r"\w+.*\[.+\]", f"line {i + 1}: {lines[i]}")

    def test_a_case_built_from_the_defaults_is_sound(self):
        # The defaults, and of the reference case what has no default: the rotor, its speed, its bearings.
        reference = (PARAMS / "neisi2019.toml").read_text()
        bearings = reference[reference.index("[bearings.TB1]"):reference.index("[materials]")]
        text = self.text.replace("[run]\n", '[run]\ninitial_speed = "15200 rpm"\n', 1)
        text = text.replace("[rotor]\n", '[rotor]\ngeometry = "neisi2019-rotor.json"\n', 1)
        self.write("defaults.toml", text + bearings)
        self.assertIn("no errors found", self.succeed("check", "defaults.toml").stdout)
        self.assertGreater(self.run_case("defaults.toml", run__end_time="10 ms")["bearings"]["TB1"]["peak_contact_force"], 1000)

    def test_written_defaults_are_the_defaults(self):
        # A case that says nothing, and one that says all the defaults, have the same resolved parameters.
        sparse = ('[run]\ninitial_speed = "100 rpm"\n[rotor]\ngeometry = "neisi2019-rotor.json"\n'
                  '[bearings.A]\ntype = "linear"\nnode = 2\nstiffness = [[1e7, 0], [0, 1e7]]\n')
        full = self.text.replace("[run]\n", '[run]\ninitial_speed = "100 rpm"\n', 1)
        full = full.replace("[rotor]\n", '[rotor]\ngeometry = "neisi2019-rotor.json"\n', 1) + sparse[sparse.index("[bearings.A]"):]
        resolved = []
        for name, text in (("sparse", sparse), ("full", full)):
            self.write(f"{name}.toml", text)
            self.run_case(f"{name}.toml", output=name, run__end_time="1 ms")
            resolved.append(tomllib.loads((self.folder / name / "parameters.toml").read_text()))
        self.assertEqual(*resolved)

    def test_keys_that_may_be_given_are_written_so_that_they_can_be_switched_on(self):
        lines = [line for line in self.text.splitlines() if re.match(r"#\w+ = ", line)]
        self.assertGreater(len(lines), 30)
        for line in lines:
            tomllib.loads(line[1:])


@needs_jsonschema
class Schema(ProgramTest):
    def setUp(self):
        super().setUp()
        self.schema = json.loads(self.succeed("schema").stdout)
        self.validator = jsonschema.validators.validator_for(self.schema)(self.schema)

    def errors(self, tree):
        return [f"{'.'.join(map(str, error.absolute_path))}: {error.message[:200]}" for error in self.validator.iter_errors(tree)]

    def reference(self):
        return tomllib.loads((PARAMS / "neisi2019.toml").read_text())

    def test_the_schema_is_a_schema(self):
        self.assertIn("$schema", self.schema)
        type(self.validator).check_schema(self.schema)

    def test_the_schema_accepts_the_parameter_files(self):
        files = [*sorted(PARAMS.glob("*.toml")), PARAMS / "heat/bearing.toml"]
        self.assertGreater(len(files), 1)
        for file in files:
            with self.subTest(file.name):
                self.assertEqual(self.errors(tomllib.loads(file.read_text())), [])

    def test_the_schema_accepts_the_defaults(self):
        self.assertEqual(self.errors(tomllib.loads(self.succeed("defaults").stdout)), [])

    def test_the_schema_accepts_a_new_case(self):
        self.succeed("new", "case")
        for file in sorted((self.folder / "case").glob("*.toml")):
            self.assertEqual(self.errors(tomllib.loads(file.read_text())), [], file.name)
        self.assertEqual(json.loads((self.folder / "case/schema.json").read_text()), self.schema)

    def test_the_schema_accepts_resolved_parameters(self):
        self.run_case("reference.toml", run__end_time="1 ms")
        self.assertEqual(self.errors(tomllib.loads((self.folder / "out/parameters.toml").read_text())), [])

    def test_the_schema_accepts_catalogue_bearings(self):
        for file in sorted((PARAMS / "bearings").glob("*.toml")):
            tree = self.reference()
            tree["bearings"]["TB1"] = {"type": "touchdown", "catalogue": file.stem, "node": 2, "contact_stiffness": 1e9}
            self.assertEqual(self.errors(tree), [], file.name)

    def test_the_schema_refuses_what_the_program_refuses(self):
        for section, key, value in (
            ("contact", "air_gpa", "250 um"), ("contact", "friction_coefficient", 5), ("contact", "friction_coefficient", True),
            ("integration", "method", "euler"), ("thermal", "growth", "true"), ("bearings.TB1", "balls_per_row", 14.5),
            ("bearings.TB1", "conformity", [0.52]), ("bearings.TB1", "type", "touchdwn"), ("", "contcat", {}), ("run", "end_time", -1),
        ):
            with self.subTest(f"{section}.{key} = {value}"):
                tree = self.reference()
                place = tree
                for part in filter(None, section.split(".")):
                    place = place[part]
                place[key] = value
                self.assertNotEqual(self.errors(tree), [])


class NewCase(ProgramTest):
    def test_a_new_case_checks_and_runs(self):
        done = self.succeed("new", "my/case")
        self.assertIn("rotordrop run my/case/drop.toml", done.stdout)
        self.assertIn("no errors found", self.succeed("check", "my/case/drop.toml").stdout)
        summary = self.run_case("my/case/drop.toml", run__end_time="10 ms")
        reference = self.run_case("reference.toml", output="reference", run__end_time="10 ms")
        self.assertEqual(summary["bearings"], reference["bearings"])

    def test_a_new_case_stands_on_its_own(self):
        self.succeed("new", "case")
        (self.folder / "reference.toml").unlink()
        (self.folder / "neisi2019-rotor.json").unlink()
        (self.folder / "case").rename(self.folder / "elsewhere")
        self.succeed("check", "elsewhere/drop.toml")

    def test_what_is_suggested_in_a_new_case_works(self):
        self.succeed("new", "case")
        text = (self.folder / "case/drop.toml").read_text()
        self.assertIn('# [bearings.TB1]\n# catalogue = "6014"\n', text)
        (self.folder / "case/drop.toml").write_text(text.replace('# [bearings.TB1]\n# catalogue = "6014"\n', '[bearings.TB1]\ncatalogue = "6014"\n'))
        self.succeed("check", "case/drop.toml")


class Catalogue(ProgramTest):
    def test_every_bearing_can_be_used_in_place_of_tb1(self):
        reference = (self.folder / "reference.toml").read_text()
        begin, end = reference.index("[bearings.TB1]"), reference.index("[bearings.TB2]")
        # Bores differ: contact.bore_radius would hold for all.
        self.write("reference.toml", re.sub(r"^bore_radius = .*\n", "", reference[:begin] + reference[end:], flags=re.MULTILINE))
        files = sorted((PARAMS / "bearings").glob("*.toml"))
        self.assertGreater(len(files), 15)
        for file in files:
            with self.subTest(file.stem):
                data = tomllib.loads(file.read_text())
                outside = float(data["outer_ring_diameters"][1].removesuffix(" mm"))
                self.case(f'[bearings.TB1]\n{INSTALLATION}catalogue = "{file.stem}"\nhousing_diameters = ["{outside} mm", "{outside + 20} mm"]\n')
                self.succeed("check", "drop.toml")
                summary = self.run_case("drop.toml", "--force")
                self.assertGreater(summary["bearings"]["TB1"]["peak_contact_force"], 500)
                self.assertLess(abs(summary["energy"]["residual"]), 1e-3)
                resolved = tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]["TB1"]
                self.assertEqual(resolved["balls_per_row"], data["balls_per_row"])
                self.assertEqual(resolved["ball_diameter"], data["ball_diameter"])

    def test_a_catalogue_name_of_all_bearings_is_that_of_those_without_one(self):
        machine = (PARAMS / "own-machine/drop.toml").read_text()
        shutil.copytree(PARAMS / "own-machine", self.folder / "own")
        self.write("own/drop.toml", machine)
        self.succeed("run", "own/drop.toml", "-o", "each", *settings(run__end_time="20 us"))
        each = tomllib.loads((self.folder / "each/parameters.toml").read_text())["bearings"]
        # TB2's name and data from [bearings], TB1 with its own; what stands beside a bearing goes before the catalogue.
        common = machine.replace('catalogue = "6018"\n', "").replace("[bearings.TB1]", '[bearings]\ncatalogue = "6018"\n\n[bearings.TB1]')
        self.assertEqual(common.count("catalogue ="), 2)
        self.write("own/drop.toml", common)
        self.succeed("run", "own/drop.toml", "-o", "all", *settings(run__end_time="20 us"))
        self.assertEqual(self.summary("all")["input_warnings"], [])
        both = tomllib.loads((self.folder / "all/parameters.toml").read_text())["bearings"]
        self.assertEqual((both["TB1"], both["TB2"]), (each["TB1"], each["TB2"]))
        self.succeed("run", "all/parameters.toml", "-o", "again", *settings(run__end_time="20 us"))
        self.assertEqual(self.summary("again")["input_warnings"], [])
        own = ["--set", 'bearings.TB2.ring_mass="0.45 kg"', "--set", 'bearings.catalogue="6018"']
        self.succeed("run", "own/drop.toml", "-o", "own-mass", *settings(run__end_time="20 us"), *own)
        self.assertEqual(tomllib.loads((self.folder / "own-mass/parameters.toml").read_text())["bearings"]["TB2"]["ring_mass"], "0.45 kg")
        # A wrong name is told at its place, and once; where every bearing has a name it has no effect, and that is told.
        done = self.call("check", "own/drop.toml", "--set", 'bearings.catalogue="6081"')
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("the catalogue has no such bearing"), 1, done.stderr)
        self.assertIn('--set bearings.catalogue: bearings.catalogue = "6081": the catalogue has no such bearing', done.stderr)
        self.write("own/drop.toml", machine)
        self.assertIn("bearings.catalogue has no effect: every touchdown bearing has a value of its own", self.succeed("check", "own/drop.toml", "--set", 'bearings.catalogue="6020"').stderr)

    def test_a_count_of_all_bearings_makes_sets_of_all(self):
        case = '[bearings]\ncount = 2\n' + "".join(f'[bearings.{name}]\ncatalogue = "7014-25"\nhousing_diameters = ["110 mm", "130 mm"]\n{{}}' for name in ("TB1", "TB2"))
        found = []
        for text in (case.format("", ""), case.replace("[bearings]\ncount = 2\n", "").format("count = 2\n", "count = 2\n")):
            self.case(text)
            self.succeed("run", "drop.toml", "-o", "out", "--force", *settings(run__end_time="1 us"))
            bearings = tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]
            found.append([(bearings[name]["rows"], bearings[name]["width"], bearings[name]["C0"]) for name in ("TB1", "TB2")])
        self.assertEqual(found[0], found[1])

    def test_a_catalogue_bearing_goes_before_what_a_base_says_of_it(self):
        self.case('[bearings.TB1]\ncatalogue = "61914"\nhousing_diameters = ["100 mm", "120 mm"]\n')
        for arguments in (["drop.toml"], ["reference.toml", "--set", 'bearings.TB1.catalogue="61914"',
                                          "--set", 'bearings.TB1.housing_diameters=["100 mm", "120 mm"]', "--set", "run.end_time=1 ms"]):
            self.succeed("run", *arguments, "-o", "out", "--force")
            resolved = tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]["TB1"]
            self.assertEqual(resolved["balls_per_row"], 17)  # the 6014 of the base has 14
            self.assertEqual(resolved["outer_ring_diameters"][1], "100 mm")
            self.assertEqual(resolved["node"], 2)  # what the catalogue does not say stays the base's

    def test_values_of_the_case_go_before_those_of_the_catalogue(self):
        self.case(f'[bearings.TB3]\n{INSTALLATION}catalogue = "6014"\nhousing_diameters = ["110 mm", "130 mm"]\nballs_per_row = 12\n'.replace("node = 2", "node = 20"))
        self.run_case("drop.toml", run__end_time="1 ms")
        resolved = tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]["TB3"]
        self.assertEqual(resolved["balls_per_row"], 12)
        self.assertEqual(resolved["pitch_diameter"], "90 mm")

    def test_a_bearing_beside_the_case_is_found(self):
        (self.folder / "bearings").mkdir()
        text = (PARAMS / "bearings/6014.toml").read_text()
        self.write("bearings/mine.toml", text)
        self.case(f'[bearings.TB3]\n{INSTALLATION}catalogue = "mine"\nhousing_diameters = ["110 mm", "130 mm"]\n'.replace("node = 2", "node = 20"))
        self.succeed("check", "drop.toml")


class Check(ProgramTest):
    def test_check_says_what_it_found_and_writes_nothing(self):
        before = sorted(path.name for path in self.folder.iterdir())
        done = self.succeed("check", "reference.toml")
        self.assertRegex(done.stdout, r"rotor: 109\.69\d+ kg, Ip 0\.38999\d* kg m2, Id 4\.5535\d* kg m2")
        self.assertIn("reference.toml: no errors found", done.stdout)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), before)

    def test_check_takes_overrides(self):
        self.assertIn("at 3000 rpm", self.succeed("check", "reference.toml", *settings(run__initial_speed="3000 rpm")).stdout)

    def test_a_table_sets_its_own_keys(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run="{ end_time = '1 ms' }", contact="{ air_gap = '200 um' }", contact__friction_coefficient="0.2"))
        written = tomllib.loads((self.folder / "out/parameters.toml").read_text())
        self.assertEqual([written["contact"][key] for key in ("air_gap", "friction_coefficient", "friction_law")], ["200 um", 0.2, "regularised"])
        self.assertEqual(written["run"]["initial_speed"], "15200 rpm")

    def test_every_parameter_file_is_sound(self):
        for file in sorted(PARAMS.glob("*.toml")):
            with self.subTest(file.name):
                self.succeed("check", file)

    def test_values_in_all_units_mean_the_same(self):
        plain = self.run_case("reference.toml", output="a", run__end_time="10 ms")
        self.case('[run]\nambient = "20 degC"\ninitial_speed = "1591.7402778282 rad/s"\n[contact]\nair_gap = 0.25e-3\nbore_radius = "3.5 cm"\n'
                  '[thermal]\nh_shaft = "50 W/(m2 degC)"\nfit_resistance = "5 K/kW"\n')
        text = (self.folder / "drop.toml").read_text().replace('run.end_time = "10 ms"\n', "").replace("[run]\n", "[run]\nend_time = 0.01\n")
        self.write("drop.toml", text)
        other = self.run_case("drop.toml", output="b")
        for name in ("TB1", "TB2"):
            for key in ("peak_contact_force", "friction_heat", "first_contact_time"):
                self.assertAlmostEqual(other["bearings"][name][key], plain["bearings"][name][key], delta=1e-6 * plain["bearings"][name][key])

    def test_the_version_names_its_libraries(self):
        self.assertRegex(self.succeed("--version").stdout, r"rotordrop \d+\.\d+\.\d+ \(revision \w+\+?; SUNDIALS [\d.]+, HDF5 [\d.]+; instruction set (base|v3|v4|v4-newton)\)")

    def test_help_names_every_command(self):
        text = self.succeed("--help").stdout
        for command in ("run", "check", "modes", "defaults", "schema", "new"):
            self.assertRegex(text, rf"\n  {command} ")
            self.succeed(command, "--help")


if __name__ == "__main__":
    unittest.main()
