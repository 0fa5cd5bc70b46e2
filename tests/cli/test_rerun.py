"""A recorded drop once more, from its file alone; and `--resume` of a run that is finished."""

import pathlib
import re
import shutil
import sys
import unittest

import h5py

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PROGRAM, ProgramTest, content_of, settings  # noqa: E402

HAS_ROOM = (pathlib.Path(PROGRAM).parent / "rotordrop_fe.so").is_file()
FIXED = settings(integration__method="runge-kutta-4", integration__step="1 us")


class Rerun(ProgramTest):
    def alone(self, directory):
        """The result file of a run somewhere else, with nothing left of what it was made from."""
        other = self.folder / "elsewhere"
        other.mkdir(exist_ok=True)
        shutil.move(self.folder / directory / "results.h5", other / "results.h5")
        for path in list(self.folder.iterdir()):
            if path != other:
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        return other / "results.h5"

    def test_the_file_alone_gives_the_same_bits(self):
        # The case stands on a base, a geometry file and values of the command line; the file knows all of them.
        case = self.case('contact.friction_coefficient = 0.05\nrotor.initial_offset = ["0.1 um", 0]\n')
        self.succeed("run", case, "-o", "out", *settings(run__ambient="30 degC"))
        summary = self.summary()
        file = self.alone("out")
        done = self.succeed("rerun", file, "-o", "again")
        with h5py.File(file) as first:
            names = []
            first.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and name not in ("parameters", "given") else None)
            with h5py.File(self.folder / "again/results.h5") as second:
                for name in names:
                    self.assertEqual(first[name][()].tobytes(), second[name][()].tobytes(), name)
                for name in ("parameters", "given"):
                    self.assertEqual(first[name][()].decode(), second[name][()].decode(), "values and where they are from")
            n_rows = len(first["time"])
        self.assertGreater(len(names), 50)
        self.assertIn(f"the same bits as {file}: {len(names)} datasets, {n_rows} rows\n", done.stdout)
        again = self.summary("again")
        for one in (summary, again):
            del one["run"]["wall_time"], one["run"]["cpu_time"]
        self.assertEqual(again, summary)

    @unittest.skipUnless(HAS_ROOM, "without finite elements")
    def test_with_finite_elements_too(self):
        for coupling in ("reduced", "windowed"):
            with self.subTest(coupling):
                name = f"out-{coupling}"
                self.succeed("run", self.case(""), "-o", name, *settings(thermal__models='["lumped", "fe"]', thermal__fe__coupling=coupling, thermal__fe__section="plain"))
                self.assertIn("the same bits as", self.succeed("rerun", name, "-o", f"again-{coupling}").stdout)

    def test_another_bit_is_found(self):
        self.succeed("run", self.case(""), "-o", "out")
        with h5py.File(self.folder / "out/results.h5", "r+") as file:
            force = file["bearings/TB1/contact_force"]
            k = int(force[()].argmax())
            force[k] = force[k] + 0.25
            time_there = file["time"][k]
        done = self.call("rerun", "out/results.h5", "-o", "again")
        self.assertEqual(done.returncode, 3)
        said = re.search(r"OTHER bits than out/results\.h5: 1 of \d+ datasets differ\n  /bearings/TB1/contact_force: largest difference 0\.25 N, first at ([0-9.]+) ms", done.stdout)
        self.assertAlmostEqual(float(said[1]), 1e3 * time_there, delta=1e-3)

    def test_the_instruction_set_is_recorded(self):
        now = re.search(r"instruction set ([\w-]+)", self.succeed("--version").stdout)[1]
        self.succeed("run", self.case(""), "-o", "out")
        with h5py.File(self.folder / "out/results.h5", "r+") as file:
            self.assertEqual(file.attrs["instruction_set"], now)
            file["bearings/TB1/contact_force"][3] += 0.25
        self.assertNotIn("instruction set", self.call("rerun", "out/results.h5", "-o", "again").stdout, "it is the same")
        for recorded, told in (("other", f"The instruction set was other and is {now}; ROTORDROP_ISA=other"), (f"other, {now}", f"had other, {now} one after the other")):
            with h5py.File(self.folder / "out/results.h5", "r+") as file:
                file.attrs["instruction_set"] = recorded
            self.assertIn(told, self.call("rerun", "out/results.h5", "-o", "again", "--force").stdout)

    def test_an_interrupted_run_is_compared_as_far_as_it_goes(self):
        self.interrupt_run("reference.toml", *FIXED, *settings(run__end_time="1 s"), after=0.3)
        done = self.succeed("rerun", "out/results.h5", "-o", "again")
        self.assertRegex(done.stdout, r"the same bits as .*, up to where the recorded run was interrupted")

    def test_a_file_that_the_case_names_must_be_what_it_was(self):
        self.succeed("run", self.case(""), "-o", "first")
        self.succeed("run", self.case('thermal.driver = "recorded"\nthermal.recorded = "first/results.h5"\n', "second.toml"), "-o", "second")
        self.assertIn("the same bits as", self.succeed("rerun", "second", "-o", "again").stdout)
        with h5py.File(self.folder / "first/results.h5", "r+") as file:
            file["bearings/TB1/expansion"][0, 0] = 1e-6
        done = self.call("rerun", "second", "-o", "again", "--force")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"first/results\.h5: the file has changed since the drop was recorded")

    def test_what_is_no_drop_is_refused(self):
        self.succeed("run", self.case(""), "-o", "out")
        before = content_of(self.folder / "out")
        for arguments, says in ((("nothing.h5",), "there is no such file"), (("reference.toml",), "reference.toml"), (("out", "-o", "out"), "this is the directory of the drop")):
            done = self.call("rerun", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(says, done.stderr)
        self.assertEqual(content_of(self.folder / "out"), before)


class FinishedRun(ProgramTest):
    def test_there_is_nothing_to_resume(self):
        case = self.case('limits.bearings.TB1.peak_contact_force.max = "1 kN"\n')
        self.succeed("run", case, "-o", "out")
        before = content_of(self.folder / "out")
        done = self.succeed("run", case, "-o", "out", "--resume")
        self.assertRegex(done.stdout, r"the run in out is finished, at t = 0\.01 s: there is nothing to resume\n")
        self.assertEqual(content_of(self.folder / "out"), before)
        self.assertEqual(self.call("run", case, "-o", "out", "--resume", "--accept").returncode, 3, "as the run itself")

    def test_that_of_another_case_is_refused(self):
        self.succeed("run", self.case(""), "-o", "out")
        before = content_of(self.folder / "out")
        done = self.call("run", self.case("contact.friction_coefficient = 0.01\n"), "-o", "out", "--resume")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no checkpoint to go on from", done.stderr)
        self.assertEqual(content_of(self.folder / "out"), before)


if __name__ == "__main__":
    unittest.main()
