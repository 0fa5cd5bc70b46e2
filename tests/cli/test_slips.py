"""Values that are allowed, and most often a slip: a warning with its reason from every command that reads a case, a fault with --strict."""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
from program import HAS_MESH_ROOM, HEATED_DISC, PARAMS, PROGRAM, ProgramTest, settings  # noqa: E402
from scaled_values import passing, with_value  # noqa: E402

MANY_PARTS = pathlib.Path(__file__).resolve().parents[1] / "faults/many-parts.toml"

# What is set, and what the warning says.
SLIPS_OF_PARTS = {
    MANY_PARTS: [
        (["bearings.TB1.support.squeeze_film.radius=5.5 mm"], r"squeeze_film\.radius = 5\.5 mm is 0\.1 times the outer ring's, 55 mm"),
        (["bearings.TB1.support.squeeze_film.length=200 mm"], r"squeeze_film\.length = 200 mm, but the bearing is 20 mm wide"),
        (["bearings.TB2.support.elastomer.shape_factor=3 mm"], r"elastomer gives way by \d+\.?\d* mm under this bearing's share"),
        (["bearings.SPRING.stiffness=[[-1e6, 0], [0, 1e6]]"], r"SPRING\.stiffness = -1e\+06 N/m on its diagonal pushes the rotor away"),
        # Eigenvalues of [[a, b], [b, a]]: a + b and a - b.
        (["bearings.SPRING.stiffness=[[1e6, 3e6], [3e6, 1e6]]"], r"SPRING\.stiffness has -2e\+06 N/m in its softest direction, between y and z: it pushes the rotor away"),
        (["bearings.SPRING.damping=[[1e2, 3e2], [3e2, 1e2]]"], r"SPRING\.damping has -200 N s/m in one direction between y and z: it drives the rotor"),
        (["bearings.SPRING.stiffness=[[0, 1e6], [1e6, 0]]"], r"SPRING\.stiffness couples y and z with 1e\+06 N/m, but has 0 N/m on its diagonal"),
        (["bearings.SPRING.stiffness=[[1e6, 0], [0, 1e9]]"], r"SPRING\.stiffness has 1e\+06 and 1e\+09 N/m on its diagonal: one is 1e\+03 times"),
        (["bearings.SPRING.damping=[[-1e2, 0], [0, 1e2]]"], r"SPRING\.damping = -100 N s/m on its diagonal drives the rotor"),
        (["bearings.SPRING.damping=[[1e6, 0], [0, 1e2]]"], r"SPRING\.damping = 1e\+06 N s/m is 47\.7 times critical damping"),
        (["rotor.windage.gap=0.2 mm"], r"windage\.gap = 200 um is less than the air gap of the touchdown bearings, 250 um"),
        (["rotor.windage.gap=90 mm"], r"windage\.gap = 90 mm is more than half the rotor's radius, 101\.5 mm"),
        (["rotor.windage.viscosity=1.8e-3"], r"1\.2 kg/m3 times 0\.0018 m2/s = 0\.00216 Pa s; air has 1\.8e-5, hydrogen 9e-6 Pa s, at any pressure"),
        (["rotor.torque=-2000"], r"rotor\.torque of -2000 N m at 1\.52e\+04 rpm is 3\.18 MW, 29 kW for each kilogram"),
        (["contact.static_friction_coefficient=0.05"], r"static_friction_coefficient = 0\.05 is less than the dynamic one, 0\.1"),
        (["contact.friction_over_temperature=[[20, 1], [200, 0.8]]"], r'friction_over_temperature, argument = 20 K is unusual.*"20 degC"'),
        (["bearings.TB1.housing_fit=0.9 mm"], r"housing_fit = 900 um is 0\.82 % of the bearing's diameter"),
        (["bearings.TB1.housing_fit=10 um"], r"TB1\.housing_fit does not count: thermal\.expansion takes ring and housing as one body"),
        (["thermal.recorded=nowhere.h5"], r'thermal\.recorded does not count: thermal\.driver is "automatic"'),
        (["bearings.TB1.contact_width=180 mm"], r"contact_width is 180 mm, but the bearing is 20 mm wide"),
        (["bearings.TB2.ring_diametral_inertia=2.2e-2"], r"ring_diametral_inertia = 0\.022 kg m2 is 56\.4 times ring_spin_inertia"),
        (["bearings.TB2.shoulders.stiffness=1e12"], r"shoulders\.stiffness = 1e\+12 N/m is 201 times that of the bodies, 4\.97e\+09 N/m"),
        (["bearings.TB2.shoulders.stiffness=1e6"], r"shoulders\.stiffness = 1e\+06 N/m is 0\.000201 times that of the bodies"),
    ],
    PARAMS / "neisi2019-ribbon.toml": [
        (["bearings.TB1.support.ribbon.geometry.waves=400"], r"400 waves of 8\.5 mm: 3400 mm, but around the outer ring there are 345\.6 mm"),
        (["bearings.TB1.support.ribbon.geometry.strip_width=180 mm"], r"strip_width of 180 mm, but the bearing is 20 mm wide"),
        (["bearings.TB1.support.ribbon.geometry.thickness=0.8 mm"], r"thickness of 0\.8 mm, but waves of 1 mm height"),
        (["bearings.TB1.support.ribbon.geometry.interference=0.8 mm"], r"interference of 0\.8 mm, but waves of 1 mm height: mounting would flatten them"),
        (["bearings.TB1.support.ribbon.geometry.modulus=206"], r'modulus = 206 Pa is unusual.*write "206 GPa"'),
        (["bearings.M1.stiffness=[[100, 0], [0, 100]]"], r"M1\.stiffness = 100 N/m is unusual for a magnet"),
        (['bearings.M1.release_time=["2 s", "2 s"]'], r"M1 holds the rotor until the end of the run, 0\.2 s, where other magnets let go"),
    ],
}
UNUSUAL = [
    (["contact.friction_coefficient=1e-4"], r"friction_coefficient = 0\.0001 is unusual: it is most often 0 or between 0\.005 and 0\.8"),
    (["contact.lambda=8e-5"], r"contact\.lambda = 8e-0?5 s/m is unusual"),
    (["bearings.TB1.radial_clearance=190 um"], r"radial_clearance = 190 um; a bore of 70 mm has less than 125 um"),
    (["bearings.TB1.housing_length=2.5 mm"], r"the housing of bearings\.TB1 is 2\.5 mm long, but the bearing is 20 mm wide"),
    (['bearings.TB1.housing_diameters=["110 mm", "1300 mm"]'], r"outside diameter of 1300 mm, 11\.8 times the bearing's"),
    (["thermal.contact_half_width=4 mm"], r"contact_half_width = 4 mm is more than a quarter of the balls' diameter in bearings\.TB1, 11\.91 mm"),
    (["materials.steel.k=700"], r"steel has 7800 kg/m3, as metals have, but k = 700 W/\(m K\); silver, the best of them, conducts 430"),
    (["rotor.unbalance=[{ node = 5, me = 1.07e-3 }]"], r"e omega = 15\.5\d* mm/s at its initial speed"),
    (["rotor.unbalance=[{ node = 5, me = 1.07e-12 }]"], r"e omega = 1\.6e-08 mm/s at its initial speed; the finest grade"),
    (["rotor.unbalance=[]", "rotor.balance_grade=G0.0025"], r"balance_grade is G0\.0025; the finest of ISO 21940-11 is G0\.4"),
    (["rotor.unbalance=[]", "rotor.balance_grade=G2.5", "rotor.balance_speed=12000"], r"balance_speed: at 114592 rpm the rotor's surface runs at 1218 m/s"),
    (["rotor.initial_velocity=[4, 0]"], r"initial_velocity = 4 m/s is unusual"),
    (["materials.steel.k_table=[[20, 46], [200, 42]]"], r'k_table, argument = 20 K is unusual.*"20 degC"'),
    (["bearings.TB1.support.K_y=1e300"], r"support\.K_y = 1e\+?300 N/m is unusual"),
    (["bearings.TB1.support.K_z=2.7"], r"support\.K_z = 2\.7 N/m is unusual"),
    (["bearings.TB1.support.C_y=1e300"], r"support\.C_y = 1e\+?300 N s/m is unusual"),
    (["bearings.TB1.support.C_y=2.7"], r"support\.C_y = 2\.7 N s/m is 2\.82e-06 of critical damping"),
    (["bearings.TB1.support.mass=85 t"], r"support\.mass = 85 t is unusual: it is most often between 1e-05 and 20 t"),
    (["run.gravity=981"], r"run\.gravity = 981 m/s2 is 100 times that of the earth"),
    (["bearings.TB1.drag_viscosity=15"], r'drag_viscosity = 15 m2/s is unusual.*write "15 mm2/s"'),
    (["bearings.TB1.f2=25"], r"f2 = 25 is unusual"),
    (["run.gravity=[0, -0.0981, 0]"], r"run\.gravity = 0\.0981 m/s2 is 0\.01 times that of the earth"),
    (["bearings.TB2.preload=0.29"], r"preload = 0\.29 N is 0\.00\d+ % of the static rating of a row"),
    (["bearings.TB2.contact_angle=0.436 deg"], r"contact_angle = 0\.436 deg: angular contact bearings have 12 to 40 deg"),
    (["bearings.TB1.support.mass=50 g"], r"support\.mass = 0\.05 kg is 0\.\d+ times the inner ring's"),
    (["bearings.TB1.support.mass=8.5 t"], r"support\.mass = 8500 kg is 77\.5 times the rotor's"),
    (["bearings.TB1.support.C_y=3.68e6"], r"support\.C_y = 3\.68e\+06 N s/m is 3\.84 of critical damping.*between 0\.0001 and 3"),
    (["materials.Si3N4.E=3.15 GPa"], r"Si3N4 has 3200 kg/m3, as ceramics and metals have, but E = 3\.15 GPa"),
    (["materials.Si3N4.k=0.35"], r"Si3N4 has 3200 kg/m3, as ceramics and metals have, but k = 0\.35 W/\(m K\)"),
    (["materials.steel.nu=0.003"], r"steel has nu = 0\.003; most metals have 0\.25 to 0\.35"),
    (["materials.steel.alpha=1.18e-8"], r"steel has alpha = 1\.18e-08 1/K; even Invar has 1\.2e-6"),
    (["contact.tangential_stiffness=1e5"], r"tangential_stiffness = 100000 N/m is unusual"),
    (["contact.wear_coefficient_bore=1e-11"], r"wear_coefficient_bore = 1e-11 m2/N is unusual"),
    (["thermal.h_shaft=0.05"], r"h_shaft = 0\.05 W/\(m2 K\) is unusual"),
    (["thermal.fit_resistance=5"], r"fit_resistance = 5 K/W is unusual"),
    (["integration.tolerance=3e-4"], r"integration\.tolerance = 0\.0003 is unusual"),
    (["preload.temperature_limit=0.15 degC"], r"preload\.temperature_limit = .* is unusual"),
    (["statics.speed=15200"], r'statics\.speed = 15200 rad/s is unusual: .*write "15200 rpm"'),
    (["preload.speed=15200"], r'preload\.speed = 15200 rad/s is unusual: .*write "15200 rpm"'),
    (["preload.map.speed=[0, 15200]"], r'preload\.map\.speed = 15200 rad/s is unusual: .*write "15200 rpm"'),
    (["preload.pressure_limit=42 MPa"], r"preload\.pressure_limit = .* is unusual"),
    (["output.checkpoint_interval=10000"], r"checkpoint_interval = .* is unusual"),
    (["bearings.TB1.shaft_lump_length=20"], r'shaft_lump_length = 20 m is unusual.*write "20 mm"'),
    (["bearings.TB1.conformity=[0.6, 0.6]"], r"conformity = 0\.6 is unusual"),
    (["bearings.TB1.inner_shoulder_diameter=99 mm"], r"inner_shoulder_diameter is 99 mm, but a shoulder of this ring lies between 70 and 90 mm"),
    (["bearings.TB1.outer_shoulder_diameter=10 mm"], r"outer_shoulder_diameter is 10 mm, but a shoulder of this ring lies between 90 and 110 mm"),
    (['bearings.TB1.housing_diameters=["110 mm", "111 mm"]'], r"has a wall of 0\.5 mm around a bore of 110 mm"),
    (["rotor.unbalance=[{ node = 3, me = 0.05 }]"], r"unbalance of 0\.05 kg m in \d+\.?\d* kg is e omega = \d+"),
    (['bearings.AMB={ type = "magnet", node = 5, stiffness = [[1e7, 0], [0, 1e7]], damping = [[1e4, 0], [0, 1e4]], release_time = ["2 s", "2 s"] }'], r"no magnet lets go before the end of the run, 0\.3 s: nothing falls"),
    (["bearings.TB1.ring_mass=2.1"], r"ring_mass is 2\.1 kg, but a ring of its diameters, width and material has 0\.145 kg"),
    (["rotor.initial_angle=25"], r'initial_angle = 25 rad is unusual.*write "25 deg"'),
    (["thermal.h_shaft=50000"], r"h_shaft = 50000 W/\(m2 K\) is unusual"),
    (["thermal.fit_resistance=500"], r"fit_resistance = 500 K/W is unusual"),
    (["contact.regularisation_speed=50"], r"regularisation_speed = 50 m/s is unusual"),
    (["rotor.mass_proportional_alpha=3000"], r"mass_proportional_alpha = 3000 1/s is unusual"),
    (["rotor.cut_off_frequency=45"], r'cut_off_frequency = 45 Hz is unusual.*write "45 kHz"'),
    (["rotor.cut_off_frequency=4500000"], r"cut_off_frequency = 4500000 Hz is unusual"),
    (["rotor.torque=[[0, 1e9]]"], r"rotor\.torque = 1000000000 N m is unusual"),
    (["rotor.torque=50000"], r"rotor\.torque of 5e\+04 N m changes the speed by 3\.673e\+05 rpm in 0\.3 s"),
    (['rotor.windage={ torque = 0.5, speed = 15.2 }'], r"rotor\.windage brakes with 5483 N m"),
    (["bearings.TB1.C0=310 kN"], r"C0 is 310 kN, but a row of balls like these has about 29\.8 kN"),
    (["bearings.TB1.C=4e6"], r"TB1\.C is 4000 kN, but a row of balls like these has about 35\.9 kN"),
    (["bearings.TB2.preload=29 kN"], r"preload = 2\.9e\+04 N is 93\.5 % of the static rating of a row, 31 kN"),
    (["rotor.initial_velocity=[30, 0]"], r"initial_velocity = 30 m/s is unusual"),
    (["rotor.initial_tilt_rate=[9000, 0]"], r"initial_tilt_rate = 9000 rad/s is unusual"),
    (["rotor.initial_orbit.speed=15200", "rotor.initial_orbit.radius=100 um"], r"initial_orbit\.speed is 1\.451e\+05 rpm, 9\.55 times the rotor's"),
    (["thermal.contact_half_width=0.4"], r'contact_half_width = 0\.4 m is unusual'),
    (["thermal.rub_band_length=5.9"], r'rub_band_length = 5\.9 m is unusual.*write "5\.9 mm"'),
    (["thermal.gas_conductivity=26"], r"gas_conductivity = 26 W/\(m K\) is unusual"),
    (['bearings.TB1.support={ type = "ribbon", mass = "1 kg", ribbon = { stiffness = 4e4, slip_force = 200, stick_stiffness = 4e5 } }'], r"ribbon\.stiffness = 4e\+04 N/m gives way by 13\.39 mm"),
    (['bearings.TB1.support={ type = "ribbon", mass = "1 kg", ribbon = { stiffness = 4e7, slip_force = 6e5, stick_stiffness = 4e8 } }'], r"slip_force = 6e\+05 N is 1\.12e\+03 times this bearing's share of the rotor's weight: it never slips"),
    (['bearings.TB1.support={ type = "ribbon", mass = "1 kg", ribbon = { stiffness = 4e7, slip_force = 8, stick_stiffness = 4e8 } }'], r"slip_force = 8 N is 0\.0149 times this bearing's share of the rotor's weight: it always slips.*support\.ribbon slips after 0\.02 um \(slip_force over stick_stiffness\)"),
    (['bearings.TB1.support={ type = "ribbon", mass = "1 kg", ribbon = { stiffness = 4e7, slip_force = 2000, stick_stiffness = 4e5 } }'], r"ribbon\.stick_stiffness = 4e\+05 N/m is 0\.01 times its stiffness, 4e\+07 N/m"),
    (["bearings.TB1.support.K_y=2.7e4"], r"support\.K_y = 2\.7e\+04 N/m gives way by 19\.84 mm under this bearing's share"),
    (["bearings.TB1.support.K_y=2.7e6"], r"has K_y = 2\.7e\+06 and K_z = 1\.5e\+09 N/m: one is 556 times the other"),
    (["bearings.TB1.contact_stiffness=1.144e12"], r"contact_stiffness = 1\.144e\+12 N/m\^n, but journal and bore of these dimensions have about 6\.98e\+09"),
    (['bearings.AMB={ type = "magnet", node = 5, stiffness = [[1e7, 0], [0, 1e7]], damping = [[-1e4, 0], [0, 1e4]], release_time = ["10 ms", "10 ms"] }'], r"damping = -1e\+04 N s/m on its diagonal drives the rotor"),
    (['bearings.AMB={ type = "magnet", node = 16, stiffness = [[1e9, 0], [0, 1e9]], holding_force = [-1076, 0], release_time = ["10 ms", "10 ms"] }'], r"the magnets hold the rotor with -1076 N along y where its weight is -1076 N"),
    (["rotor.unbalance=[]", "rotor.balance_grade=G2500"], r"e omega = 2500 mm/s at its initial speed.*Check balance_grade"),
    (["rotor.unbalance=[]", "rotor.balance_grade=G2.5", "rotor.balance_speed=12 rpm"], r"rotor\.balance_speed is 12 rpm"),
    (["run.gravity=[9.81, 0, 0]"], r"gravity of 9\.81 m/s2 along the axis has no effect: the rotor is locked there"),
    (["materials.steel.c=51000"], r"steel has rho c = 7800 kg/m3 times 5\.1e\+04 J/\(kg K\) = 398 MJ/\(m3 K\)"),
    (["materials.steel.k=0.45"], r"steel has 7800 kg/m3, as metals have, but k = 0\.45 W/\(m K\)"),
    (["materials.steel.E=2e10"], r"steel has 7800 kg/m3, as metals have, but E = 20 GPa"),
    (["output.interval=1"], r"output\.interval = 1 s is longer than the run, 0\.3 s"),
    (["run.end_time=0.3 h", "integration.method=runge-kutta-4", "integration.step=1e-7"], r"1080 s takes 1\.1e\+10 steps of at most 1e-07 s: hours or days"),
]


class Slips(ProgramTest):
    def said(self, *arguments, code=0):
        done = self.call(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        return re.sub(r"\s+", " ", done.stderr)

    def test_unusual_values_warn(self):
        for assignments, says in UNUSUAL:
            words = [word for assignment in assignments for word in ("--set", assignment)]
            with self.subTest(says):
                self.assertRegex(self.said("check", "reference.toml", *words), "warning: .*" + says)
                self.assertRegex(self.said("check", "reference.toml", "--strict", *words, code=2), "error: .*" + says)

    def test_a_run_that_would_not_end_is_refused(self):
        said = self.said("check", "reference.toml", *settings(run__end_time="1e6 s", output__interval="1 s", integration__method="runge-kutta-4", integration__step="1e-7 s"), code=2)
        self.assertRegex(said, r"1e\+06 s in steps of at most 1e-07 s are 1e\+13 steps; at most 1e\+11 are taken")

    def test_a_rotor_of_too_many_nodes_is_told_before_its_modes_are_sought(self):
        def with_nodes(n):
            elements = [{"n1": i + 1, "n2": i + 2, "od": 0.0695} for i in range(n - 1)]
            self.write("rotor.json", json.dumps({"units": "SI", "material": {"E": 2e11, "nu": 0.3, "rho": 7850}, "nodes": [{"id": i + 1, "x": i / n} for i in range(n)], "elements": elements}))
            return ["check", "reference.toml", "--set", 'rotor.geometry="rotor.json"', "--set", "rotor.unbalance=[]", "--set", f"bearings.TB1.node={n // 20}", "--set", f"bearings.TB2.node={n - n // 10}"]

        self.assertRegex(self.said(*with_nodes(25000), code=2), r"the rotor has 25000 nodes: its modes have 50000 unknowns a plane, which take 80 GB")
        self.assertRegex(self.said(*with_nodes(501)), "warning: .*the rotor has 501 nodes: its modes take about 1.3 s")
        self.assertNotIn("nodes: its modes", self.said(*with_nodes(400)))

    def test_modes_are_sought_at_a_thousand_speeds_at_most(self):
        said = self.said("modes", "reference.toml", "--speeds", ",".join(map(str, range(1, 1002))), code=2)
        self.assertIn("--speeds: these are 1001 speeds; at most 1000 are taken", said)

    def test_supports_are_a_thousand_at_most(self):
        self.write("many.toml", 'base = "reference.toml"\n' + "".join(f'[bearings.S{i}]\ntype = "linear"\nnode = {3 + i % 20}\nstiffness = [[1e5, 0], [0, 1e5]]\n' for i in range(999)))
        self.assertIn("there are 1001 bearings and supports; at most 1000 are taken", self.said("check", "many.toml", code=2))

    def test_a_speed_of_an_option_is_looked_at(self):
        for words in (["modes", "reference.toml", "--shapes", "m.h5", "--speeds"], ["critical-speeds", "reference.toml", "--diagram", "c.svg", "--force", "--up-to"]):
            self.assertRegex(self.said(*words, "15200"), words[-1] + r": at 145149 rpm the rotor's surface runs at \d+ m/s")
            (self.folder / "m.h5").unlink(missing_ok=True)
            self.assertNotIn("warning", self.said(*words, "15200 rpm"))

    def test_every_bearing_of_the_catalogue_has_usual_ratings(self):
        # Of makers' catalogues: the estimates of ratings and stiffness must not doubt them.
        for file in sorted((PARAMS / "bearings").glob("*.toml")):
            size = tomllib.loads(file.read_text())
            bore, outside = (float(size[key].split()[0]) for key in ("bore_diameter", "outside_diameter"))
            self.write("drop.toml", f'base = "reference.toml"\n[bearings.TB1]\ncatalogue = "{file.stem}"\nbore_radius = "{bore / 2} mm"\nhousing_diameters = ["{outside} mm", "{1.3 * outside} mm"]\n')
            said = self.said("check", "drop.toml")
            self.assertEqual("the shaft at node 2" in said, bore != 70)  # it was looked at
            for key in ("C0 is", ".C is", "ring_mass is", "contact_stiffness ="):
                self.assertNotIn(key, said, file.stem)

    def test_no_value_passes_a_thousand_times_too_large(self):
        # Rows this coarse may be meant; so may a torque that lasts, and whirl and strong damping by linear supports.
        meant = {"output.interval", "rotor.torque[1][0]", "bearings.SPRING.stiffness[0][1]", "bearings.SPRING.stiffness[1][0]", "bearings.SPRING.damping[0][0]",
                 "bearings.SPRING.damping[1][1]"}
        for case in (MANY_PARTS, PARAMS / "neisi2019-ribbon.toml"):
            with self.subTest(case.name):
                silent, strange = passing(str(PROGRAM), str(case), [1000])
                of_elastomers = {"thermal.fit_resistance"} if case == MANY_PARTS else set()  # 5 K/W of an O-ring
                self.assertEqual({key for key, value in silent} - meant - of_elastomers, set())
                self.assertEqual(strange, [])

    def test_parts_that_do_not_fit_each_other_warn(self):
        for case, slips in SLIPS_OF_PARTS.items():
            self.assertEqual(self.said("check", case), "")
            for assignments, says in slips:
                with self.subTest(says):
                    self.assertRegex(self.said("check", case, *[word for assignment in assignments for word in ("--set", assignment)]), "warning: .*" + says)

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_elastic_growth_of_a_ring_on_a_ribbon_warns(self):
        said = self.said("check", PARAMS / "neisi2019-ribbon.toml", *settings(thermal__models='["lumped", "fe"]', thermal__expansion="elastic"))
        self.assertRegex(said, r"warning: .*outer ring of bearings\.TB1 is carried by a ribbon, but elasticity lets it grow as if it sat in its housing")

    def test_slips_in_a_rotor_file_warn(self):
        rotor = json.loads((PARAMS / "neisi2019-rotor.json").read_text())
        for path, value, says in ((("elements", 14, "od"), 0.0203024, r"element 15 of the rotor has od = 20\.3 mm beside an element of 203 mm"),
                                  (("elements", 29, "od"), 0.005, r"element 30 of the rotor has od = 5 mm beside an element of 60 mm"),
                                  (("elements", 2, "od"), 0.7, r"element 3 of the rotor has od = 700 mm beside an element of 80 mm"),
                                  (("elements", 8, "id_"), 0.1088, r"element 9 of the rotor is a tube with a wall of 0\.0545 mm"),
                                  (("mass_points", 0, "Id"), 0.867, r"mass point 1 at node 1 has 1\.003 kg and Id = 0\.867 kg m2; a body of its mass and Ip as long as the whole rotor has 0\.0785 kg m2")):
            with self.subTest(says):
                self.write("rotor.json", json.dumps(with_value(rotor, path, value)))
                self.assertRegex(self.said("check", "reference.toml", "--set", 'rotor.geometry="rotor.json"'), "warning: .*" + says)

    def test_check_says_when_the_rotor_first_touches(self):
        # sqrt(2 250 um / 9.81 m/s2)
        done = self.succeed("check", "reference.toml", *settings(run__end_time="3 ms"))
        self.assertIn("first touch: after about 7.14 ms, by free fall. The run ends before, at 3 ms: nothing is touched.", done.stdout)
        self.assertIn("first touch: after about 7.14 ms, by free fall\n", self.succeed("check", "reference.toml").stdout)

    def test_first_touch_knows_the_rotors_damping(self):
        # u'' + alpha u' = g from rest: u = g (t - (1 - exp(-alpha t)) / alpha) / alpha is 250 um at t.
        for alpha in (30.0, 300.0):
            low, high = 0.0, 1.0
            while high - low > 1e-9:
                t = 0.5 * (low + high)
                low, high = (t, high) if 9.81 * (t + math.expm1(-alpha * t) / alpha) / alpha < 250e-6 else (low, t)
            done = self.succeed("check", "reference.toml", *settings(rotor__mass_proportional_alpha=f"{alpha} 1/s"))
            self.assertIn(f"first touch: after about {1e3 * t:.3g} ms, by free fall\n", done.stdout)

    def test_a_rotor_of_another_material_than_the_ring_is_told(self):
        rotor = json.loads((PARAMS / "neisi2019-rotor.json").read_text())
        rotor["material"]["E"] = 1.1e11
        self.write("rotor.json", json.dumps(rotor))
        other = ["check", "reference.toml", "--set", 'rotor.geometry="rotor.json"']
        told = self.succeed(*other).stderr
        self.assertRegex(told, r'the rotor\'s surface at bearings\.TB1 has a modulus of 110 GPa, the material "steel" of its ring 200 GPa.*\n.*bearings\.TB1\.journal')
        self.assertNotIn("surface at bearings", self.succeed(*other, "--set", "bearings.TB1.journal=steel", "--set", "bearings.TB2.journal=steel").stderr)
        self.assertIn('Did you mean "steel"', self.call(*other, "--set", "bearings.TB1.journal=stel").stderr)

    def test_every_command_warns(self):
        slip = settings(bearings__TB1__f2="25")
        commands = [["check", "reference.toml"], ["modes", "reference.toml"], ["statics", "reference.toml"], ["critical-speeds", "reference.toml"],
                    ["run", "reference.toml", "-o", "out", *settings(run__end_time="1 us")]]
        if HAS_MESH_ROOM:
            commands.append(["mesh", "reference.toml", "-o", "m.msh"])
        self.write("study.toml", 'case = "reference.toml"\n[design]\nkind = "grid"\n[vary]\ncontact.friction_coefficient = [0.05, 0.1]\n')
        commands.append(["study", "study.toml", "--dry-run", *settings(run__end_time="1 ms")])
        for command in commands:
            with self.subTest(command[0]):
                self.assertIn("bearings.TB1.f2 = 25 is unusual", self.said(*command, *slip))

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_heat_warns_of_its_sections(self):
        self.write("disc.toml", "output_times = [1]\n" + HEATED_DISC.replace('"20 mm"', "60"))
        self.assertRegex(self.said("check", "disc.toml"), r'rectangle#1\.r = 60 m is unusual.*If mm is meant, write "60 mm"')
        self.assertRegex(self.said("check", "disc.toml", "--strict", code=2), r"r = 60 m is unusual")
        film = '[[convection]]\nboundary = "disc.outer"\ncoefficient = 23000\n'
        self.write("disc.toml", "output_times = [1]\n" + HEATED_DISC + film)
        self.assertRegex(self.said("check", "disc.toml"), r"convection#1\.coefficient = 23000 W/\(m2 K\^n\) is unusual")
        self.write("disc.toml", "output_times = [1]\n" + HEATED_DISC)
        self.assertEqual(self.said("heat", "disc.toml", "-o", "disc"), "")


class LayersOfSets(ProgramTest):
    """A layer that names a bearing of the catalogue does not drop that there was a set."""

    def resolved(self, case, *words):
        done = self.succeed("run", case, "-o", "out", "--force", *settings(run__end_time="1 us"), *words)
        return tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]["TB2"], done.stderr

    def test_a_pair_stays_a_pair_and_it_is_said(self):
        self.write("drop.toml", 'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "71914-25"\n')
        self.write("middle.toml", 'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "71914-25-pair-X"\n')
        self.write("over.toml", 'base = "middle.toml"\n[bearings.TB2]\ncatalogue = "71914-25"\n')
        for case, words in (("drop.toml", []), ("over.toml", []), ("reference.toml", ["--set", 'bearings.TB2.catalogue="71914-25"'])):
            with self.subTest(case):
                pair, said = self.resolved(case, *words)
                self.assertEqual((pair["rows"], pair["arrangement"], pair["preload"]), (2, "X", "290 N"))
                self.assertEqual((pair["width"], pair["C0"]), (0.032, 62000))
                self.assertRegex(said, r'warning: .*bearings\.TB2\.catalogue = "71914-25" is laid over a set of 2 rows: taken as a set of 2\.')
                self.assertIn("Write count = 2 beside it, or count = 1", said)

    def test_what_the_layer_says_itself_holds(self):
        for count, rows in ((2, 2), (1, 1)):
            self.write("drop.toml", f'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "71914-25"\ncount = {count}\n')
            bearing, said = self.resolved("drop.toml")
            self.assertEqual(bearing["rows"], rows)
            self.assertNotIn("laid over", said)
        # One bearing alone: what is left of the set is told.
        self.assertRegex(said, r"bearings\.TB2\.preload is of a set, but the bearing has rows = 1")

    def test_values_of_one_bearing_given_for_a_pair_are_told(self):
        one = tomllib.loads((PARAMS / "bearings/71914-25.toml").read_text())
        for key in ("width", "ring_mass", "ring_spin_inertia", "C0", "C"):
            with self.subTest(key):
                self.write("drop.toml", f'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "71914-25"\ncount = 2\n{key} = "{one[key]}"\n')
                said = " ".join(self.succeed("check", "drop.toml").stderr.split())
                self.assertRegex(said, rf"warning: drop\.toml:5:\d+: bearings\.TB2\.{key} = .* is about that of one bearing of the catalogue \(71914-25, .*\), but count = 2\. It is of all 2 bearings together: leave it out")
        # Those of both, or of one bearing alone, are right.
        for count, mass in ((2, "0.21 kg"), (2, "0.25 kg"), (1, "0.105 kg")):
            self.write("drop.toml", f'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "71914-25"\ncount = {count}\nring_mass = "{mass}"\n')
            self.assertNotIn("of one bearing", self.succeed("check", "drop.toml").stderr, (count, mass))

    def test_a_deep_groove_bearing_in_place_of_a_pair_is_one_and_it_is_said(self):
        self.write("drop.toml", 'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "61914"\npreload = 0\n')
        bearing, said = self.resolved("drop.toml")
        self.assertEqual(bearing["rows"], 1)
        self.assertRegex(said, r'catalogue = "61914" is one bearing, and replaces a set of several rows')

    def test_what_another_name_replaces_is_listed(self):
        self.write("middle.toml", 'base = "reference.toml"\n[bearings.TB1]\ncatalogue = "61914"\nring_mass = "0.25 kg"\nball_diameter = "8 mm"\nhousing_diameters = ["100 mm", "120 mm"]\nf2 = 0.3\n')
        self.write("drop.toml", 'base = "middle.toml"\n[bearings.TB1]\ncatalogue = "71914-25"\n')
        for words in (["drop.toml"], ["middle.toml", "--set", 'bearings.TB1.catalogue="71914-25"']):
            said = " ".join(self.succeed("check", *words).stderr.split())
            self.assertRegex(said, r'warning: .*bearings\.TB1\.catalogue = "71914-25" replaces what the layers below say of "61914": ball_diameter = 8 mm, ring_mass = 0\.25 kg\.')
        # Values from the case's own numbers are another bearing's, and are to go.
        self.write("drop.toml", 'base = "reference.toml"\n[bearings.TB1]\ncatalogue = "6014"\n')
        self.assertNotIn("replaces", self.succeed("check", "drop.toml").stderr)

    def test_a_row_alone_has_no_arrangement(self):
        for words in (["bearings.TB2.rows=1", "bearings.TB2.arrangement=O"], ["bearings.TB1.arrangement=O"]):
            done = self.succeed("check", "reference.toml", *[word for assignment in words for word in ("--set", assignment)])
            self.assertRegex(done.stderr, r"warning: .*arrangement is of a set, but the bearing has rows = 1")


class WithoutEffect(ProgramTest):
    """What a user wrote and nothing reads is told."""

    def said(self, case, *assignments):
        return self.succeed("check", case, *[word for assignment in assignments for word in ("--set", assignment)]).stderr

    def test_keys_of_a_support_of_another_type(self):
        ribbon = 'bearings.TB1.support.ribbon={ stiffness = "4e7 N/m", slip_force = "2 kN", stick_stiffness = "3e8 N/m" }'
        self.assertRegex(self.said("reference.toml", ribbon), r'support\.ribbon has no effect with type = "linear"')
        shutil.copytree(PARAMS / "own-machine", self.folder / "own")
        said = self.said("own/drop.toml", "bearings.TB1.support.K_y=1e9")
        self.assertRegex(said, r'bearings\.TB1\.support\.K_y has no effect with type = "ribbon"')

    def test_what_a_layer_replaces_is_not_told_and_the_file_of_a_run_says_the_same(self):
        for name in ("neisi2019-ribbon.toml", "neisi2019-settling.toml", "neisi2019.toml", "neisi2019-rotor.json"):
            shutil.copy(PARAMS / name, self.folder)
        self.succeed("run", "neisi2019-ribbon.toml", "-o", "out", *settings(run__end_time="30 ms"))
        self.assertEqual(self.summary()["input_warnings"], [])
        self.assertEqual(self.said("out/parameters.toml"), "")

    def test_keys_of_all_bearings_that_each_sets_itself(self):
        self.assertRegex(self.said("reference.toml", "bearings.f2=5"), r"bearings\.f2 has no effect: every touchdown bearing has a value of its own")
        self.assertEqual(self.said("reference.toml", "bearings.conformity=[0.53, 0.53]").count("has no effect"), 1)
        self.assertNotIn("has no effect", self.said("reference.toml"))

    def test_a_catalogue_name_that_is_there_already_changes_nothing(self):
        self.write("middle.toml", 'base = "reference.toml"\n[bearings.TB1]\ncatalogue = "6014"\nring_mass = "0.25 kg"\n')
        self.write("drop.toml", 'base = "middle.toml"\n[bearings.TB1]\ncatalogue = "6014"\n')
        self.succeed("run", "drop.toml", "-o", "out", *settings(run__end_time="1 us"))
        self.assertIn('ring_mass = "0.25 kg"', (self.folder / "out/parameters.toml").read_text())


class ShaftsAsTables(ProgramTest):
    def test_columns_in_a_wrong_unit(self):
        shutil.copytree(PARAMS / "own-machine", self.folder / "own")
        shaft = (PARAMS / "own-machine/shaft.csv").read_text()
        self.assertEqual(self.succeed("check", "own/drop.toml").stderr, "")
        for right, wrong, says in (("mass [kg]", "mass [t]", "radius of gyration"), ("mass [kg]", "mass [g]", "radius of gyration"), ("length [mm]", "length [cm]", "50 times as long as thick"),
                                   ("Ip [kg m2], Id [kg m2]", "Ip [kg mm2], Id [kg mm2]", "radius of gyration")):
            with self.subTest(wrong):
                self.assertIn(right, shaft)
                self.write("own/shaft.csv", shaft.replace(right, wrong))
                self.assertIn(says, re.sub(r"\s+", " ", self.succeed("check", "own/drop.toml").stderr))


class FilesOfTheUser(ProgramTest):
    def test_a_case_in_the_directory_of_results_is_not_written_over(self):
        self.write("parameters.toml", 'base = "reference.toml"\n')
        for command in (["run", "parameters.toml", "-o", "."], ["run", "parameters.toml", "-o", ".", "--force"], ["run", "reference.toml", "-o", "."]):
            done = self.call(*command, *settings(run__end_time="1 ms"))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('holds "parameters.toml", but no results of this program', done.stderr)
        self.assertEqual((self.folder / "parameters.toml").read_text(), 'base = "reference.toml"\n')
        (self.folder / "parameters.toml").unlink()
        self.write("case.toml", 'base = "reference.toml"\n')
        self.write("study.toml", 'case = "case.toml"\n[design]\nkind = "grid"\n[vary]\ncontact.friction_coefficient = [0.05, 0.1]\n')
        self.assertEqual(self.call("study", "study.toml", "-o", ".", *settings(run__end_time="1 ms")).returncode, 2)
        self.assertEqual((self.folder / "case.toml").read_text(), 'base = "reference.toml"\n')

    def test_what_a_killed_run_left_before_its_results_may_be_replaced(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"))
        for name in ("results.h5", "summary.json"):
            (self.folder / "out" / name).unlink()
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"))

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_what_a_killed_computation_of_heat_left_may_be_replaced(self):
        self.write("disc.toml", "output_times = [1]\n" + HEATED_DISC)
        self.succeed("heat", "disc.toml", "-o", "out")
        for name in ("results.h5", "summary.json"):
            (self.folder / "out" / name).unlink()
        self.succeed("heat", "disc.toml", "-o", "out")

    def test_a_summary_of_someone_else_is_refused(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"))
        for content in ("{}", "[]", '{"run": {}, "energy": {}}', '{"run": {}, "bearings": {}, "energy": {}}', '{"bearings": 5}'):
            self.write("out/summary.json", content)
            done = self.call("report", "out", "--force")
            self.assertEqual(done.returncode, 2, (content, done.stderr))
            self.assertIn("summary.json", done.stderr)

    def test_messages_may_get_lost(self):
        with open("/dev/full", "w") as full:
            for words, code in ((["check", "reference.toml", *settings(run__gravity="-1")], 2), (["modes", "reference.toml"], 0), (["bogus"], 2),
                                (["run", "reference.toml", "-o", "out", "--quiet", *settings(run__end_time="1 ms", run__gravity="60")], 0)):
                done = subprocess.run([PROGRAM, *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=full, timeout=60)
                self.assertEqual(done.returncode, code, words)
                closed = subprocess.run(["sh", "-c", 'exec "$@" 2>&-', "-", PROGRAM, *[word.replace("out", "closed") for word in words]], cwd=self.folder, stdout=subprocess.DEVNULL, timeout=60)
                self.assertEqual(closed.returncode, code, words)
        self.assertTrue((self.folder / "out/results.h5").is_file() and (self.folder / "closed/results.h5").is_file())


class OneFaultBesideAnother(ProgramTest):
    def test_an_unknown_bearing_hides_no_other_fault(self):
        self.write("drop.toml", 'base = "reference.toml"\n[bearings.TB1]\ncatalogue = "6o14"\nball_diamter = "12 mm"\n[contact]\nair_gpa = 1\n[run]\nend_time = "3 kg"\n')
        done = self.call("check", "drop.toml")
        self.assertEqual(done.returncode, 2)
        for says in ("the catalogue has no such bearing", 'unknown key "ball_diamter"', 'unknown key "air_gpa"', "3 kg is a mass"):
            self.assertIn(says, done.stderr)
        self.assertEqual(done.stderr.count("error: "), 4, done.stderr)


class NamesOfFiles(ProgramTest):
    def test_where_nobody_may_write_is_input(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"))
        self.write("study.toml", 'case = "reference.toml"\n[design]\nkind = "grid"\n[vary]\ncontact.friction_coefficient = [0.05, 0.1]\n')
        (self.folder / "locked").mkdir()
        for path in (self.folder, *self.folder.rglob("*")):
            path.chmod(0o555 if path.is_dir() else 0o444)
        self.addCleanup(self.folder.chmod, 0o755)
        brief = settings(run__end_time="1 ms")
        commands = [["run", "reference.toml", "-o", "locked/out", *brief], ["modes", "reference.toml", "--shapes", "locked/m.h5"], ["critical-speeds", "reference.toml", "--diagram", "locked/c.svg"],
                    ["report", "out", "-o", "locked/r.html"], ["preload", "reference.toml", "-o", "locked/p"], ["study", "study.toml", "-o", "locked/s", *brief], ["new", "locked/case"], ["rerun", "out/results.h5", "-o", "locked/again"]]
        if HAS_MESH_ROOM:
            commands += [["mesh", "reference.toml", "-o", "locked/m.msh"], ["mesh", "reference.toml", "-o", "locked/deep/m.msh"]]
        user = {"user": 65534, "group": 65534} if os.geteuid() == 0 else {}
        for command in commands:
            with self.subTest(command[0]):
                try:
                    done = subprocess.run([PROGRAM, *command], cwd=self.folder, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL, **user)
                except PermissionError:
                    self.skipTest("the program is where only its owner may run it")
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertRegex(done.stderr, "Permission denied|cannot be (made|written)")
        self.assertEqual(list((self.folder / "locked").iterdir()), [])

    def test_a_name_with_a_line_break_is_refused(self):
        done = self.call("run", "reference.toml", "-o", "new\nline")
        self.assertEqual(done.returncode, 2)
        self.assertIn("control character, such as a line break", done.stderr)

    def test_names_that_are_too_long_are_input(self):
        long = "m" * 300
        commands = [["modes", "reference.toml", "--shapes", long + ".h5"]]
        if HAS_MESH_ROOM:
            commands.append(["mesh", "reference.toml", "-o", long + ".msh"])
        for command in commands:
            done = self.call(*command)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, "cannot be written|File name too long")

    def test_what_a_command_reads_is_not_written_over(self):
        self.succeed("run", "reference.toml", "-o", "out", *settings(run__end_time="1 ms"))
        summary = (self.folder / "out/summary.json").read_text()
        case = (self.folder / "reference.toml").read_text()
        for command in (["compare", "out", "-o", "out/summary.json", "--force"], ["calibrate", "reference.toml", "-o", "./reference.toml", "--force"]):
            done = self.call(*command)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("is what the command reads; it is not replaced", done.stderr)
        self.assertEqual((self.folder / "out/summary.json").read_text(), summary)
        self.assertEqual((self.folder / "reference.toml").read_text(), case)

    @unittest.skipUnless(HAS_MESH_ROOM, "finite elements are not built")
    def test_a_mesh_may_have_the_longest_name(self):
        name = "m" * 251 + ".msh"
        self.succeed("mesh", "reference.toml", "--bearing", "TB1", "-o", name)
        self.assertTrue((self.folder / name).is_file())


if __name__ == "__main__":
    unittest.main()
