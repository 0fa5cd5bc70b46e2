"""Short memory, short disks: finite elements are refused in words, and what is half made is taken away."""

import subprocess
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HAS_MESH_ROOM, IS_SANITIZED, PROGRAM, ProgramTest, content_of, settings  # noqa: E402


@unittest.skipIf(IS_SANITIZED, "sanitizers reserve more addresses than a limit leaves")
class Short(ProgramTest):
    def limited(self, limit, *arguments):
        return subprocess.run(["bash", "-c", f'ulimit {limit}; ulimit -c 0; exec "$@"', "-", PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120)

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_finite_elements_say_that_memory_is_short(self):
        # A conductivity over temperature, or kept matrices would be stepped without the libraries.
        self.case('[thermal]\nmodels = ["lumped", "fe"]\n[thermal.fe]\ncoupling = "windowed"\n[materials.steel]\nk_table = [[293, 46], [600, 36]]\n')
        n_refused = 0
        # From too little for the libraries to enough: in between libraries of others end a process where they get none.
        for megabytes in (*range(460, 640, 20), 1500):
            with self.subTest(megabytes):
                done = self.limited(f"-v {megabytes * 1000}", "run", "drop.toml", "-o", "out", "--force", "--quiet", *settings(run__end_time="20 us"))
                self.assertIn(done.returncode, (0, 1), done.stderr)
                if done.returncode == 1:
                    n_refused += 1
                    self.assertRegex(done.stderr, "error: .*(not enough memory|cannot be loaded)")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(n_refused, 3)

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_what_a_matrix_needs_is_told_before_it_is_factorised(self):
        self.case('[thermal]\nmodels = ["lumped", "fe"]\n[thermal.fe]\ncoupling = "windowed"\nrefinement = 4\n')
        said = ""
        for megabytes in range(760, 1200, 60):
            said += self.limited(f"-v {megabytes * 1000}", "run", "drop.toml", "-o", "out", "--force", "--quiet", *settings(run__end_time="20 us")).stderr
        self.assertRegex(said, r"matrix of the finite elements: \d+ unknowns need at least \d+ MB, [\d.]+ MB are left")

    def test_a_long_list_that_does_not_fit_is_told(self):
        # The library that reads TOML ends the process where it finds no memory.
        self.case("[rotor.drive]\ntorque = [" + ",".join(f"[{i}e-6, 1]" for i in range(400000)) + "]\n")
        codes = set()
        for megabytes in (60, 100, 150, 200, 3000):
            done = self.limited(f"-v {megabytes * 1000}", "check", "drop.toml", "--set", "rotor.geometry=nix.json")
            codes.add(done.returncode)
            self.assertIn(done.returncode, (1, 2, 127), done.stderr)
            if done.returncode == 1:
                self.assertRegex(done.stderr, "error: .*not enough memory")
        self.assertGreaterEqual(codes, {1, 2})

    def test_a_new_case_that_cannot_be_written_leaves_nothing(self):
        before = content_of(self.folder)
        for words in ([], ["--own"]):
            done = self.limited("-f 8", "new", "mine", *words)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertIn("cannot write", done.stderr)
            self.assertEqual(content_of(self.folder), before)

    def test_a_page_of_someone_else_stays(self):
        (self.folder / "out").mkdir()
        self.write("out/report.html", "<html>mine</html>")
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"))
        self.succeed("run", "reference.toml", "-o", "out", "--force", *settings(run__end_time="1 ms"))
        self.assertEqual((self.folder / "out/report.html").read_text(), "<html>mine</html>")
        self.succeed("report", "out", "--force")
        self.succeed("run", "reference.toml", "-o", "out", "--force", *settings(run__end_time="1 ms"))
        self.assertFalse((self.folder / "out/report.html").exists(), "the program's own page goes with its results")


if __name__ == "__main__":
    unittest.main()
