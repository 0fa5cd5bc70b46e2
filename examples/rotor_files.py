#!/usr/bin/env python3
"""Rotors from ROSS (its TOML or JSON) and from tables (CSV) as cases of rotordrop, and back to ROSS.

    /usr/bin/python3 examples/rotor_files.py import rotor.toml my-rotor [--speed "1000 rpm"]
    /usr/bin/python3 examples/rotor_files.py import shaft.csv my-rotor
    /usr/bin/python3 examples/rotor_files.py export my-rotor/drop.toml rotor.toml

An import writes my-rotor/rotor.json and my-rotor/drop.toml, ready for `rotordrop modes` and `rotordrop critical-speeds`. What has no counterpart is told
and stands in drop.toml as a comment. Both programs use Timoshenko elements with Cowper's shear coefficient, so their frequencies agree to rounding.

A CSV table has one row per shaft section, from left to right, and a header with units in brackets:

    length [mm], outer_diameter [mm], bore [mm], E [GPa], nu, rho [kg/m3], mass [kg], Ip [kg m2], Id [kg m2]

bore, E, nu and rho (those of steel: 200 GPa, 0.3, 7800 kg/m3) and mass, Ip, Id (of a disk at the section's left end) may be left out. A last row of length 0
carries a disk at the right end. A column name is for the reader. The program itself takes such a table as `rotor.geometry`, too.

Axes: ROSS has z along the shaft and y up; rotordrop has x along the shaft and y up. Both are right-handed, so z of rotordrop is -x of ROSS.
"""

import argparse
import csv
import json
import math
import pathlib
import re
import sys
import tomllib

UNITS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "Pa": 1.0, "MPa": 1e6, "GPa": 1e9, "kg/m3": 1.0, "g/cm3": 1e3, "kg": 1.0, "g": 1e-3,
         "kg m2": 1.0, "kg mm2": 1e-6, "g mm2": 1e-9, "1": 1.0, "rpm": math.pi / 30, "rad/s": 1.0}
COLUMNS = {"length": "m", "outer_diameter": "m", "bore": "m", "E": "Pa", "nu": "1", "rho": "kg/m3", "mass": "kg", "Ip": "kg m2", "Id": "kg m2"}
DIMENSIONS = {"m": {"m", "cm", "mm", "um", "in"}, "Pa": {"Pa", "MPa", "GPa"}, "kg/m3": {"kg/m3", "g/cm3"}, "kg": {"kg", "g"}, "kg m2": {"kg m2", "kg mm2", "g mm2"}, "1": {"1"}}
ROSS_VERSION = "2.0.0"
STEEL = {"E": 2.0e11, "nu": 0.3, "rho": 7800.0}


class Fault(Exception):
    """A fault of the input, to be told as it is."""


def from_table(path):
    """Geometry, supports and notes from a CSV table."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = [row for row in csv.reader(line for line in file if line.strip() and not line.lstrip().startswith("#"))]
    if len(rows) < 2:
        raise Fault(f"{path}: the table needs a header and at least one section.")
    columns = []
    for word in rows[0]:
        match = re.fullmatch(r"\s*(\w+)\s*(?:\[(.*?)\])?\s*", word)
        if match and match[1] == "name":
            columns.append(("name", 1.0))
            continue
        if not match or match[1] not in COLUMNS:
            raise Fault(f"{path}: unknown column \"{word.strip()}\". Known: {', '.join(COLUMNS)}, each with its unit in brackets, and name.")
        unit, base = match[2] or "1", COLUMNS[match[1]]
        if unit not in DIMENSIONS[base]:
            raise Fault(f"{path}: column {match[1]} has the unit [{unit}]; allowed: {', '.join(sorted(DIMENSIONS[base]))}.")
        columns.append((match[1], UNITS[unit]))
    for needed in ("length", "outer_diameter"):
        if needed not in [name for name, _ in columns]:
            raise Fault(f"{path}: the column {needed} is missing.")
    nodes, elements, masses, materials = [0.0], [], [], []
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(columns):
            raise Fault(f"{path}: section {number} has {len(row)} values, the header {len(columns)}.")
        try:
            value = {name: float(word) * factor for (name, factor), word in zip(columns, row) if word.strip() and name != "name"}
        except ValueError as error:
            raise Fault(f"{path}: section {number}: {error}.") from None
        material = {key: value.get(key, default) for key, default in STEEL.items()}
        if material not in materials:
            materials.append(material)
        node = len(nodes)
        if any(value.get(key, 0.0) for key in ("mass", "Ip", "Id")):
            masses.append({"node": node, "mass": value.get("mass", 0.0), "Ip": value.get("Ip", 0.0), "Id": value.get("Id", 0.0)})
        if value.get("length", 0.0) == 0.0 and number == len(rows) - 1:
            continue
        if value.get("length", 0.0) <= 0.0:
            raise Fault(f"{path}: section {number}: the length must be larger than 0; only the last row may have 0.")
        nodes.append(nodes[-1] + value["length"])
        elements.append({"n1": node, "n2": node + 1, "od": value["outer_diameter"], "id_": value.get("bore", 0.0), "material": f"material {materials.index(material) + 1}"})
    return geometry_of(path, nodes, elements, masses, {f"material {k}": material for k, material in enumerate(materials, 1)}), {}, []


def geometry_of(path, positions, elements, masses, materials):
    return {"description": f"from {path.name}", "units": "SI", "materials": materials, "nodes": [{"id": k, "x": x} for k, x in enumerate(positions, 1)],
            "elements": elements, "mass_points": masses}


def at_speed(table, speeds, speed, tag, notes):
    """A coefficient, or its value at the speed if it is a table."""
    if not isinstance(table, list):
        return float(table)
    if len(table) == 1 or not speeds:
        return float(table[0])
    if not speeds[0] <= speed <= speeds[-1]:
        notes.append(f"{tag}: {speed:.4g} rad/s is outside its table, {speeds[0]:.4g} to {speeds[-1]:.4g} rad/s; the nearest end holds")
    speed = min(max(speed, speeds[0]), speeds[-1])
    for k in range(len(speeds) - 1):
        if speed <= speeds[k + 1]:
            part = (speed - speeds[k]) / (speeds[k + 1] - speeds[k])
            return table[k] + part * (table[k + 1] - table[k])
    return float(table[-1])


def from_ross(path, speed):
    """Geometry, supports and notes from a rotor that ROSS saved."""
    data = tomllib.loads(path.read_text()) if path.suffix == ".toml" else json.loads(path.read_text())
    kinds = {}
    for key, value in data.items():
        if isinstance(value, dict) and key != "parameters":
            kinds.setdefault(key.split("_", 1)[0], []).append((str(value.get("tag") or key.split("_", 1)[-1]), value))
    shaft = sorted(kinds.pop("ShaftElement", []), key=lambda item: item[1]["n"])
    if not shaft:
        raise Fault(f"{path}: there is no ShaftElement; is it a rotor that ROSS saved?")
    notes, positions, elements, masses, materials, supports = [], {0: 0.0}, [], [], {}, {}
    for tag, element in shaft:
        n, length, material = element["n"], element["L"], element["material"]
        if n not in positions:
            raise Fault(f"{path}: {tag} begins at node {n}, to which no element leads.")
        if abs(positions.setdefault(n + 1, positions[n] + length) - positions[n] - length) > 1e-9:
            raise Fault(f"{path}: {tag} has another length than the layer below it.")
        nu = material["E"] / (2 * material["G_s"]) - 1  # ROSS takes E and G
        if not 0 <= nu < 0.5:
            notes.append(f"material {material['name']}: its E and G give Poisson's ratio {nu:.3g}; taken as 0.3")
            nu = 0.3
        if element["odl"] != element["odr"] or element["idl"] != element["idr"]:
            notes.append(f"{tag}: a cone, taken as a cylinder of its mean diameters")
        notes += [f"{tag}: {what} is left out" for what in ("axial_force", "torque", "alpha", "beta") if element.get(what)]
        if not all(element.get(what, True) for what in ("shear_effects", "rotary_inertia", "gyroscopic")):
            notes.append(f"{tag}: shear, rotary inertia and gyroscopic effect are always on")
        if element.get("shear_method_calc", "cowper") != "cowper":
            notes.append(f"{tag}: shear by {element['shear_method_calc']}, taken by Cowper")
        materials[material["name"]] = {"E": material["E"], "nu": nu, "rho": material["rho"]}
        elements.append({"name": tag, "n1": n + 1, "n2": n + 2, "od": (element["odl"] + element["odr"]) / 2, "id_": (element["idl"] + element["idr"]) / 2, "material": material["name"]})
    for tag, disk in kinds.pop("DiskElement", []):
        masses.append({"node": disk["n"] + 1, "name": tag, "mass": disk["m"], "Ip": disk["Ip"], "Id": disk["Id"]})
    for kind in list(kinds):
        for tag, element in kinds[kind]:
            if "kxx" not in element:
                notes.append(f"{tag}: a {kind} is left out")
                continue
            value = lambda name: at_speed(element.get(name, 0.0), element.get("speed", element.get("frequency")), speed, tag, notes)  # noqa: B023, E731
            if any(value("m" + axes) for axes in ("xx", "xy", "yx", "yy")):
                notes.append(f"{tag}: its added mass is left out")
            if element.get("n_link") is not None:
                notes.append(f"{tag}: its link to node {element['n_link']} is taken as the ground")
            matrix = lambda k: [[value(k + "yy"), -value(k + "yx")], [-value(k + "xy"), value(k + "xx")]]  # noqa: B023, E731
            name = re.sub(r"[^A-Za-z0-9_-]", "_", tag)
            supports[name] = {"node": element["n"] + 1, "stiffness": matrix("k"), "damping": matrix("c")}
    return geometry_of(path, [x for _, x in sorted(positions.items())], elements, masses, materials), supports, list(dict.fromkeys(notes))


def write_case(folder, source, geometry, supports, notes, speed):
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("rotor.json", "drop.toml"):
        if (folder / name).exists():
            raise Fault(f"{folder / name} exists already; choose another folder.")
    (folder / "rotor.json").write_text(json.dumps(geometry, indent=1) + "\n")
    lines = [f"# A rotor from {source.name}. Touchdown bearings and contact are still to be added for a drop.", *(f"# not as in {source.name}: {note}" for note in notes), "",
             "[run]", f'initial_speed = "{speed!r} rad/s"', "", "[rotor]", 'geometry = "rotor.json"', "modal_damping = 0"]
    for name, support in supports.items():
        lines += ["", f"[bearings.{name}]", 'type = "linear"', f"node = {support['node']}", f"stiffness = {support['stiffness']}", f"damping = {support['damping']}"]
    (folder / "drop.toml").write_text("\n".join(lines) + "\n")


def to_ross(case, target):
    """Writes the rotor and the linear supports of a case in the layout of ROSS's Rotor.save(), as TOML or JSON."""
    parameters = tomllib.loads(case.read_text())
    geometry = parameters["rotor"]["geometry"]
    if isinstance(geometry, str):
        file = case.parent / geometry
        geometry = from_table(file)[0] if file.suffix == ".csv" else tomllib.loads(file.read_text()) if file.suffix == ".toml" else json.loads(file.read_text())
    x = [node["x"] for node in geometry["nodes"]]
    sections = {"parameters": {}}
    for k, element in enumerate(geometry["elements"]):
        material = geometry["materials"][element["material"]] if "material" in element else geometry["material"]
        tag = element.get("name", f"ShaftElement {k}")
        sections[f"ShaftElement_{tag}"] = {
            "L": x[element["n2"] - 1] - x[element["n1"] - 1], "idl": element.get("id_", 0.0), "odl": element["od"], "idr": element.get("id_", 0.0), "odr": element["od"],
            "n": element["n1"] - 1, "axial_force": 0, "torque": 0, "shear_effects": True, "rotary_inertia": True, "gyroscopic": True, "shear_method_calc": "cowper",
            "tag": tag, "alpha": 0.0, "beta": 0.0}
        sections[f"ShaftElement_{tag}.material"] = {"name": element.get("material", "material"), "rho": material["rho"], "E": material["E"],
                                                    "G_s": material["E"] / (2 * (1 + material["nu"])), "color": "#525252"}
    for k, point in enumerate(geometry.get("mass_points", [])):
        tag = point.get("name", f"Disk {k}")
        sections[f"DiskElement_{tag}"] = {"n": point["node"] - 1, "m": point["mass"], "Id": point.get("Id", 0.0), "Ip": point.get("Ip", 0.0), "tag": tag, "scale_factor": 1.0}
    for name, support in parameters.get("bearings", {}).items():
        if not isinstance(support, dict) or support.get("type") != "linear":
            continue
        section = {}
        for letter, matrix in (("k", support["stiffness"]), ("c", support.get("damping", [[0, 0], [0, 0]]))):
            if any(isinstance(value, str) for row in matrix for value in row):
                raise Fault(f"{case}: bearings.{name}: write its matrices as numbers in SI units.")
            section |= {letter + "xx": [matrix[1][1]], letter + "xy": [-matrix[1][0]], letter + "yx": [-matrix[0][1]], letter + "yy": [matrix[0][0]]}
        sections[f"BearingElement_{name}"] = section | {"n": support["node"] - 1, "tag": name}
    if target.suffix == ".json":
        tree = {"ross_version": ROSS_VERSION}
        for title, section in sections.items():
            if title.endswith(".material"):
                tree[title.removesuffix(".material")]["material"] = section
            else:
                tree[title] = section
        target.write_text(json.dumps(tree, indent=1) + "\n")
        return
    lines = [f'ross_version = "{ROSS_VERSION}"']
    for title, section in sections.items():
        head = f'"{title.removesuffix(".material")}"' + (".material" if title.endswith(".material") else "")
        lines += ["", f"[{head}]" if title != "parameters" else "[parameters]", *(f"{key} = {json.dumps(value)}" for key, value in section.items())]
    target.write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    reading = commands.add_parser("import", help="a case from ROSS's TOML or JSON, or from a CSV table")
    reading.add_argument("file", type=pathlib.Path)
    reading.add_argument("folder", type=pathlib.Path)
    reading.add_argument("--speed", default="0 rpm", help="spin speed of the case, at which tables of coefficients are read")
    writing = commands.add_parser("export", help="ROSS's TOML or JSON (by the ending of the name) from a case")
    writing.add_argument("case", type=pathlib.Path)
    writing.add_argument("file", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        if arguments.command == "export":
            if arguments.file.suffix not in (".toml", ".json"):
                raise Fault(f"{arguments.file}: the name must end in .toml or .json, which ROSS reads.")
            if arguments.file.exists():
                raise Fault(f"{arguments.file} exists already; choose another name.")
            to_ross(arguments.case, arguments.file)
            return 0
        match = re.fullmatch(r"\s*([-+.\deE]+)\s*(rpm|rad/s)\s*", arguments.speed)
        if not match:
            raise Fault(f"--speed \"{arguments.speed}\": write it with rpm or rad/s, such as \"1000 rpm\".")
        speed = float(match[1]) * UNITS[match[2]]
        geometry, supports, notes = from_table(arguments.file) if arguments.file.suffix == ".csv" else from_ross(arguments.file, speed)
        write_case(arguments.folder, arguments.file, geometry, supports, notes, speed)
    except (Fault, OSError, KeyError, ValueError) as error:
        print(f"error: {error if not isinstance(error, KeyError) else f'the key {error} is missing'}", file=sys.stderr)
        return 2
    for note in notes:
        print(f"note: {note}", file=sys.stderr)
    print(f"{arguments.folder / 'drop.toml'}: {len(geometry['nodes'])} nodes, {len(geometry['elements'])} elements, {len(geometry['mass_points'])} disks, {len(supports)} supports")
    return 0


if __name__ == "__main__":
    sys.exit(main())
