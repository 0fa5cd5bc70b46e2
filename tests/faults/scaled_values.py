#!/usr/bin/env python3
"""Every number of a case a hundred or a thousand times too large or too small: which of them pass without a warning?

    tests/faults/scaled_values.py PROGRAM CASE [FACTOR...]

Each number of the case as it is resolved, defaults included, is scaled alone (factors: 1000, 0.001, 100 and 0.01 unless given) and checked with
--strict. What passes is listed: a value that may well be meant, or one whose usual range is too wide. Exit codes: 0; 1 if the program ended
otherwise than with 0 or 2.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib


def numbers_of(value, key=""):
    """(key, number, unit) of all numbers that are not zero, of tables and lists."""
    if isinstance(value, dict):
        for name, entry in value.items():
            if name not in ("title", "note"):
                yield from numbers_of(entry, f"{key}.{name}" if key else name)
    elif isinstance(value, list):
        for i, entry in enumerate(value):
            yield from numbers_of(entry, f"{key}[{i}]")
    elif isinstance(value, (int, float)) and not isinstance(value, bool) and value != 0:
        yield key, float(value), ""
    elif isinstance(value, str) and (given := re.fullmatch(r"([-+0-9.eE]+) (.+)", value)) and float(given[1]) != 0:
        yield key, float(given[1]), given[2]


def with_value(tree, path, value):
    """A copy of a tree in which one value is another."""
    step, rest = path[0], path[1:]
    copy = list(tree) if isinstance(tree, list) else dict(tree)
    copy[step] = with_value(tree[step], rest, value) if rest else value
    return copy


def rotor_numbers(geometry):
    """(path, number) of what a rotor's file says of its shaft and masses."""
    for part, keys in (("nodes", ("x",)), ("elements", ("od",)), ("mass_points", ("mass", "Ip", "Id")), ("material", ("E", "rho"))):
        entries = enumerate(geometry[part]) if isinstance(geometry[part], list) else [(None, geometry[part])]
        for i, entry in entries:
            for key in keys:
                if entry.get(key):
                    yield (part, key) if i is None else (part, i, key), entry[key]


def passing(program, case, factors):
    """{(key, value): factors that pass in silence}, and the commands that ended otherwise than with 0 or 2."""
    silent, strange = collections.defaultdict(list), []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", case, "-o", f"{folder}/out", "--quiet", "--set", 'run.end_time="1 us"'], capture_output=True, check=True)
        resolved = tomllib.loads(pathlib.Path(folder, "out/parameters.toml").read_text())
        geometry = resolved["rotor"].pop("geometry")

        def look(key, value, factor, assignment):
            command = [program, "check", case, "--strict", "--set", assignment]
            code = subprocess.run(command, capture_output=True, timeout=120).returncode
            if code == 0:
                silent[key, value].append(factor)
            elif code != 2:
                strange.append((code, command))

        for key, number, unit in numbers_of(resolved):
            for factor in factors if key != "run.end_time" else []:
                value = f'"{number * factor:g} {unit}"' if unit else f"{number * factor:g}"
                look(key, f"{number:g} {unit}".strip(), factor, f"{key}={value}")
        for path, number in rotor_numbers(geometry):
            for factor in factors:
                file = pathlib.Path(folder, "rotor.json")
                file.write_text(json.dumps(with_value(geometry, path, number * factor)))
                look("rotor.geometry." + ".".join(map(str, path)), f"{number:g}", factor, f'rotor.geometry="{file}"')
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
