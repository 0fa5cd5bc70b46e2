#!/usr/bin/env python3
"""Rotors from ROSS (its TOML or JSON) and from tables (CSV) as cases of rotordrop, and back to ROSS.

    /usr/bin/python3 examples/rotor_files.py import rotor.toml my-rotor [--speed "1000 rpm"]
    /usr/bin/python3 examples/rotor_files.py import shaft.csv my-rotor
    /usr/bin/python3 examples/rotor_files.py export my-rotor/drop.toml rotor.toml
    /usr/bin/python3 examples/rotor_files.py export my-rotor/results/parameters.toml rotor.toml

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
         "kg m2": 1.0, "kg mm2": 1e-6, "g mm2": 1e-9, "1": 1.0, "rpm": math.pi / 30, "rad/s": 1.0,
         "N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3, "MN/m": 1e6, "N/um": 1e6, "kN/mm": 1e6, "N s/m": 1.0, "kN s/m": 1e3, "N s/mm": 1e3}
COLUMNS = {"length": "m", "outer_diameter": "m", "bore": "m", "E": "Pa", "nu": "1", "rho": "kg/m3", "mass": "kg", "Ip": "kg m2", "Id": "kg m2"}
DIMENSIONS = {"m": {"m", "cm", "mm", "um", "in"}, "Pa": {"Pa", "MPa", "GPa"}, "kg/m3": {"kg/m3", "g/cm3"}, "kg": {"kg", "g"}, "kg m2": {"kg m2", "kg mm2", "g mm2"}, "1": {"1"},
              "N/m": {"N/m", "kN/m", "N/mm", "MN/m", "N/um", "kN/mm"}, "N s/m": {"N s/m", "kN s/m", "N s/mm"}}
ROSS_VERSION = "2.0.0"
STEEL = {"E": 2.0e11, "nu": 0.3, "rho": 7800.0}


class Fault(Exception):
    """A fault of the input, to be told as it is."""


def unused(name, used, numbered="{} ({})"):
    """The name, or with a number behind it if it is used already; it is used from now on."""
    k, free = 1, name
    while free in used:
        k += 1
        free = numbered.format(name, k)
    used.add(free)
    return free


def number(given, unit, what):
    """A bare number, in SI, or a quantity such as "50 mm"."""
    if isinstance(given, (int, float)) and not isinstance(given, bool):
        return float(given)
    match = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*?)\s*", given) if isinstance(given, str) else None
    if not match or (match[2] or unit) not in DIMENSIONS[unit]:
        raise Fault(f"{what} = {given!r}: write a number in SI, or one of the units {', '.join(sorted(DIMENSIONS[unit]))}.")
    return float(match[1]) * UNITS[match[2] or unit]


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
        elements.append({"n1": node, "n2": node + 1, "od": value["outer_diameter"], "bore": value.get("bore", 0.0), "material": f"material {materials.index(material) + 1}"})
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
    used_tags, used_materials, used_supports, names = set(), set(), set(), {}
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
        values = {"E": material["E"], "nu": nu, "rho": material["rho"]}
        # Other values by a name that is there already are another material.
        key = (material["name"], *values.values())
        if key not in names:
            names[key] = unused(material["name"], used_materials)
            materials[names[key]] = values
            if names[key] != material["name"]:
                notes.append(f"{tag}: another material by the name {material['name']}, called {names[key]} here")
        elements.append({"name": unused(tag, used_tags), "n1": n + 1, "n2": n + 2, "od": (element["odl"] + element["odr"]) / 2, "bore": (element["idl"] + element["idr"]) / 2, "material": names[key]})
    for tag, disk in kinds.pop("DiskElement", []):
        masses.append({"node": disk["n"] + 1, "name": tag, "mass": disk["m"], "Ip": disk["Ip"], "Id": disk["Id"]})
    for kind in list(kinds):
        for tag, element in kinds[kind]:
            if "kxx" not in element:
                notes.append(f"{tag}: a {kind} is left out")
                continue
            # As in ROSS, y is as x if it is not given.
            like_x = {"kyy": "kxx", "cyy": "cxx"}
            value = lambda name: at_speed(element.get(name, element.get(like_x.get(name), 0.0)), element.get("speed", element.get("frequency")), speed, tag, notes)  # noqa: B023, E731
            if any(value("m" + axes) for axes in ("xx", "xy", "yx", "yy")):
                notes.append(f"{tag}: its added mass is left out")
            if element.get("n_link") is not None:
                notes.append(f"{tag}: its link to node {element['n_link']} is taken as the ground")
            matrix = lambda k: [[value(k + "yy"), -value(k + "yx")], [-value(k + "xy"), value(k + "xx")]]  # noqa: B023, E731
            plain = re.sub(r"[^A-Za-z0-9_-]", "_", tag)
            name = unused(plain, used_supports, "{}_{}")
            if name != plain:
                notes.append(f"{tag}: a second support by this name, called {name} here")
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


def shaft_of(case, parameters):
    """The geometry of a case."""
    if "base" in parameters:
        raise Fault(f"{case}: it has a base, which is not followed here. Export parameters.toml beside the results of a run: it holds all layers.")
    geometry = parameters["rotor"]["geometry"]
    if not isinstance(geometry, str):
        return geometry
    file = case.parent / geometry
    return from_table(file)[0] if file.suffix == ".csv" else tomllib.loads(file.read_text()) if file.suffix == ".toml" else json.loads(file.read_text())


def to_ross(case, target):
    """Writes the rotor and the linear supports of a case in the layout of ROSS's Rotor.save(), as TOML or JSON; what is left out, as notes."""
    parameters = tomllib.loads(case.read_text())
    geometry = shaft_of(case, parameters)
    notes = []
    if parameters["rotor"].get("unbalance") or parameters["rotor"].get("balance_grade"):
        notes.append("the unbalance is left out: ROSS takes it with its analyses")
    x = [number(node["x"], "m", f"x of node {node['id']}") for node in geometry["nodes"]]
    sections, used = {"parameters": {}}, set()
    default_material = unused("material", set(geometry.get("materials", {})))  # it has no name of its own
    for k, element in enumerate(geometry["elements"]):
        of = element.get("material", "")
        if of not in geometry.get("materials", {}) and "material" not in geometry:
            raise Fault(f"{case}: element {k + 1} names no material of the geometry, which has no default one.")
        material = {key: number(value, unit, f"{key} of material {of or 'by default'}") for key, unit in (("E", "Pa"), ("nu", "1"), ("rho", "kg/m3"))
                    for value in [(geometry["materials"][of] if of else geometry["material"])[key]]}
        outside, bore = number(element["od"], "m", f"od of element {k + 1}"), number(element.get("bore", element.get("id_", 0.0)), "m", f"bore of element {k + 1}")
        tag = unused(element.get("name", f"ShaftElement {k}"), used)
        if tag != element.get("name", tag):
            notes.append(f"a second element by the name {element['name']} is called {tag}")
        sections[f"ShaftElement_{tag}"] = {
            "L": x[element["n2"] - 1] - x[element["n1"] - 1], "idl": bore, "odl": outside, "idr": bore, "odr": outside,
            "n": element["n1"] - 1, "axial_force": 0, "torque": 0, "shear_effects": True, "rotary_inertia": True, "gyroscopic": True, "shear_method_calc": "cowper",
            "tag": tag, "alpha": 0.0, "beta": 0.0}
        sections[f"ShaftElement_{tag}.material"] = {"name": of or default_material, "rho": material["rho"], "E": material["E"],
                                                    "G_s": material["E"] / (2 * (1 + material["nu"])), "color": "#525252"}
    used = set()
    for k, point in enumerate(geometry.get("mass_points", [])):
        tag = unused(point.get("name", f"Disk {k}"), used)
        if tag != point.get("name", tag):
            notes.append(f"a second mass point by the name {point['name']} is called {tag}")
        mass, Id, Ip = (number(point.get(key, 0.0), unit, f"{key} of mass point {k + 1}") for key, unit in (("mass", "kg"), ("Id", "kg m2"), ("Ip", "kg m2")))
        sections[f"DiskElement_{tag}"] = {"n": point["node"] - 1, "m": mass, "Id": Id, "Ip": Ip, "tag": tag, "scale_factor": 1.0}
    for name, support in parameters.get("bearings", {}).items():
        if not isinstance(support, dict):
            continue
        if support.get("type") != "linear":
            notes.append(f"bearings.{name}, of type \"{support.get('type', 'touchdown')}\", is left out: only linear supports have a counterpart")
            continue
        section = {}
        for letter, unit, given in (("k", "N/m", support["stiffness"]), ("c", "N s/m", support.get("damping", [[0, 0], [0, 0]]))):
            matrix = [[number(value, unit, f"bearings.{name}: {value!r}") for value in row] for row in given]
            section |= {letter + "xx": [matrix[1][1]], letter + "xy": [-matrix[1][0]], letter + "yx": [-matrix[0][1]], letter + "yy": [matrix[0][0]]}
        sections[f"BearingElement_{name}"] = section | {"n": support["node"] - 1, "tag": name}
    write_ross(sections, target)
    return notes


def write_ross(sections, target):
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
            for note in to_ross(arguments.case, arguments.file):
                print(f"note: {note}", file=sys.stderr)
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
