"""Typical mistakes of a newcomer: each message says what is wrong in plain words, where, and how it is meant.

Where a message offers a line, that line is put into the case and must be accepted: advice that does not work is worse than none.
"""

import json
import re
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HEATED_DISC, PARAMS, ProgramTest  # noqa: E402

CONTACT = '[contact]\nair_gap = "250 um"\n'
# What was done, the text after the base, what the message says, and the line that it offers (None: none).
MISTAKES = [
    ("a unit of another dimension", '[contact]\nair_gap = "250 N"\n', r"drop\.toml:3:11: 250 N is a force; contact\.air_gap needs a length such as", None),
    ("a decimal comma in a quantity", '[contact]\nair_gap = "0,25 mm"\n', "Write a decimal point, not a comma", None),
    ("a decimal comma", "[contact]\nfriction_coefficient = 0,1\n", "a number has a decimal point, not a comma", "friction_coefficient = 0.1"),
    ("a missing closing quote", '[contact]\nair_gap = "250 um\n', "a text has no closing quote", 'air_gap = "250 um"'),
    ("no quotes around a unit", "[contact]\nair_gap = 250 um\n", "a value with a unit is in quotes", 'air_gap = "250 um"'),
    ("no quotes around a word", "[contact]\nfriction_law = regularised\n", "a text is in quotes", 'friction_law = "regularised"'),
    ("quotes of a word processor", "[contact]\nair_gap = \u201c250 um\u201d\n", "quotes are straight", 'air_gap = "250 um"'),
    ("a colon for the equals sign", '[contact]\nair_gap: "250 um"\n', "a value follows an equals sign", 'air_gap = "250 um"'),
    ("no equals sign", '[contact]\nair_gap "250 um"\n', "there is no equals sign", 'air_gap = "250 um"'),
    ("True for true", "[thermal]\ngrowth = True\n", "in small letters", "growth = true"),
    ("yes for true", "[thermal]\ngrowth = yes\n", "in small letters", "growth = true"),
    ("a number that begins with its point", "[contact]\nfriction_coefficient = .1\n", "a number begins with a digit", "friction_coefficient = 0.1"),
    ("nothing behind the equals sign", "[contact]\nair_gap =\n", "air_gap has no value", None),
    ("a section without its bracket", '[contact\nair_gap = "250 um"\n', "the name of a section has no closing bracket", "[contact]"),
    ("a section twice", CONTACT + "[contact]\nfriction_coefficient = 0.1\n", r"the section \[contact\] is there twice, first in line 2", None),
    ("a key twice", CONTACT + 'air_gap = "200 um"\n', "air_gap is given twice, first in line 3: remove one", None),
    ("a comment of another language", "// soft\n" + CONTACT, "a comment begins with #", "# soft"),
    ("a list with units without quotes", "[rotor]\ninitial_offset = [1 um, 0]\n", "a value with a unit is in quotes, in lists, too", 'initial_offset = ["1 um", 0]'),
    ("a backslash in the name of a file", '[rotor]\ngeometry = "C:\\my\\rotor.json"\n', "a backslash has a meaning of its own", 'geometry = "C:/my/rotor.json"'),
    ("a table in braces over two lines", '[bearings.TB1]\nsupport = { mass = "85 kg",\n K_y = 2 }\n', "a table in braces is on one line", None),
    ("a key outside its section", 'air_gap = "250 um"\n', r"known in \[contact\]", None),
    ("a mistyped key", '[contact]\nair_gpa = "250 um"\n', 'Did you mean "air_gap"', None),
    ("a mistyped word", '[contact]\nfriction_law = "regularized"\n', 'Did you mean "regularised"', None),
    ("a point of a section's name left out", '[bearings TB1]\nf2 = 0.25\n', "parts of a section's name are joined by a point", "[bearings.TB1]"),
    ("a section as YAML has it", "contact:\n  friction_coefficient = 0.1\n", "the name of a section is in brackets", "[contact]"),
    ("a bearing with its maker", '[bearings.TB1]\ncatalogue = "SKF 6014"\n', 'Did you mean "6014"', None),
    ("a bearing with its seals", '[bearings.TB1]\ncatalogue = "6014-2RS"\n', 'Did you mean "6014"', None),
    ("a bearing's number without quotes", "[bearings.TB1]\ncatalogue = 6014\n", r"bearings\.TB1\.catalogue is an integer; it must be a text in quotes", 'catalogue = "6014"'),
    ("a space in a number", '[rotor]\nunbalance = [{ node = 5, me = "1.07 e-6 kg m" }]\n', 'has a space within its number.*Write it without: "1.07e-6 kg m"', None),
    ("an unknown bearing", '[bearings.TB1]\ncatalogue = "6o14"\n', 'Did you mean "6014"', None),
    ("a bearing too big for its housing", '[bearings.TB1]\ncatalogue = "6020"\n', r"housing_diameters = \[\"150 mm\", ", None),
    ("a file that is not there", '[rotor]\ngeometry = "rotr.json"\n', r'rotor\.geometry = "rotr\.json": there is no such file', None),
    ("a star without quotes", '[limits]\nbearings.*.peak_contact_force.max = "8 kN"\n', r"a name with \* is in quotes", '"bearings.*.peak_contact_force" = { max = "8 kN" }'),
    ("a bearing without quotes", "[bearings.TB1]\ncatalogue = 6014-C3-hybrid\n", "a text is in quotes, also one that begins with digits", 'catalogue = "6014-C3-hybrid"'),
    ("no quotes in a table", '[bearings.TB1]\nsupport = { type = linear, mass = "85 kg", K_y = 2e9, K_z = 2e9, C_y = 3e3, C_z = 3e3 }\n', "a text is in quotes, in lists and tables, too",
     'support = { type = "linear", mass = "85 kg", K_y = 2e9, K_z = 2e9, C_y = 3e3, C_z = 3e3 }'),
    ("millimetres without their unit", "[contact]\nair_gap = 0.25\n", "the air gap of 250 mm is more than a fifth of the bore radius|air_gap = 250 mm is not smaller than bore_radius", None),
    ("thousands with a comma", "[run]\ninitial_speed = 15,200 rpm\n", r"a number has no comma.*If a decimal point is meant: initial_speed = \"15\.200 rpm\"", 'initial_speed = "15200 rpm"'),
    ("a fraction", "[contact]\nexponent = 10/9\n", "a number is no fraction", "exponent = 1.1111111111111112"),
    ("a fraction in quotes", '[contact]\nexponent = "10/9"\n', r'"10/9" is a fraction.*Write it as a decimal number: 1\.1111111111111112', None),
    ("a semicolon behind a value", '[contact]\nair_gap = "250 um";\n', "nothing stands behind a value but a comment", 'air_gap = "250 um"'),
    ("another language's comment behind a value", "[contact]\nfriction_coefficient = 0.1 // dry\n", "nothing stands behind a value but a comment", "friction_coefficient = 0.1"),
    ("no comma in a list", '[bearings.TB1]\nhousing_diameters = ["110 mm" "130 mm"]\n', "entries of a list are separated by commas", 'housing_diameters = ["110 mm", "130 mm"]'),
    ("a unit behind the quotes", '[contact]\nair_gap = "250" um\n', "number and unit are together in quotes", 'air_gap = "250 um"'),
    ("a unit alone in quotes", '[contact]\nair_gap = 0.25 "mm"\n', "number and unit are together in quotes", 'air_gap = "0.25 mm"'),
    ("two equals signs", "[contact]\nfriction_coefficient == 0.1\n", "there is one equals sign", "friction_coefficient = 0.1"),
    ("a space in a key", '[run]\ninitial speed = "15200 rpm"\n', "the name of a key has no spaces", 'initial_speed = "15200 rpm"'),
    ("no comma in a table in braces", '[bearings.TB1]\nsupport = { mass = "85 kg" K_y = 2e9, K_z = 2e9, C_y = 3e3, C_z = 3e3 }\n', "entries of a table in braces are separated by commas",
     'support = { mass = "85 kg", K_y = 2e9, K_z = 2e9, C_y = 3e3, C_z = 3e3 }'),
    ("round brackets around a list", "[bearings.TB1]\nconformity = (0.52, 0.53)\n", "a list is in square brackets", "conformity = [0.52, 0.53]"),
    ("a semicolon before the unit", "[run]\ninitial_speed = 12000; rpm\n", "number and unit are together in quotes", 'initial_speed = "12000 rpm"'),
    ("a backslash that begins a number of a letter", '[rotor]\ngeometry = "C:\\users\\rotor.json"\n', "a backslash has a meaning of its own", 'geometry = "C:/users/rotor.json"'),
    ("words alone", "[contact]\nsoft contact\n", "a line is KEY = VALUE, the name of a section in brackets, or a comment", None),
    ("a word alone", "[contact]\nsoft\n", "a line is KEY = VALUE", None),
    ("capital units", '[contact]\nair_gap = "0.25 MM"\n', 'Did you mean "0.25 mm"', None),
    ("capital rpm", '[run]\ninitial_speed = "15200 RPM"\n', 'Did you mean "15200 rpm"', None),
    ("degrees Celsius as C", '[run]\nambient = "20 C"\n', '20 C is an electric charge.*Did you mean "20 degC"', None),
    ("a denominator without parentheses", '[thermal]\nh_shaft = "50 W/m2 K"\n', r'Did you mean "50 W/\(m2 K\)"', None),
    ("a temperature in degrees Celsius", "[run]\nambient = 20\n", 'out of range.*If degC is meant, write "20 degC"', None),
    ("an angle in degrees", "[bearings.TB2]\ncontact_angle = 25\n", 'out of range.*If deg is meant, write "25 deg"', None),
    ("a bearing's name in small letters", '[bearings.tb1]\nwidth = "21 mm"\n', 'Did you mean "bearings.TB1"', None),
    ("a bearing's table without its place", '[TB1]\nwidth = "21 mm"\n', r"write \[bearings\.TB1\]", None),
    ("yes in quotes", '[run]\nsecond_opinion = "yes"\n', "must be true or false, without quotes.*Write true", None),
    ("a balance grade without G", "[rotor]\nbalance_grade = 40\n", r'rotor\.balance_grade = 40 is not a balance grade.*Did you mean "G40"', None),
    ("a name of a file with line breaks", '[rotor]\ngeometry = "C:\\rotor\\new.json"\n', r"it holds a line break.*write / ", None),
]


class Newcomers(ProgramTest):
    def test_each_mistake_has_a_message_to_act_upon(self):
        for what, text, says, line in MISTAKES:
            with self.subTest(what):
                self.write("drop.toml", 'base = "reference.toml"\n' + text)
                done = self.call("check", "drop.toml")
                self.assertEqual(done.returncode, 2)
                said = re.sub(r"\s+", " ", done.stderr)
                self.assertRegex(said, says)
                self.assertNotRegex(said, "saw '|error while parsing", "the parser's words")
                offered = re.search(r"Write it as: (.*)", done.stderr)
                self.assertEqual(offered[1] if offered else None, line, done.stderr)
                if line and "C:/" not in line:
                    number = int(re.search(r"drop\.toml:(\d+)", done.stderr)[1])
                    lines = (self.folder / "drop.toml").read_text().splitlines()
                    # The parser may find a mistake only on the next line.
                    fixed = []
                    for place in (number - 1, number - 2):
                        mended = lines[:place] + [line] + lines[place + 1:]
                        self.write("mended.toml", "\n".join(mended) + "\n")
                        fixed.append(self.call("check", "mended.toml").returncode)
                    self.assertIn(0, fixed, "the offered line works")

    def test_what_set_offers_works_or_is_not_offered(self):
        done = self.call("check", "reference.toml", "--set", "bearings.TB1.catalogue=6014")
        self.assertEqual(done.returncode, 2)
        self.assertIn("""Write it as: --set 'bearings.TB1.catalogue="6014"'""", done.stderr)
        self.succeed("check", "reference.toml", "--set", 'bearings.TB1.catalogue="6014"')
        for refused in ('run.gravity="1 g"', 'run.initial_speed="15200 1/min"', 'bearings.TB1.housing_diameters="140 mm"', "bearings.TB1.housing_diameters=140 mm"):
            done = self.call("check", "reference.toml", "--set", refused)
            self.assertEqual(done.returncode, 2)
            self.assertNotIn("Write it as", done.stderr, refused)

    def test_another_kind_of_file_is_told_what_it_is(self):
        for name, content, says in (("rotor.json", b'{"nodes": []}', r"in JSON; a parameter file is in TOML.*\[rotor\] geometry = "), ("results.h5", b"\x89HDF\r\n\x1a\n", "a file of results"),
                                    ("shaft.csv", b"x;od\n0;90\n", "a table .*new FOLDER --from"), ("utf16.toml", "[run]\n".encode("utf-16"), "UTF-16.*Save it as UTF-8"),
                                    ("latin.toml", "[run]\n# Wälzlager\n".encode("latin-1"), "latin.toml:2:1: this line has a letter that is no UTF-8")):
            (self.folder / name).write_bytes(content)
            done = self.call("check", name)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(re.sub(r"\s+", " ", done.stderr), says)

    def test_a_modulus_without_its_unit_is_given_the_usual_one(self):
        rotor = json.loads((PARAMS / "neisi2019-rotor.json").read_text())
        for modulus, meant in ((200, "200 GPa"), (200000, "200000 MPa")):
            rotor["material"]["E"] = modulus
            (self.folder / "rotor.json").write_text(json.dumps(rotor))
            done = self.call("check", "reference.toml", "--set", 'rotor.geometry="rotor.json"')
            self.assertEqual(done.returncode, 2)
            self.assertIn(f'write "{meant}"', done.stderr)

    def test_a_file_given_to_another_command_is_told_where_it_belongs(self):
        self.write("study.toml", 'case = "reference.toml"\n[vary]\ncontact.friction_coefficient = [0.05, 0.1]\n')
        self.write("disc.toml", "output_times = [1]\n" + HEATED_DISC)
        for words, says in ((["run", "study.toml"], "this is a study, not the case of a drop. Its command: rotordrop study study.toml"), (["check", "study.toml"], "this is a study"),
                            (["run", "disc.toml"], "this is a case of heat conduction alone, not the case of a drop. Its command: rotordrop heat disc.toml"),
                            (["study", "reference.toml"], 'this is the case of a drop, not a study. Its command: rotordrop run reference.toml, or name it in a study by case = "reference.toml"'),
                            (["run", PARAMS / "bearings/6014.toml"], 'this is a bearing of the catalogue, not a case. Name it in the case: [bearings.NAME] with catalogue = "6014"'),
                            (["study", PARAMS / "bearings/6014.toml"], "this is a bearing of the catalogue, not a case"),
                            (["rerun", "reference.toml"], "this is a file of parameters, not results.h5 of a drop. A case is computed by: rotordrop run reference.toml"),
                            (["study", "disc.toml"], "this is a case of heat conduction alone, not a study")):
            done = self.call(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(says, " ".join(done.stderr.split()))
            self.assertEqual(done.stderr.count("error: "), 1, done.stderr)

    def test_a_case_that_is_not_there_is_answered_with_the_near_one(self):
        self.write("drop.toml", 'base = "reference.toml"\n')
        for name in ("drop", "dorp.toml", "./drp.toml"):
            self.assertRegex(self.call("check", name).stderr, r'Did you mean "(\./)?drop\.toml"')
        self.assertNotIn("Did you mean", self.call("check", "xylophone.toml").stderr)

    def test_a_case_of_the_program_is_answered_with_its_place(self):
        for command, name, own in (("run", "neisi2019-ribbon.toml", "neisi2019-ribbon.toml"), ("check", "vertical-drop", "vertical-drop.toml"),
                                   ("study", "support-damping.toml", "studies/support-damping.toml"), ("heat", "ring-in-housing.toml", "heat/ring-in-housing.toml")):
            told = self.call(command, name)
            self.assertEqual(told.returncode, 2)
            self.assertIn(f"The program brings one of this name along: {PARAMS / own}", told.stderr)
        place = re.search(r"along: (.+)", self.call("check", "vertical-drop").stderr)[1]
        self.succeed("check", place)

    def test_usual_slips_warn(self):
        for text, says in (("[run]\ninitial_speed = 9000\n", 'If rpm is meant, write "9000 rpm"'), ("[contact]\nair_gap = 0.25\n", "air_gap"), ('[contact]\nair_gap = "5 mm"\n', "is unusual")):
            self.write("drop.toml", 'base = "reference.toml"\n' + text)
            done = self.call("check", "drop.toml")
            self.assertIn(says, done.stderr)

    def test_results_that_are_there_are_not_replaced_by_accident(self):
        case = self.case('run.end_time = "1 ms"\n'.replace("run.end_time", "output.interval"))
        self.succeed("run", case, "-o", "out")
        done = self.call("run", case, "-o", "out")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "-o DIR.*--force.*--resume")


if __name__ == "__main__":
    unittest.main()
