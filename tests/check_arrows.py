#!/usr/bin/env python3
"""Reads the #include lines of src/ and fails on an arrow that should not be there, a file that is too long or a folder that is too full.

    python3 tests/check_arrows.py                  # first proves that it finds faults, then checks src/ and the page of docs
    python3 tests/check_arrows.py --self-test      # only the first
    python3 tests/check_arrows.py --draw FILE.svg  # draws the rooms; the page's picture is docs/images/rooms.svg

The rules:
- A folder holds at most 15 sources, headers not counted. A file has at most 400 lines, but for those of LONG_FILES that hold one idea.
- A room may include its own headers and those of the rooms that ROOMS gives it, written "room/header.h".
- rotor, bearing and thermal never include each other; they meet in machine.
- case, study and cli see machine, integrate, io and the contracts, and of the parts only headers named *_parameters.h: what can be
  asked of a part goes through machine and analysis.
- A room may lie in another's folder: thermal/fe. Nobody else includes its headers; it is loaded at run time.
- A library belongs to the rooms that LIBRARIES gives it. SUNDIALS: only integrate. HDF5 and toml++: only io; zlib: io and cache; OpenSSL: io. deal.II, UMFPACK,
  CHOLMOD, PETSc, MPI and gmsh: only thermal/fe. pybind11: only python.
- What a room's CMakeLists.txt names under DEPENDS must be in ROOMS too.
- docs/images/rooms.svg shows what ROOMS says, and docs/reference/source-layout.md has a line for each room.

Exit codes: 0 no fault, 1 faults found, 2 no src/ to read.
"""

import argparse
import pathlib
import re
import sys
import tempfile

import room_drawing

# Whom a room may include, besides itself. "rotor:parameters" means headers named *_parameters.h of that room.
PARAMETERS_OF_PARTS = {"rotor:parameters", "bearing:parameters", "thermal:parameters"}
ROOMS = {
    "base": set(),
    "model": {"base"},
    "laws": {"base"},
    "rotor": {"base", "model", "laws"},
    "bearing": {"base", "model", "laws"},
    "thermal": {"base", "model", "laws"},
    "conduction": {"base", "model"},
    "thermal/fe": {"base", "model", "laws", "conduction"},
    "machine": {"base", "model", "laws", "rotor", "bearing", "thermal"},
    "integrate": {"base", "model"},
    "analysis": {"base", "model", "laws", "rotor", "bearing", "thermal", "machine", "integrate"},
    "io": {"base", "model"},
    "cache": {"base", "model", "conduction", "io"},
    "case": {"base", "model", "machine", "integrate", "analysis", "io", "cache"} | PARAMETERS_OF_PARTS,
    "study": {"base", "model", "machine", "integrate", "analysis", "io", "case"} | PARAMETERS_OF_PARTS,
    "study/mpi": {"study"},
    "study/openturns": {"study"},
    "cli": {"base", "model", "machine", "integrate", "analysis", "io", "case", "study"} | PARAMETERS_OF_PARTS,
    "python": {"base", "model", "machine", "analysis", "io", "case", "study"},
}

# What a room holds, in the drawing.
WORDS = {
    "base": "units, errors, parameters",
    "model": "contracts of the parts",
    "laws": "pure functions of physics",
    "rotor": "beams, modes, unbalance",
    "bearing": "ball rows, touchdown, supports",
    "thermal": "circuits, sections, heat",
    "conduction": "heat conduction in time",
    "thermal/fe": "finite elements, loaded at run time",
    "machine": "the parts assembled",
    "integrate": "time steps and equilibria",
    "analysis": "what is asked of a machine",
    "io": "files of all kinds",
    "cache": "kept between runs",
    "case": "from a file to a machine",
    "study": "the work of the commands",
    "study/mpi": "studies over ranks, loaded at run time",
    "study/openturns": "surrogates, loaded at run time",
    "cli": "the commands",
    "python": "the package for Python",
}

# Files over 400 lines that may stay, and why.
LONG_FILES = {}
MOST_LINES, MOST_SOURCES = 400, 15

# Library, how its headers begin, and who may include them. Libraries that are not listed are free for all.
LIBRARIES = [
    ("SUNDIALS", r"(arkode|cvodes?|idas?|kinsol|nvector|sundials|sunlinsol|sunmatrix|sunnonlinsol|sunmemory|sunadaptcontroller)/", {"integrate"}),
    ("HDF5", r"(hdf5(_hl)?\.h|H5)", {"io"}),
    ("zlib", r"zlib", {"io", "cache"}),
    ("OpenSSL", r"openssl/", {"io"}),
    ("toml++", r"(toml\+\+/|toml\.hpp)", {"io"}),
    ("nlohmann-json", r"nlohmann/", {"io", "case", "study", "cli", "python"}),
    ("OpenTURNS", r"openturns/", {"study/openturns"}),
    ("NLopt", r"nlopt", {"study"}),
    ("UDUNITS", r"udunits", {"base"}),
    ("CLI11", r"CLI/", {"cli"}),
    ("deal.II", r"deal\.II/", {"thermal/fe"}),
    ("UMFPACK", r"umfpack", {"thermal/fe"}),
    ("CHOLMOD", r"cholmod", {"thermal/fe"}),
    ("PETSc", r"petsc", {"thermal/fe"}),
    ("gmsh", r"gmsh", {"thermal/fe"}),
    ("MPI", r"mpi\.h", {"thermal/fe", "study/mpi"}),
    ("pybind11", r"(pybind11/|Python\.h)", {"python"}),
]
GENERATED = {"base": {"rotordrop_git_revision.h"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]*)"|<([^>]*)>|(\S.*))')


def may_include(room, other, header):
    if other == room or other in ROOMS[room]:
        return True
    return f"{other}:parameters" in ROOMS[room] and header.endswith("_parameters.h")


def room_of(path):
    """The innermost room in whose folder a path such as "thermal/fe/grid_lines.h" lies, or None."""
    folders = path.split("/")[:-1]
    while folders and "/".join(folders) not in ROOMS:
        folders.pop()
    return "/".join(folders) or None


def fault_of_include(room, quoted, angled, computed):
    """What is wrong with one #include line of a room, or None."""
    if computed is not None:
        return f"cannot tell what it includes: {computed}"
    name = quoted if quoted is not None else angled
    first = room_of(name)
    if first is not None:
        if may_include(room, first, name):
            return None
        allowed = ", ".join(sorted(ROOMS[room])) or "no other room"
        return f'{room} -> {first} ("{name}"); {room} may include: {allowed}'
    for library, beginning, rooms in LIBRARIES:
        if re.match(beginning, name, re.IGNORECASE) and room not in rooms:
            return f"{room} includes {library} (<{name}>); only for: {', '.join(sorted(rooms)) or 'nobody'}"
    if quoted is not None and name not in GENERATED.get(room, set()):
        return f'"{name}" is no header of a room; write "room/header.h"'
    return None


def faults_of_source(file, room):
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match and (fault := fault_of_include(room, *match.groups())):
            yield f"{file}:{number}: {fault}"


def faults_of_cmake(file, room):
    """DEPENDS of rotordrop_room(), and rotordrop_ROOM in target_link_libraries()."""
    text = re.sub(r"#.*", "", file.read_text(encoding="utf-8"))
    named = set()
    for names in re.findall(r"\bDEPENDS\s+((?:[a-z_]+\s*)+)", text):
        named |= {word for word in names.split() if word in ROOMS}
    for names in re.findall(r"target_link_libraries\(([^)]*)\)", text):
        named |= {word.removeprefix("rotordrop_") for word in names.split()[1:]} & set(ROOMS)
    for other in sorted(named - ROOMS[room] - {room}):
        yield f"{file}: {room} -> {other} is no arrow of tests/check_arrows.py"


def faults_of_size(source):
    """Files with too many lines, and folders with too many sources."""
    texts = {".h", ".hpp", ".cpp", ".cc", ".ipp", ".inc", ".js", ".css", ".html"}
    for folder in sorted([source, *(path for path in source.rglob("*") if path.is_dir())]):
        n_sources = sum(file.suffix in {".cpp", ".cc"} for file in folder.iterdir())
        if n_sources > MOST_SOURCES:
            yield f"{folder}: {n_sources} sources; a folder holds at most {MOST_SOURCES}: make folders in it, one subject each"
    for file in sorted(path for path in source.rglob("*") if path.suffix in texts):
        n_lines = file.read_text(encoding="utf-8").count("\n")
        if n_lines > MOST_LINES and file.relative_to(source).as_posix() not in LONG_FILES:
            yield f"{file}: {n_lines} lines; a file has at most {MOST_LINES}: divide it by its ideas"


def find_faults(source):
    """All faults of a source tree, and the number of files read."""
    faults, n_files = list(faults_of_size(source)), 0
    for folder in sorted(path for path in source.iterdir() if path.is_dir()):
        room = folder.name
        if room not in ROOMS:
            faults.append(f"{folder}: {room} is no room of tests/check_arrows.py; say there whom it may include")
            continue
        for file in sorted(folder.rglob("*")):
            if file.suffix in {".h", ".hpp", ".cpp", ".cc", ".ipp", ".inc"}:
                n_files += 1
                faults.extend(faults_of_source(file, room_of(file.relative_to(source).as_posix())))
            elif file.name == "CMakeLists.txt":
                faults.extend(faults_of_cmake(file, room_of(file.relative_to(source).as_posix())))
    return faults, n_files


def drawing():
    used = {}
    for library, _, rooms in LIBRARIES:
        for room in rooms:
            used.setdefault(room, []).append(library)
    # The libraries that belong to one room or two; the others say nothing about a room.
    few = {library for library, _, rooms in LIBRARIES if len(rooms) <= 2}
    return room_drawing.drawing(ROOMS, WORDS, {room: ", ".join(library for library in libraries if library in few) for room, libraries in used.items()})


def faults_of_page(docs):
    picture, page = docs / "images/rooms.svg", docs / "reference/source-layout.md"
    if not picture.is_file() or picture.read_text(encoding="utf-8") != drawing():
        yield f"{picture} does not show what ROOMS says; renew it: python3 tests/check_arrows.py --draw {picture}"
    text = page.read_text(encoding="utf-8") if page.is_file() else ""
    for room in ROOMS:
        if not re.search(rf"^\| `{room}` \| \S", text, re.MULTILINE):
            yield f"{page} has no line for {room}: | `{room}` | what it holds |"


# Files of a tree with one fault each, what the message must say; None: no fault.
PROOFS = [
    ("rotor/a.cpp", '#include "bearing/row/ball_row.h"\n', "rotor -> bearing"),
    ("bearing/a.cpp", '#include "thermal/circuit/thermal_network.h"\n', "bearing -> thermal"),
    ("thermal/a.h", '  #  include "rotor/geometry.h"  // with blanks\n', "thermal -> rotor"),
    ("thermal/fe/a.h", "#include <bearing/row/ball_row.h>\n", "thermal/fe -> bearing"),
    ("model/a.h", '#include "laws/hertz.h"\n', "model -> laws"),
    ("base/a.h", '#include "model/ports.h"\n', "base -> model"),
    ("thermal/fe/a.h", '#include "rotor/geometry.h"\n', "thermal/fe -> rotor"),
    ("thermal/fe/a.h", '#include "thermal/circuit/thermal_network.h"\n', "thermal/fe -> thermal "),
    ("thermal/fe/a.h", '#include "thermal/fe/b.h"\n#include "model/heat_conduction.h"\n#include <deal.II/base/point.h>\n', None),
    ("thermal/a.cpp", '#include "thermal/fe/a.h"\n', "thermal -> thermal/fe"),
    ("study/a.cpp", '#include "thermal/fe/a_parameters.h"\n', "study -> thermal/fe"),
    ("thermal/a.cpp", "#include <deal.II/base/point.h>\n", "thermal includes deal.II"),
    ("thermal/fe/a.cpp", "#include <hdf5.h>\n", "thermal/fe includes HDF5"),
    ("machine/a.cpp", '#include "integrate/integrator.h"\n', "machine -> integrate"),
    ("io/a.cpp", '#include "case/case.h"\n', "io -> case"),
    ("study/a.cpp", '#include "cli/commands.h"\n', "study -> cli"),
    ("study/a.cpp", '#include "bearing/row/ball_row.h"\n', "study -> bearing"),
    ("study/a.cpp", '#include "bearing/touchdown_parameters.h"\n', None),
    ("analysis/a.cpp", '#include "io/hdf5/recorder.h"\n', "analysis -> io"),
    ("analysis/a.cpp", "#include <nlohmann/json.hpp>\n", "analysis includes nlohmann-json"),
    ("machine/a.cpp", '#include "analysis/drop.h"\n', "machine -> analysis"),
    ("study/a.cpp", '#include "analysis/drop.h"\n', None),
    ("case/a.cpp", '#include "study/drop/drop_run.h"\n', "case -> study"),
    ("machine/a.cpp", "#include <cvodes/cvodes.h>\n", "machine includes SUNDIALS"),
    ("integrate/a.cpp", "#include <cvodes/cvodes.h>\n", None),
    ("study/a.cpp", "#include <hdf5.h>\n", "study includes HDF5"),
    ("cli/a.cpp", "#include <toml++/toml.h>\n", "cli includes toml++"),
    ("study/a.cpp", "#include <pybind11/pybind11.h>\n", "study includes pybind11"),
    ("python/a.cpp", '#include <pybind11/stl.h>\n#include "study/drop/drop_run.h"\n', None),
    ("python/a.cpp", '#include "cli/commands.h"\n', "python -> cli"),
    ("study/a.cpp", '#include "python/values.h"\n', "study -> python"),
    ("integrate/a.cpp", "#include <deal.II/base/point.h>\n", "integrate includes deal.II"),
    ("integrate/a.cpp", "#include <petscvec.h>\n", "integrate includes PETSc"),
    ("thermal/a.cpp", '#include "gmsh.h"\n', "thermal includes gmsh"),
    ("thermal/fe/a.cpp", '#include <gmsh.h>\n#include "thermal/fe/gmsh_mesher.h"\n', None),
    ("rotor/a.cpp", '#include "../bearing/ball_row.h"\n', "no header of a room"),
    ("rotor/a.cpp", '#include "geometry.h"\n', "no header of a room"),
    ("rotor/a.cpp", "#include OTHER_HEADER\n", "cannot tell"),
    ("magnets/a.cpp", "\n", "magnets is no room"),
    ("bearing/CMakeLists.txt", "rotordrop_room(bearing\n  SOURCES a.cpp\n  DEPENDS model rotor\n  LIBRARIES fmt::fmt)\n", "bearing -> rotor"),
    ("rotor/CMakeLists.txt", "target_link_libraries(rotordrop_rotor PUBLIC rotordrop_thermal)\n", "rotor -> thermal"),
    ("rotor/a.cpp", "\n" * 401, "401 lines"),
    ("rotor/a.h", "\n" * 400, None),
    ("study/report/a.js", "\n" * 401, "401 lines"),
    ("machine/build_machine.cpp", "\n" * 401, "401 lines"),
    ([f"rotor/elements/{k}.cpp" for k in range(16)], "\n", "16 sources"),
    ([f"rotor/{k}.cpp" for k in range(15)] + [f"rotor/{k}.h" for k in range(15)] + ["rotor/elements/0.cpp"], "\n", None),
    ("rotor/a.cpp", '// #include "bearing/row/ball_row.h"\n#include <vector>\n#include "rotor/geometry.h"\n#include "model/ports.h"\n', None),
]


def proofs_of_page():
    """Whether an old picture and a missing line are found: (what, whether it was)."""
    with tempfile.TemporaryDirectory() as folder:
        docs = pathlib.Path(folder)
        (docs / "images").mkdir()
        (docs / "reference").mkdir()
        page = "".join(f"| `{room}` | words |\n" for room in ROOMS)
        (docs / "images/rooms.svg").write_text(drawing(), encoding="utf-8")
        (docs / "reference/source-layout.md").write_text(page, encoding="utf-8")
        yield "a page as it should be", not list(faults_of_page(docs))
        (docs / "reference/source-layout.md").write_text(page.replace("| `laws` | words |\n", ""), encoding="utf-8")
        yield "a page without laws", [fault for fault in faults_of_page(docs) if "no line for laws" in fault] == list(faults_of_page(docs)) != []
        (docs / "reference/source-layout.md").write_text(page, encoding="utf-8")
        before = ROOMS["io"]
        ROOMS["io"] = before | {"laws"}
        yield "a picture without an arrow", any("does not show" in fault for fault in faults_of_page(docs))
        ROOMS["io"] = before
        arrows, parameters = room_drawing.split(ROOMS)
        yield "arrows that follow from others", arrows["rotor"] == ["model", "laws"] and parameters["study"] == [] and parameters["case"] == ["rotor", "bearing", "thermal"]


def self_test():
    """Number of proofs that failed."""
    n_failed = 0
    for what, was_found in proofs_of_page():
        if not was_found:
            n_failed += 1
            print(f"self-test: {what}: judged wrongly")
    for name, text, expected in PROOFS:
        with tempfile.TemporaryDirectory() as folder:
            names = name if isinstance(name, list) else [name]
            for file in (pathlib.Path(folder, name) for name in names):
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text, encoding="utf-8")
            faults, _ = find_faults(pathlib.Path(folder))
        is_right = not faults if expected is None else len(faults) == 1 and expected in faults[0]
        if not is_right:
            n_failed += 1
            print(f"self-test: {name} with {text[:200]!r}: expected {expected!r}, got {faults}")
    n_proofs = len(PROOFS) + len(list(proofs_of_page()))
    print(f"self-test: {n_proofs - n_failed} of {n_proofs} trees and pages judged rightly")
    return n_failed


def main():
    parser = argparse.ArgumentParser(description="Checks that rooms of src/ include only whom they may.")
    parser.add_argument("--self-test", action="store_true", help="only prove, on trees made for it, that faults are found")
    parser.add_argument("--draw", metavar="FILE.svg", type=pathlib.Path, help="draw the rooms into a file")
    arguments = parser.parse_args()
    if arguments.draw:
        arguments.draw.write_text(drawing(), encoding="utf-8")
        return 0
    if self_test():
        return 1
    if arguments.self_test:
        return 0
    root = pathlib.Path(__file__).resolve().parent.parent
    if not (root / "src").is_dir():
        print("error: there is no folder src beside tests", file=sys.stderr)
        return 2
    faults, n_files = find_faults(root / "src")
    faults += faults_of_page(root / "docs")
    for fault in faults:
        print(fault.replace(f"{root}/", ""))
    print(f"{n_files} files of src, {len(faults)} faults")
    return 1 if faults or n_files == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
