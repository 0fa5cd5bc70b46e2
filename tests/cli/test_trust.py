"""Nothing is lost and nothing is silently wrong: other people's files, full disks, damaged results, hostile inputs."""

import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HAS_MESH_ROOM, PARAMS, PROGRAM, ProgramTest, content_of, settings, start  # noqa: E402

SHORT = settings(run__end_time="1 ms")
# Long enough to be killed, with steps that are the same after a resume.
LONG = settings(run__end_time="60 ms", integration__method="runge-kutta-4", integration__step="0.5 us", output__checkpoint_interval="0.05 s")

STUDY = 'case = "reference.toml"\n[design]\nkind = "grid"\n[vary]\ncontact.friction_coefficient = [0.05, 0.1]\n'


class OtherPeoplesFiles(ProgramTest):
    def test_a_directory_without_results_keeps_what_is_in_it(self):
        for name in ("fields", "failed", "checkpoints"):
            with self.subTest(name):
                folder = self.folder / f"of-{name}"
                (folder / name).mkdir(parents=True)
                (folder / name / "mine.txt").write_text("mine")
                (folder / "report.html").write_text("mine")
                before = content_of(folder)
                for force in ((), ("--force",)):
                    done = self.call("run", "reference.toml", "-o", folder, *SHORT, *force)
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertRegex(done.stderr, f'the directory holds "{name}", but no results')
                    self.assertEqual(content_of(folder), before)

    def test_no_command_replaces_what_it_reads(self):
        """Neither the case nor a file that it names, whatever --force says."""
        self.succeed("run", "reference.toml", "-o", "out", *SHORT)
        rotor = (PARAMS / "neisi2019-rotor.json").read_text()
        for name, text, arguments in (
                ("parameters.toml", 'base = "../reference.toml"\n# mine\n', ["out/parameters.toml"]),
                ("parameters.toml", 'base = "../reference.toml"\n# mine\n', ["over.toml"]),
                ("summary.json", rotor, ["reference.toml", "--set", 'rotor.geometry="out/summary.json"']),
                ("results.h5", None, ["reference.toml", "--set", 'thermal.driver="recorded"', "--set", 'thermal.recorded="out/results.h5"'])):
            with self.subTest(arguments):
                self.write("over.toml", 'base = "out/parameters.toml"\n')
                kept = (self.folder / "out" / name).read_bytes()
                if text is not None:
                    (self.folder / "out" / name).write_text(text)
                before = content_of(self.folder / "out")
                done = self.call("run", *arguments, "-o", "out", "--force", *SHORT)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(f"out/{name}: this file is what the command reads, and results would replace it", done.stderr)
                self.assertEqual(content_of(self.folder / "out"), before)
                (self.folder / "out" / name).write_bytes(kept)
        self.succeed("run", "out/parameters.toml", "-o", "out", "--force")  # its own: the same again

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_a_calibration_does_not_replace_what_the_case_names(self):
        for name in ("neisi2019.toml", "neisi2019-rotor.json", "neisi2019-settling.toml"):
            shutil.copy(PARAMS / name, self.folder)
        for output in ("neisi2019-rotor.json", "neisi2019.toml"):
            before = (self.folder / output).read_bytes()
            done = self.call("calibrate", "neisi2019-settling.toml", "--until", "10ms", "-o", output, "--force")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"{output}: this file is what the command reads; it is not replaced", done.stderr)
            self.assertEqual((self.folder / output).read_bytes(), before)

    def test_a_study_report_replaces_only_its_own(self):
        self.write("study.toml", STUDY)
        self.succeed("study", "study.toml", "-o", "out", *SHORT)
        (self.folder / "out/report.html").write_text("mine")
        self.assertEqual(self.call("study", "report", "out").returncode, 2)
        self.assertEqual((self.folder / "out/report.html").read_text(), "mine")
        self.succeed("study", "report", "out", "--force")
        self.succeed("study", "report", "out")

    def test_a_report_of_someone_else_stays_in_a_directory_without_results(self):
        (self.folder / "out").mkdir()
        (self.folder / "out/report.html").write_text("mine")
        self.succeed("run", "reference.toml", "-o", "out", *SHORT)
        self.assertEqual((self.folder / "out/report.html").read_text(), "mine")

    def test_replacing_results_removes_only_files_of_the_program(self):
        self.succeed("run", "reference.toml", "-o", "out", *SHORT)
        out = self.folder / "out"
        ours = ["fields/TB1.pvd", "fields/TB1-00001.vtu", "checkpoints/checkpoint-000001.h5", "failed/checkpoint-000001.h5",
                "results.h5.123.new", "results.h5.resuming.123.new", "summary.json.writing"]
        mine = ["fields/notes.txt", "checkpoints/model.pt", "mine.writing", "notes.txt"]
        for name in ours + mine:
            (out / name).parent.mkdir(exist_ok=True)
            (out / name).write_text("x")
        (self.folder / "elsewhere").mkdir()
        (self.folder / "elsewhere/checkpoint-000001.h5").write_text("mine")
        shutil.rmtree(out / "failed")
        (out / "failed").symlink_to(self.folder / "elsewhere")
        self.succeed("run", "reference.toml", "-o", "out", *SHORT, "--force")
        there = content_of(out)
        self.assertEqual([name for name in ours if name in there and not name.startswith("failed")], [])
        self.assertEqual([name for name in mine if name not in there], [])
        self.assertEqual((self.folder / "elsewhere/checkpoint-000001.h5").read_text(), "mine")

    def test_files_of_someone_else_by_names_of_results_stay(self):
        self.succeed("run", "reference.toml", "-o", "whole", *SHORT)
        with h5py.File(self.folder / "mine.h5", "w") as file:
            file["measured"] = [1.0, 2.0]
        text, hdf5 = b"my notes", (self.folder / "mine.h5").read_bytes()
        others = [("results.h5", text), ("results.h5", hdf5), ("preload.h5", hdf5), ("study.h5", hdf5), ("shard.h5", text), ("summary.json", b'{"mine": 1}'),
                  ("study.json", text), ("preload.json", text), ("study.journal", text), ("comparison.json", b'{"a": 2}'), ("comparison.h5", hdf5), ("measured.json", text)]
        for name, content in others:
            for start_of in ("nothing", "results"):
                with self.subTest(name, start_of=start_of):
                    shutil.rmtree(self.folder / "out", ignore_errors=True)
                    if start_of == "results":
                        shutil.copytree(self.folder / "whole", self.folder / "out")
                    (self.folder / "out").mkdir(exist_ok=True)
                    (self.folder / "out" / name).write_bytes(content)
                    before = content_of(self.folder / "out")
                    for force in ((), ("--force",)):
                        done = self.call("run", "reference.toml", "-o", "out", *SHORT, *force)
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertEqual(content_of(self.folder / "out"), before)
                    self.assertIn("the program did not write it", done.stderr)
        for name in ("comparison.json", "comparison.h5"):
            shutil.rmtree(self.folder / "out")
            shutil.copytree(self.folder / "whole", self.folder / "out")
            (self.folder / "out" / name).write_text("mine")
            done = self.call("compare", "out", "--against", "whole")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("did not write it", done.stderr)
            self.assertEqual((self.folder / "out" / name).read_text(), "mine")

    def test_tables_and_inputs_by_names_of_a_study_stay(self):
        self.succeed("run", "reference.toml", "-o", "whole", *SHORT)
        self.write("s.toml", STUDY)
        for name in ("study.csv", "measured.csv", "study.toml", "case.toml"):
            with self.subTest(name):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                shutil.copytree(self.folder / "whole", self.folder / "out")
                (self.folder / "out" / name).write_text("mine")
                self.succeed("run", "reference.toml", "-o", "out", *SHORT, "--force")
                self.assertEqual((self.folder / "out" / name).read_text(), "mine")
                before = content_of(self.folder / "out")
                done = self.call("study", "s.toml", "-o", "out", *SHORT, "--force")
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(f"out/{name}: results would replace this file, but the program did not write it", done.stderr)
                self.assertEqual(content_of(self.folder / "out"), before)
        (self.folder / "out/case.toml").unlink()
        (self.folder / "out/parameters.toml").write_text("mine = 1\n")
        before = content_of(self.folder / "out")
        done = self.call("run", "reference.toml", "-o", "out", *SHORT, "--force")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("out/parameters.toml: results would replace this file", done.stderr)
        self.assertEqual(content_of(self.folder / "out"), before)

    def test_only_a_study_replaces_a_study(self):
        self.write("s.toml", STUDY)
        self.succeed("study", "s.toml", "-o", "out", *SHORT)
        self.succeed("study", "rerun", "out", "--point", "0", "--quiet")
        (self.folder / "out/point-0/parameters.toml").write_text("mine = 1\n")
        before = content_of(self.folder / "out")
        for command in (("run", "reference.toml", *SHORT), ("preload", "reference.toml", "--bearing", "TB1"), ("study", "rerun", "out", "--point", "0")):
            done = self.call(*command, "-o", "out", "--force")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('out: the directory holds the study "s"', done.stderr)
            self.assertEqual(content_of(self.folder / "out"), before)
        self.succeed("study", "s.toml", "-o", "out", *SHORT, "--force")
        self.assertEqual((self.folder / "out/point-0/parameters.toml").read_text(), "mine = 1\n")

    def test_a_link_or_a_folder_by_the_name_of_results_stays(self):
        self.succeed("run", "reference.toml", "-o", "whole", *SHORT)
        shutil.copytree(self.folder / "whole", self.folder / "out")
        (self.folder / "out/results.h5").unlink()
        for make in (lambda path: path.symlink_to("../whole/results.h5"), lambda path: path.mkdir()):
            make(self.folder / "out/results.h5")
            done = self.call("run", "reference.toml", "-o", "out", *SHORT, "--force")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertTrue((self.folder / "out/results.h5").is_symlink() or (self.folder / "out/results.h5").is_dir())
            if (self.folder / "out/results.h5").is_symlink():
                (self.folder / "out/results.h5").unlink()

    def test_damaged_results_of_ours_may_be_replaced(self):
        self.succeed("run", "reference.toml", "-o", "whole", *SHORT)
        whole = (self.folder / "whole/results.h5").read_bytes()
        for damaged in (whole[:len(whole) // 2], whole[:len(whole) // 2].ljust(len(whole), b"\0"), b"", bytes(len(whole))):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            shutil.copytree(self.folder / "whole", self.folder / "out")
            (self.folder / "out/results.h5").write_bytes(damaged)
            (self.folder / "out/summary.json").unlink()
            self.succeed("run", "reference.toml", "-o", "out", *SHORT, "--force")

    def test_a_place_where_no_file_can_be_is_a_mistake_of_the_user(self):
        self.succeed("run", "reference.toml", "-o", "out", *SHORT)
        for command in (["report", "out", "-o", "/proc/x"], ["modes", "reference.toml", "--shapes", "/proc/x"], ["compare", "out", "--against", "out", "-o", "/proc/x"],
                        ["calibrate", "reference.toml", "-o", "/proc/x"], ["run", "reference.toml", "-o", "/proc/x"]):
            if command[0] != "calibrate" or HAS_MESH_ROOM:
                done = self.call(*command)
                self.assertEqual(done.returncode, 2, (command, done.stderr))

    def test_a_report_replaces_pages_and_nothing_else(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"), "--quiet")
        before = content_of(self.folder)
        for name in ("out/results.h5", "out/parameters.toml", "reference.toml"):
            done = self.call("report", "out", "-o", name, "--force")
            self.assertEqual(done.returncode, 2, name)
            self.assertIn("it is no HTML page", done.stderr)
        self.assertEqual(content_of(self.folder), before)
        self.succeed("report", "out", "-o", "out/report.html", "--force")

    def test_an_empty_name_is_refused(self):
        before = content_of(self.folder)
        for command in (("run", "reference.toml", "-o", ""), ("mesh", "reference.toml", "-o", ""), ("modes", "reference.toml", "--shapes", ""),
                        ("report", "reference.toml", "-o", ""), ("run", "")):
            done = self.call(*command)
            self.assertEqual(done.returncode, 2, command)
            self.assertIn("the name is empty", done.stderr)
        self.assertEqual(content_of(self.folder), before)

    def test_mode_shapes_replace_mode_shapes_and_nothing_else(self):
        before = (self.folder / "reference.toml").read_bytes()
        done = self.call("modes", "reference.toml", "--shapes", "reference.toml")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "does not hold mode shapes")
        self.assertEqual((self.folder / "reference.toml").read_bytes(), before)
        for _ in range(2):
            self.succeed("modes", "reference.toml", "--shapes", "modes.h5")

    def test_heat_does_not_go_into_a_directory_where_a_run_is_live(self):
        shutil.copytree(__file__.rpartition("/tests/")[0] + "/params/heat", self.folder / "heat")
        process = start("run", "reference.toml", "-o", "out", *LONG, *settings(run__end_time="2 s"), cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        while not (self.folder / "out/results.h5").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        done = self.call("heat", "heat/ring-in-housing.toml", "-o", "out", "--force")
        if "finite-element module" in done.stderr:
            self.skipTest("built without finite elements")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "another run is writing into the directory")


class FullDisks(ProgramTest):
    def to_full(self, *arguments):
        with open("/dev/full", "w") as full:
            return subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)

    def test_output_that_cannot_be_written_is_a_failure(self):
        for command in (("check", "reference.toml"), ("modes", "reference.toml", "--json"), ("defaults",), ("schema",),
                        ("statics", "reference.toml", "--json"), ("run", "reference.toml", *SHORT)):
            done = self.to_full(*command)
            self.assertEqual(done.returncode, 1, (command, done.stderr))
            self.assertRegex(done.stderr, "standard output cannot be written|No space left on device")
            self.assertNotIn("fault of the program", done.stderr)

    def test_a_limit_of_file_size_is_a_failure_that_keeps_what_was_written(self):
        command = ["bash", "-c", 'ulimit -f 16000; exec "$@"', "-", PROGRAM, "run", "reference.toml", "-o", "out", *settings(run__end_time="300 ms", output__interval="2 us")]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, "results.h5 could not be written .*File too large")
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            self.assertGreater(len(file["time"]), 10)

    def test_a_disk_that_fills_up_is_told_once_and_the_state_is_saved(self):
        command = ["bash", "-c", 'ulimit -f 8000; exec "$@"', "-", PROGRAM, "run", "reference.toml", "-o", "out", "--quiet", *settings(output__interval="2 us", output__checkpoint_interval="0.01 s")]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("is saved in out/failed/checkpoint-", done.stderr)
        self.assertNotIn("could not be saved", done.stderr)
        self.assertEqual(done.stderr.count("could not be written"), 1, done.stderr)

    def test_a_mesh_that_cannot_be_written_is_a_failure_that_leaves_no_file(self):
        command = ["bash", "-c", 'ulimit -f 20; exec "$@"', "-", PROGRAM, "mesh", "reference.toml", "--bearing", "TB1", "-o", "m.msh"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=120)
        if "built without the mesh module" in done.stderr:
            self.skipTest("built without finite elements")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stderr, "cannot write m.msh")
        self.assertEqual([name for name in content_of(self.folder) if name.endswith(".msh")], [])


class DamagedResults(ProgramTest):
    def killed(self):
        """Leaves a killed run with three checkpoints in out/; where its results end on disk."""
        process = start("run", "reference.toml", "-o", "out", *LONG, cwd=self.folder)
        try:
            deadline = time.monotonic() + 60
            while len(list((self.folder / "out").glob("checkpoints/checkpoint-*.h5"))) < 3:
                self.assertIsNone(process.poll(), "the run ended before it could be killed: make LONG longer")
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
        finally:
            process.kill()
            process.communicate()
        return os.stat(self.folder / "out/results.h5").st_blocks * 512

    def resumed(self):
        return self.call("run", "reference.toml", "-o", "out", *LONG, "--resume", timeout=60)

    def test_plain_readers_open_results_of_a_live_a_killed_and_a_finished_run(self):
        process = start("run", "reference.toml", "-o", "out", *LONG, *settings(run__end_time="2 s"), cwd=self.folder)
        while not (self.folder / "out/results.h5").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        time.sleep(1.2)
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            live = len(file["time"])
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGKILL)
        process.communicate()
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            killed = len(file["time"])
            self.assertEqual(len(file["bearings/TB1/contact_force"][:killed]), killed)
        self.assertGreater(live, 0)
        self.assertGreaterEqual(killed, live)
        self.run_case("reference.toml", output="whole", run__end_time="1 ms")
        with h5py.File(self.folder / "whole/results.h5", "r") as file:
            self.assertEqual(len(file["time"]), 21)

    def test_results_that_are_cut_off_or_filled_with_zeros_are_refused_at_once(self):
        end = self.killed()
        shutil.copytree(self.folder / "out", self.folder / "sound")
        whole = os.path.getsize(self.folder / "sound/results.h5")
        for share in (0.02, 0.3, 0.7, 0.95):
            for filled in (False, True):
                if filled and share == 0.95:
                    continue  # what is lost may lie after the last checkpoint
                with self.subTest(share=share, filled=filled):
                    shutil.rmtree(self.folder / "out")
                    shutil.copytree(self.folder / "sound", self.folder / "out")
                    with open(self.folder / "out/results.h5", "r+b") as file:
                        file.truncate(int(share * end))
                        if filled:
                            file.truncate(whole)
                    before = content_of(self.folder / "out")
                    done = self.resumed()
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertRegex(done.stderr, "damaged|cannot be read as an HDF5 file")
                    self.assertEqual(content_of(self.folder / "out"), before)
                    self.assertIn(self.call("report", "out", "-o", "r.html", "--force", timeout=30).returncode, (2,) if not filled else (0, 2))

    def test_files_on_which_hdf5_itself_crashes_are_refused(self):
        # Single bytes of metadata were altered; HDF5 1.10.8 ends by a signal while it reads them.
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="0.1 ms"))
        for seed in sorted((pathlib.Path(__file__).parents[1] / "fuzz/seeds/recorded").glob("crash-*.h5")):
            with self.subTest(seed.name):
                shutil.copy(seed, self.folder / "out/results.h5")
                for command in (("report", "out", "-o", "page.html"), ("rerun", "out", "-o", "again")):
                    done = self.call(*command, timeout=60)
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertRegex(done.stderr, r"^error: out/results\.h5: this file is damaged")

    def test_one_flipped_bit_of_a_row_is_found(self):
        self.killed()
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            at = file["bearings/TB1/ring_speed"].id.get_chunk_info(0).byte_offset
        with open(self.folder / "out/results.h5", "r+b") as file:
            file.seek(at + 3)
            byte = file.read(1)[0]
            file.seek(at + 3)
            file.write(bytes([byte ^ 1]))
        done = self.resumed()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "the rows of /time are not those that were written")

    def test_rows_after_an_earlier_checkpoint_may_be_lost(self):
        # A power cut takes what was not synchronised; here the last rows of one series.
        self.killed()
        newest = sorted((self.folder / "out/checkpoints").glob("*.h5"))
        with h5py.File(newest[0], "r") as file:
            kept = int(file["extras/recorded rows"][0])
        with h5py.File(newest[-1], "r") as file:
            self.assertGreater(int(file["extras/recorded rows"][0]), kept)
        with h5py.File(self.folder / "out/results.h5", "r+") as file:
            file["time"].resize(kept, axis=0)
        done = self.resumed()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, "the results are damaged.*resumes from an earlier checkpoint")
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            times = file["time"][:]
        self.assertEqual(len(times), 1201)
        self.assertTrue(numpy.all(numpy.diff(times) > 0))

    def alter_checkpoints(self, change):
        """Their content, and their own check sums with it."""
        for file in (self.folder / "out/checkpoints").iterdir():
            body = file.read_bytes()[:-len("\nrotordrop check sum 0123456789abcdef\n")]
            with open(file, "wb") as out:
                out.write(body)
            with h5py.File(file, "r+") as content:
                change(content)
            body = file.read_bytes()
            file.write_bytes(body + f"\nrotordrop check sum {hashlib.sha256(body).hexdigest()[:16]}\n".encode())

    def test_rows_are_not_compared_with_sums_of_an_earlier_form(self):
        self.killed()

        def name_as_before(content):
            content.move("extras/recorded rows", "extras/recorded")
            content["extras/recorded"][1:] = 1.0

        self.alter_checkpoints(name_as_before)
        done = self.resumed()
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.folder / "out/results.h5", "r") as file:
            self.assertEqual(len(file["time"]), 1201)

    def test_a_checkpoint_with_a_valid_sum_and_other_content_is_refused(self):
        self.killed()

        def spoil(content):
            del content["extras/loop"]
            content["extras/loop"] = [1.0]

        self.alter_checkpoints(spoil)
        done = self.resumed()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, "does not hold what this version of the program needs")

    def test_links_to_other_files_are_not_followed(self):
        self.succeed("run", "reference.toml", "-o", "out", *SHORT)
        shutil.copy(self.folder / "out/results.h5", self.folder / "other.h5")
        with h5py.File(self.folder / "out/results.h5", "r+") as file:
            del file["energy/mechanical"]
            file["energy/mechanical"] = h5py.ExternalLink("../other.h5", "/energy/mechanical")
        done = self.call("report", "out")
        self.assertEqual(done.returncode, 2, done.stderr)

    def test_a_directory_removed_while_running_is_a_failure(self):
        process = start("run", "reference.toml", "-o", "out", *LONG, cwd=self.folder)
        while not (self.folder / "out/parameters.toml").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        while (self.folder / "out").exists():  # again if the run has just made a file
            shutil.rmtree(self.folder / "out", ignore_errors=True)
        _, err = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 1, err)
        self.assertNotIn("fault of the program", err)


class HostileInputs(ProgramTest):
    def refuse(self, *arguments, says, timeout=30, **options):
        done = self.call(*arguments, timeout=timeout, **options)
        self.assertEqual(done.returncode, 2, done.stderr[:500])
        self.assertRegex(done.stderr, says)
        self.assertNotIn("fault of the program", done.stderr)
        self.assertLess(len(done.stderr), 100_000)
        return done

    def test_deep_nesting_is_refused(self):
        self.write("drop.toml", ".".join(["a"] * 20000) + " = 1\n")
        self.refuse("check", "drop.toml", says="nested more than 100 deep")
        self.write("drop.toml", "a = " + "[" * 5000 + "]" * 5000)
        self.refuse("check", "drop.toml", says="nested more than 100 deep")
        self.refuse("check", "reference.toml", "--set", ".".join(["a"] * 20000) + "=1", says="nested more than 100 deep")
        self.write("rotor.json", "[" * 1_000_000 + "]" * 1_000_000)
        self.write("drop.toml", 'base = "reference.toml"\n[rotor]\ngeometry = "rotor.json"\n')
        self.refuse("check", "drop.toml", says="nested more than 100 deep")

    def test_dots_in_texts_and_comments_are_not_nesting(self):
        self.write("drop.toml", 'base = "reference.toml"\n# ' + "." * 300 + "\n")
        self.succeed("check", "drop.toml")

    def test_devices_pipes_and_huge_files_are_refused(self):
        os.mkfifo(self.folder / "pipe.toml")
        with open(self.folder / "huge.toml", "wb") as file:
            file.truncate(1 << 32)
        for name, says in (("/dev/zero", "a device or a pipe"), ("pipe.toml", "a device or a pipe"), ("huge.toml", "more than the"), (".", "a directory")):
            self.write("drop.toml", f'base = "{name}"\n')
            self.refuse("check", "drop.toml", says=says, timeout=10)
        self.refuse("check", "pipe.toml", says="a device or a pipe", timeout=10)

    def test_many_unknown_keys_take_no_time(self):
        self.write("drop.toml", "".join(f"k{i} = 1\n" for i in range(200_000)))
        self.refuse("check", "drop.toml", says="200000 keys; at most", timeout=20)
        self.write("drop.toml", 'base = "reference.toml"\n' + "".join(f"k{i} = 1\n" for i in range(9000)))
        self.refuse("check", "drop.toml", says="8980 more keys at the top level are unknown", timeout=20)

    def test_long_lists_of_wrong_entries_take_no_time(self):
        self.refuse("check", "reference.toml", "--set", f"rotor.unbalance=[{','.join(['1'] * 50_000)}]", says="and 49900 more faults", timeout=20)

    def test_long_lines_with_a_mistake_are_refused(self):
        for text in ("title = " + "x" * 30_000, "[rotor]\nunbalance = [" + "{node = 1}," * 3000 + "{node = 1} {node = 1}]",
                     "title = " + " " * 100_000 + "x y", "[run]\nend_time = [" + "1 ms, " * 10_000 + "]"):
            self.write("drop.toml", 'base = "reference.toml"\n' + text)
            self.assertLess(len(self.refuse("check", "drop.toml", says="this is not valid TOML", timeout=20).stderr), 2000)
        self.refuse("check", "reference.toml", "--set", "rotor.unbalance=" + "[" * 30_000 + "1", says="must be an array", timeout=20)

    def test_pipes_instead_of_results_are_refused(self):
        os.mkfifo(self.folder / "pipe.h5")
        self.refuse("rerun", "pipe.h5", says="a device or a pipe", timeout=10)
        self.refuse("modes", "reference.toml", "--shapes", "pipe.h5", says="does not hold mode shapes", timeout=10)

    def test_more_rows_than_a_disk_holds_are_refused(self):
        self.refuse("run", "reference.toml", *settings(run__end_time="1e6", output__interval="1e-7"), says="rows of results")

    def test_a_mesh_of_too_many_cells_is_refused(self):
        for key, value in (("housing_length", "250 m"), ("width", "2e7")):
            done = self.call("mesh", "reference.toml", "-o", "m.msh", *settings(**{f"bearings__TB1__{key}": value}), timeout=30)
            self.assertEqual(done.returncode, 2, (key, done.stderr))
            self.assertNotIn("fault of the program", done.stderr)

    def test_a_section_that_no_mesh_can_show_is_refused(self):
        source = __file__.rpartition("/tests/")[0]
        text = pathlib.Path(f"{source}/params/heat/ring-in-housing.toml").read_text().replace('r = ["40 mm", "60 mm"]', 'r = ["40 mm", 1e9]')
        self.assertIn("1e9", text)
        self.write("heat.toml", text)
        self.refuse("check", "heat.toml", says="no mesh can show both")
        self.refuse("heat", "heat.toml", says="no mesh can show both")

    def test_names_with_control_characters_are_refused(self):
        self.write("drop.toml", 'base = "reference.toml"\n["bearings"."T\\nB"]\ntype = "linear"\n')
        self.refuse("check", "drop.toml", says="control character")
        self.write("drop.toml", 'base = "reference.toml"\n[rotor]\ngeometry = "a\\u0000b"\n')
        self.refuse("check", "drop.toml", says="NUL")
        shutil.copy(self.folder / "reference.toml", self.folder / "a\nb.toml")
        self.refuse("check", "a\nb.toml", says="control character")

    def test_marks_of_the_report_in_a_case_are_text(self):
        shutil.copy(self.folder / "reference.toml", self.folder / "@DATA@.toml")
        self.write("@DATA@.toml", 'base = "reference.toml"\n[run]\nend_time = "1 ms"  # @JS@ @DATA@\n')
        self.succeed("run", "@DATA@.toml", "-o", "out")
        self.succeed("report", "out")
        page = (self.folder / "out/report.html").read_text()
        self.assertIn("<title>Drop @DATA@</title>", page)
        data = page.split('id="data">')[1].split("</script>")[0]
        self.assertEqual(json.loads(data)["title"], "Drop @DATA@")
        self.assertIn("@JS@", data)

    def test_names_that_cannot_be_are_bad_input(self):
        long = "x" * 300
        (self.folder / "loop").symlink_to("loop")
        (self.folder / "file").write_text("")
        for place in (long, "loop/out", "file/out"):
            self.refuse("run", "reference.toml", "-o", place, *SHORT, says=".")
            self.refuse("modes", "reference.toml", "--shapes", f"{place}/m.h5", says=".")
        for case in (f"{long}.toml", "loop", "file/case.toml"):
            self.refuse("check", case, says="cannot be read")
            self.write("drop.toml", f'base = "reference.toml"\n[rotor]\ngeometry = "{case}"\n[bearings.TB1]\ncatalogue = "6014"\n')
            self.refuse("check", "drop.toml", says="there is no such file")
        self.succeed("run", "reference.toml", "-o", "y" * 255, *SHORT)
        self.succeed("report", "y" * 255, "-o", "z" * 250 + ".html")

    def test_a_missing_geometry_does_not_hide_other_faults(self):
        self.write("drop.toml", 'base = "reference.toml"\n[rotor]\ngeometry = "none.json"\n[contact]\nair_gpa = 1\n')
        done = self.call("check", "drop.toml")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "there is no such file")
        self.assertRegex(done.stderr, 'unknown key "air_gpa"')


class Slips(ProgramTest):
    def warnings(self, text, *options):
        self.write("drop.toml", 'base = "reference.toml"\n' + text)
        done = self.succeed("check", "drop.toml", *options)
        return done.stderr

    def test_the_reference_cases_are_usual(self):
        source = __file__.rpartition("/tests/")[0]
        for name in ("neisi2019", "neisi2019-settling", "neisi2019-thrust", "neisi2019-preload"):
            self.assertEqual(self.succeed("check", f"{source}/params/{name}.toml", "--strict").stderr, "", name)

    def test_a_speed_in_rpm_without_its_unit(self):
        said = self.warnings("[run]\ninitial_speed = 9000\n")
        self.assertRegex(said, r"warning: drop.toml:3:17: run.initial_speed = 9000 rad/s is unusual")
        self.assertRegex(said, "9000 rad/s is 85944 rpm")
        said = self.warnings("[run]\ninitial_speed = 15200\n")
        self.assertRegex(said, r"surface runs at [56]\d\d m/s in bearings.TB1 \(145149 rpm")

    def test_usual_ranges_stand_beside_the_keys(self):
        # Declared with the key, shown by defaults, schema and manual, and warned of with the unit that may be meant.
        defaults = re.sub(r"\s*#?\s+", " ", self.succeed("defaults").stdout)
        self.assertIn("[length in m, > 0; usually between 5e-05 and 0.001]", defaults)
        self.assertIn("usually between -6500 and 6500", self.succeed("schema").stdout)
        said = self.warnings("[bearings.TB1]\nC0 = 31\n")
        self.assertRegex(said, r"warning: drop.toml:3:6: bearings.TB1.C0 = 31 N is unusual: it is most often between 100 and 100000000 N")
        self.assertIn('31 N is 0.031 kN. If kN is meant, write "31 kN".', said)
        for text in ("[bearings.TB1]\ncontact_stiffness = 1e300\n", "[bearings]\ncontact_stiffness = 1e15\n", "[materials.steel]\nk = 7000\n", "[rotor]\nunbalance = [{ node = 3, me = 1 }]\n"):
            with self.subTest(text):
                self.assertIn("is unusual", self.warnings(text))
        self.assertEqual(self.call("check", "drop.toml", "--strict").returncode, 2)

    def test_what_does_not_fit(self):
        for text, says in (("[rotor]\nunbalance = [{ node = 3, me = 1e300 }]\n", "unbalance#1.me = 1e.300 kg m is unusual"),
                           ("[contact]\nair_gap = \"5 mm\"\n", "contact.air_gap = 5 mm is unusual"),
                           ("[bearings.TB1]\nwidth = \"200 mm\"\n", "mm wide, more than its diameter"),
                           ("[bearings.TB2]\nwidth = \"10 mm\"\n", "its 2 rows of balls"),
                           ("[bearings.TB1]\nwidth = \"2 mm\"\n", "its row of balls of 11.91 mm needs 11.91 mm"),
                           ("[bearings.TB1]\nhousing_length = \"25 m\"\n", "more than 20 times")):
            with self.subTest(says):
                self.assertRegex(self.warnings(text), says)

    def test_a_rotor_in_millimetres_and_one_that_cannot_be(self):
        geometry = json.loads((self.folder / "neisi2019-rotor.json").read_text())
        geometry["elements"][5]["od"] = 90
        self.write("mm.json", json.dumps(geometry))
        self.assertRegex(self.warnings('[rotor]\ngeometry = "mm.json"\n'), "element 6 of the rotor has od = 90 m; .*\n.*millimetres")
        geometry["elements"][5]["od"] = 0.09
        geometry["mass_points"] = [{"node": 3, "mass": 1.0, "Ip": 100.0, "Id": 1.0}]
        self.write("disc.json", json.dumps(geometry))
        self.assertRegex(self.warnings('[rotor]\ngeometry = "disc.json"\n'), "Ip = .* more than 2 Id")

    def test_strict_makes_faults_of_warnings_and_the_summary_keeps_them(self):
        self.write("drop.toml", 'base = "reference.toml"\n[contact]\nair_gap = "1.2 mm"\n')
        done = self.call("run", "drop.toml", "-o", "out", *SHORT, "--strict")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "error: drop.toml:3:11: contact.air_gap = 1.2 mm is unusual")
        self.assertFalse((self.folder / "out").exists())
        self.succeed("run", "drop.toml", "-o", "out", *SHORT)
        warnings = self.summary()["input_warnings"]
        self.assertEqual([w["where"] for w in warnings], ["drop.toml:3:11", "reference.toml:46:8", "reference.toml:74:8"])
        for w in warnings[1:]:
            self.assertRegex(w["message"], r"leaves 0\.25 mm by radius in bearings\.TB\d, 70 mm, where the air gap is 1\.2 mm")
        self.succeed("run", "reference.toml", "-o", "usual", *SHORT)
        self.assertEqual(self.summary("usual")["input_warnings"], [])


if __name__ == "__main__":
    unittest.main()
