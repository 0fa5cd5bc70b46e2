"""mpirun -n N rotordrop study: the same bits for any number of ranks; a rank that is killed costs nothing that was finished."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, ProgramTest  # noqa: E402

MODULE = pathlib.Path(PROGRAM).parent / "rotordrop_mpi.so"
STUDY = """
case = "drop.toml"
[vary]
"contact.friction_coefficient" = { range = [0.05, 0.3] }
[design]
kind = "latin-hypercube"
size = SIZE
"""


def pids_of_ranks(launcher):
    """Processes below mpirun, by their ranks."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            environment = dict(item.split("=", 1) for item in (entry / "environ").read_text().split("\0") if "=" in item)
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
        except (OSError, ValueError):
            continue
        if parent == launcher and "OMPI_COMM_WORLD_RANK" in environment:
            found[int(environment["OMPI_COMM_WORLD_RANK"])] = int(entry.name)
    return found


@unittest.skipUnless(shutil.which("mpirun") and MODULE.is_file(), "there is no mpirun, or the program was built without its MPI module")
class Ranks(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case("")

    def start(self, n, *arguments, options=()):
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", *options, "-n", str(n), PROGRAM, "study", "s.toml", *arguments]
        return subprocess.Popen(command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def run_ranks(self, n, *arguments, **options):
        running = self.start(n, *arguments, **options)
        told, error = running.communicate(timeout=300)
        return running.returncode, told, error

    def bytes_of(self, output):
        return [(self.folder / output / name).read_bytes() for name in ("study.h5", "study.csv")]

    def test_any_number_of_ranks_gives_the_same_bits(self):
        self.write("s.toml", STUDY.replace("SIZE", "12"))
        self.succeed("study", "s.toml", "-o", "alone", "--jobs", "1")
        for n in (1, 3):
            code, told, error = self.run_ranks(n, "-o", f"ranks-{n}")
            self.assertEqual(code, 0, error)
            self.assertEqual(told.count("results in"), 1)
            self.assertEqual(self.bytes_of(f"ranks-{n}"), self.bytes_of("alone"))
            self.assertEqual(list((self.folder / f"ranks-{n}").glob("rank-*")), [])

    def test_bad_input_is_told_once_and_ends_all_ranks(self):
        self.write("s.toml", STUDY.replace("SIZE", "12").replace("0.05, 0.3", "0.3, 0.05"))
        code, _, error = self.run_ranks(3, "-o", "bad")
        self.assertEqual(code, 2)
        self.assertEqual(error.count("range is empty"), 1)

    def test_a_search_is_refused_by_rank_0_alone(self):
        self.write("s.toml", STUDY.partition("[design]")[0] + '[minimise]\nresult = "bearings.TB1.peak_contact_force"\n')
        code, _, error = self.run_ranks(3, "-o", "bad")
        self.assertEqual(code, 2, error)
        self.assertEqual(error.count("a search runs in one process"), 1)
        self.assertFalse((self.folder / "bad").exists())

    def killed(self, rank, options=()):
        """A study of three ranks of which one is killed after its first points; how many points are finished when all have ended."""
        self.write("s.toml", STUDY.replace("SIZE", "200"))
        running = self.start(3, "-o", "killed", options=options)
        journal = self.folder / ("killed/study.journal" if rank == 0 else f"killed/rank-{rank}.journal")
        for _ in range(1200):
            time.sleep(0.05)
            if journal.exists() and journal.read_text().count('"point"') > 1:
                break
        os.kill(pids_of_ranks(running.pid)[rank], signal.SIGKILL)
        try:
            running.communicate(timeout=240)
        except subprocess.TimeoutExpired:
            running.kill()
            self.fail("mpirun does not end after a rank was killed")
        # A point that the killed rank has written, but not yet told, is computed once more: the same bits.
        return len({point for file in (self.folder / "killed").glob("*.journal") for point in re.findall(r'"point":\s*(\d+)', file.read_text())})

    def completes(self):
        self.succeed("study", "s.toml", "-o", "killed", "--resume", "--quiet")
        self.succeed("study", "s.toml", "-o", "whole", "--quiet")
        self.assertEqual(self.bytes_of("killed"), self.bytes_of("whole"))

    def test_a_killed_rank_ends_all_and_resume_completes(self):
        for rank in (0, 2):
            with self.subTest(rank=rank):
                shutil.rmtree(self.folder / "killed", ignore_errors=True)
                shutil.rmtree(self.folder / "whole", ignore_errors=True)
                self.assertGreater(self.killed(rank), 1)
                self.completes()

    def test_the_rest_finishes_where_the_launcher_lets_it_live(self):
        """The lost rank is given up after 20 s."""
        self.assertEqual(self.killed(2, ["--enable-recovery"]), 200)
        self.succeed("study", "s.toml", "-o", "whole", "--quiet")
        self.assertEqual(self.bytes_of("killed"), self.bytes_of("whole"))


if __name__ == "__main__":
    unittest.main()
