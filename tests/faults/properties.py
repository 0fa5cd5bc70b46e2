#!/usr/bin/python3
"""What must hold for every machine, tried on random valid ones: balances, symmetries, units, restarts, lanes, even heating.

    tests/faults/properties.py build/release/rotordrop [MACHINES] [SEED] [--save DIR]

A machine is a stepped shaft with discs, two touchdown bearings of the catalogue, unbalance, and random speed, gaps and contacts. Steps are fixed: a mirrored or
turned machine then makes the same steps, and differs by roundoff alone, which the first impacts mostly raise less than a million times. Where a machine differs by more, it is
also run with another instruction set and with the last digit of its speed changed, and ten times the largest of these differences is allowed. A machine that fails is made
simpler as long as it still fails, and saved. Exit code 1 if any does.
"""

import argparse
import copy
import json
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

CATALOGUE = pathlib.Path(__file__).resolve().parents[2] / "params/bearings"
ROUNDOFF = 1e-6  # relative, of peaks, times and heats
CHAOS = 1e-2  # where roundoff alone makes so much, nothing can be told


def toml(value):
    """A value as TOML; numbers with all digits."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value)


def case_text(machine):
    m = machine
    lines = ["[run]", f"end_time = {m['end_time']!r}", f"initial_speed = {m['speed']!r}", f"gravity = {toml(m['gravity'])}"]
    lines += ["[rotor]", 'geometry = "rotor.json"', f"modal_damping = {m['modal_damping']!r}", f"unbalance = {toml(m['unbalance'])}", 'cut_off_frequency = "4000 Hz"']
    lines += ["[contact]", f"friction_coefficient = {m['friction']!r}", f"air_gap = {toml(m['gap'])}"]
    lines += ["[integration]", m.get("integration", 'method = "runge-kutta-4"\nstep = "2 us"')]
    lines += ["[materials]", "steel = { E = 2.1e11, nu = 0.3, rho = 7850, k = 46, c = 470, alpha = 11.5e-6 }", "Si3N4 = { E = 3.15e11, nu = 0.26, rho = 3200, k = 25, c = 680, alpha = 3.2e-6 }"]
    if "output" in m:
        lines += ["[output]", m["output"]]
    for name, bearing in m["bearings"].items():
        lines += [f"[bearings.{name}]", 'type = "touchdown"'] + [f"{key} = {toml(value)}" for key, value in bearing.items()]
    if "rises" in m:
        lines += ["[statics]", 'subject = "bearings"', *(f"{key} = {value!r}" for key, value in m["rises"].items())]
    return "\n".join(lines) + "\n"


def of_catalogue(entry, key):
    """What stands behind a key of a bearing of the catalogue: its first number."""
    for line in (CATALOGUE / f"{entry}.toml").read_text().splitlines():
        if line.startswith(key + " "):
            return float(line.split("=")[1].split("#")[0].strip(' "[').split()[0])
    raise ValueError(f"{entry}: {key}")


def bore_of(entry):
    return of_catalogue(entry, "bore_diameter") * 1e-3


def bearing_of(entry, rng):
    """Keys of a bearing of the catalogue: deep groove alone, angular contact as a preloaded pair."""
    outside = of_catalogue(entry, "outside_diameter") * 1e-3
    keys = {"catalogue": entry, "housing_diameters": [outside, 1.2 * outside], "housing_length": 1.2e-3 * of_catalogue(entry, "width")}
    if of_catalogue(entry, "contact_angle") > 0 and of_catalogue(entry, "rows") == 1:
        keys |= {"rows": 2, "arrangement": rng.choice(["X", "O"]), "preload": rng.uniform(0.003, 0.01) * of_catalogue(entry, "C0") * 1e3}
        keys |= {key: 2 * factor * of_catalogue(entry, key) for key, factor in (("ring_mass", 1), ("ring_spin_inertia", 1), ("width", 1e-3), ("C0", 1e3))}
        keys["housing_length"] *= 2
    return keys


def is_steel(entry):
    return "hybrid" not in entry


def random_machine(rng):
    entries = sorted(path.stem for path in CATALOGUE.glob("*.toml"))
    entry = rng.choice(entries)
    bore = bore_of(entry)
    gap = rng.uniform(100e-6, 300e-6)
    n = rng.randint(7, 14)
    ends = (rng.randint(2, 3), n - rng.randint(1, 2))
    elements, nodes, x = [], [{"id": 1, "x": 0.0}], 0.0
    for i in range(1, n):
        length = rng.uniform(0.4, 1.2) * bore
        thick = not {i, i + 1} & set(ends)
        elements.append({"id": i, "n1": i, "n2": i + 1, "length": length, "od": bore * (rng.uniform(1.0, 2.2) if thick else rng.uniform(0.8, 0.98)), "id_": 0.0})
        x += length
        nodes.append({"id": i + 1, "x": x})
    discs = []
    for _ in range(rng.randint(0, 3)):
        mass, radius = rng.uniform(0.5, 20) * (bore / 0.07) ** 3, rng.uniform(1, 2) * bore
        discs.append({"node": rng.randint(1, n), "name": "disc", "mass": mass, "Ip": 0.5 * mass * radius**2, "Id": 0.25 * mass * radius**2 * rng.uniform(1, 1.5)})
    bearings = {}
    for name, node in zip(("DE", "NDE"), ends):
        chosen = entry if rng.random() < 0.5 else rng.choice([e for e in entries if bore_of(e) == bore])
        stiffness = 10 ** rng.uniform(7.5, 9)
        bearings[name] = {
            **bearing_of(chosen, rng),
            "node": node,
            "contact_stiffness": 10 ** rng.uniform(8.5, 9.3),
            "support": {"mass": rng.uniform(5, 80), "K_y": stiffness, "K_z": stiffness * rng.uniform(0.5, 1), "C_y": 3e3, "C_z": 2e3},
        }
    return {
        "rotor": {"units": "SI", "material": {"E": 2.0e11, "nu": 0.3, "rho": 7850.0}, "nodes": nodes, "elements": elements, "mass_points": discs},
        "end_time": 15e-3,
        "speed": rng.choice([-1, 1]) * rng.uniform(50, 200 / (0.5 * bore)),
        "gravity": [0.0, -9.81, 0.0],
        "modal_damping": rng.uniform(0.001, 0.02),
        "unbalance": [{"node": rng.randint(1, n), "me": 10 ** rng.uniform(-6, -4), "angle": rng.uniform(0, 2 * math.pi)} for _ in range(rng.randint(0, 2))],
        "friction": rng.uniform(0.02, 0.4),
        "gap": gap,
        "bearings": bearings,
    }


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def write(self, machine):
        (self.folder / "rotor.json").write_text(json.dumps(machine["rotor"]))
        (self.folder / "case.toml").write_text(machine.get("text") or case_text(machine))

    def call(self, *words, **environment):
        done = subprocess.run([self.path, *words], cwd=self.folder, env={**os.environ, **environment}, capture_output=True, text=True, timeout=300)
        if done.returncode:
            raise AssertionError(f"exit {done.returncode}: {done.stderr.strip()[:600]}")
        self.said = done.stderr
        return done.stdout

    def drop(self, machine, **environment):
        self.write(machine)
        self.call("run", "case.toml", "-o", "out", "--force", "--quiet", **environment)
        return json.loads((self.folder / "out/summary.json").read_text())

    def statics(self, machine):
        self.write(machine)
        return json.loads(self.call("statics", "case.toml", "--json"))


def scalars(summary, renamed=None):
    keys = ("first_contact_time", "peak_contact_force", "peak_contact_force_time", "friction_heat", "inner_heat", "outer_heat", "largest_ball_force")
    return {(renamed or {}).get(name, name): {key: bearing[key] for key in keys} for name, bearing in summary["bearings"].items()}


def largest_difference(a, b):
    """Relative, and where."""
    worst, where = 0.0, ""
    for name in a:
        for key, value in a[name].items():
            other = b[name][key]
            if value is None and other is None:
                continue
            difference = math.inf if value is None or other is None else abs(value - other) / max(abs(value), abs(other), 1e-300)
            if difference > worst:
                worst, where = difference, f"{name}.{key} is {value!r} and {other!r}"
    return worst, where


def require_equal(program, machine, a, b, what):
    """@param machine  that of which a are the numbers"""
    difference, where = largest_difference(a, b)
    if difference <= ROUNDOFF:
        return
    own = scalars(program.drop(machine))
    neighbours = [program.drop(machine, ROTORDROP_ISA="base")]
    speed = machine["speed"]
    for _ in range(4):
        speed = math.nextafter(speed, math.inf)
        neighbours.append(program.drop({**machine, "speed": speed}))
    roundoff = max(largest_difference(own, scalars(summary))[0] for summary in neighbours)
    if roundoff > CHAOS:
        print(f"{what}: not told, roundoff alone makes {roundoff:.1g}", flush=True)
    elif difference > 10 * roundoff:
        raise AssertionError(f"{what}: {where}; roundoff alone makes {roundoff:.1g}")


def make_equal(bearing, model):
    """The same bearing at its own node, on its own support and contact."""
    own = {key: bearing[key] for key in ("node", "contact_stiffness", "support")}
    keys = {**copy.deepcopy(model), **own}
    bearing.clear()
    bearing.update(keys)


# Properties: each takes the program, a machine and its summary, and raises AssertionError. -------------------------------------


def energy_closes(program, machine, _):
    """With error control, as machines are run: fixed steps of 2 us are too long for some of them."""
    energy = program.drop({**machine, "integration": 'method = "tsitouras"\ntolerance = 3e-7'})["energy"]
    scale = energy["dissipated"] + 1.0
    # The reference case leaves 1e-9 of what it dissipates; harder impacts and faster whirl more.
    if abs(energy["residual"]) > 1e-6 * scale:
        raise AssertionError(f"energy: {energy['residual']} J of {energy['dissipated']} J are missing")
    # Temperatures are absolute: 293 K of 1000 J/K leave 1e-10 J of roundoff in every one of some thousand steps.
    if abs(energy["heat_residual"]) > 1e-7 * scale:
        raise AssertionError(f"heat: {energy['heat_residual']} J of {energy['heat_deposited']} J are missing")
    if energy["dissipated"] < -1e-9:
        raise AssertionError("energy comes from nowhere")


def spin_momentum(program, machine, _):
    """Friction at the bores alone changes the rotor's spin: Ip (omega - omega_0) = - sum of the integral of F R. No unbalance, which turns it, too. With error control: near
    the end of slip, friction of fixed steps changes its sign from step to step, and rows miss part of it."""
    summary = program.drop({**machine, "unbalance": [], "output": 'interval = "4 us"', "integration": 'method = "tsitouras"\ntolerance = 3e-7'})
    with h5py.File(program.folder / "out/results.h5") as file:
        times, speed = file["time"][()], file["rotor/spin_speed"][()]
        change = summary["rotor"]["polar_inertia"] * (speed[-1] - speed[0])
        impulse, moved = 0.0, 0.0
        for name, bearing in machine["bearings"].items():
            # Growth changes the rotor's radius by less than 1e-3 of itself.
            moment = file[f"bearings/{name}/friction_force"][()] * (0.5 * bore_of(bearing["catalogue"]) - machine["gap"])
            impulse -= numpy.trapz(moment, times)
            moved += numpy.trapz(abs(moment), times)
    # Rows 4 us apart follow impacts of some tenths of a millisecond within a part in a thousand.
    if abs(change - impulse) > 5e-3 * moved + 1e-9:
        raise AssertionError(f"spin momentum: it changes by {change} N m s, and friction gives {impulse}")


def restart_anywhere(program, machine, summary):
    """Interrupted at any instant and resumed, the same bits. Steps are fixed."""
    program.write(machine)
    shutil.rmtree(program.folder / "parts", ignore_errors=True)
    process = subprocess.Popen([program.path, "run", "case.toml", "-o", "parts", "--quiet"], cwd=program.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(random.Random(repr(machine["speed"])).uniform(0.02, 0.25))
    process.send_signal(signal.SIGTERM)
    if process.wait(timeout=60) not in (0, 143, -15):
        raise AssertionError(f"restart: the interrupted run ended with {process.returncode}")
    program.call("run", "case.toml", "-o", "parts", "--resume", "--quiet")
    resumed = json.loads((program.folder / "parts/summary.json").read_text())
    whole = copy.deepcopy(summary)
    for one in (whole, resumed):
        for key in ("wall_time", "cpu_time", "rhs_evaluations"):  # the first of a part is evaluated anew
            one["run"].pop(key)
    if whole != resumed:
        differing = [f"{name}.{key}" for name, bearing in whole["bearings"].items() for key in bearing if bearing[key] != resumed["bearings"][name].get(key)]
        differing += [key for key in whole if key != "bearings" and whole[key] != resumed.get(key)]
        raise AssertionError(f"restart: the resumed drop differs in {differing}")


def mirror_image(program, machine, summary):
    """z becomes -z: everything that turns turns the other way."""
    other = copy.deepcopy(machine)
    other["speed"] *= -1
    other["gravity"][2] *= -1
    for unbalance in other["unbalance"]:
        unbalance["angle"] *= -1
    require_equal(program, machine, scalars(summary), scalars(program.drop(other)), "mirror image")


def turned_by_a_ball(program, machine, summary):
    """All of it turned about the axis by the angle between two balls: the balls stand as before. Supports alike in all directions, equal bearings."""
    first = copy.deepcopy(machine)
    entry = first["bearings"]["DE"]["catalogue"]
    n = of_catalogue(entry, "balls_per_row")
    for bearing in first["bearings"].values():
        make_equal(bearing, first["bearings"]["DE"])
        bearing["support"]["K_z"], bearing["support"]["C_z"] = bearing["support"]["K_y"], bearing["support"]["C_y"]
    second = copy.deepcopy(first)
    angle = 2 * math.pi / n
    second["gravity"] = [0.0, -9.81 * math.cos(angle), -9.81 * math.sin(angle)]
    for unbalance in second["unbalance"]:
        unbalance["angle"] += angle
    require_equal(program, first, scalars(program.drop(first)), scalars(program.drop(second)), "turned by a ball")


def order_and_names(program, machine, summary):
    other = copy.deepcopy(machine)
    names = {"DE": "Z", "NDE": "A"}
    other["bearings"] = {names[name]: bearing for name, bearing in reversed(machine["bearings"].items())}
    require_equal(program, machine, scalars(summary, names), scalars(program.drop(other)), "order and names of the bearings")


def units(program, machine, summary):
    other = copy.deepcopy(machine)
    text = case_text(other)
    for value, unit, factor in ((machine["end_time"], "ms", 1e3), (machine["speed"], "rpm", 30 / math.pi), (machine["gap"], "um", 1e6)):
        assert repr(value) in text
        text = text.replace(repr(value), json.dumps(f"{value * factor!r} {unit}"), 1)
    other["text"] = text
    require_equal(program, machine, scalars(summary), scalars(program.drop(other)), "units")


def even_heating(program, machine, summary):
    """Parts of one material that are evenly warm are a larger machine of the same shape: preload stays within (1 + alpha T)^2."""
    rise = 50.0
    cold, warm = (program.statics({**machine, "rises": {f"{part}_rise": T for part in ("inner", "outer", "ball", "shaft")}}) for T in (0.0, rise))
    for name, bearing in machine["bearings"].items():
        if not is_steel(bearing["catalogue"]):
            continue
        a, b = (result["bearings"][name].get("preload") for result in (cold, warm))
        if a is None or a == 0:
            continue
        if abs(b / a - 1) > 2.5 * 11.5e-6 * rise:
            raise AssertionError(f"even heating: preload of {name} goes from {a} to {b} N")


def side_by_side(program, machine, _):
    """Eight drops in the lanes of a study are those alone, within what rounding makes of them; with balls, waves and supports that lanes know."""
    rng = random.Random(repr(machine["speed"]))
    machine = {**copy.deepcopy(machine), "integration": 'method = "tsitouras"\ntolerance = 1e-10', "output": 'interval = "1 ms"'}
    for bearing in machine["bearings"].values():
        if rng.random() < 0.3:
            bearing["ball_model"] = "inertial"
        if rng.random() < 0.4:
            bearing["waviness"] = [{"surface": rng.choice(["inner_race", "outer_race", "bore"]), "order": rng.randint(2, 12), "amplitude": rng.uniform(0.1e-6, 2e-6), "phase": rng.uniform(0, 6)}]
        if rng.random() < 0.3:
            stiffness = 10 ** rng.uniform(7.3, 8)
            bearing["support"] = {"type": "ribbon", "mass": 1.0, "ribbon": {"stiffness": stiffness, "slip_force": rng.uniform(300, 2000), "stick_stiffness": 6 * stiffness}}
    speeds = [machine["speed"] * (1 + 1e-3 * k) for k in range(9)]  # one more than there are lanes
    program.write(machine)
    (program.folder / "study.toml").write_text(f'case = "case.toml"\nlanes = true\n[vary]\nrun.initial_speed = {toml(speeds)}\n[design]\nkind = "grid"\n')
    program.call("study", "study.toml", "-o", "study", "--force")
    if "one by one" in program.said:
        raise AssertionError(f"side by side: {program.said}")
    with h5py.File(program.folder / "study/study.h5") as file:
        lanes = {key: file[f"results/{key}"][()] for key in file["results"]}
    for k in (0, rng.randrange(1, 8), 8):
        one = {**machine, "speed": speeds[k]}
        alone = scalars(program.drop(one))
        in_lane = {name: {key: None if math.isnan(value := float(lanes[f"bearings.{name}.{key}"][k])) else value for key in values} for name, values in alone.items()}
        require_equal(program, one, alone, in_lane, f"side by side, drop {k}")


PROPERTIES = [side_by_side, energy_closes, spin_momentum, restart_anywhere, mirror_image, turned_by_a_ball, order_and_names, units, even_heating]


def fault_of(program, machine, property_):
    try:
        property_(program, machine, program.drop(machine))
    except AssertionError as error:
        return str(error)
    return None


def simpler(machine):
    """Machines with one thing less."""
    for key, value in (("unbalance", []), ("modal_damping", 0.01), ("friction", 0.1), ("gap", 200e-6), ("speed", 1000.0)):
        if machine[key] != value:
            yield {**copy.deepcopy(machine), key: value}
    if machine["rotor"]["mass_points"]:
        other = copy.deepcopy(machine)
        other["rotor"]["mass_points"].pop()
        yield other
    names = list(machine["bearings"])
    if machine["bearings"][names[0]]["catalogue"] != machine["bearings"][names[1]]["catalogue"]:
        other = copy.deepcopy(machine)
        make_equal(other["bearings"][names[1]], other["bearings"][names[0]])
        yield other


def shrunk(program, machine, property_):
    for candidate in simpler(machine):
        if fault_of(program, candidate, property_):
            return shrunk(program, candidate, property_)
    return machine


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    arguments.add_argument("machines", type=int, nargs="?", default=1000)
    arguments.add_argument("seed", type=int, nargs="?", default=1)
    arguments.add_argument("--save", type=pathlib.Path, default=pathlib.Path("failing-machines"), help="folder for machines that fail")
    options = arguments.parse_args()
    failures, contacts = 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        program = Program(options.program, pathlib.Path(scratch))
        for i in range(options.machines):
            machine = random_machine(random.Random(f"{options.seed} {i}"))
            try:
                summary = program.drop(machine)
            except AssertionError as error:
                failures += 1
                print(f"machine {i} of seed {options.seed} does not run: {error}", flush=True)
                continue
            contacts += any(bearing["peak_contact_force"] for bearing in summary["bearings"].values())
            for property_ in PROPERTIES:
                try:
                    property_(program, machine, summary)
                except AssertionError as error:
                    failures += 1
                    print(f"machine {i} of seed {options.seed}: {error}", flush=True)
                    small = shrunk(program, machine, property_)
                    folder = options.save / f"{property_.__name__}-{options.seed}-{i}"
                    folder.mkdir(parents=True, exist_ok=True)
                    Program(options.program, folder).write(small)
                    print(f"    {fault_of(program, small, property_)}; made simpler and saved in {folder}", flush=True)
    print(f"{options.machines} machines, {contacts} of them touched, {len(PROPERTIES)} properties each: {failures} failures")
    return 1 if failures or contacts < options.machines / 2 else 0


if __name__ == "__main__":
    sys.exit(main())
