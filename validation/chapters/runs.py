"""Runs of the program that are done once: a folder per key of program, parameters and what is kept of the results."""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import threading
import tomllib

from . import cases, measures

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = (".cpp", ".h", ".in", ".txt", ".cmake", ".py")


class RunError(RuntimeError):
    """A program or script that validation needs ended with an error."""


def hash_of_files(paths, root=ROOT):
    """One number for the contents and the names of files and of all files in folders."""
    digest = hashlib.sha256()
    for path in paths:
        path = pathlib.Path(path)
        files = sorted(p for p in path.rglob("*") if p.is_file() and p.suffix in SOURCES) if path.is_dir() else [path]
        for file in files:
            digest.update(os.path.relpath(file, root).encode() + b"\0" + file.read_bytes() + b"\0")
    return digest.hexdigest()


def parameter_files(path):
    """A case file, the files it is based on, and the rotor's geometry: all that its parameters come from."""
    path = pathlib.Path(path)
    table = tomllib.loads(path.read_text())
    geometry = table.get("rotor", {}).get("geometry")
    rotor = [path.parent / geometry] if isinstance(geometry, str) else []
    return [path, *rotor, *(parameter_files(path.parent / table["base"]) if "base" in table else [])]


def key_of(source, base, settings, kept="", root=ROOT):
    """Key of a run: hash of the program's sources, the parameters' files, the settings and the code that keeps the results.

    A run with the same key is not done again. Whatever can change a number is in it; comments of the report, or the order of settings, are not."""
    digest = hashlib.sha256()
    for part in (source, hash_of_files(parameter_files(base), root), json.dumps(settings, sort_keys=True), kept):
        digest.update(part.encode() + b"\0")
    return digest.hexdigest()[:20]


def revision(root=ROOT):
    """Git revision, with a word when there are local changes; "unknown" outside a repository."""
    def git(*arguments):
        return subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True, check=True).stdout.strip()

    try:
        return git("rev-parse", "--short=10", "HEAD") + (" with local changes" if git("status", "--porcelain", "--untracked-files=no") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def check_call(command, cwd=None, timeout=1500):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, timeout=timeout, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise RunError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stderr.strip() or done.stdout.strip()}")
    return done.stdout


class Cache:
    """Results below a folder, each in a folder named by its key; a folder without done.json was interrupted and is made again."""

    def __init__(self, folder, program, root=ROOT, report=print):
        self.folder, self.program, self.root, self.report = pathlib.Path(folder), pathlib.Path(program), root, report
        # The folder src and the build's recipes; the program is built from them before anything runs.
        self.source = hash_of_files([root / "src", root / "CMakeLists.txt", root / "cmake"], root)
        self.computed = self.reused = 0
        self._lock = threading.Lock()

    def keep(self, key, name, make):
        """Folder of a result; make(folder) fills it and returns what goes into done.json, which comes back as second value."""
        folder = self.folder / key
        try:
            done = json.loads((folder / "done.json").read_text())
        except (OSError, ValueError):
            done = None
        if done is None:
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            done = make(folder)
            (folder / "done.json.part").write_text(json.dumps({"name": name, "result": done}))
            (folder / "done.json.part").rename(folder / "done.json")
            done = {"name": name, "result": done}
            with self._lock:
                self.computed += 1
                self.report(f"  computed  {name}")
        else:
            with self._lock:
                self.reused += 1
        return folder, done["result"]

    def drop(self, name, base, settings, keep_series=False):
        """Runs a case; (folder, measures). The series are deleted after measuring unless they are wanted: a run has 7 MB of them."""
        kept = hash_of_files([pathlib.Path(measures.__file__)]) + ("series" if keep_series else "")
        key = key_of(self.source, base, settings, kept, self.root)

        def make(folder):
            case = folder / "case.toml"
            case.write_text(cases.case_text(os.path.relpath(base, folder), settings))
            check_call([self.program, "run", case, "-o", folder / "run", "--quiet"])
            result = measures.of_run(folder / "run")
            if not keep_series:
                (folder / "run" / "results.h5").unlink()
            return result

        return self.keep(key, name, make)


def run_all(jobs, tasks):
    """Calls tasks {name: function} on some threads; {name: result}. The first fault ends it."""
    with concurrent.futures.ThreadPoolExecutor(max_workers=jobs) as pool:
        futures = {pool.submit(task): name for name, task in tasks.items()}
        results = {}
        try:
            for future in concurrent.futures.as_completed(futures):
                results[futures[future]] = future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
        return results
