#!/usr/bin/env python3
"""Every number of a case a hundred or a thousand times too large or too small: which of them pass without a warning?

    tests/faults/scaled_values.py PROGRAM CASE [FACTOR...]

Each number of the case as it is resolved, defaults included, is scaled alone (factors: 1000, 0.001, 100 and 0.01 unless given) and checked with
--strict. What passes is listed: a value that may well be meant, or one whose usual range is too wide. Exit codes: 0; 1 if the program ended
otherwise than with 0 or 2.
"""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib


def numbers_of(table, path=()):
    """(key, number, unit) of all numbers of a table that are not zero."""
    for key, value in table.items():
        if key in ("title", "note"):
            continue
        if isinstance(value, dict):
            yield from numbers_of(value, (*path, key))
        elif isinstance(value, (int, float)) and not isinstance(value, bool) and value != 0:
            yield ".".join((*path, key)), float(value), ""
        elif isinstance(value, str) and (given := re.fullmatch(r"([-+0-9.eE]+) (.+)", value)) and float(given[1]) != 0:
            yield ".".join((*path, key)), float(given[1]), given[2]


def passing(program, case, factors):
    """{(key, value): factors that pass in silence}, and the commands that ended otherwise than with 0 or 2."""
    silent, strange = collections.defaultdict(list), []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", case, "-o", f"{folder}/out", "--quiet", "--set", 'run.end_time="1 us"'], capture_output=True, check=True)
        resolved = tomllib.loads(pathlib.Path(folder, "out/parameters.toml").read_text())
    for key, number, unit in numbers_of(resolved):
        if key == "run.end_time":
            continue
        for factor in factors:
            value = f'"{number * factor:g} {unit}"' if unit else f"{number * factor:g}"
            command = [program, "check", case, "--strict", "--set", f"{key}={value}"]
            code = subprocess.run(command, capture_output=True, timeout=120).returncode
            if code == 0:
                silent[key, f"{number:g} {unit}".strip()].append(factor)
            elif code != 2:
                strange.append((code, command))
    return silent, strange


def main():
    program, case = (str(pathlib.Path(word).resolve()) for word in sys.argv[1:3])
    factors = [float(word) for word in sys.argv[3:]] or [1000, 0.001, 100, 0.01]
    silent, strange = passing(program, case, factors)
    for (key, value), passed in silent.items():
        print(f"{key} = {value}: times", ", ".join(f"{factor:g}" for factor in passed))
    for code, command in strange:
        print("exit code", code, *command)
    print(f"{sum(map(len, silent.values()))} of the scaled values pass in silence")
    return 1 if strange else 0


if __name__ == "__main__":
    sys.exit(main())
