"""A machine of one's own: the example that `new --own` makes, shafts as tables, and what a first user gets wrong on the way."""

import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import SOURCE, ProgramTest  # noqa: E402

EXAMPLE = SOURCE / "params/own-machine"


def sections():
    """Rows of the example's table as numbers in SI."""
    lines = [line for line in (EXAMPLE / "shaft.csv").read_text().splitlines() if not line.startswith("#")]
    for row in csv.reader(lines[1:]):
        length, outside, bore, mass = (float(word.strip() or 0) for word in row[:4])
        yield length * 1e-3, outside * 1e-3, bore * 1e-3, mass


class OwnMachine(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("new", "mine", "--own")
        self.file = self.folder / "mine/drop.toml"

    def edit(self, before, after):
        text = self.file.read_text()
        self.assertIn(before, text)
        self.file.write_text(text.replace(before, after, 1))

    def said(self, *arguments, code=2):
        done = self.call(*arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return re.sub(r"\s+", " ", done.stderr)

    def test_the_example_is_what_its_table_says_and_runs(self):
        done = self.succeed("check", "mine/drop.toml")
        self.assertEqual(done.stderr, "", "no warning")
        mass = sum(7800 * math.pi / 4 * (outside**2 - bore**2) * length + extra for length, outside, bore, extra in sections())
        self.assertAlmostEqual(float(re.search(r"rotor: (\S+) kg", done.stdout)[1]), mass, delta=1e-4)
        self.assertTrue(390 < mass < 410)
        run = self.succeed("run", "mine/drop.toml", "-o", "out")
        self.assertRegex(run.stdout, r"Limits: \d of 8 met in this drop: (ACCEPTED|REJECTED)")
        # Its weight stands on both bearings in the end, by the lever of the centre of gravity; the rotor still rocks.
        summary = json.loads((self.folder / "out/summary.json").read_text())
        forces = [bearing["mean_contact_force_end"] for bearing in summary["bearings"].values()]
        self.assertAlmostEqual(sum(forces) / (9.81 * mass), 1, delta=0.1)

    def test_a_table_is_the_rotor_that_the_script_makes_of_it(self):
        subprocess.run(["/usr/bin/python3", str(SOURCE / "examples/rotor_files.py"), "import", str(EXAMPLE / "shaft.csv"), "other"], cwd=self.folder, check=True, capture_output=True, timeout=60)
        found = []
        for geometry in ("mine/shaft.csv", "other/rotor.json"):
            self.write("modes.toml", f'[run]\ninitial_speed = "1000 rpm"\nend_time = "1 ms"\n[rotor]\ngeometry = "{geometry}"\nmodal_damping = 0\n')
            report = json.loads(self.succeed("modes", "modes.toml", "--speeds", "1000 rpm", "--json").stdout)
            found.append([mode["frequency"] for mode in report["speeds"][0]["modes"]])
        self.assertGreater(len(found[0]), 5)
        for a, b in zip(*found):
            self.assertAlmostEqual(a, b, delta=1e-9 * abs(b))

    def test_a_shaft_of_ones_own_is_named_and_copied(self):
        self.write("pump.csv", (EXAMPLE / "shaft.csv").read_text())
        self.succeed("new", "pump", "--from", "pump.csv")
        self.assertIn('geometry = "pump.csv"', (self.folder / "pump/drop.toml").read_text())
        self.succeed("check", "pump/drop.toml")
        self.write("ross.toml", '["ShaftElement_Shaft 0"]\nL = 0.25\n')
        self.assertIn("rotor_files.py import ross.toml", self.said("new", "other", "--from", "ross.toml"))
        self.assertFalse((self.folder / "other").exists())

    def test_mistakes_in_a_table_name_line_and_column(self):
        header, row = "length [mm], outer_diameter [mm], mass [kg]\n", "100, 80, \n"
        for text, says in (("lenght [mm], outer_diameter [mm]\n100, 80\n", r'shaft\.csv:1:1: unknown column "lenght"\. Did you mean "length"'),
                           ("length [mm]\n100\n", "the column outer_diameter is missing"),
                           (header + row + "100, 80\n", r"shaft\.csv:3:1: this row has 2 values, the header 3 columns"),
                           (header + row + "99,5, 80, \n", "decimal points, not commas"),
                           (header + row + "0, 80, \n" + row, r"shaft\.csv:3:1: the length of a section must be larger than 0"),
                           (header + row + ", 80, \n" + row, "this section has no length"),
                           (header + row + "1OO, 80, \n", r"shaft\.csv:3:1: .*1OO"),
                           ("length [kg], outer_diameter [mm]\n100, 80\n", r"shaft\.csv:2:1: .* is a mass"),
                           ("length [mm], outer_diameter [mm], bore [mm]\n100, 80, 90\n", r"shaft\.csv:2:10: .*is not smaller than its od"),
                           ("length, outer_diameter [mm]\n100, 80\n", r"shaft\.csv:1:1: the column length names no unit\. Write it in brackets"),
                           ("length [mm], od [mm]\n100, 80\n", 'unknown column "od"\\. Did you mean "outer_diameter"'),
                           ("length [mm]; outer_diameter [mm]\n100; 79,4\n", r"shaft\.csv:2:6: .*79,4 mm.*decimal point, not a comma"),
                           ("length [mm]; outer_diameter [mm]; name\n100; 80; Laufrad gr\u00f6\u00dfer\n".encode("latin-1"), r"shaft\.csv:2:1: this line is not text in UTF-8"),
                           ("length [mm], outer_diameter [mm]\n".encode("utf-16"), "this file is text in UTF-16"),
                           (header.replace("\n", ",\n") + "100, 80, , 3\n", r"shaft\.csv:2:12: this value stands in a column without a name"),
                           (header.replace("mass", "length").replace("[kg]", "[mm]") + row, r"shaft\.csv:1:35: there are two columns length"),
                           ("length [mm]; outer_diameter [mm]\n79,4; 80\n", r"shaft\.csv:2:1: .*79,4 mm.*Write a decimal point, not a comma"),
                           ("# nothing\n", "a line that names its columns")):
            with self.subTest(says):
                (self.folder / "mine/shaft.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
                self.assertRegex(self.said("check", "mine/drop.toml"), says)

    def test_what_spreadsheets_write_is_the_same_table(self):
        masses = []
        for change in (lambda text: text, lambda text: text.replace(",", ";"), lambda text: text.replace(", ", "\t").replace(",", "\t"), lambda text: "\ufeff" + text.replace("\n", "\r\n"),
                       lambda text: text.replace("\n", ",,\n") + ",,,,,,,,\n", lambda text: text.replace("\n200, ", "\n20 cm, ")):
            table = "".join(line + "\n" for line in (EXAMPLE / "shaft.csv").read_text().splitlines() if not line.startswith("#"))
            (self.folder / "mine/shaft.csv").write_text(change(table), newline="")
            masses.append(re.search(r"rotor: (\S+) kg.*", self.succeed("check", "mine/drop.toml").stdout)[0])
        self.assertEqual(len(set(masses)), 1, masses)

    def test_thousands_are_not_read_as_decimals(self):
        self.edit('"12000 rpm"', '"11,000 rpm"')
        self.assertIn("Write thousands without a comma (11000)", self.said("check", "mine/drop.toml"))
        self.edit('"11,000 rpm"', '"11.000 rpm"')
        self.assertRegex(self.said("check", "mine/drop.toml", code=0), "the rotor spins at 11 rpm; .*eleven thousand is 11000 rpm")

    def test_a_gap_that_growth_closes_is_told_so(self):
        self.edit('"0.25 mm"', '"0.3 um"')
        self.assertRegex(self.said("check", "mine/drop.toml"), r"the spinning rotor grows by \S+ um at TB1 and closes the air gap of 0\.3 um")

    def test_check_prints_what_a_drawing_shows(self):
        done = self.succeed("check", "mine/drop.toml").stdout
        self.assertIn("TB1: 71920-25, 2 of them, X arrangement, node 3 at x = 110 mm; journal 99.5 mm in a bore of 100 mm, the shaft there has 99.5 mm;", done)

    def test_a_gap_in_metres_is_told_at_its_place(self):
        self.edit('air_gap = "0.25 mm"', "air_gap = 0.25")
        self.assertRegex(self.said("check", "mine/drop.toml"), r"drop\.toml:14:11: bearings\.TB1: the air gap of 250 mm is more than a fifth of the bore radius of 50 mm")

    def test_a_misspelt_catalogue_is_told_once(self):
        self.edit("catalogue = ", "catalog = ")
        said = self.said("check", "mine/drop.toml")
        self.assertIn('Did you mean "catalogue"', said)
        self.assertRegex(said, r"\d+ keys are missing in \[bearings\.TB1\]: .*ball_diameter.*A bearing of the catalogue brings most of them")
        self.assertLessEqual(said.count("error:"), 3)

    def test_a_bearing_that_is_too_large_for_the_shaft_is_told(self):
        self.edit('catalogue = "71920-25"', 'catalogue = "6018"')
        self.assertIn("it does not pass the bore of bearings.TB1, 90 mm", self.said("check", "mine/drop.toml", code=0))
        self.edit('catalogue = "6018"', 'catalogue = "71920-25"')
        table = (self.folder / "mine/shaft.csv").read_text()
        (self.folder / "mine/shaft.csv").write_text(table.replace("99.5", "100"))
        self.assertRegex(self.said("check", "mine/drop.toml", code=0), "diameter of 100 mm and leaves 0 mm by radius in bearings.TB1, 100 mm, where the air gap is 0.25 mm")
        self.succeed("run", "mine/drop.toml", "-o", "tight", "--set", 'run.end_time="2 ms"')
        self.succeed("report", "tight")
        self.assertIn("where the air gap is 0.25 mm", (self.folder / "tight/report.html").read_text(), "warnings of the case are in the report, too")
        (self.folder / "mine/shaft.csv").write_text(table)
        table = (self.folder / "mine/shaft.csv").read_text().replace("99.5", "90")
        (self.folder / "mine/shaft.csv").write_text(table)
        self.assertRegex(self.said("check", "mine/drop.toml", code=0), "diameter of 90 mm, less than 95 % of the journal in bearings.TB1, 99.5 mm")

    def test_a_material_in_wrong_units_is_told(self):
        table = (self.folder / "mine/shaft.csv").read_text()
        for column, value, code, says in (("E [Pa]", "210", 2, r"E = .?210.* is out of range"), ("rho [kg/m3]", "7.85", 0, r'rho = 7\.85 kg/m3; it is most often .*"7\.85 g/cm3"')):
            lines = [line if line.startswith("#") else (f"{column}, " if "length" in line else f"{value}, ") + line for line in table.splitlines()]
            (self.folder / "mine/shaft.csv").write_text("\n".join(lines) + "\n")
            self.assertRegex(self.said("check", "mine/drop.toml", code=code), says)

    def test_limits_on_nothing_offer_results_of_that_kind(self):
        for name, offers in (("bearings.*.peak_force", "bearings.*.peak_contact_force"), ("bearings.*.support.travel", "bearings.*.support.largest_travel"),
                             ("bearings.TB1.temperature_rise", "bearings.*.temperature_rise_end.inner_ring")):
            self.edit("[limits]\n", f'[limits]\n"{name}" = {{ max = 1 }}\n')
            self.assertIn(offers, self.said("run", "mine/drop.toml", "-o", "out"))
            self.edit(f'[limits]\n"{name}" = {{ max = 1 }}\n', "[limits]\n")

    def test_a_quiet_run_says_why_it_is_rejected(self):
        self.edit('{ max = "8 kN" }', '{ max = "1 kN" }')
        done = self.call("run", "mine/drop.toml", "-o", "out", "--accept", "--quiet")
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"REJECTED +\S+ %  bearings\.TB1\.peak_contact_force")

    def test_an_acceptance_names_the_warnings_and_bounds_besides(self):
        for value in ('{ max = "8 kN" }', "{ min = 2 }", '{ max = "0.2 mm" }', '{ max = "170 K" }'):
            self.edit(value, "{ min = 0 }")
        self.edit('travel_limit = "0.2 mm"', 'travel_limit = "1 um"')
        done = self.succeed("run", "mine/drop.toml", "-o", "out")
        self.assertRegex(done.stdout, r"ACCEPTED\n  the .*warnings? of the run above (is|are) no limit; run\.warnings = \{ max = 0 \}")
        self.assertRegex(done.stdout, r"local\.bore_rise = \S+ K, at least 0 K; between \S+ K and \S+ K")
        self.succeed("report", "out")
        self.assertIn("Warnings of the run, which are no limits: ", (self.folder / "out/report.html").read_text())
        self.edit("[limits]\n", "[limits]\nrun.warnings = { max = 0 }\n")
        self.assertIn("REJECTED", self.succeed("run", "mine/drop.toml", "-o", "out", "--force").stdout)

    def test_unusual_values_are_told_in_their_unit(self):
        self.edit('air_gap = "0.25 mm"', 'air_gap = "2.5 mm"')
        self.assertIn("contact.air_gap = 2.5 mm is unusual: it is most often between 0.05 and 1 mm", self.said("check", "mine/drop.toml", code=0))


if __name__ == "__main__":
    unittest.main()
