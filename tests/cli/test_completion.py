"""Completion scripts run in their shells, and manual pages that man reads."""

import json
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import time
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest  # noqa: E402


def commands_of(help_text):
    """Names under "Subcommands:" of the program's own help."""
    return re.findall(r"^  ([a-z-]+) ", help_text.split("Subcommands:")[1], re.M)


class Completion(ProgramTest):
    def script(self, shell):
        return self.write(f"rotordrop.{shell}", self.succeed("completion", shell).stdout)

    def bash(self, *words):
        """What bash would offer for the last of the words, with "=" as a word of its own as bash has it."""
        script = f"source {self.script('bash')}\nCOMP_WORDS=(rotordrop {' '.join(map(repr, words))})\nCOMP_CWORD={len(words)}\n_rotordrop\nprintf '%s\\n' \"${{COMPREPLY[@]}}\""
        done = subprocess.run(["bash", "--norc", "-c", script], cwd=self.folder, capture_output=True, text=True, timeout=30)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_offers_the_commands_of_the_program_and_no_others(self):
        commands = commands_of(self.succeed("--help").stdout)
        self.assertIn("completion", commands)
        self.assertEqual(sorted(self.bash("")), sorted(commands + ["--help", "--version"]))
        self.assertEqual(self.bash("stat"), ["statics"])

    def test_bash_offers_the_options_of_the_command(self):
        self.assertEqual(self.bash("preload", "case.toml", "--res"), ["--results"])
        self.assertIn("--resume", self.bash("run", "--"))
        self.assertNotIn("--resume", self.bash("check", "--"))

    def test_bash_offers_case_files_and_folders(self):
        (self.folder / "results").mkdir()
        self.assertEqual(sorted(self.bash("run", "re")), ["reference.toml", "results"])
        self.assertEqual(self.bash("report", "re"), ["results"])
        self.assertEqual(self.bash("run", "reference.toml", "-o", "re"), ["results"])

    def test_bash_offers_keys_and_the_words_that_they_take(self):
        self.assertEqual(self.bash("run", "x.toml", "--set", "contact.friction_coe"), ["contact.friction_coefficient="])
        self.assertEqual(sorted(self.bash("run", "x.toml", "--set", "rotor.model", "=", "")), ["full", "modal", "rigid"])
        self.assertEqual(self.bash("run", "x.toml", "--set", "rotor.model", "=", "ri"), ["rigid"])
        self.assertEqual(self.bash("run", "x.toml", "--set", "bearings.TB1.ball_dia"), ["bearings.TB1.ball_diameter="])

    def test_every_key_of_the_schema_that_takes_one_value_is_offered(self):
        def leaves(node, path=""):
            for key, inner in node.get("properties", {}).items():
                if "properties" in inner:
                    yield from leaves(inner, path + key + ".")
                elif path + key not in ("base", "materials", "bearings", "rotor.probes"):
                    yield path + key

        expected = set(leaves(json.loads(self.succeed("schema").stdout)))
        offered = {word.rstrip("=") for word in self.bash("run", "x.toml", "--set", "")}
        self.assertGreater(len(expected), 150)
        self.assertEqual(sorted(key for key in expected - offered if not key.startswith("bearings.type")), [])

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_offers_the_same(self):
        script = self.script("fish")

        def fish(line):
            done = subprocess.run(["fish", "--no-config", "-c", f"source {script}; complete -C '{line}'"], cwd=self.folder, capture_output=True, text=True, timeout=60,
                                  env={**os.environ, "HOME": str(self.folder)})
            self.assertEqual(done.stderr, "")
            return [row.split("\t")[0] for row in done.stdout.splitlines()]

        self.assertEqual(sorted(word for word in fish("rotordrop ") if not word.startswith("-")), sorted(commands_of(self.succeed("--help").stdout)))
        self.assertEqual(fish("rotordrop stat"), ["statics"])
        self.assertEqual(fish("rotordrop run --set contact.friction_coe"), ["contact.friction_coefficient="])
        self.assertEqual(fish("rotordrop run --set rotor.model=ri"), ["rotor.model=rigid"])
        self.assertEqual(fish("rotordrop preload x.toml --res"), ["--results"])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_completes_what_is_typed(self):
        shutil.copy(self.folder / self.script("zsh"), self.folder / "_rotordrop")
        (self.folder / ".zshrc").write_text(f"PS1='> '\nfpath=({self.folder} $fpath)\nautoload -Uz compinit; compinit -u -d {self.folder}/dump\nunsetopt beep\n")
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.environ.update(ZDOTDIR=str(self.folder), TERM="dumb", PATH=os.environ["PATH"])
            os.execvp("zsh", ["zsh", "-i"])

        def typed(text, until):
            os.write(terminal, text.encode())
            shown, deadline = "", time.monotonic() + 30
            while until not in shown and time.monotonic() < deadline:
                if select.select([terminal], [], [], 0.2)[0]:
                    shown += os.read(terminal, 65536).decode(errors="replace")
            return shown

        try:
            typed("", "> ")
            for begin, whole in (("rotordrop stat\t", "statics"), ("rotordrop run --set contact.friction_coe\t", "friction_coefficient="),
                                 ("rotordrop run --set rotor.model=ri\t", "model=rigid"), ("rotordrop preload --res\t", "--results")):
                self.assertIn(whole, typed(begin, whole))
                os.write(terminal, b"\x15")  # clears the line; nothing is printed that could be waited for
        finally:
            os.close(terminal)
            os.kill(process, 9)
            os.waitpid(process, 0)

    def test_an_unknown_shell_is_answered_with_those_that_are_known(self):
        done = self.call("completion", "csh")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "bash.*zsh.*fish")


class ManualPages(ProgramTest):
    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_man_reads_every_page_without_a_warning(self):
        for topic in ["", "case"] + commands_of(self.succeed("--help").stdout):
            page = self.write("page.1", self.succeed("man", *filter(None, [topic])).stdout)
            done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page], cwd=self.folder, capture_output=True, text=True,
                                  env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "100"}, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), topic)

    def test_a_page_has_the_options_of_its_command(self):
        page = self.succeed("man", "run").stdout
        for option in re.findall(r"--([a-z-]+)", self.succeed("run", "--help").stdout):
            self.assertIn("\\-\\-" + option.replace("-", "\\-"), page)

    def test_the_page_of_cases_has_units_and_defaults(self):
        page = self.succeed("man", "case").stdout
        self.assertRegex(page, r"\.B run\.end_time\n(.*\n)+?Type: time in s, > 0; usually between 1e\\-05 and 10000\.\nDefault: \"0\.3 s\"\.")

    def test_an_unknown_page_is_answered_with_a_near_one(self):
        done = self.call("man", "staticks")
        self.assertEqual(done.returncode, 2)
        self.assertIn('Did you mean "statics"?', done.stderr)


if __name__ == "__main__":
    unittest.main()
