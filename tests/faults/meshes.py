#!/usr/bin/env python3
"""Meshes with altered bytes: each is read by a program of its own, which must take or refuse it.

    tests/faults/meshes.py PROGRAM [COUNT] [SEED]

Seeds are the meshes of tests/fuzz/seeds/mesh, text and binary. A mesh on which the program ends by a signal or with exit code 1, or takes
longer than 60 s, is left in the current folder and named. Exit codes: 0 none of them did, 1 one did.
"""

import collections
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FAILURES = {"crashes on": "gmsh crashes", "come to an end": "gmsh does not end", "far more memory": "gmsh wants too much memory"}


def altered(seeds, chance):
    text = bytearray(chance.choice(seeds))
    for _ in range(chance.randint(1, 4)):
        at, kind = chance.randrange(len(text)), chance.random()
        if kind < 0.4:
            text[at] = chance.randrange(256)
        elif kind < 0.6:
            del text[at:at + chance.randint(1, 40)]
        elif kind < 0.8:
            text[at:at] = chance.choice([b"-1", b"0", b"99999999", b"4000000000", b"1e308", b"\n", b" "])
        else:
            other = chance.randrange(len(text))
            text[at:at] = text[other:other + chance.randint(1, 40)]
    return bytes(text)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    count, seed = (int(sys.argv[k]) if len(sys.argv) > k else default for k, default in ((2, 1000), (3, 1)))
    chance = random.Random(seed)
    seeds = [file.read_bytes() for file in sorted((SOURCE / "tests/fuzz/seeds/mesh").iterdir())]
    found, faults = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder) / "altered.msh"
        for number in range(count):
            mesh.write_bytes(altered(seeds, chance))
            command = [program, "mesh", SOURCE / "params/neisi2019.toml", "--set", f"thermal.fe.mesh={mesh}", "--bearing", "TB1", "-o", mesh.with_name("out.msh"), "--force"]
            try:
                done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=60)
                code, words = done.returncode, " ".join(done.stderr.split())
            except subprocess.TimeoutExpired:
                code, words = "none after 60 s", ""
            if code == 2:
                found[next((name for part, name in FAILURES.items() if part in words), "refused")] += 1
            elif code == 0:
                found["taken"] += 1
            else:
                faults += 1
                left = pathlib.Path(f"mesh-{seed}-{number}.msh")
                left.write_bytes(mesh.read_bytes())
                print(f"exit code {code}: {left}\n{words}", flush=True)
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{count} altered meshes, {faults} faults; " + ", ".join(f"{n} {name}" for name, n in found.most_common()) + f"; at most {memory:.0f} MB")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
