"""rotordrop study: the same bits whatever the workers, shards and kills; failures as rows; reruns; what is wrong is told before anything runs."""

import json
import random
import re
import shlex
import shutil
import struct
import subprocess
import sys
import time
import unittest

import h5py
import numpy

sys.path.insert(0, __file__.rpartition("/")[0])
from browser import BROWSER, DRIVER, Browser  # noqa: E402
from program import BUILD, PARAMS, SOURCE, ProgramTest, start  # noqa: E402

HAS_ELEMENTS = (BUILD / "rotordrop_fe.so").is_file()

STUDY = """
case = "drop.toml"
[vary]
"contact.friction_coefficient" = { range = [0.05, 0.3] }
damping = { keys = ["bearings.TB1.support.C_y", "bearings.TB2.support.C_y"], values = [2e3, 4e3, 8e3] }
[design]
kind = "latin-hypercube"
size = 12
[limits]
"bearings.*.peak_contact_force" = { max = "5 kN" }
[derived]
peak = { formula = "max(bearings.TB1.peak_contact_force, bearings.TB2.peak_contact_force)", unit = "N" }
[choose]
parameter = "damping"
result = "peak"
"""


def numbers_of(summary, path=""):
    """Numbers of summary.json by the names that a study gives them."""
    if path in ("input_warnings", "warnings", "limits", "second_opinion"):
        return {}
    if isinstance(summary, dict):
        return {name: value for key, inner in summary.items() for name, value in numbers_of(inner, f"{path}.{key}" if path else key).items()}
    if isinstance(summary, list):
        return {name: value for i, inner in enumerate(summary) for name, value in numbers_of(inner, f"{path}[{i}]").items()}
    if summary is None:
        return {path: numpy.nan}
    if isinstance(summary, str):
        return {path: float(summary == "yes")} if summary in ("yes", "no") else {}
    return {path: float(summary)}


def kill_until_done(folder, seed, whole):
    """Runs s.toml into killed/ and kills it at random instants of the time that it takes unbroken [s], later and later, until it has come to its end; the number of kills."""
    chance = random.Random(seed)
    for n_kills in range(200):
        running = start("study", "s.toml", "-o", "killed", "--resume", "--quiet", cwd=folder)
        try:
            running.communicate(timeout=whole * (chance.uniform(0.1, 0.5) + 0.02 * n_kills))
        except subprocess.TimeoutExpired:
            running.kill()
            running.communicate()
            continue
        assert running.returncode == 0, running.returncode
        return n_kills
    raise AssertionError("200 kills and no end")


class Studies(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case("")
        self.write("s.toml", "lanes = false\n" + STUDY)

    def study(self, output, *arguments, code=0, file="s.toml"):
        done = self.call("study", file, "-o", output, *arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def bytes_of(self, output):
        return [(self.folder / output / name).read_bytes() for name in ("study.h5", "study.csv")]

    def test_any_number_of_workers_gives_the_same_bits(self):
        self.study("one", "--jobs", "1")
        for n in ("2", "3"):
            self.study(n, "--jobs", n)
            self.assertEqual(self.bytes_of(n), self.bytes_of("one"))
        self.assertFalse((self.folder / "one/scratch").exists())

    def test_kills_at_any_instant_cost_nothing_but_time(self):
        begin = time.monotonic()
        self.study("whole")
        n_kills = kill_until_done(self.folder, 4, time.monotonic() - begin)
        self.assertGreater(n_kills, 1)
        self.assertEqual(self.bytes_of("killed"), self.bytes_of("whole"))

    def test_an_interrupted_study_says_how_to_go_on(self):
        long = ["--set", 'run.end_time="0.1 s"']
        running = start("study", "s.toml", "-o", "out", *long, cwd=self.folder)
        journal = self.folder / "out/study.journal"
        for _ in range(200):
            time.sleep(0.01)
            if journal.exists() and journal.read_text().count('"point"') > 2:
                break
        running.terminate()
        _, told = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 143)
        self.assertIn("--resume", told)
        self.study("out", "--resume", *long)
        self.study("whole", *long)
        self.assertEqual(self.bytes_of("out"), self.bytes_of("whole"))

    def test_a_page_made_while_the_study_runs_is_made_again(self):
        running = start("study", "s.toml", "-o", "out", "--jobs", "1", "--set", 'run.end_time="0.3 s"', cwd=self.folder)
        self.addCleanup(running.communicate)
        self.addCleanup(running.kill)
        journal = self.folder / "out/study.journal"
        for _ in range(2000):
            time.sleep(0.01)
            if journal.exists() and journal.read_text().count('"point"') > 0:
                break
        self.succeed("study", "report", "out")
        page = self.folder / "out/report.html"
        part = page.read_text()
        self.assertIsNone(running.poll(), "the study ended before its page was made: make it longer")
        told, _ = running.communicate(timeout=60)
        self.assertIn("report.html is made again", told)
        made = page.read_text()
        self.assertNotEqual(made, part)
        self.succeed("study", "report", "out")
        self.assertEqual(page.read_text(), made)

    def test_shards_join_to_the_same_bits(self):
        self.study("whole")
        for i in (1, 2, 3):
            self.study(f"shard-{i}", "--shard", f"{i}/3", "--quiet")
        part = self.call("study", "join", "shard-1", "shard-3", "-o", "part")
        self.assertEqual(part.returncode, 1)
        self.assertIn("4 points are in no shard", part.stderr)
        with h5py.File(self.folder / "part/study.h5") as h5:
            self.assertEqual(list(h5["/status"][:]), [0, 2, 0] * 4)
        self.succeed("study", "join", "shard-1", "shard-2", "shard-3", "-o", "joined")
        self.assertEqual(self.bytes_of("joined"), self.bytes_of("whole"))

    def test_virtual_datasets_show_the_shards_files(self):
        self.write("s.toml", STUDY + '[keep]\nresults = ["bearings.*.friction_heat", "bearings.*.second_contact_time"]\nseries = ["/bearings/TB1/contact_force", "/bearings/TB1/orbit"]\n')
        self.study("whole")
        for i in (1, 2, 3):
            self.study(f"shard-{i}", "--shard", f"{i}/3", "--quiet")
        shards = [f"shard-{i}" for i in (3, 1, 2)]
        self.succeed("study", "join", *shards, "-o", "there/joined", "--virtual")
        (self.folder / "there").rename(self.folder / "moved")
        for i in (1, 2, 3):
            (self.folder / f"shard-{i}").rename(self.folder / f"gone-{i}")
        with h5py.File(self.folder / "moved/joined/study.h5") as h5:
            self.assertTrue(numpy.isnan(h5["/results/peak"][:]).all())
        for i in (1, 2, 3):
            (self.folder / f"gone-{i}").rename(self.folder / f"shard-{i}")
        compared = []
        with h5py.File(self.folder / "moved/joined/study.h5") as h5, h5py.File(self.folder / "whole/study.h5") as whole:
            self.assertEqual(dict(h5.attrs), dict(whole.attrs))

            def compare(name, item):
                if isinstance(item, h5py.Dataset):
                    self.assertEqual(h5[name][...].tobytes(), item[...].tobytes(), name)
                    self.assertEqual(dict(h5[name].attrs), dict(item.attrs), name)
                    self.assertEqual(h5[name].is_virtual, name.startswith(("results/", "series/")), name)
                    compared.append(name)

            whole.visititems(compare)
        self.assertEqual(sum(name.startswith("series/") for name in compared), 4 * 12)
        with h5py.File(self.folder / "shard-2/shard.h5") as h5:
            self.assertEqual(list(h5["/point"][:]), [1, 4, 7, 10])
        for name in ("study.csv",):
            self.assertEqual((self.folder / "moved/joined" / name).read_bytes(), (self.folder / "whole" / name).read_bytes())
        self.succeed("study", "report", "moved/joined")
        # A shard that is missing has NaN and status 2.
        self.assertEqual(self.call("study", "join", "shard-1", "shard-3", "-o", "part", "--virtual").returncode, 1)
        with h5py.File(self.folder / "part/study.h5") as h5:
            self.assertEqual(list(h5["/status"][:]), [0, 2, 0] * 4)
            self.assertEqual(list(numpy.isnan(h5["/results/peak"][:])), [False, True, False] * 4)
        self.assertIn("given twice", self.call("study", "join", "shard-1", "shard-1", "-o", "no", "--virtual").stderr)
        (self.folder / "shard-2/shard.h5").unlink()
        self.assertIn("not finished", self.call("study", "join", *shards, "-o", "no", "--virtual").stderr)
        self.assertIn("no file shard.h5", self.call("study", "join", "whole", "-o", "no", "--virtual").stderr)
        self.assertFalse((self.folder / "no").exists())

    def test_a_journal_of_something_else_is_not_gone_on_with(self):
        self.study("out", "--shard", "1/3")
        self.assertIn("shard 1 of 3", self.study("out", "--resume", code=2).stderr)
        self.write("renamed.toml", (self.folder / "s.toml").read_text(encoding="utf-8"))
        told = self.study("out", "--resume", "--shard", "1/3", code=2, file="renamed.toml").stderr
        self.assertIn("by the name of s, not renamed", told)
        self.write("s.toml", STUDY.replace("size = 12", "size = 13"))
        self.assertIn("another study", self.study("out", "--resume", "--shard", "1/3", code=2).stderr)
        self.assertIn("holds results already", self.study("out", code=2).stderr)

    def test_results_are_columns_with_units_and_a_rerun_gives_a_row_again(self):
        told = self.study("out").stdout
        self.assertIn("95 % quantile of peak by damping", told)
        with h5py.File(self.folder / "out/study.h5") as h5:
            force = h5["/results/bearings.TB1.peak_contact_force"]
            self.assertEqual(force.attrs["units"], "N")
            self.assertEqual(h5["/parameters/damping"].attrs["units"], "N s/m")
            numpy.testing.assert_array_equal(h5["/parameters/damping"][:], h5["/parameters/bearings.TB2.support.C_y"][:])
            self.assertEqual(set(h5["/status"][:]), {0})
            forces, both = force[:], h5["/results/bearings.TB2.peak_contact_force"][:]
            numpy.testing.assert_array_equal(h5["/results/peak"][:], numpy.maximum(forces, both))
        summary = json.loads((self.folder / "out/study.json").read_text())
        self.assertEqual((summary["points"], summary["done"], summary["failed"]), (12, 12, 0))
        self.assertAlmostEqual(summary["results"]["peak"]["mean"], numpy.maximum(forces, both).mean(), places=6)
        limit = {entry["result"]: entry for entry in summary["limits"]}["bearings.TB1.peak_contact_force"]
        self.assertEqual(limit["broken"], (forces > 5000).sum())
        self.assertEqual([level["n"] for level in summary["choose"]["levels"]], [4, 4, 4])
        rows = (self.folder / "out/study.csv").read_text().splitlines()
        self.assertEqual(len(rows), 13)
        self.succeed("study", "rerun", "out", "--point", "7")
        again = json.loads((self.folder / "out/point-7/summary.json").read_text())
        self.assertEqual(again["bearings"]["TB1"]["peak_contact_force"], forces[7])
        self.assertTrue((self.folder / "out/point-7/report.html").is_file())

    def test_a_rerun_takes_what_was_varied_for_all_bearings(self):
        # TB2 keeps its own value in each point; TB1 takes that of [bearings].
        self.write("own.toml", 'base = "reference.toml"\n[bearings.TB2]\nball_damping_beta = "4e-5 s"\n')
        self.write("s.toml", 'case = "own.toml"\n[vary]\nbearings.ball_damping_beta = [1e-5, 1e-4]\nbearings.ball_model = ["quasi-static", "inertial"]\n[design]\nkind = "grid"\n')
        self.study("out", "--set", "run.end_time=9 ms")
        with h5py.File(self.folder / "out/study.h5") as h5:
            forces = {b: h5[f"/results/bearings.{b}.peak_contact_force"][:] for b in ("TB1", "TB2")}
        self.assertEqual(len(set(forces["TB1"])), 4)
        for point in range(4):
            self.succeed("study", "rerun", "out", "--point", str(point))
            again = json.loads((self.folder / f"out/point-{point}/summary.json").read_text())
            for bearing, force in forces.items():
                self.assertEqual(again["bearings"][bearing]["peak_contact_force"], force[point], (bearing, point))
            self.assertRegex((self.folder / f"out/point-{point}/parameters.toml").read_text().split("[bearings.TB2]")[1], r'ball_damping_beta = "4e-5 s"')
        self.study("out", "--set", "run.end_time=9 ms", "--resume")

    def test_points_of_several_kinds_run_one_kind_after_the_other(self):
        # Two numbers of modes, and methods of two numbers of stages: four kinds that cannot run side by side.
        self.write("s.toml", 'case = "reference.toml"\nlanes = true\n[vary]\nrotor.cut_off_frequency = [900.0, 7000.0]\nintegration.method = ["two-step-runge-kutta", "bogacki-shampine"]\ncontact.friction_coefficient = [0.1, 0.2]\n[design]\nkind = "grid"\n')
        found = []
        for jobs in ("1", "2"):
            self.study(f"out-{jobs}", "--jobs", jobs, "--set", "run.end_time=9 ms")
            with h5py.File(self.folder / f"out-{jobs}/study.h5") as h5:
                self.assertEqual(set(h5["/status"][:]), {0})
                found.append(h5["/results/bearings.TB1.peak_contact_force"][:])
        numpy.testing.assert_array_equal(*found)
        self.assertEqual(len(set(found[0])), 8)

    def test_points_have_the_bits_of_single_runs(self):
        self.write("s.toml", "lanes = false\n" + STUDY.replace("values = [2e3, 4e3, 8e3] }", 'values = [2e3, 4e3, 8e3] }\nbearings.TB1.balls_per_row = [18, 20, 22]\n"rotor.unbalance[0].me" = { range = ["1 g mm", "3 g mm"] }'))
        self.study("out", "--jobs", "2")
        with h5py.File(self.folder / "out/study.h5") as h5:
            parameters = {key: h5["/parameters"][key][:] for key in h5["/parameters"] if key != "damping"}
            results = {key: h5["/results"][key][:] for key in h5["/results"] if key != "peak"}
        for point in (0, 5, 11):
            values = {key: column[point].item() for key, column in parameters.items()}
            values["bearings.TB1.balls_per_row"] = int(values["bearings.TB1.balls_per_row"])
            arguments = [word for key, value in values.items() for word in ("--set", f"{key}={value!r}")]
            self.succeed("run", "drop.toml", "-o", f"alone-{point}", *arguments)
            alone = numbers_of(json.loads((self.folder / f"alone-{point}/summary.json").read_text()))
            self.assertEqual(set(alone) - {"run.wall_time", "run.cpu_time"}, set(results))
            different = {key for key, values in results.items() if struct.pack("d", alone[key]) != struct.pack("d", values[point])}
            self.assertEqual(different, set(), point)

    def test_drops_in_lanes_do_not_depend_on_who_runs_beside_them(self):
        """Eight, four and one beside each other, by one worker and three, in shards, killed: the same bits; and those of a drop alone but for rounding."""
        text = STUDY + '[keep]\nresults = ["bearings.*.peak_contact_force", "bearings.*.friction_heat", "energy.*"]\n'
        self.case('integration.method = "tsitouras"\nintegration.tolerance = 1e-6\n')
        self.write("s.toml", "lanes = true\n" + text)
        self.study("one", "--jobs", "1")
        whole = self.bytes_of("one")
        self.study("three", "--jobs", "3")
        self.assertEqual(self.bytes_of("three"), whole)
        shards = [f"shard-{k}" for k in (1, 2, 3)]
        for k, shard in enumerate(shards):
            self.study(shard, "--shard", f"{k + 1}/3")
        self.succeed("study", "join", *shards, "-o", "joined", "--quiet")
        self.assertEqual(self.bytes_of("joined"), whole)
        kill_until_done(self.folder, 4, 3.)
        self.assertEqual(self.bytes_of("killed"), whole)
        with h5py.File(self.folder / "one/study.h5") as h5:
            forces, heats = h5["/results/bearings.TB1.peak_contact_force"][:], h5["/results/bearings.TB1.friction_heat"][:]
        self.succeed("study", "rerun", "one", "--point", "7")
        again = json.loads((self.folder / "one/point-7/summary.json").read_text())["bearings"]["TB1"]
        self.assertEqual((again["peak_contact_force"], again["friction_heat"]), (forces[7], heats[7]))
        self.write("s.toml", text)
        self.study("unasked")
        with h5py.File(self.folder / "unasked/study.h5") as h5:
            numpy.testing.assert_array_equal(h5["/results/bearings.TB1.peak_contact_force"][:], forces)
        # Rounding grows by some 1e9 in the first impact.
        self.write("s.toml", "lanes = false\n" + text)
        self.study("alone")
        with h5py.File(self.folder / "alone/study.h5") as h5:
            numpy.testing.assert_allclose(h5["/results/bearings.TB1.peak_contact_force"][:], forces, rtol=1e-3)
            row = h5["/results/bearings.TB1.peak_contact_force"][7]
            self.assertFalse(numpy.array_equal(h5["/results/bearings.TB1.peak_contact_force"][:], forces))
        self.succeed("study", "rerun", "alone", "--point", "7")
        again = json.loads((self.folder / "alone/point-7/summary.json").read_text())
        self.assertEqual(again["bearings"]["TB1"]["peak_contact_force"], row)
        self.assertIn("another study", self.study("one", "--resume", code=2).stderr)

    def test_what_does_not_run_in_lanes_is_told_and_runs_one_by_one(self):
        self.case('integration.method = "dormand-prince"\nintegration.tolerance = 3e-7\n')
        self.assertNotIn("one by one", self.study("alone").stderr)
        self.write("s.toml", "lanes = true\n" + STUDY)
        told = self.study("out").stderr  # of a method of SUNDIALS
        self.assertIn("run one by one", told)
        named = told[told.index("integration.method") :].splitlines()[0]
        page = (SOURCE / "docs/how-to/studies.md").read_text(encoding="utf-8")
        documented = next(line for line in page.splitlines() if line.startswith("What runs in lanes:"))
        for method in re.findall(r'"[^"]+"', named):
            self.assertIn(method, documented)
        self.assertEqual(self.bytes_of("out")[1], self.bytes_of("alone")[1])

    def test_parts_that_nobody_asks_for_change_no_other_result(self):
        self.study("all")
        kept = {"few": ["bearings.*.friction_heat", "energy.*"], "whirl": ["bearings.*.whirl.*"],
                "local": ["bearings.*.local.*", "bearings.*.damage.*"], "warnings": ["run.warnings"]}
        for output, results in kept.items():
            self.write("s.toml", "lanes = false\n" + STUDY + f"[keep]\nresults = {json.dumps(results)}\n")
            self.study(output)
        with h5py.File(self.folder / "all/study.h5") as whole:
            for output in kept:
                with h5py.File(self.folder / output / "study.h5") as h5:
                    self.assertTrue(0 < len(h5["/results"]) < 50)
                    for key in h5["/results"]:
                        numpy.testing.assert_array_equal(h5["/results"][key][:], whole["/results"][key][:], err_msg=key)

    FAILING = """
case = "drop.toml"
on_failure = "POLICY"
[vary]
"integration.step" = ["5 us", "1 ms", "4 us"]
[design]
kind = "list"
"""

    def fixed_step(self, policy):
        self.case('[integration]\nmethod = "runge-kutta-4"\n')
        self.write("f.toml", self.FAILING.replace("POLICY", policy))

    def test_a_failed_drop_is_a_row_with_its_reason(self):
        self.fixed_step("go on")
        self.study("out", file="f.toml")
        with h5py.File(self.folder / "out/study.h5") as h5:
            self.assertEqual(list(h5["/status"][:]), [0, 1, 0])
            self.assertEqual(h5["/parameters/integration.step"][1], 1e-3)
            reason = h5["/reason"][1].decode()
            self.assertTrue(numpy.isnan(h5["/results/bearings.TB1.peak_contact_force"][1]))
        self.assertIn("t =", reason)
        self.assertNotIn("scratch", reason)
        self.assertEqual(json.loads((self.folder / "out/study.json").read_text())["failed"], 1)

    def test_policies_stop_and_retry(self):
        self.fixed_step("stop")
        self.assertIn("stopped after a failed drop", self.study("stop", "--jobs", "1", code=1, file="f.toml").stderr)
        self.fixed_step("retry")
        self.study("retry", file="f.toml")
        with h5py.File(self.folder / "retry/study.h5") as h5:
            self.assertIn("second", h5["/reason"][1].decode())

    def test_a_key_of_all_bearings_that_none_takes_is_told(self):
        self.write("s.toml", 'case = "reference.toml"\n[vary]\nbearings.contact_stiffness = [1e9, 2e9]\nbearings.ball_model = ["quasi-static", "inertial"]\n[design]\nkind = "list"\n')
        told = self.succeed("study", "s.toml", "-o", "out", "--dry-run").stderr
        self.assertRegex(told, r"s.toml:3:\d+: bearings.contact_stiffness has no effect: every touchdown bearing has a value of its own.\n +Vary bearings.TB1.contact_stiffness")
        self.assertNotIn("ball_model", told)

    def test_a_rerun_of_a_point_that_was_done_in_a_second_try_is_that_try(self):
        self.write("s.toml", 'case = "reference.toml"\non_failure = "retry"\n[vary]\nintegration.tolerance = [1e-6, 4e-3]\n[design]\nkind = "list"\n')
        self.study("out", "--set", "run.end_time=9 ms", "--set", 'run.fatal_warnings=["energy-residual"]', "--set", "integration.step=1 ms", "--set", "integration.method=tsitouras")
        with h5py.File(self.folder / "out/study.h5") as h5:
            self.assertEqual([reason.decode()[:20] for reason in h5["/reason"][:]], ["", "done in a second try"])
            force = h5["/results/bearings.TB1.peak_contact_force"][1]
        self.succeed("study", "rerun", "out", "--point", "1")
        again = json.loads((self.folder / "out/point-1/summary.json").read_text())
        self.assertEqual(again["bearings"]["TB1"]["peak_contact_force"], force)

    def test_series_are_kept_by_choice(self):
        self.write("s.toml", STUDY.replace("size = 12", "size = 2") + '[keep]\nresults = ["bearings.*.friction_heat"]\nseries = ["/bearings/TB1/contact_force"]\n')
        self.study("out")
        with h5py.File(self.folder / "out/study.h5") as h5:
            series, times = h5["/series/1/bearings/TB1/contact_force"], h5["/series/1/bearings/TB1/contact_force_time"]
            self.assertEqual(series.attrs["units"], "N")
            self.assertEqual(series.shape, times.shape)
            self.assertGreater(series[:].max(), 100)
            self.assertEqual(set(h5["/results"]), {"bearings.TB1.friction_heat", "bearings.TB2.friction_heat", "bearings.TB1.peak_contact_force", "bearings.TB2.peak_contact_force", "bearings.TB1.first_touch_time", "bearings.TB2.first_touch_time",
                                                    "bearings.TB1.ends_in_first_contact", "bearings.TB2.ends_in_first_contact", "peak"}, "with what tells whether the limit is assessed")

    def test_entries_of_lists_are_set_on_the_command_line_too(self):
        import tomllib

        self.succeed("run", "drop.toml", "-o", "out", "--set", "rotor.unbalance[1].me=3e-6 kg m", "--set", "rotor.initial_offset[0]=10 um", "--set", "run.end_time=1 ms")
        rotor = tomllib.loads((self.folder / "out/parameters.toml").read_text())["rotor"]
        self.assertIn("3e-06", str(rotor["unbalance"][1]["me"]).replace("3e-6", "3e-06"))
        self.assertIn("1.07e-06", str(rotor["unbalance"][0]["me"]).replace("1.07e-6", "1.07e-06"))
        self.assertEqual(str(rotor["initial_offset"][0]), "10 um")
        self.assertIn("no entry 2", self.call("run", "drop.toml", "-o", "no", "--set", "rotor.unbalance[2].me=1e-6").stderr)

    def test_an_entry_that_is_set_is_told_beside_the_place_of_its_list(self):
        self.succeed("run", "drop.toml", "-o", "out", "--set", "bearings.TB1.conformity[0]=0.53", "--set", "run.end_time=1 ms")
        line = next(line for line in (self.folder / "out/parameters.toml").read_text().splitlines() if line.startswith("conformity = [0.53, 0.52]"))
        self.assertRegex(line, r"# from reference\.toml:\d+.*; \[0\] from --set$")
        with h5py.File(self.folder / "out/results.h5") as h5:
            given = {row[0]: row[3] for row in json.loads(h5["/given"][()])["values"]}
        self.assertRegex(given["bearings.TB1.conformity"], r"reference\.toml:\d+.*; \[0\] from --set$")
        self.assertEqual(sum("[0] from --set" in line for line in (self.folder / "out/parameters.toml").read_text().splitlines()), 1, "not of TB2")

    def test_a_point_that_ran_in_lanes_is_run_again_in_lanes(self):
        self.write("s.toml", STUDY)
        self.study("out")
        self.succeed("study", "rerun", "out", "--point", "3", "--quiet")
        with h5py.File(self.folder / "out/point-3/results.h5") as h5:
            self.assertEqual(h5.attrs["lanes"], "yes")
        done = self.succeed("rerun", "out/point-3/results.h5", "-o", "again", "--quiet")
        self.assertIn("the same bits", done.stdout)

    def test_a_dry_run_computes_and_writes_nothing(self):
        told = self.study("out", "--dry-run").stdout
        self.assertIn("12 drops", told)
        self.assertRegex(told, r"about [^,]* of CPU and .* of results")
        self.write("s.toml", STUDY)
        self.assertRegex(self.study("out", "--dry-run").stdout, r"about .* of CPU one by one, .* in lanes, and .* of results")
        self.assertFalse((self.folder / "out").exists())

    def test_what_is_unusual_in_points_alone_is_told_before_the_drops(self):
        varied = 'case = "drop.toml"\n[vary]\nrun.initial_speed = ["1000 rpm", 15200]\nrun.ambient = [70, "20 degC", 80]\nrun.end_time = ["1 ms", "2 ms"]\n[design]\nkind = "grid"\n'
        self.write("v.toml", varied)
        for arguments in (["--dry-run"], ["--quiet"]):
            said = " ".join(self.study("out", *arguments, file="v.toml").stderr.split())
            self.assertEqual(said.count("warning:"), 4, said)  # the surface in both bearings, too
            self.assertRegex(said, r"warning: v\.toml:3:\d+: 6 of 12 points: run\.initial_speed = 15200 rad/s is unusual: .*15200 rpm.* Point \d+: run\.initial_speed = 15200, run\.ambient = ")
            self.assertRegex(said, r"warning: v\.toml:4:\d+: 8 of 12 points: run\.ambient = 70 K is unusual")
            self.assertIn("6 of 12 points: the rotor's surface runs at", said)
        # What the base has is told once, and not again for its points.
        said = self.study("out", "--dry-run", "--set", "bearings.TB1.f2=25", file="v.toml").stderr
        self.assertEqual(said.count("bearings.TB1.f2 = 25 is unusual"), 1)
        self.assertNotIn("points: bearings.TB1.f2", said)
        self.assertEqual(self.study("out2", "--dry-run", file="s.toml").stderr, "")
        # Of a range: one warning, whatever the drawn values; of a search the corners are looked at.
        self.write("m.toml", 'case = "drop.toml"\n[vary]\nbearings.TB1.support.K_y = { range = [2.7, 2.7e9] }\n[minimise]\nresult = "bearings.TB1.peak_contact_force"\nevaluations = 6\n')
        self.write("l.toml", 'case = "drop.toml"\n[vary]\nbearings.TB1.support.K_y = { range = [1, 1000] }\nrun.end_time = ["1 ms"]\n[design]\nkind = "latin-hypercube"\nsize = 8\n')
        self.assertRegex(self.study("out3", "--dry-run", file="l.toml").stderr, r"l\.toml:3:\d+: 8 of 8 points: bearings\.TB1\.support\.K_y = [0-9.]+ N/m is unusual")
        self.assertEqual(self.study("out3", "--dry-run", file="l.toml").stderr.count("N/m is unusual"), 1)
        self.assertRegex(self.study("out3", "--dry-run", file="m.toml").stderr, r"points: bearings\.TB1\.support\.K_y = 2\.7 N/m is unusual")

    def test_shipped_studies_have_no_unusual_points(self):
        for file in sorted((PARAMS / "studies").glob("*.toml")):
            with self.subTest(file.name):
                self.assertEqual(self.study("out", "--dry-run", "--set", 'run.end_time="10 ms"', file=file).stderr, "")

    def test_bad_input_is_told_before_anything_is_written(self):
        for change, message in ((("0.05, 0.3", "0.3, 0.05"), "range is empty"), (("size = 12", "size = 1000000000000"), "size"),
                                (("contact.friction_coefficient", "contact.friction_coeficient"), "Did you mean"), (("0.05, 0.3", "-0.3, 0.3"), "no valid case"),
                                (('"contact.friction_coefficient" = { range = [0.05, 0.3] }', "contact.friction_coefficient = { min = 0.05, max = 0.3 }"), "{ range = [from, to] }"),
                                (('"contact.friction_coefficient" = { range = [0.05, 0.3] }', '"rotor.initial_offset[0]" = { values = [0, "-900 um"] }'), "is no valid case: the rotor starts 900 um from the centre"),
                                (('values = [2e3, 4e3, 8e3] }\n[design]\nkind = "latin-hypercube"\nsize = 12', 'range = [1, 2] }\n[design]\nkind = "grid"\nlevels = 100000'), "1e+10 drops"),
                                (("size = 12", 'size = 12\n[keep]\nseries = ["/bearings/TB1/contact_forc"]'), "Did you mean \"/bearings/TB1/contact_force\"?"),
                                (("peak_contact_force\" =", "peak_force\" ="), "limit is on nothing")):
            with self.subTest(message=message):
                self.write("bad.toml", STUDY.replace(*change))
                self.assertIn(message, self.study("out", code=2, file="bad.toml").stderr)
                self.assertFalse((self.folder / "out").exists())
        self.assertIn("not a shard", self.study("out", "--shard", "0/3", code=2).stderr)
        self.assertIn("no study file", self.call("study").stderr)

    @unittest.skipUnless(DRIVER and BROWSER, "chromium and chromium-driver are not installed (./install-dependencies --tests)")
    def test_the_report_of_one_drop_has_no_empty_sections(self):
        self.case("")
        self.write("one.toml", 'case = "drop.toml"\n[vary]\ncontact.friction_coefficient = [0.2]\n[design]\nkind = "grid"\n')
        self.study("one", file="one.toml")
        self.succeed("study", "report", "one")
        browser = Browser()
        self.addCleanup(browser.close)
        browser.open(self.folder / "one/report.html")
        self.assertEqual([m["message"] for m in browser.log("browser")], [])
        self.assertEqual(browser.run("return [...document.querySelectorAll('h2')].map((e) => e.textContent)"), ["Answers", "Response", "Provenance"])
        self.assertIn("rotordrop study rerun one --point 0", browser.run("return document.querySelector('#response').textContent"))

    @unittest.skipUnless(DRIVER and BROWSER, "chromium and chromium-driver are not installed (./install-dependencies --tests)")
    def test_the_report_is_drawn_and_an_axis_selects(self):
        self.study("out")
        self.succeed("study", "report", "out")
        browser = Browser()
        self.addCleanup(browser.close)
        browser.open(self.folder / "out/report.html")
        self.assertEqual(browser.run("return document.getElementById('page').dataset.ready"), "yes")
        self.assertEqual([m["message"] for m in browser.log("browser")], [])
        self.assertEqual([url for url in browser.requests() if not url.startswith(("file:", "data:"))], [])
        self.assertEqual(browser.run("return document.querySelectorAll('#response circle').length"), 2 * 12)
        # More numbers than a function takes as arguments, some 120 000.
        self.assertEqual(browser.run("const x = scaleOf({ values: Array.from({ length: 300000 }, (_, i) => i) }, 0, 1); return [x.at(0) < 0.1, x.at(299999) > 0.9]"), [True, True])
        self.assertEqual(browser.run("return element('g', {}, Array.from({ length: 150000 }, () => 'x')).childNodes.length"), 150000)
        self.assertEqual(browser.run("return document.querySelectorAll('#worst-points tbody tr').length"), 10)
        self.assertIn("--point", browser.run("return document.querySelector('#worst-points tbody tr').textContent"))
        with h5py.File(self.folder / "out/study.h5") as h5:
            worst = int(h5["/results/peak"][:].argmax())
        self.assertEqual(browser.run("return document.querySelector('#worst-points tbody td').textContent"), str(worst))
        # Of limits to both sides the worst drop is the one farthest outside, here below them.
        worst = browser.run("""data.limits.push({ result: "both", min: 10, max: 20 });
            const result = { name: "both", values: [15, 22, 3, null, 19, 11] };
            return [worstOf(result), worstWords(result, 5)]""")
        self.assertEqual(worst[0], [2, 1, 4, 5, 0], "7 below, 2 above, 1 within (twice), 5 within")
        self.assertIn("The 5 drops farthest beyond the limits of both", worst[1])
        # Evenly spread numbers on an even axis, however small the smallest; those that are even in the logarithm on a logarithmic one.
        middles = browser.run("""const at = (values, middle) => scaleOf({ values }, 0, 1).at(middle);
            return [at([0.01, 1, 2, 3, 4, 5, 6.01], 3.01), at([1e3, 1e4, 1e5, 1e6, 1e7], 1e5)]""")
        numpy.testing.assert_allclose(middles, 0.5, atol=1e-9)
        # Commands are ready for a shell, whatever the folder is called.
        folders, commands = ["out/a-1", "my study", "it's"], []
        for folder in folders:
            shutil.copytree(self.folder / "out", self.folder / "copy")
            (self.folder / "copy").rename(self.folder / folder)
            self.succeed("study", "report", folder, "--force")
            browser.open(self.folder / folder / "report.html")
            commands.append(browser.run("return rerunCommand(7)"))
        self.assertEqual([shlex.split(command) for command in commands], [["rotordrop", "study", "rerun", folder, "--point", "7"] for folder in folders])
        self.assertEqual(commands[0], "rotordrop study rerun out/a-1 --point 7")
        # A drag over the upper half of the first axis leaves the drops in that half.
        selected = browser.run("""const axis = document.querySelector('.axis-hit'), box = axis.getBoundingClientRect(), x = box.left + box.width / 2;
            axis.setPointerCapture = () => {};
            const send = (type, y) => axis.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, bubbles: true }));
            send('pointerdown', box.top); send('pointermove', box.top + box.height / 2); send('pointerup', box.top + box.height / 2);
            return document.querySelector('#parallel-coordinates .note').textContent""")
        with h5py.File(self.folder / "out/study.h5") as h5:
            friction = h5["/parameters/contact.friction_coefficient"][:]
        self.assertIn(f"{(friction > (friction.min() + friction.max()) / 2).sum()} of 12 drops selected", selected)


SEARCH = """
case = "drop.toml"
[vary]
contact.friction_coefficient = { range = [0.1, 0.3] }
damping = { keys = ["bearings.TB1.support.C_y", "bearings.TB1.support.C_z", "bearings.TB2.support.C_y", "bearings.TB2.support.C_z"], range = [1e3, 1e7], scale = "log" }
[design]
size = 2
[derived]
peak = { formula = "max(bearings.TB1.peak_contact_force, bearings.TB2.peak_contact_force)", unit = "N" }
[minimise]
result = "peak"
of = "quantile"
over = ["damping"]
evaluations = 12
searches = 2
tolerance = 0.05
"""


@unittest.skipUnless(HAS_ELEMENTS, "the program has no finite-element room")
class UnitsOfElements(ProgramTest):
    def test_every_number_of_a_drop_with_finite_elements_has_a_unit(self):
        for coupling, group in (("reduced", ".fe.modes"), ("windowed", "windows.largest_growth_error")):
            self.write("drop.toml", f"""
base = "reference.toml"
run.end_time = "9 ms"
thermal.models = ["lumped", "fe"]
thermal.driver = "fe"
thermal.expansion = "elastic"
thermal.growth_by_speed = "closed-form"
thermal.fe.section = "plain"
thermal.fe.coupling = "{coupling}"
""")
            self.write("study.toml", 'case = "drop.toml"\n[vary]\n"contact.friction_coefficient" = [0.1, 0.2]\n[design]\nkind = "list"\n')
            self.succeed("study", "study.toml", "-o", coupling)
            with h5py.File(self.folder / coupling / "study.h5") as file:
                results = {name: dict(values.attrs) for name, values in file["results"].items()}
            self.assertTrue(any(name.endswith(group) for name in results), group)
            nameless = [name for name, told in results.items() if not told.get("units") or not told.get("long_name")]
            self.assertEqual(nameless, [])


class Searches(ProgramTest):
    def setUp(self):
        super().setUp()
        self.case("")
        self.write("s.toml", SEARCH)

    def bytes_of(self, output):
        return [(self.folder / output / name).read_bytes() for name in ("study.h5", "study.csv")]

    def test_any_workers_and_kills_give_the_same_bits(self):
        self.succeed("study", "s.toml", "-o", "one", "--jobs", "1")
        for n in ("2", "3"):
            begin = time.monotonic()
            self.succeed("study", "s.toml", "-o", n, "--jobs", n)
            self.assertEqual(self.bytes_of(n), self.bytes_of("one"))
        n_kills = kill_until_done(self.folder, 5, time.monotonic() - begin)
        self.assertGreater(n_kills, 1)
        self.assertEqual(self.bytes_of("killed"), self.bytes_of("one"))

    def test_the_best_is_no_worse_than_a_grid_and_can_be_run_again(self):
        told = self.succeed("study", "s.toml", "-o", "out").stdout
        self.assertIn("smallest 95 % quantile of peak", told)
        found = json.loads((self.folder / "out/study.json").read_text())["minimise"]
        with h5py.File(self.folder / "out/study.h5") as h5:
            peak, damping, friction = (h5[path][:] for path in ("/results/peak", "/parameters/damping", "/parameters/contact.friction_coefficient"))
            self.assertEqual(set(h5["/search"][:]), {0, 1})
            self.assertEqual(len(h5["/evaluation"]), len(peak))
        # Every evaluation has the same sample of friction; its 95 % quantile by numpy, whose default is the same type 7.
        self.assertEqual(len(set(friction)), 2)
        values = [numpy.quantile(peak[a : b + 1], 0.95) for a, b in (e["points"] for e in found["course"])]
        numpy.testing.assert_allclose([e["value"] for e in found["course"]], values, rtol=1e-12)
        self.assertEqual(found["best"]["value"], min(e["value"] for e in found["course"]))
        # A grid of the same drops, by the queue of designs: no level is better by more than a permille.
        grid = f"""
case = "drop.toml"
[vary]
contact.friction_coefficient = {list(dict.fromkeys(friction.tolist()))}
damping = {{ keys = ["bearings.TB1.support.C_y", "bearings.TB1.support.C_z", "bearings.TB2.support.C_y", "bearings.TB2.support.C_z"], values = [1e3, 1e4, 1e5, 1e6, 1e7] }}
[design]
kind = "grid"
[derived]
peak = {{ formula = "max(bearings.TB1.peak_contact_force, bearings.TB2.peak_contact_force)", unit = "N" }}
"""
        self.write("g.toml", grid)
        self.succeed("study", "g.toml", "-o", "grid")
        with h5py.File(self.folder / "grid/study.h5") as h5:
            levels = h5["/parameters/damping"][:]
            by_level = [numpy.quantile(h5["/results/peak"][:][levels == level], 0.95) for level in set(levels)]
        self.assertLess(found["best"]["value"], min(by_level) * 1.001)
        self.assertGreater(max(by_level), found["best"]["value"] * 1.01)
        point = found["best"]["points"][0]
        self.succeed("study", "rerun", "out", "--point", str(point))
        again = json.loads((self.folder / f"out/point-{point}/summary.json").read_text())
        self.assertEqual(max(again["bearings"][b]["peak_contact_force"] for b in ("TB1", "TB2")), peak[point])

    def test_a_search_is_no_shard_and_a_dry_run_tells_its_size(self):
        self.assertIn("cannot be divided", self.call("study", "s.toml", "-o", "out", "--shard", "1/2").stderr)
        told = self.succeed("study", "s.toml", "-o", "out", "--dry-run").stdout
        self.assertIn("at most 2 x 12 evaluations of 2 drops each", told)
        self.assertFalse((self.folder / "out").exists())

    @unittest.skipUnless(DRIVER and BROWSER, "chromium and chromium-driver are not installed (./install-dependencies --tests)")
    def test_the_report_shows_the_course(self):
        self.succeed("study", "s.toml", "-o", "out")
        self.succeed("study", "report", "out")
        browser = Browser()
        self.addCleanup(browser.close)
        browser.open(self.folder / "out/report.html")
        self.assertEqual(browser.run("return document.getElementById('page').dataset.ready"), "yes")
        self.assertEqual([m["message"] for m in browser.log("browser")], [])
        found = json.loads((self.folder / "out/study.json").read_text())["minimise"]
        self.assertEqual(browser.run("return document.querySelectorAll('#search circle').length"), len(found["course"]))
        self.assertIn(f"{found['best']['points'][0]} to {found['best']['points'][1]}", browser.run("return document.querySelector('#search tbody tr').textContent"))


if __name__ == "__main__":
    unittest.main()
