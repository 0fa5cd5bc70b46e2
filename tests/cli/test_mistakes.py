"""Command lines with a slip: what was meant, and a form that works."""

import shlex
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest  # noqa: E402


class Mistakes(ProgramTest):
    def refused(self, *arguments):
        done = self.call(*arguments)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def form_for(self, *words):
        """The --set that the program proposes for `check reference.toml` and these words; it must work as it is."""
        message = self.refused("check", "reference.toml", *words)
        form = next(line for line in message.splitlines() if "Write it as: " in line).split("Write it as: ")[1]
        self.succeed("check", "reference.toml", *shlex.split(form))
        return form

    def test_a_mistyped_command_is_answered_with_the_near_one(self):
        for word, meant in (("rnu", "run"), ("statiks", "statics"), ("cehck", "check"), ("prelaod", "preload")):
            self.assertIn(f"Did you mean {meant}?", self.refused(word, "reference.toml"))
        self.assertNotIn("Did you mean", self.refused("xylophone"))

    def test_a_case_without_a_command_is_told_how_to_be_run(self):
        self.assertIn("rotordrop run reference.toml", self.refused("reference.toml"))

    def test_a_mistyped_option_is_answered_with_the_near_one(self):
        self.assertIn("Did you mean --force?", self.refused("run", "reference.toml", "--forse"))
        self.assertIn("Did you mean --set?", self.refused("check", "reference.toml", "--st", "contact.friction_coefficient=0.05"))

    def test_an_option_before_the_command_is_sent_behind_it(self):
        self.assertIn("behind it", self.refused("--quiet", "run", "reference.toml"))

    def test_spaces_around_a_value(self):
        for words in (["--set", "contact.friction_coefficient", "=", "0.05"], ["--set", "contact.friction_coefficient=", "0.05"],
                      ["--set", "contact.friction_coefficient", "0.05"], ["--set", "contact.friction_coefficient:", "0.05"],
                      ["--set", "contact.friction_coefficient:0.05"], ["contact.friction_coefficient=0.05"], ["-set", "contact.friction_coefficient=0.05"]):
            self.assertEqual(self.form_for(*words), "--set contact.friction_coefficient=0.05", words)

    def test_a_unit_that_the_shell_took_apart(self):
        self.assertEqual(self.form_for("--set", "run.initial_speed=8000", "rpm"), "--set 'run.initial_speed=8000 rpm'")
        message = self.refused("check", "--set", "run.initial_speed=8000", "rpm", "reference.toml")
        self.assertIn("Write it as: --set 'run.initial_speed=8000 rpm'\n", message)

    def test_a_value_of_another_option_that_the_shell_took_apart(self):
        self.assertIn("--speeds '0 rpm, 100 rpm'", self.refused("modes", "reference.toml", "--speeds", "0", "rpm,100", "rpm"))

    def test_a_list_that_the_shell_took_apart(self):
        for command, option, words, form in (("critical-speeds", "--map", ["1e6", "1e9"], "1e6, 1e9"), ("critical-speeds", "--map", ["1", "1000", "N/um"], "1 N/um, 1000 N/um"),
                                             ("critical-speeds", "--map", ["1e6 N/m", "1e9 N/m"], "1e6 N/m, 1e9 N/m"), ("modes", "--speeds", ["0 rpm", "15200 rpm"], "0 rpm, 15200 rpm"),
                                             ("modes", "--speeds", ["0", "rpm", "15200", "rpm"], "0 rpm, 15200 rpm"), ("modes", "--speeds", ["0", "-50", "5"], "0, -50, 5")):
            for arguments in ([command, "reference.toml", option, *words], [command, option, *words, "reference.toml"]):
                message = self.refused(*arguments)
                self.assertIn(f"Write it as: {option} '{form}'\n", message)
            self.succeed(command, "reference.toml", *shlex.split(message.split("Write it as: ")[1]))
        self.assertIn("Write it as: --times '1 ms, 10 ms'\n", self.refused("compare", "out", "--times", "1", "ms", "10", "ms"))
        self.assertIn("--stiffness takes one value", self.refused("critical-speeds", "reference.toml", "--stiffness", "1e6", "1e9"))
        self.assertIn("Write it as: --stiffness '1e6 N/m'\n", self.refused("critical-speeds", "reference.toml", "--stiffness", "1e6", "N/m"))
        self.assertIn("Write it as: -o 'run 1 2'\n", self.refused("run", "reference.toml", "-o", "run", "1", "2"))

    def test_quotes(self):
        for value in ("'8000 rpm", "8000 rpm\"", "\u201c8000 rpm\u201d", "\u20188000 rpm\u2019"):
            self.assertEqual(self.form_for("--set", f"run.initial_speed={value}"), "--set 'run.initial_speed=8000 rpm'", value)

    def test_lists(self):
        expected = "--set 'rotor.initial_offset=[\"1 um\", \"2 um\"]'"
        for words in (["rotor.initial_offset=[1 um, 2 um]"], ["rotor.initial_offset=[1", "um,", "2", "um]"], ["rotor.initial_offset=1 um, 2 um"],
                      ["rotor.initial_offset=[\"1 um\", 2 um"]):
            self.assertEqual(self.form_for("--set", *words), expected, words)
        self.assertEqual(self.form_for("--set", "thermal.models=[lumped]"), "--set 'thermal.models=[\"lumped\"]'")
        self.assertEqual(self.form_for("--set", "thermal.models=lumped"), "--set 'thermal.models=[\"lumped\"]'")

    def test_a_list_where_one_value_would_do(self):
        self.assertEqual(self.form_for("--set", "run.gravity=0,-9.81,0"), "--set 'run.gravity=[0, -9.81, 0]'")
        message = self.refused("check", self.case('run.gravity = "0,-9.81,0"\n'))
        self.assertIn("Several values are a list in brackets, where the key takes one: [0, -9.81, 0].", message)
        self.assertNotIn("decimal point", message)

    def test_a_decimal_comma(self):
        self.assertEqual(self.form_for("--set", "contact.friction_coefficient=0,05"), "--set contact.friction_coefficient=0.05")

    def test_a_comma_between_thousands(self):
        self.assertEqual(self.form_for("--set", "run.initial_speed=12,000 rpm"), "--set 'run.initial_speed=12000 rpm'")

    def test_several_parameters_in_one(self):
        both = "--set contact.friction_coefficient=0.05 --set run.end_time=1"
        for words in (["contact.friction_coefficient=0.05,run.end_time=1"], ["contact.friction_coefficient=0.05 run.end_time=1"],
                      ["contact.friction_coefficient=0.05", "run.end_time=1"]):
            self.assertEqual(self.form_for("--set", *words), both, words)

    def test_what_is_right_is_left_alone(self):
        for value in ("run.initial_speed='8000 rpm'", "run.initial_speed=8000 rpm", "rotor.initial_offset=[\"1 um\", \"2 um\"]", "run.initial_speed = 8000 rpm"):
            self.succeed("check", "reference.toml", "--set", value)

    def test_an_empty_value_is_not_a_default(self):
        """"$SPEED" of a script whose variable was never set."""
        for command, options in (("critical-speeds", ("--stiffness", "--up-to", "--map")), ("modes", ("--speeds", "--modes")), ("calibrate", ("--until",)),
                                 ("compare", ("--times", "--tolerance", "--floor", "--growth-tolerance", "--band-length")), ("mesh", ("--bearing", "--format")),
                                 ("statics", ("--bearing",)), ("preload", ("--bearing",)), ("study", ("--shard", "--jobs"))):
            for option in options:
                for value in ("", " "):
                    message = self.refused(command, "reference.toml", option, value)
                    self.assertIn(f"error: {command}: {option}: the value is empty; write one, or leave the option out.\n", message)
        self.assertIn("--output: the name is empty", self.refused("study", "report", "there", "-o", ""))
        self.assertIn("--point: the value is empty.", self.refused("study", "rerun", "there", "--point", ""))
        self.assertIn("directories: the name is empty", self.refused("study", "join", "", "-o", "there"))
        self.assertIn("--set", self.refused("check", "reference.toml", "--set", ""))

    def test_one_unit_behind_several_numbers(self):
        """As if it were of all of them: "0,5,10 krpm" must not be 5 rad/s."""
        for command, option, value, meant in (("critical-speeds", "--map", "1, 1000 N/um", "1 N/um, 1000 N/um"), ("modes", "--speeds", "0,5,10 krpm", "0, 5 krpm, 10 krpm"),
                                              ("modes", "--speeds", "1 rad/s,5,10 rpm,20", "1 rad/s, 5 rpm, 10 rpm, 20 rpm"),
                                              ("compare", "--times", "1,10,100 ms", "1 ms, 10 ms, 100 ms")):
            message = self.refused(command, "reference.toml", option, value)
            self.assertIn("no unit, but other entries of the list have one", message)
            self.assertIn(f"Write it as: {option} '{meant}'\n", message)
        self.succeed("modes", "reference.toml", "--speeds", "0, 5 krpm, 10 krpm")


if __name__ == "__main__":
    unittest.main()
