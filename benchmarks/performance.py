#!/usr/bin/env python3
"""Table of what the program costs: docs/performance.md.

    /usr/bin/python3 benchmarks/performance.py [--build build/release] [--previous PROGRAM --previous-case FILE] [--rounds 7] [--update]

Kernels and right-hand sides come from rotordrop_benchmarks, repeated; whole drops, start-up and finite elements from the program. Programs run by turns, so
that what else happens on the machine meets all of them; every figure is CPU time, the least of the rounds, and behind it the median's surplus over the least: a
machine that does other work shows in the surplus first.
"""

import argparse
import json
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs"))
from child_cpu import with_cpu_of_children  # noqa: E402
from document_tables import put_between  # noqa: E402

DOCUMENT = ROOT / "docs/performance.md"
CASE = ROOT / "params/neisi2019-settling.toml"
HEAT = ROOT / "params/heat/ring-in-housing.toml"
#: with 128 unknowns, as validation/heat_cost_freefem.py has it
LINEAR_HEAT = [ROOT / "validation/heat_two_bodies.toml"] + [
    word for key in ("cells=2", "grading=25", "end_grading=1", "growth=2", "time_tolerance=1e-2") for word in ("--set", f"fe.{key}")]
BEGIN, END = "<!-- performance.py: begin -->\n", "<!-- performance.py: end -->"
BESIDE = ["--set", 'thermal.models=["lumped", "fe"]']
WINDOWS = ["--set", 'thermal.models=["fe"]', "--set", "thermal.fe.coupling=windowed"]
DROPS_OF_STUDY = 64
NO_ROWS = ["--set", "output.interval=0.1", "--set", "output.detail_interval=0.1"]
#: with it energy closed to 1e-5 J and orbits stayed within 0.2 um in 72 of 72 starts (docs/theory/convergence.md)
LOOSER = ["--set", "integration.tolerance=2.5e-6"]
#: the third order of Neisi 2019, table 4
WAVES = "bearings.waviness=[" + ", ".join(f'{{surface="{surface}", order=3, amplitude="1 um"}}' for surface in ("inner", "outer", "bore")) + "]"
OTHER_DROPS = {kind: ["--set", setting]
               for kind, setting in {"waves": WAVES, "full": "rotor.model=full", "arc": "bearings.ring_bending=arc", "inertial": "bearings.ball_model=inertial"}.items()}

#: what drop_with/KIND of the benchmarks has more than the reference drop
MORE = {"nothing": "nothing more: what the turns leave", "finite_elements_beside": "finite elements beside the circuit", "inertial_balls": "balls with inertia", "waves": "waves of the third order on races and bores, 1 um", "bent_rings": "bent rings over the arc of contact",
        "all_modes": "rotor with all its modes, up to 87 kHz"}

KERNELS = [
    ("balls", "ball", "one ball, its forces and energies"),
    ("balls_of_the_yardstick", "ball", "the same by the yardstick of `benchmarks/yardstick.h`"),
    ("balls_and_their_tractions", "ball", "one ball, its forces, energies and tractions, as at the ends of steps"),
    ("power_from_tables", "power", "a power of a penetration with the contact's exponent, waited for"),
    ("power_of_the_library", "power", "the same by the C library"),
    ("right_hand_side_of/rigid_rings", "call", "right-hand side, rigid rings that translate"),
    ("right_hand_side_of/free_rings", "call", "right-hand side, rigid rings that also tilt and move along the axis"),
    ("right_hand_side_of/wavy_races_and_bores", "call", "right-hand side, rigid rings that translate, a wave on each race and in the bore"),
    ("right_hand_side_of/inertial_balls", "call", "right-hand side, rigid rings that translate, balls with inertia"),
    ("right_hand_side_of/bent_rings", "call", "right-hand side, bent rings over the arc of contact"),
    ("right_hand_side_of/bent_rings_and_inertial_balls", "call", "right-hand side, bent rings over the arc of contact, balls with inertia"),
    ("right_hand_side_in_lanes", "drop", "right-hand side of one of eight drops in lanes, rigid rings that translate"),
    ("recorded_row", "row", "one recorded row, written to the file"),
    ("local_rub/process_time", "row", "local temperatures and wear where one bearing rubs, two bands and their shares, of one row"),
]


def three_digits(number):
    """As text, without an exponent where it is large."""
    text = f"{number:.3g}"
    return f"{float(text):.0f}" if "e+" in text else text


class Samples(list):
    """CPU times [s] of one thing."""

    def text(self, unit, per_second):
        if not self:
            return "-"
        least, middle = min(self), statistics.median(self)
        return f"{three_digits(least * per_second)} {unit} (+{(middle / least - 1.0) * 100.0:.0f} %)" if least > 0 else f"0 {unit}"


def cpu_of(command, **options):
    """CPU of a process and its children [s]."""
    words = [str(word) for word in command]
    return with_cpu_of_children(lambda: subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options))[1]


def version_of(program):
    return subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.strip()


def kernels(program, rounds):
    """Times of each benchmark [s], by repetition, and the least that a cycle took [s]."""
    out = subprocess.run(
        [program, "--benchmark_format=json", f"--benchmark_repetitions={rounds}", "--benchmark_min_time=0.1",
         "--benchmark_filter=^(" + "|".join(name for name, _, _ in KERNELS) + ")$", "--benchmark_enable_random_interleaving=true"],
        check=True, capture_output=True, text=True).stdout
    found, cycle = {}, float("inf")
    for run in json.loads(out)["benchmarks"]:
        if run["run_type"] != "iteration":
            continue
        name = run["run_name"]
        thing = next(thing for known, thing, _ in KERNELS if known == name)
        found.setdefault(name, Samples()).append(run[f"per_{thing}"])
        cycle = min(cycle, run[f"per_{thing}"] / run[f"cycles_per_{thing}"])
    return found, cycle


def by_level(program, pattern, levels):
    """Runs of benchmarks, for each instruction set that the machine has."""
    found = {}
    for level in levels:
        done = subprocess.run([program, "--benchmark_format=json", f"--benchmark_filter={pattern}"], capture_output=True, text=True,
                              env={**os.environ, "ROTORDROP_ISA": level})
        if done.returncode == 0:
            found[level] = json.loads(done.stdout)["benchmarks"]
    return found


def lanes(program):
    """Milliseconds of a drop in lanes and of a single one, and how many times as many drops, by instruction set: the median of the benchmark's turns."""
    return {level: runs[0] for level, runs in by_level(program, "^lanes", ("v4-newton", "v4", "v3", "base")).items()}


def drops_with_more(program):
    """Counters of drop_with/KIND by (kind, instruction set): the benchmark's turns with the plain drop."""
    return {(run["run_name"].split("/")[1], level): run
            for level, runs in by_level(program, "^drop_with", ("v4-newton", "v4", "v3")).items() for run in runs if "times" in run}


def drop(program, case, folder, settings):
    """CPU of a drop and of its whole process [s], into a new folder: what stands there would be removed in the drop's time."""
    out = pathlib.Path(folder, "drop")
    shutil.rmtree(out, ignore_errors=True)
    process = cpu_of([program, "run", case, *settings, "--quiet", "-o", out])
    run = json.loads((out / "summary.json").read_text(encoding="utf-8"))["run"]
    return run["cpu_time"], process


def drop_with(program, case, folder, settings):
    """CPU of a drop [s]; None if the program does not know the settings."""
    try:
        return drop(program, case, folder, settings)[0]
    except subprocess.CalledProcessError:
        return None


def drop_of_study(program, case, folder):
    """CPU of a drop of a study that keeps all results [s]; None if the program knows no such study."""
    study = pathlib.Path(folder, "friction.toml")
    study.write_text(f'case = "{case}"\n[vary]\ncontact.friction_coefficient = {{ range = [0.05, 0.3] }}\n'
                     f'[design]\nkind = "latin-hypercube"\nsize = {DROPS_OF_STUDY}\n', encoding="utf-8")
    try:
        return cpu_of([program, "study", study, "--jobs", "1", "--quiet", "--force", "-o", pathlib.Path(folder, "study")]) / DROPS_OF_STUDY
    except subprocess.CalledProcessError:
        return None


def heat(program, folder):
    """CPU per step and unknown of a heat run [s]; None without finite elements."""
    out = pathlib.Path(folder, "heat")
    try:
        cpu_of([program, "heat", HEAT, "--quiet", "--force", "-o", out])
        solved = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        return solved["cpu_time"] / solved["steps"] / solved["unknowns"]
    except (subprocess.CalledProcessError, FileNotFoundError, KeyError):
        return None


def heat_process(program, folder):
    """CPU of a whole process that heats a section it has met before [s]; None without finite elements."""
    out = pathlib.Path(folder, "heat")
    try:
        return [cpu_of([program, "heat", *LINEAR_HEAT, "--quiet", "--force", "-o", out]) for _ in range(2)][1]
    except (subprocess.CalledProcessError, FileNotFoundError):
        return None


def programs_table(programs, rounds):
    """Rows of (what, texts of each program)."""
    samples = {}
    with tempfile.TemporaryDirectory() as folder:
        for turn in range(rounds):
            for name, (program, case, settings) in programs.items():
                def add(what, value):
                    if value is not None:
                        samples.setdefault(what, {}).setdefault(name, Samples()).append(value)
                in_drop, process = drop(program, case, folder, settings)
                bare, _ = drop(program, case, folder, settings + NO_ROWS)
                if name == "this":
                    add("looser", drop_with(program, case, folder, settings + LOOSER))
                for _ in range(2):  # as below
                    add("beside", drop_with(program, case, folder, settings + BESIDE))
                add("bare_beside", drop_with(program, case, folder, settings + BESIDE + NO_ROWS))
                add("windows", drop_with(program, case, folder, settings + WINDOWS + NO_ROWS))
                for what, other in OTHER_DROPS.items():
                    add(what, drop_with(program, case, folder, settings + other + NO_ROWS))
                # Twice in a round: memory that is touched for the first time after other programs costs up to a quarter of a drop.
                for of_drop, of_process in ((in_drop, process), drop(program, case, folder, settings)):
                    add("drop", of_drop)
                    add("process", of_process)
                add("bare", bare)
                add("study", drop_of_study(program, case, folder))
                add("start", cpu_of([program, "--version"]))
                short, whole = drop(program, case, folder, settings + ["--set", "run.end_time=1ms"])
                add("fixed", whole - short)
                add("heat", heat(program, folder))
                add("heat_process", heat_process(program, folder))
                print(f"round {turn + 1} of {rounds}: {name}", flush=True)
    texts = [
        ("drop", "reference drop of 0.3 s with its records (`run.cpu_time`)", "ms", 1e3),
        ("looser", "the same with a tolerance of 2.5e-6", "ms", 1e3),
        ("bare", "reference drop almost without rows", "ms", 1e3),
        ("beside", "reference drop with its records and finite elements beside the circuit: 76 more values in each row", "ms", 1e3),
        ("bare_beside", "almost without rows, finite elements beside the circuit", "ms", 1e3),
        ("windows", "almost without rows, finite elements in windows instead of the circuit", "ms", 1e3),
        ("full", "almost without rows, rotor with all its modes, up to 87 kHz (`rotor.model = \"full\"`)", "ms", 1e3),
        ("waves", "almost without rows, waves of the third order on races and bores, 1 um", "ms", 1e3),
        ("arc", "almost without rows, bent rings over the arc of contact", "ms", 1e3),
        ("inertial", "almost without rows, balls with inertia", "ms", 1e3),
        ("process", "the whole process of the reference drop with its records", "ms", 1e3),
        ("study", f"a drop of a study of {DROPS_OF_STUDY} over friction that keeps all results, by one job", "ms", 1e3),
        ("fixed", "a process of a drop of 1 ms, without the drop", "ms", 1e3),
        ("start", "`rotordrop --version`", "ms", 1e3),
        ("heat", "finite elements of `rotordrop heat` with k and c over temperature, per step and unknown", "us", 1e6),
        ("heat_process", "a process of `rotordrop heat`, linear, 128 unknowns, of a section that it has met before", "ms", 1e3),
    ]
    return [(what, [samples.get(key, {}).get(name, Samples()).text(unit, scale) for name in programs])
            for key, what, unit, scale in texts if key in samples]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--previous", type=pathlib.Path, help="program of the previous release, to run by turns with this one")
    parser.add_argument("--previous-case", type=pathlib.Path, default=CASE, help="the reference case as that release has it, if that program does not know this one's keys")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--update", action="store_true", help=f"put the tables into {DOCUMENT.relative_to(ROOT)}")
    a = parser.parse_args()

    found, cycle = kernels(a.build / "rotordrop_benchmarks", a.rounds)
    lines = ["", "| | time | cycles |", "|---|---|---|"]
    for name, _, what in KERNELS:
        times = found[name]
        unit, scale = ("us", 1e6) if min(times) > 1e-6 else ("ns", 1e9)
        lines.append(f"| {what} | {times.text(unit, scale)} | {three_digits(min(times) / cycle)} |")

    lines += ["", "| drops in memory, without series | in lanes | one by one | times as many |", "|---|---|---|---|"]
    for level, of in lanes(a.build / "rotordrop_benchmarks").items():
        lines.append(f"| eight at once, instruction set {level} | {of['lane_drop_ms']:.3g} ms a drop | {of['single_drop_ms']:.3g} ms | "
                     f"{of['times']:.3g} ({of['times_least']:.3g} to {of['times_largest']:.3g}) |")

    lines += ["", "| drops with more, in memory, almost without rows | a drop | reference drop | times as long |", "|---|---|---|---|"]
    for (kind, level), of in drops_with_more(a.build / "rotordrop_benchmarks").items():
        lines.append(f"| {MORE[kind]}, instruction set {level} | {of['drop_ms']:.3g} ms | {of['plain_drop_ms']:.3g} ms | "
                     f"{of['times']:.3g} ({of['times_low']:.3g} to {of['times_high']:.3g}) |")

    programs = {"this": (a.build / "rotordrop", CASE, [])}
    if a.previous:
        programs["previous"] = (a.previous, a.previous_case, [])
    lines += ["", "| | this version |" + (" previous release |" if a.previous else ""),
              "|---|---|" + ("---|" if a.previous else "")]
    for what, values in programs_table(programs, a.rounds):
        lines.append(f"| {what} | " + " | ".join(values) + " |")

    cpu = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    load = os.getloadavg()[0]
    lines = [f"Machine: {cpu.group(1) if cpu else platform.processor()}, {os.cpu_count()} cores, load {load:.1f} at the end; {a.rounds} rounds.",
             f"This version: {version_of(a.build / 'rotordrop')}."] + (
                 [f"Previous release: {version_of(a.previous)}."] if a.previous else []) + lines
    text = "\n".join(lines) + "\n"
    print(text)
    if a.update:
        put_between(DOCUMENT, BEGIN, END, text)


if __name__ == "__main__":
    main()
