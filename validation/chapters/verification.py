"""Tables of convergence, energy and independent programs: from the tests' own output, from runs and from the scripts of validation/. Nothing typed in."""

import json
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from . import runs

TESTS = "^verification/"
BOILERPLATE = re.compile(r"^(Running main\(\)|Note: |\[[ =\-A-Z]+\]|$|\s*\d+ tests? |ok$)")
SCRIPTS = {"heat_freefem.py": ("FreeFEM", "FreeFem++"), "heat_getdp.py": ("GetDP", "getdp")}
PEER_NEEDS = ("numpy", "scipy", "numba")


def printed_by(text):
    """What a test printed beside the test framework's own lines."""
    return "\n".join(line.rstrip() for line in text.splitlines() if not BOILERPLATE.match(line)).strip("\n")


def of_junit(text):
    """Tests of a JUnit file: name, group, passed, seconds, and their printed tables."""
    tests = []
    for case in ElementTree.fromstring(text).iter("testcase"):
        name = case.attrib["name"]
        failed = case.find("failure") is not None or case.attrib.get("status") == "fail"
        skipped = case.find("skipped") is not None or case.attrib.get("status") in ("notrun", "disabled")
        tests.append({"name": name.removeprefix("verification/"), "group": name.removeprefix("verification/").split(".")[0], "state": "failed" if failed else "skipped" if skipped else "passed",
                      "seconds": float(case.attrib.get("time", 0)), "printed": printed_by(case.findtext("system-out") or "")})
    return tests


def run_tests(cache, build):
    """The verification tests of the build, with what they print."""
    if not (build / "tests/CTestTestfile.cmake").is_file():
        return {"skipped": "the tests are not built"}
    key = "tests-" + runs.hash_of_files([cache.root / "src", cache.root / "tests", __file__], cache.root)[:14]

    def make(folder):
        file = folder / "tests.xml"
        command = ["ctest", "-R", TESTS, "--test-output-size-passed", "200000", "--output-junit", str(file)]
        subprocess.run(command, cwd=build, capture_output=True, timeout=1500)
        if not file.is_file():
            raise runs.RunError("ctest wrote no results")
        return of_junit(file.read_text())

    return {"tests": cache.keep(key, "verification tests", make)[1]}


def convergence(cache):
    """Tables of validation/convergence.py, as it writes them."""
    script = cache.root / "validation/convergence.py"
    key = "convergence-" + runs.hash_of_files([cache.root / "src", cache.root / "params", script, __file__, *sorted((cache.root / "params").glob("neisi*"))], cache.root)[:14]

    def make(folder):
        shutil.copy(cache.root / "docs/theory/convergence.md", folder)
        runs.check_call([sys.executable, script, "--program", cache.program, "--write", folder, "--images", folder, "--work", folder / "work"])
        shutil.rmtree(folder / "work", ignore_errors=True)
        return tables_between_markers((folder / "convergence.md").read_text())

    return cache.keep(key, "convergence of the time integration (validation/convergence.py)", make)[1]


def tables_between_markers(text):
    """{name: rows of cells} of the tables that convergence.py writes."""
    tables = {}
    for name, body in re.findall(r"<!-- (\w+): written by [^>]*-->\n(.*?)<!-- end of \1 -->", text, re.DOTALL):
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in body.splitlines() if line.startswith("|")]
        tables[name] = [row for i, row in enumerate(rows) if i != 1]
    return tables


def other_program(cache, script, name, command):
    """rotordrop heat against FreeFEM or GetDP: the largest difference, or that the other is not installed."""
    if not shutil.which(command):
        return {"other": name, "skipped": f"{command} is not installed"}
    path = cache.root / "validation" / script
    inputs = [cache.root / "src", path, *sorted((cache.root / "validation").glob("heat_*.toml"))]
    key = f"{path.stem}-" + runs.hash_of_files(inputs, cache.root)[:14]

    def make(folder):
        done = subprocess.run([sys.executable, str(path), str(cache.program), str(folder / "report.json")], capture_output=True, text=True, timeout=1500)
        if done.returncode not in (0, 1) or not (folder / "report.json").is_file():
            raise runs.RunError(f"{script} ended with {done.returncode}: {done.stderr.strip()[-500:]}")
        return json.loads((folder / "report.json").read_text())

    return {"other": name, **cache.keep(key, f"rotordrop heat against {name}", make)[1]}


def leaves(tree, path=""):
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{path}{key}.")
        elif not isinstance(value, (list, str)):
            yield f"{path}{key}", value


PEER_CASES = {"settling": ("ideal", 30.0), "table": ("ideal+damping-table", 0.0)}
COMPARED = ("first_contact_time", "peak_contact_force", "peak_contact_force_time", "first_bounce_apex", "peak_friction_heat_rate", "friction_heat", "catch_up_time", "ring_speed_end", "mean_contact_force_end", "load_torque_peak",
            "spin_torque_peak", "temperature_rise_end.inner_ring", "temperature_rise_end.shaft", "temperature_rise_end.ball", "temperature_rise_end.outer_ring", "temperature_rise_end.housing")


def peer(cache, measures):
    """The drop itself by validation/peer/drop_peer.py, which shares no code with the program, against the same cases here."""
    found = subprocess.run([sys.executable, "-c", f"import {', '.join(PEER_NEEDS)}"], capture_output=True, text=True)
    if found.returncode:
        return {"other": "drop_peer.py", "skipped": f"needs {', '.join(PEER_NEEDS)} ({found.stderr.strip().splitlines()[-1]})"}
    here = cache.root / "validation/peer"
    inputs = [here / "drop_peer.py", here / "reference-case.toml", cache.root / "params/neisi2019-rotor.json", __file__]
    result = {"other": "drop_peer.py", "cases": {}}
    for name, (case, alpha) in PEER_CASES.items():
        key = f"peer-{name}-" + runs.hash_of_files(inputs, cache.root)[:14]

        def make(folder, alpha=alpha):
            runs.check_call([sys.executable, here / "drop_peer.py", "--case", here / "reference-case.toml", "--rotor", cache.root / "params/neisi2019-rotor.json", "--alpha", alpha, "--step", "2.5e-6", "--out", folder / "peer.json"])
            return json.loads((folder / "peer.json").read_text())["bearings"]

        theirs = cache.keep(key, f"drop_peer.py, {name}", make)[1]
        rows = []
        for bearing, numbers in theirs.items():
            ours, theirs_flat = dict(leaves(measures[case]["bearings"][bearing])), dict(leaves(numbers))
            for quantity in COMPARED:
                a, b = ours.get(quantity), theirs_flat.get(quantity)
                rows.append({"bearing": bearing, "quantity": quantity, "ours": a, "theirs": b, "relative_difference": a / b - 1 if a is not None and b else None})
        result["cases"][name] = rows
    return result


def energy(measures):
    """Residuals of energy and heat over all runs of the study."""
    rows = []
    for name, m in measures.items():
        e = m["summary"]["energy"]
        spin = max(abs(n["spin_up"]["residual"]) / n["friction_heat"] for n in m["bearings"].values())
        rows.append({"run": name, "dissipated": e["dissipated"], "residual": e["residual"], "heat_residual": e["heat_residual"], "heat_deposited": e["heat_deposited"], "spin_up": spin})
    return {"runs": len(rows), "largest_residual": max(abs(r["residual"]) for r in rows), "largest_heat_residual": max(abs(r["heat_residual"]) for r in rows), "largest_spin_up": max(r["spin_up"] for r in rows),
            "worst": sorted(rows, key=lambda r: -abs(r["residual"]))[:5], "reference": next((r for r in rows if r["run"] == "ideal"), None)}


def tasks(cache, build):
    others = {f"{name}": (lambda s=script, n=name, c=command: other_program(cache, s, n, c)) for script, (name, command) in SCRIPTS.items()}
    return {"tests": lambda: run_tests(cache, build), "convergence": lambda: convergence(cache), **others}


def chapter(found, cache, measures):
    return {"tests": found["tests"], "convergence": found["convergence"], "heat": [found[name] for name, _ in SCRIPTS.values()], "peer": peer(cache, measures), "energy": energy(measures)}
