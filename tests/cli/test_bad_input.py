"""Faulty input: exit code 2, a message that says what, where, what is allowed; and nothing is written.

One fault is one entry of FAULTS. The sign » in a text stands before the place that the message must name; it is taken
out before the file is written. A second » is the place of a second message, in the order in which they must come.
"""

import dataclasses
import re
import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest, content_of  # noqa: E402

BASE = 'base = "reference.toml"\n'


@dataclasses.dataclass
class Fault:
    name: str  # reads as the end of "the program reports ..."
    text: str = ""  # of drop.toml
    says: tuple = ()  # regular expressions, all of which the message must have
    files: dict = dataclasses.field(default_factory=dict)  # further files: name and text
    edits: dict = dataclasses.field(default_factory=dict)  # of reference.toml: text and what stands for it
    geometry: tuple = ()  # (text, what stands for it) in neisi2019-rotor.json
    options: tuple = ()  # of `run` and `check`
    place: tuple = ()  # further places: ("--set contact.rows",), or ("drop.toml",) if any line will do
    whole: bool = False  # whether the text is the whole of drop.toml; else it follows `base = "reference.toml"`


def bearing(line, name="TB1"):
    return f"[bearings.{name}]\n{line}\n"


def rotor(nodes="[{ id = 1, x = 0 }, { id = 2, x = 0.5 }, { id = 3, x = 1 }]",
          elements="[{ n1 = 1, n2 = 2, od = 0.1 }, { n1 = 2, n2 = 3, od = 0.1 }]",
          more="", material="{ E = 2e11, nu = 0.3, rho = 7800 }"):
    """A whole case on a rotor of two elements."""
    material = f"material = {material}\n" if material else ""
    return SPEED + LINEAR_SUPPORTS + f"[rotor.geometry]\n{material}nodes = {nodes}\nelements = {elements}\n{more}\n"


SPEED = '[run]\ninitial_speed = "1000 rpm"\n'
LINEAR_SUPPORTS = """[bearings.A]
type = "linear"
node = 1
stiffness = [[1e8, 0], [0, 1e8]]
[bearings.B]
type = "linear"
node = 3
stiffness = [[1e8, 0], [0, 1e8]]
"""

NAMES = [
    Fault(f"a bearing that is called {key}", SPEED + f'[rotor]\ngeometry = "neisi2019-rotor.json"\n[bearings.»{key}]\ntype = "linear"\nnode = 4\n'
          + "stiffness = [[1e8, 0], [0, 1e8]]\n" + LINEAR_SUPPORTS.replace("node = 3", "node = 20"),
          (rf"\[bearings\.{key}\] cannot have this name", r'a key of tables with type = "touchdown"', rf"\[bearings\.{key}_1\]"), whole=True)
    for key in ("C0", "ball", "support", "rows", "waviness")
]

TYPES_AND_UNITS = [
    Fault("a text for a number", '[contact]\nfriction_coefficient = »"ten"', (r'"ten" is not a number', r"contact\.friction_coefficient")),
    Fault("true for a number", "[contact]\nair_gap = »true", (r"contact\.air_gap is (a boolean|true)", r"must be a length", "250 um")),
    Fault("a list for a number", "[contact]\nair_gap = »[1, 2]", (r"contact\.air_gap is (a list|an array)", "must be a length")),
    Fault("a table for a number", "[contact]\nair_gap = »{ a = 1 }", (r"contact\.air_gap is a table", "must be a length")),
    Fault("a number for a text", bearing("ball = »3"), (r"bearings\.TB1\.ball is", "a text in quotes")),
    Fault("a text for true", '[thermal]\ngrowth = »"true"', (r"thermal\.growth is a text", "true or false, without quotes")),
    Fault("a number for a table", "contact = »5", ("contact is an integer", "must be a table", r"Write \[contact\]")),
    Fault("a number for a named table", "[bearings]\n»TB1 = 5", (r"TB1",)),
    Fault("a text for an integer", bearing('balls_per_row = »"14"'), (r"bearings\.TB1\.balls_per_row is a text", "must be an integer between 3 and 256")),
    Fault("a fraction for an integer", bearing("balls_per_row = »14.5"), (r"balls_per_row = 14\.5; it must be an integer",)),
    Fault("an integer beyond all bounds", bearing("node = »9999999999999"), (r"bearings\.TB1\.node = 9999999999999 is out of range",)),
    Fault("a date", "[run]\nend_time = »2020-01-01", ("dates and times have no meaning", "quotes")),
    Fault("one entry where two are needed", bearing("conformity = »[0.52]"), ("conformity has 1 entries", "list of 2")),
    Fault("gravity with two entries", "[run]\ngravity = »[0, -9.81]", (r"run\.gravity has 2 entries", "3")),
    Fault("a stiffness that is no matrix", '[bearings.TB1]\ntype = "linear"\nnode = 2\nstiffness = »[1e9, 1e9]\n',
          ("not a 2 x 2 matrix", "N/m"), edits={"[bearings.TB1]": "[bearings.TB0]", "node = 2  ": "node = 3  "}),
    Fault("an unknown unit", '[contact]\nair_gap = »"250 furlonks"', ('unknown unit "furlonks"', r"contact\.air_gap needs a length such as 250 um")),
    Fault("a length for a time", '[run]\nend_time = »"250 um"', ("250 um is a length", r"run\.end_time needs a time such as 2 ms")),
    Fault("a mass for a force", bearing('preload = »"29 kg"', "TB2"), ("29 kg is a mass", r"preload needs a force")),
    Fault("a torque for a stiffness", bearing('support.K_y = »"1 N m"'), ("1 N m is a torque", "K_y needs a stiffness")),
    Fault("hertz for an angular speed", '[run]\ninitial_speed = »"253 Hz"', ("does not say whether it counts revolutions or radians", "Write rpm")),
    Fault("1/s for an angular speed", '[run]\ninitial_speed = »"1591 1/s"', ("revolutions or radians", "rad/s")),
    Fault("rpm for a rate", '[rotor]\nmass_proportional_alpha = »"30 rpm"', ("30 rpm is an angular speed", "needs a rate", "1/s")),
    Fault("an exponent that is not an integer", bearing('contact_stiffness = »"1.144e9 N/m^1.111"'),
          ("bare number in N/m.n", "Write the value in N/m.n without a unit")),
    Fault("a broken exponent elsewhere", bearing('support.K_y = »"1e9 N/m^1.5"'), ("exponent that is not an integer", "m2 or s.-1")),
    Fault("degrees for a temperature", '[run]\nambient = »"20 deg"', ("20 deg is an angle", "needs a temperature", "K, degC or degF")),
    Fault("a temperature below absolute zero", '[run]\nambient = »"-300 degC"', ("below absolute zero",)),
    Fault("degrees Celsius that were meant as kelvin", '[run]\nambient = »"2000 degC"', (r"out of range", "between 60 and 2000 K")),
    Fault("a temperature for an angle", bearing('contact_angle = »"25 degC"', "TB2"), ("25 degC is a temperature", "needs an angle", "deg or rad")),
    Fault("degrees without a unit", bearing("contact_angle = »25", "TB2"), (r"contact_angle = 25 is out of range", r"between 0 and 1\.2 rad")),
    Fault("a length in the direction of an angle", '[rotor]\ninitial_offset = ["10 um", »"3 deg"]', ("3 deg is an angle", r"initial_offset#2 needs a length")),
    Fault("two numbers", '[contact]\nair_gap = »"2 50 um"', ("contains a number", "Write one number, then its unit")),
    Fault("a decimal comma", '[contact]\nair_gap = »"0,25 mm"', ("decimal point, not a comma",)),
    Fault("a unit without a number", '[contact]\nair_gap = »"um"', ('"um" is not a number with a unit',)),
    Fault("an empty text for a number", '[contact]\nair_gap = »""', ("is not a number with a unit",)),
    Fault("nan", "[contact]\nair_gap = »nan", (r"contact\.air_gap = nan is not a finite number",)),
    Fault("inf", "[run]\nend_time = »inf", (r"run\.end_time = inf is not a finite number",)),
    Fault("nan in a text", '[contact]\nair_gap = »"nan um"', ("not a finite number",)),
    Fault("a number too large for a double", bearing('contact_stiffness = »"1e999"'), ("too large",)),
]

RANGES = [
    Fault("a friction coefficient of 5", "[contact]\nfriction_coefficient = »5", (r"friction_coefficient = 5 is out of range", "between 0 and 2")),
    Fault("a negative air gap", '[contact]\nair_gap = »"-250 um"', (r'air_gap = "?-250 um"? is out of range', "> 0 m")),
    Fault("an end at the start", "[run]\nend_time = »0", (r"run\.end_time = 0 is out of range", "> 0 s")),
    Fault("a step of zero", "[integration]\nstep = »0", (r"integration\.step = 0 is out of range", r"between 1e-09 and 0\.001 s")),
    Fault("a step too large", '[integration]\nstep = »"1 s"', ("out of range", r"between 1e-09 and 0\.001 s")),
    Fault("a tolerance of 1", "[integration]\ntolerance = »1", (r"integration\.tolerance = 1 is out of range", r"between 1e-13 and 0\.01")),
    Fault("a tolerance of 0", "[integration]\ntolerance = »0", ("out of range",)),
    Fault("an unknown method", '[integration]\nmethod = »"dormand-prinz"', ('is not known', '"adams"', 'Did you mean "dormand-prince"')),
    Fault("waves of order 0", bearing('waviness = [{ surface = "bore", order = »0, amplitude = "1 um" }]'), ("order = 0 is out of range", "between 1 and 1000")),
    Fault("waves on an unknown surface", bearing('waviness = [{ surface = »"inner race", order = 3, amplitude = "1 um" }]'),
          ("is not known", '"inner_race", "outer_race", "bore"', 'Did you mean "inner_race"')),
    Fault("waves of a metre", bearing('waviness = [{ surface = "bore", order = 2, amplitude = »"1 m" }]'), ("amplitude", "between -0.001 and 0.001 m")),
    Fault("a negative ring mass", bearing('ring_mass = »"-0.2 kg"'), ("ring_mass", "out of range", "> 0 kg")),
    Fault("a support of zero stiffness", bearing("support.K_y = »0"), (r"bearings\.TB1\.support\.K_y = 0 is out of range", "> 0 N/m")),
    Fault("a contact of zero stiffness", bearing("contact_stiffness = »0"), ("contact_stiffness = 0 is out of range", "> 0")),
    Fault("negative support damping", bearing("support.C_y = »-1"), ("C_y = -1 is out of range", ">= 0")),
    Fault("a Poisson's ratio of 0.5", '[materials]\nsteel = { E = 2.0e11, nu = »0.5, rho = 7800, k = 70, c = 510, alpha = 11.8e-6 }',
          (r"materials\.steel\.nu = 0\.5 is out of range", "between 0 and 0.499")),
    Fault("a Young's modulus in the wrong unit", '[materials]\nsteel = { E = »200, nu = 0.3, rho = 7800, k = 70, c = 510, alpha = 11.8e-6 }',
          ("E = 200 is out of range", "Pa")),
    Fault("a share above 1", "[thermal]\nshare_to_ring = »66", ("share_to_ring = 66 is out of range", "between 0 and 1")),
    Fault("no rows", bearing("rows = »0"), ("rows = 0 is out of range", "between 1 and 8")),
    Fault("two balls", bearing("balls_per_row = »2"), ("between 3 and 256",)),
    Fault("a conformity below 1/2", bearing("conformity = [»0.5, 0.52]"), ("conformity#1", "between 0.501 and 0.6")),
    Fault("modal damping of 100 %", "[rotor]\nmodal_damping = »1", ("between 0 and 0.2",)),
    Fault("an output interval of zero", "[output]\ninterval = »0", (r"output\.interval = 0 is out of range",)),
    Fault("a node numbered from 0", bearing("node = »0"), ("node = 0 is out of range", ">= 1")),
    Fault("a faulty default for all bearings, once", '[bearings]\nball_damping_beta = »"1 s"', (r"bearings\.ball_damping_beta", "between 0 and 0.001 s")),
]

KEYS = [
    Fault("a misspelt key", '[contact]\n»air_gpa = "250 um"', ('unknown key "air_gpa" in .contact.', 'Did you mean "air_gap"', "Known here: .*exponent")),
    Fault("a key nobody knows", "[contact]\n»colour = 3", ('unknown key "colour"', "Known here: .*air_gap")),
    Fault("a key in the wrong section", "[contact]\n»balls_per_row = 3", ('unknown key "balls_per_row" in .contact.', r"It is known in \[bearings\.NAME\]")),
    Fault("a key in upper case", '[contact]\n»Air_Gap = "250 um"', ('unknown key "Air_Gap"', 'Did you mean "air_gap"')),
    Fault("an unknown section", "[»contcat]\nair_gap = 1e-4", ('unknown key "contcat" at the top level', 'Did you mean "contact"')),
    Fault("an unknown key of a bearing", bearing("»ball_diametre = 0.01"), (r"in \[bearings\.TB1\]", 'Did you mean "ball_diameter"')),
    Fault("an unknown key in a table of a table", bearing("support.»K_x = 1e9"), (r"in \[bearings\.TB1\.support\]", "Did you mean \"K_[yz]\"")),
    Fault("an unknown default for all bearings", "[bearings]\n»ball_dampnig_beta = 1e-5", (r"in \[bearings\]", 'Did you mean "ball_damping_beta"')),
    Fault("an unknown key in an array of tables", "[rotor]\nunbalance = [{ node = 5, me = 1e-6, »phase = 0 }]", ("unknown key \"phase\"", r"rotor\.unbalance", "angle")),
    Fault("a missing key of a bearing", "", ('missing key "ring_mass" in .bearings.TB1.', "> 0"),
          edits={"[bearings.TB1]\n": "»[bearings.TB1]\n", 'ring_mass = "0.21 kg"            # source: (est.)\nring_spin_inertia = "3.4e-4': '#\nring_spin_inertia = "3.4e-4'}),
    Fault("a missing table of a bearing", "", ('missing key "mass" in .bearings.TB1.support.',),
          edits={"[bearings.TB1]\n": "»[bearings.TB1]\n", 'support = { mass = "85 kg"': "#"}),
    Fault("a support without springs", bearing('support = { mass = "85 kg" }'), (r"bearings\.TB1\.support\.K_y is missing", 'type = "linear" needs it'),
          edits={'support = { mass = "85 kg"': "#"}, place=("drop.toml",)),
    Fault("a missing speed", rotor().replace(SPEED, '»[run]\nend_time = "1 ms"\n'), whole=True, says=('missing key "initial_speed"', "angular speed such as .15200 rpm")),
    Fault("a rotor without geometry", SPEED + '»[rotor]\nmodel = "rigid"\n' + LINEAR_SUPPORTS, ('missing key "geometry" in .rotor.',), whole=True),
    Fault("a case without bearings", rotor().replace(LINEAR_SUPPORTS, ""), ("no bearings", r"\[bearings\.NAME\]"), place=("drop.toml",), whole=True),
    Fault("a bearing without type", "[bearings.»TB3]\nnode = 5\n", ('missing key "type" in .bearings.TB3.', '"touchdown", "linear"')),
    Fault("an unknown bearing type", '[bearings.TB3]\nnode = 5\ntype = »"touchdwn"\n', (r'bearings\.TB3\.type = "?touchdwn"? is not known', 'Did you mean "touchdown"', '"linear"')),
    Fault("an unknown model", '[rotor]\nmodel = »"modl"', ('rotor.model = "modl" is not known', 'Did you mean "modal"')),
]

GEOMETRY_OF_BEARINGS = [
    Fault("balls that do not fit", bearing("balls_per_row = »40"), (r"40 balls of 11\.906 mm do not fit on a pitch circle of 90 mm", "TB1")),
    Fault("an outer ring inside its balls", bearing('outer_ring_diameters = »["85 mm", "110 mm"]'), ("85 mm is not larger than the pitch_diameter 90 mm", "outside the pitch circle of its balls", "TB1")),
    Fault("an inner ring outside its balls", bearing('inner_ring_diameters = »["70 mm", "95 mm"]'), ("95 mm is not smaller than the pitch_diameter 90 mm", "TB1")),
    Fault("balls that reach into the bore", bearing('ball_diameter = »»"25 mm"\nballs_per_row = 5'),
          ("balls of 25 mm .* reach into the bore of 70 mm", "reach out of the outer ring of 110 mm")),
    Fault("balls larger than the outer ring", bearing('outer_ring_diameters = ["92 mm", "101 mm"]\nhousing_diameters = ["101 mm", "130 mm"]'),
          ("balls of 11.906 mm", "reach out of the outer ring of 101 mm"), place=("reference.toml",)),
    Fault("a ring with its diameters exchanged", bearing('inner_ring_diameters = »["78 mm", "70 mm"]'), ("inner_ring_diameters", "second must be larger than the first")),
    Fault("a housing smaller than the ring", bearing('housing_diameters = »["90 mm", "105 mm"]'), ("housing's outside diameter 105 mm is not larger than the outer ring's 110 mm",)),
    Fault("a housing bore that is not the ring's", bearing('housing_diameters = »["120 mm", "140 mm"]'), ("housing's bore 120 mm", "outer ring's outside diameter 110 mm")),
    Fault("a gap larger than the bore", '[contact]\nair_gap = »"36 mm"', (r"contact\.air_gap", "bore_radius", "rotor's radius is bore_radius - air_gap")),
    Fault("a gap in the wrong unit", '[contact]\nair_gap = »»"25 mm"', (r"bearings\.TB1: the air gap of 25 mm", "fifth of the bore radius of 35 mm", "bearings.TB2: the air gap", "check the unit")),
    Fault("a bore radius that was meant as a diameter", bearing('bore_radius = »"70 mm"'), (r"bearings\.TB1: the bore radius of 70 mm", "half the inner ring's bore diameter of 70 mm", "bearings.NAME.bore_radius")),
    Fault("a preload on a deep-groove bearing", bearing('preload = »"290 N"'), ("preload", "contact_angle")),
    Fault("a clearance on a preloaded set", bearing('radial_clearance = »"19 um"', "TB2"), ("radial_clearance", "preload")),
    Fault("an ambient of twenty kelvin", "[run]\nambient = »20", ("out of range", "between 60 and 2000 K")),
    Fault("gravity upwards by a slip of sign", "[run]\ngravity = »-9.81", ("out of range", "between 0 and 1000")),
    Fault("a preload beyond the static load rating", bearing('preload = »"100 kN"', "TB2"), (r"bearings\.TB2: the preload of 100000 N", "C0 = 62000 N")),
    Fault("a spin inertia in another unit", bearing('ring_spin_inertia = »3.4e-10'), ("far from that of a hoop", "kg mm2")),
    Fault("a bore of another bearing", bearing('bore_radius = »"20 mm"'), (r"bearings\.TB1: the bore radius of 20 mm", "70 mm")),
    Fault("a rotor that starts inside a ring", "[»rotor]\ninitial_offset = [\"-400 um\", 0]", ("starts 400 um from the centre of the ring of TB1", "air gap of 250 um")),
    Fault("rows of results without end", '[output]\ninterval = »"1e-30 s"', ("out of range", ">= 1e-07 s")),
    Fault("a thermal node with an empty name", '[thermal]\nnode = [{ name = »"", capacity = 1 }]', ('cannot be called ""', "letters, digits")),
    Fault("a thermal node that hides others", '[thermal]\nnode = [{ name = »"TB1", capacity = 1 }]', ('cannot be called "TB1"', "part of another node's name")),
    Fault("massless thermal nodes joined to each other only", '[thermal]\nnode = [{ name = "m", capacity = »0 }, { name = "n", capacity = »0 }]\n'
          'resistor = [{ between = ["m", "n"], resistance = 1 }]', ('"m" has no capacity', "no resistor leads from it")),
    *(Fault(f"a bearing called as the ledger {name}", f'[bearings.»{name}]\ntype = "linear"\nnode = 5\nstiffness = [[1e6, 0], [0, 1e6]]', (f'a bearing cannot be called "{name}"', "ledger of the machine", "another name"))
      for name in ("rotor_damping", "unbalance_work", "drive_work", "windage", "heat_lost", "lumped_heat_lost")),
    Fault("a bearing with a slash in its name", '[bearings.»"a/b"]\ntype = "linear"\nnode = 5\nstiffness = [[1e6, 0], [0, 1e6]]', ('a bearing cannot be called "a/b"', "letters, digits")),
]

CROSS_REFERENCES = [
    Fault("a bearing at an unknown node", bearing("node = »99"), (r"bearings\.TB1\.node = 99: the rotor has nodes 1 to 31",)),
    Fault("an unbalance at an unknown node", "[rotor]\nunbalance = [{ node = 5, me = 1e-6 }, { node = »77, me = 1e-6 }]", (r"unbalance#2\.node = 77", "nodes 1 to 31")),
    Fault("a probe at an unknown node", '[rotor.probes]\nmagnet = { node = »99, clearance = "300 um" }', (r"rotor\.probes\.magnet\.node = 99: the rotor has nodes 1 to 31",)),
    Fault("a probe without clearance", '[rotor.probes]\nmagnet = { node = 9, clearance = »"-300 um" }', (r"rotor\.probes\.magnet\.clearance", "> 0 m")),
    Fault("a clearance in metres", "[rotor.probes]\nmagnet = { node = 9, clearance = »0.3 }", (r"rotor\.probes\.magnet\.clearance = 300 mm is more than half the rotor's radius", "bare number is in metres")),
    Fault("a negative stiffness at a probe", '[rotor.probes]\nmagnet = { node = 9, clearance = "300 um", contact = { stiffness = »-1e8 } }', (r"probes\.magnet\.contact\.stiffness", "> 0 N/m")),
    Fault("a negative stiffness of a support", bearing('support = { type = "ribbon", mass = 1, ribbon = { stiffness = »-1e7, slip_force = 100, stick_stiffness = 1e8 } }'), (r"support\.ribbon\.stiffness", "> 0 N/m")),
    Fault("a loop that makes energy", bearing('support = { type = "ribbon", mass = 1, ribbon = { loop = »{ loading = [["-1 mm", "-100 N"], ["0 mm", "-50 N"], ["1 mm", "100 N"]], unloading = [["-1 mm", "-100 N"], ["1 mm", "100 N"]] } } }'), ("makes energy", "Are they exchanged")),
    Fault("a ribbon given twice", bearing('support = { type = "ribbon", mass = 1, ribbon = »{ stiffness = 1e7, slip_force = 100, stick_stiffness = 1e8, geometry = { waves = 30, pitch = "8 mm", height = "1 mm", thickness = "0.3 mm", strip_width = "15 mm", interference = "0.1 mm" } } }'), ("given in several",)),
    Fault("a ribbon without its numbers", bearing('support = { type = »"ribbon", mass = 1 }'), (r"support\.ribbon is missing", 'type = "ribbon" needs it'), place=("drop.toml",)),
    Fault("an unknown kind of support", bearing('support = { type = »"riben", mass = 1 }'), ('Did you mean "ribbon"', "squeeze-film")),
    Fault("a table that no elastomer has", bearing('support = { type = "elastomer", mass = 1, elastomer = { storage = »[["10 Hz", "1 MPa"], ["100 Hz", "1 MPa"], ["1 kHz", "1 MPa"]], loss = [["10 Hz", "0.5 MPa"], ["100 Hz", "0.8 MPa"], ["1 kHz", "0.5 MPa"]], shape_factor = 1 } }'), ("no springs and dampers have this table", "storage rises where loss is high")),
    Fault("moduli at different frequencies", bearing('support = { type = "elastomer", mass = 1, elastomer = { storage = [["10 Hz", "1 MPa"], ["100 Hz", "1.2 MPa"]], loss = »[["10 Hz", "0.1 MPa"], ["90 Hz", "0.1 MPa"]], shape_factor = 1 } }'), ("same frequencies",)),
    Fault("a bump stop without a stop", bearing('support = { type = »"bump-stop", mass = 1, K_y = 1e8, K_z = 1e8, C_y = 1, C_z = 1 }'), (r"support\.stop is missing",), place=("drop.toml",)),
    Fault("a round stop along z alone", bearing('support = { type = "linear", mass = 1, K_y = 1e8, C_y = 1, z = { type = "linear", K_z = 1e8, C_z = 1, stop = »{ gap = "20 um", stiffness = 1e8 } } }'), (r"support\.z\.stop is given, but it acts in any direction", "in `support` itself")),
    Fault("a bump stop along z alone", bearing('support = { type = "linear", mass = 1, K_y = 1e8, C_y = 1, z = { type = »"bump-stop", K_z = 1e8, C_z = 1, stop = { gap = "20 um", stiffness = 1e8 } } }'), (r'support\.z\.type = "bump-stop", but this type acts in any direction',)),
    Fault("a squeeze film along z alone", bearing('support = { type = "linear", mass = 1, K_y = 1e8, C_y = 1, z = { type = »"squeeze-film", K_z = 1e8, C_z = 1, squeeze_film = { viscosity = 0.02, clearance = "120 um" } } }'), (r'support\.z\.type = "squeeze-film", but this type acts in any direction',)),
    Fault("a magnet that pushes the rotor away", '[bearings.M]\ntype = "magnet"\nnode = 9\nstiffness = »[[-1e7, 0], [0, 1e7]]\nrelease_time = ["1 ms", "1 ms"]', ("negative stiffness", "magnet and control together")),
    Fault("a thrust magnet on a rotor that is held", '[bearings.M]\ntype = "magnet"\nnode = 9\nstiffness = [[1e7, 0], [0, 1e7]]\naxial_stiffness = »1e7', ("cannot move along it", r"rotor\.axial_motion")),
    Fault("two bearings on one node", bearing("node = »2", "TB2"), (r"bearings\.TB2\.node = 2: another touchdown bearing", "TB1")),
    Fault("an unknown material", bearing('ball = »"Si3N5"'), (r'bearings\.TB1\.ball = "Si3N5" is not a known material', 'Did you mean "Si3N4"', "Known in .materials.: .*steel")),
    Fault("an unknown catalogue name", bearing('catalogue = »"6041"'), (r'bearings\.TB1\.catalogue = "6041"', "no such bearing", 'Did you mean "60\\d\\d"', "Known: .*6014")),
    Fault("a resistor to an unknown node", '[thermal]\nresistor = [{ between = »["TB1/housing", "frame"], resistance = 0.1 }]',
          ('no node "frame"', "Known: .*TB1/housing")),
    Fault("a resistor to a misspelt node", '[thermal]\nresistor = [{ between = »["TB1/housng", "ambient"], resistance = 0.1 }]',
          ('no node "TB1/housng"', 'Did you mean "TB1/housing"')),
    Fault("a resistor with one end", '[thermal]\nresistor = [{ between = »["TB1/housing"], resistance = 0.1 }]', ("must be two node names",)),
    Fault("a resistor from a node to itself", '[thermal]\nresistor = [{ between = »["TB1/housing", "TB1/housing"], resistance = 0.1 }]', ("TB1/housing", "itself")),
    Fault("two thermal nodes of one name", '[thermal]\nnode = [{ name = "frame", capacity = 1 }, { name = »"frame", capacity = 1 }]', ('name "frame" is taken',)),
    Fault("a thermal node without capacity and resistor", '[thermal]\nnode = [{ name = "frame", capacity = »0 }]', ('"frame" has no capacity, and no resistor',)),
    Fault("friction over speed by a table and by a static value", '[contact]\nstatic_friction_coefficient = »0.2\nfriction_over_speed = [["0 m/s", 0.2], ["1 m/s", 0.1]]', ("both say how friction changes", "Give one of them")),
    Fault("a negative slip speed", '[contact]\nfriction_over_speed = »[["-1 m/s", 0.2], ["1 m/s", 0.1]]', ("negative slip speed", "0 m/s or above")),
    Fault("friction over the temperature of a circuit that does not run", '[contact]\nfriction_over_temperature = »[["20 degC", 1], ["200 degC", 0.8]]\n[thermal]\nmodels = ["fe"]', ("does not run", r'Put "lumped" into thermal\.models')),
    Fault("a torque whose times do not rise", '[rotor]\ntorque = [["0 s", "1 N m"], »["0 s", "2 N m"]]', (r"rotor\.torque#2", "must rise")),
]

GEOMETRY_OF_ROTORS = [
    Fault("nodes out of order", rotor(nodes="[{ id = 1, x = 0 }, { id = 2, x = 1.5 }, { id = 3, x = »1 }]"), (r"x = 1 m of node 3 is not larger than x = 1\.5 m of node 2",), whole=True),
    Fault("nodes numbered anyhow", rotor(nodes="[{ id = 1, x = 0 }, { id = »4, x = 0.5 }, { id = 3, x = 1 }]"), ("node id = 4", "where 2 is expected"), whole=True),
    Fault("an element that contradicts its nodes", rotor(elements='[{ n1 = 1, n2 = 2, od = 0.1, length = »"40 cm" }, { n1 = 2, n2 = 3, od = 0.1 }]'),
          (r"length = 0\.4 m of element 1", r"0\.5 m apart"), whole=True),
    Fault("an element to an unknown node", rotor(elements="[{ n1 = 1, n2 = 2, od = 0.1 }, { n1 = 2, n2 = »7, od = 0.1 }]"), ("n2 = 7", "nodes 1 to 3"), whole=True),
    Fault("an element that is turned around", rotor(elements="[{ n1 = 2, n2 = »1, od = 0.1 }, { n1 = 2, n2 = 3, od = 0.1 }]"), ("does not join", "Exchange n1 and n2"), whole=True),
    Fault("a bore as large as the shaft", rotor(elements="[{ n1 = 1, n2 = 2, od = 0.1, id_ = »0.1 }, { n1 = 2, n2 = 3, od = 0.1 }]"), (r"id_ = 0\.1 m .* is not smaller than its od = 0\.1 m",), whole=True),
    Fault("a rotor in two pieces", rotor(elements="»[{ n1 = 1, n2 = 2, od = 0.1 }]"), ("no element joins node 2 and node 3", "one connected shaft"), whole=True),
    Fault("two elements in the same space", rotor(elements="[{ n1 = 1, n2 = 2, od = 0.1 }, { n1 = 2, n2 = 3, od = 0.1 }, { n1 = 2, n2 = 3, od = »0.08 }]"), ("fill the same space",), whole=True),
    Fault("a mass point at an unknown node", rotor(more='mass_points = [{ node = »9, mass = 1, name = "disk" }]'), ('node = 9 of mass point "disk"', "nodes 1 to 3"), whole=True),
    Fault("a negative mass point", rotor(more="mass_points = [{ node = 2, mass = »-1 }]"), ("mass = -1 is out of range", ">= 0 kg"), whole=True),
    Fault("a shaft without material", rotor(material=""), ("element 1", "and 1 other name no material"), place=("drop.toml",), whole=True),
    Fault("a shaft of negative density", rotor(material="{ E = 2e11, nu = 0.3, rho = »-7800 }"), ("rho = -7800 is out of range",), whole=True),
    Fault("a shaft with a Poisson's ratio of 0.6", rotor(material="{ E = 2e11, nu = »0.6, rho = 7800 }"), ("nu = 0.6 is out of range", "between 0 and 0.5"), whole=True),
    Fault("a shaft of unknown material", rotor(elements='[{ n1 = 1, n2 = 2, od = 0.1, material = »"copper" }, { n1 = 2, n2 = 3, od = 0.1 }]'), ('"copper"', "materials"), whole=True),
    Fault("a misspelt key in a geometry file", "", ('unknown key "Ipp"', 'Did you mean "Ip"'), geometry=('"Ip": 0.0015835', '»"Ipp": 0.0015835')),
    Fault("a broken geometry file", "", ("not valid JSON",), geometry=('"Ip": 0.0015835', '"Ip": », 0.0015835')),
    Fault("a key twice in a geometry file", "", ('key "mass" occurs twice',), geometry=('"Ip": 0.0015835', '»"mass": 0.0015835')),
    Fault("a geometry that is no table", "", ("must be a table|not the name of a file or a table",), files={"list.json": "»[1, 2]\n"}, options=("--set", "rotor.geometry=list.json")),
    Fault("a missing geometry file", '[rotor]\ngeometry = »"nowhere.json"', ('rotor.geometry = "nowhere.json": there is no such file', "Looked for")),
    Fault("a number for a geometry", "[rotor]\ngeometry = »5", (r"rotor\.geometry is an integer", "name of a file or a table")),
]

FILES = [
    Fault("a value with a unit but no quotes", "[run]\nend_time = 10 »ms", ("not valid TOML", 'a value with a unit is in quotes', 'Write it as: end_time = "10 ms"')),
    Fault("a bracket that is not closed", "[run\n»end_time = 1", ("not valid TOML: the name of a section has no closing bracket", r"Write it as: \[run\]"), place=("drop.toml",)),
    Fault("a key twice", '[run]\nend_time = 1\nend_time = »2', ("not valid TOML", "end_time is given twice, first in line 3")),
    Fault("a section twice", '[run]\nend_time = 1\n[run]\ninitial_speed = 2', ("not valid TOML", r"the section \[run\] is there twice, first in line 2"), place=("drop.toml",)),
    Fault("a base that is missing", 'base = »"nowhere.toml"\n', ('"nowhere.toml" cannot be read', "Check its name"), whole=True),
    Fault("a base that is a number", "base = »5\n", ("base is an integer", "name of a file in quotes"), whole=True),
    Fault("a base that leads back", 'base = "other.toml"\n', ("refers back", "drop.toml -> other.toml -> drop.toml"), files={"other.toml": 'base = »"drop.toml"\n'}, whole=True),
    Fault("a base that is the file itself", 'base = »"drop.toml"\n', ("refers back", "drop.toml -> drop.toml"), whole=True),
    Fault("a fault in a base", 'base = "other.toml"\n', ('unknown key "air_gpa"',), files={"other.toml": 'base = "reference.toml"\n[contact]\n»air_gpa = 1\n'}, whole=True),
    Fault("an empty file", "", ("initial_speed", "geometry"), place=("drop.toml",), whole=True),
]

COMMAND_LINE = [
    Fault("--set without a value", options=("--set", "contact.air_gap"), says=("KEY=VALUE", "--set contact.friction_coefficient=0.05"), place=("--set contact.air_gap",)),
    Fault("--set of an unknown key", options=("--set", "contact.air_gpa=250 um"), says=('unknown key "air_gpa"', 'Did you mean "air_gap"'), place=("--set contact.air_gpa",)),
    Fault("--set of an unknown section", options=("--set", "contcat.air_gap=250 um"), says=('unknown key "contcat"', 'Did you mean "contact"'), place=("--set contcat.air_gap",)),
    Fault("--set of a wrong unit", options=("--set", "contact.air_gap=250 ms"), says=("250 ms is a time", "needs a length"), place=("--set contact.air_gap",)),
    Fault("--set out of range", options=("--set", "contact.friction_coefficient=-1"), says=("out of range", "between 0 and 2"), place=("--set contact.friction_coefficient",)),
    Fault("--set inside a number", options=("--set", "contact.air_gap.value=1"), says=('"air_gap" is .*nothing can be set in it', "reference.toml:"), place=("--set contact.air_gap.value",)),
    Fault("--set of a broken list", options=("--set", "run.gravity=[0, 1"), says=("not valid TOML: a list is not closed", r"The value was: \[0, 1"), place=("--set run.gravity",)),
    Fault("--set of a broken name", options=("--set", "contact..air_gap=1"), says=("is not the name of a parameter",), place=("--set contact..air_gap",)),
]

SEVERAL = [
    Fault("all faults at once, in their order",
          '[run]\nend_time = »"10 mm"\n[contact]\n»air_gpa = 1\nexponent = »7\nfriction_coefficient = »"a lot"\n'
          '[bearings.TB1]\nnode = »0\nballs_per_row = »14.5\n[thermal]\ngrowth = »1\n[integration]\nmethod = »"euler"\n',
          ("10 mm is a length", "air_gpa", "exponent = 7", "a lot", "node = 0", "14.5", "growth", "euler")),
    Fault("all faults over several sections at once", '[bearings.TB1]\nnode = »99\nball = »"stele"\n[bearings.TB2]\nnode = »98\n', ("node = 99", "stele", "node = 98")),
    Fault("faults of the rotor's file and of the case together", bearing("node = »0") + '[contact]\nexponent = »7\n',
          ("Ipp",), geometry=('"Ip": 0.0015835', '»"Ipp": 0.0015835')),
]

FAULTS = (NAMES + TYPES_AND_UNITS + RANGES + KEYS + GEOMETRY_OF_BEARINGS + CROSS_REFERENCES + GEOMETRY_OF_ROTORS + FILES + COMMAND_LINE + SEVERAL)


def without_marks(text):
    """The text without », and the places (line, column) where they stood."""
    places = []
    for number, line in enumerate(text.split("\n"), 1):
        while "»" in line:
            places.append((number, line.index("»") + 1))
            line = line.replace("»", "", 1)
    return text.replace("»", ""), places


class FaultyInput(ProgramTest):
    def lay_out(self, fault):
        """Writes the files of a case; "file:line:column" of every mark."""
        reference = (self.folder / "reference.toml").read_text()
        for old, new in fault.edits.items():
            self.assertIn(old, reference, "the reference case has changed: adapt this test")
            reference = reference.replace(old, new)
        texts = {}
        if fault.geometry:
            geometry = (self.folder / "neisi2019-rotor.json").read_text()
            self.assertIn(fault.geometry[0], geometry, "the reference rotor has changed: adapt this test")
            texts["neisi2019-rotor.json"] = geometry.replace(*fault.geometry)
        texts |= {"drop.toml": fault.text if fault.whole else BASE + fault.text, "reference.toml": reference, **fault.files}
        expected = []
        for name, text in texts.items():
            clean, places = without_marks(text)
            self.write(name, clean)
            expected += [f"{name}:{line}:{column}" for line, column in places]
        return expected + list(fault.place)


def test_of(fault):
    def test(self):
        places = self.lay_out(fault)
        (self.folder / "results").mkdir()
        for name in ("results.h5", "summary.json", "parameters.toml"):
            self.write(f"results/{name}", "earlier results")
        before = content_of(self.folder)
        done = self.call("run", "drop.toml", *fault.options)
        again = self.call("run", "drop.toml", "-o", "results", "--force", *fault.options)
        for result in (done, again):
            self.assertEqual(result.returncode, 2, result.stderr or "no message")
            self.assertEqual(result.stderr, done.stderr)
            self.assertEqual(result.stdout, "")
        self.assertEqual(content_of(self.folder), before, "something was written")
        message = " ".join(done.stderr.split())
        for words in fault.says:
            self.assertRegex(message, words, done.stderr)
        named = re.findall(r"^error: (\S+:\d+:\d+|--set [^:]+|[^:\s]+)(?=: )", done.stderr, re.MULTILINE)
        if fault.place:
            named, places = {place.split(":")[0] for place in named}, {place.split(":")[0] for place in places}
        self.assertEqual(named, places, done.stderr)
        self.assertNotIn("fault of the program", done.stderr)

    return test


for the_fault in FAULTS:
    the_name = "test_reports_" + re.sub(r"\W+", "_", the_fault.name)
    assert not hasattr(FaultyInput, the_name), the_name
    setattr(FaultyInput, the_name, test_of(the_fault))


class FaultyCommandLine(ProgramTest):
    def fails(self, *arguments, says):
        before = content_of(self.folder)
        done = self.call(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(content_of(self.folder), before, "something was written")
        for words in says:
            self.assertRegex(done.stderr, words)

    def test_the_small_case_is_sound(self):
        self.write("drop.toml", rotor())
        self.succeed("check", "drop.toml")

    def test_check_reports_what_run_reports(self):
        self.write("drop.toml", BASE + bearing("balls_per_row = 40"))
        run, check = self.call("run", "drop.toml"), self.call("check", "drop.toml")
        self.assertEqual((check.returncode, check.stdout, check.stderr), (2, "", run.stderr))

    def test_reports_a_missing_case_file(self):
        self.fails("run", "nowhere.toml", says=(r'^error: nowhere\.toml: file "nowhere\.toml" cannot be read', "Check its name"))

    def test_reports_a_folder_for_a_case_file(self):
        (self.folder / "sub").mkdir()
        self.fails("run", "sub", says=('"sub" cannot be read',))

    def test_reports_an_unknown_option(self):
        self.fails("run", "reference.toml", "--forse", says=("--forse",))

    def test_reports_an_unknown_command(self):
        self.fails("rum", "reference.toml", says=("rum|subcommand",))

    def test_reports_a_missing_command(self):
        self.fails(says=("no command is given", "Commands: run, check"))

    def test_reports_a_missing_case(self):
        self.fails("run", says=("case is required",))

    def test_reports_an_option_without_its_value(self):
        self.fails("run", "reference.toml", "-o", says=("-o|--output",))

    def test_reports_an_unknown_unit_of_a_speed(self):
        self.fails("modes", "reference.toml", "--speeds", "0 rpm,15 furlonks", says=("--speeds", 'unknown unit "furlonks"', "15200 rpm"))

    def test_reports_hertz_for_a_speed(self):
        self.fails("modes", "reference.toml", "--speeds", "253 Hz", says=("--speeds", "revolutions or radians", "rpm"))

    def test_reports_an_empty_speed(self):
        self.fails("modes", "reference.toml", "--speeds", "0 rpm,,1 rpm", says=("--speeds", "not a number"))

    def test_reports_no_modes(self):
        self.fails("modes", "reference.toml", "--modes", "0", says=("--modes",))

    def test_reports_a_folder_that_cannot_be_made(self):
        self.write("occupied", "a file")
        self.fails("run", "reference.toml", "-o", "occupied/sub", says=("occupied/sub", "cannot be made"))

    def test_reports_a_file_in_place_of_the_folder(self):
        self.write("occupied", "a file")
        self.fails("run", "reference.toml", "-o", "occupied", says=("occupied", "cannot be made"))

    def test_reports_that_a_new_case_exists(self):
        self.write("drop.toml", "mine")
        self.fails("new", ".", says=("drop.toml", "already exists"))

    def test_a_message_ends_with_what_to_do_on_indented_lines(self):
        self.write("drop.toml", BASE + '[contact]\nair_gpa = "250 um"\n')
        lines = self.call("check", "drop.toml").stderr.splitlines()
        self.assertEqual(lines[0], 'error: drop.toml:3:1: unknown key "air_gpa" in [contact].')
        self.assertTrue(all(line.startswith("       ") for line in lines[1:]), lines)
        self.assertIn('Did you mean "air_gap"?', lines[1])


if __name__ == "__main__":
    unittest.main()
