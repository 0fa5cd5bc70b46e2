"""`rotordrop mesh`: files, faults, and what a program without the mesh room says.

ROTORDROP_PROGRAM is the program under test. What needs the room is skipped where its module is not beside the program.
"""

import os
import re
import shutil
import stat
import sys
import unittest
import unittest.mock

sys.path.insert(0, __file__.rpartition("/")[0])
from program import HAS_MESH_ROOM, IS_SANITIZED, PARAMS, SOURCE, ProgramTest, content_of  # noqa: E402

sys.path.insert(0, str(SOURCE / "docs"))


class FaultyCases(ProgramTest):
    """Faults of the input are found before the room is needed."""

    def fault(self, *arguments):
        before = content_of(self.folder)
        done = self.call("mesh", *arguments)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(content_of(self.folder), before)
        return " ".join(done.stderr.split())

    def test_a_bearing_that_does_not_exist_is_named_with_the_right_one(self):
        self.assertIn('Did you mean "TB2"?', self.fault("reference.toml", "-o", "m.msh", "--bearing", "TBB2"))

    def test_a_shoulder_below_the_grooves_bottom_is_explained(self):
        case = self.case('[bearings.TB1]\ninner_shoulder_diameter = "78 mm"\n')
        message = self.fault(case, "-o", "m.msh")
        self.assertIn("bearings.TB1 cannot be meshed", message)
        self.assertIn("shoulder diameter of 78 mm leaves no groove, whose bottom is at 78.094 mm", message)
        self.assertIn("inner_shoulder_diameter", message)
        self.assertIn("drop.toml:4:", message)

    def test_a_shoulder_that_is_not_given_apart_is_blamed_on_the_ring_s_diameters(self):
        case = self.case('[bearings.TB2]\ninner_ring_diameters = ["70 mm", "75 mm"]\n')
        message = self.fault(case, "-o", "m.msh")
        self.assertIn("drop.toml:4:", message)
        self.assertIn("bearings.TB2 cannot be meshed: the inner ring's shoulder diameter of 75 mm", message)

    def test_faults_of_all_bearings_are_shown_at_once(self):
        case = self.case('[bearings.TB1]\ninner_shoulder_diameter = "78 mm"\n[bearings.TB2]\nwidth = "10 mm"\n')
        message = self.fault(case, "-o", "m.msh")
        self.assertIn("bearings.TB1 cannot be meshed", message)
        self.assertIn("bearings.TB2 cannot be meshed", message)

    def test_the_output_is_a_msh_file(self):
        self.assertIn("must end in .msh", self.fault("reference.toml", "-o", "m.vtu"))

    def test_only_known_formats_are_taken(self):
        self.assertIn("--format", self.fault("reference.toml", "-o", "m.msh", "--format", "3"))

    def test_sizes_must_fit_each_other(self):
        self.assertIn("surface_cell is larger", self.fault(self.case('[thermal.fe]\nsurface_cell = "3 mm"\n'), "-o", "m.msh"))

    def test_an_own_mesh_must_be_there(self):
        case = self.case('[thermal.fe]\nmesh = "mine-NAME.msh"\n')
        message = self.fault(case, "-o", "m.msh")
        self.assertIn("drop.toml:4:", message)
        self.assertIn("mine-TB1.msh", message)

    def test_a_case_without_touchdown_bearings_has_nothing_to_mesh(self):
        text = (self.folder / "reference.toml").read_text()
        text = re.sub(r"\[bearings\].*?(?=\[materials\])", '[bearings.L]\ntype = "linear"\nnode = 2\nstiffness = [[1e8, 0], [0, 1e8]]\n', text, flags=re.DOTALL)
        self.assertIn("nothing to mesh", self.fault(self.write("linear.toml", text), "-o", "m.msh"))


@unittest.skipIf(HAS_MESH_ROOM, "built with the mesh room")
class WithoutTheRoom(ProgramTest):
    def test_the_message_says_how_to_get_it(self):
        done = self.call("mesh", "reference.toml", "-o", "m.msh")
        self.assertEqual(done.returncode, 2)
        self.assertIn("built without the mesh module", done.stderr)
        self.assertIn("install-dependencies", done.stderr)
        self.assertEqual(list(self.folder.glob("*.msh")), [])


@unittest.skipUnless(HAS_MESH_ROOM, "built without the mesh module")
class WithTheRoom(ProgramTest):
    def names(self, file):
        return set(re.findall(r'^[12] \d+ "(.*)"$', (self.folder / file).read_text(), re.MULTILINE))

    def test_every_touchdown_bearing_gets_a_file(self):
        done = self.succeed("mesh", "reference.toml", "-o", "m.msh")
        self.assertEqual(sorted(p.name for p in self.folder.glob("*.msh")), ["m-TB1.msh", "m-TB2.msh"])
        for words in ("TB1: ", "TB2: ", "inner_ring", "thinnest cell", "scaled Jacobian"):
            self.assertIn(words, done.stdout)
        sides = {f"{b}.{s}" for b in ("inner_ring", "outer_ring", "housing") for s in ("inner", "outer", "left", "right")}
        row = {f"{ring}.{s}_{{}}" for ring in ("inner_ring", "outer_ring") for s in ("strip", "raceway")}
        bodies = {"inner_ring", "outer_ring", "housing"}
        self.assertEqual(self.names("m-TB1.msh"), bodies | sides | {name.format(1) for name in row})
        self.assertEqual(self.names("m-TB2.msh"), bodies | sides | {name.format(k) for name in row for k in (1, 2)})

    def test_one_bearing_gets_the_file_itself(self):
        self.succeed("mesh", "reference.toml", "-o", "deep/m.msh", "--bearing", "TB2", "--quiet")
        self.assertEqual([p.name for p in (self.folder / "deep").iterdir()], ["m.msh"])

    def test_the_default_place_is_the_case_s_folder_of_results(self):
        self.succeed("mesh", "reference.toml")
        self.assertTrue((self.folder / "out/reference/mesh-TB1.msh").is_file())

    def test_files_are_not_replaced_unasked(self):
        self.succeed("mesh", "reference.toml", "-o", "m.msh", "--bearing", "TB1")
        before = content_of(self.folder)
        done = self.call("mesh", "reference.toml", "-o", "m.msh", "--bearing", "TB1", "--set", "thermal.fe.refinement=2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--force", done.stderr)
        self.assertEqual(content_of(self.folder), before)
        self.succeed("mesh", "reference.toml", "-o", "m.msh", "--bearing", "TB1", "--set", "thermal.fe.refinement=2", "--force")
        self.assertNotEqual(content_of(self.folder), before)

    def test_the_same_case_gives_the_same_bytes(self):
        self.succeed("mesh", "reference.toml", "-o", "a.msh")
        self.succeed("mesh", "reference.toml", "-o", "b.msh", "--bearing", "TB2")
        self.assertEqual((self.folder / "a-TB2.msh").read_bytes(), (self.folder / "b.msh").read_bytes())

    def test_both_formats_hold_the_same_mesh(self):
        from plot_mesh import read_msh
        meshes = []
        for version in ("4.1", "2.2"):
            self.succeed("mesh", "reference.toml", "-o", f"{version}.msh", "--bearing", "TB1", "--format", version)
            self.assertTrue((self.folder / f"{version}.msh").read_text().startswith(f"$MeshFormat\n{version} "))
            vertices, cells, edges = read_msh(self.folder / f"{version}.msh")
            meshes.append([sorted((group, [vertices[n] for n in nodes]) for group, nodes in part) for part in (cells, edges)])
        self.assertEqual(*meshes)
        self.assertGreater(len(meshes[0][0]), 300)

    def test_a_mesh_that_was_written_is_taken_as_ones_own(self):
        first = self.succeed("mesh", "reference.toml", "-o", "mine.msh").stdout
        case = self.case('[thermal.fe]\nmesh = "mine-NAME.msh"\n')
        again = self.succeed("mesh", case, "-o", "again.msh").stdout
        self.assertEqual([line for line in first.splitlines()[1:] if "written" not in line],
                         [line for line in again.splitlines()[1:] if "written" not in line])

    def test_an_own_mesh_is_found_beside_the_case_and_in_its_resolved_parameters(self):
        (self.folder / "sub").mkdir()
        shutil.copy(SOURCE / "meshes/6014.geo", self.folder / "sub")
        self.write("sub/drop.toml", 'base = "../reference.toml"\n[thermal.fe]\nmesh = "6014.geo"\n')
        self.succeed("mesh", "sub/drop.toml", "-o", "m.msh", "--bearing", "TB1")
        self.succeed("run", "sub/drop.toml", "-o", "out", "--set", "run.end_time=1 ms", "--quiet")
        self.succeed("mesh", "out/parameters.toml", "-o", "n.msh", "--bearing", "TB1")
        self.assertEqual((self.folder / "m.msh").read_bytes(), (self.folder / "n.msh").read_bytes())

    def test_an_own_mesh_that_does_not_fit_is_refused(self):
        self.succeed("mesh", "reference.toml", "-o", "mine.msh", "--bearing", "TB1", "--format", "2.2")
        mine = self.folder / "mine.msh"
        good = mine.read_text()
        case = self.case('[thermal.fe]\nmesh = "mine.msh"\n')

        def refusal(text, *options):
            mine.write_text(text)
            done = self.call("mesh", case, "-o", "m.msh", "--bearing", "TB1", *options)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn("mine.msh", done.stderr)
            return " ".join(done.stderr.split())

        self.assertIn('"inner_ring.bore" is not part of an outline', refusal(good.replace('"inner_ring.inner"', '"inner_ring.bore"')))
        self.assertIn('there is no body "housing"', refusal(good.replace('"housing"', '"hosing"')))
        self.assertIn('no body "shaft"', refusal(good, "--set", "thermal.fe.shaft=bearing"))
        # A quadrilateral becomes a triangle: type 3 with four vertices, type 2 with three.
        self.assertIn("a triangle", refusal(re.sub(r"^(\d+) 3 2 (\d+ \d+) (\d+ \d+ \d+) \d+$", r"\1 2 2 \2 \3", good, count=1, flags=re.MULTILINE)))
        n_elements = int(re.search(r"\$Elements\n(\d+)\n", good)[1])
        shorter = re.sub(r"^\d+ 1 2 .*\n", "", good, count=1, flags=re.MULTILINE).replace(f"$Elements\n{n_elements}\n", f"$Elements\n{n_elements - 1}\n")
        self.assertIn("1 edges of outlines are in no group", refusal(shorter))
        self.assertIn("could not read", refusal("This is no mesh.\n"))
        # A pair's mesh has a second row.
        self.succeed("mesh", "reference.toml", "-o", "pair.msh", "--bearing", "TB2")
        self.assertIn("strip_2", refusal((self.folder / "pair.msh").read_text()))

    def test_an_own_mesh_on_which_gmsh_itself_fails_is_refused(self):
        crashes = "gmsh crashes on this file"
        wants = crashes if IS_SANITIZED else "gmsh wants far more memory"  # sanitizers end a process that asks for so much
        for name, why in (("found-crash-2.2", crashes), ("found-crash-4.1", crashes), ("found-memory-4.1", wants)):
            case = self.case(f'[thermal.fe]\nmesh = "{SOURCE}/tests/fuzz/seeds/mesh/{name}.msh"\n')
            done = self.call("mesh", case, "-o", "m.msh", "--bearing", "TB1")
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn(f"{name}.msh: {why}", " ".join(done.stderr.split()))
            self.assertFalse((self.folder / "m.msh").exists())

    def test_an_own_mesh_may_be_binary(self):
        case = self.case(f'[thermal.fe]\nmesh = "{SOURCE}/tests/fuzz/seeds/mesh/binary-4.1.msh"\n')
        self.succeed("mesh", case, "-o", "m.msh", "--bearing", "TB1")
        self.assertEqual((self.folder / "m.msh").read_bytes(), (SOURCE / "tests/fuzz/seeds/mesh/text-4.1.msh").read_bytes())

    def test_the_shaft_is_meshed_on_request(self):
        self.succeed("mesh", "reference.toml", "-o", "m.msh", "--bearing", "TB1", "--set", "thermal.fe.shaft=bearing")
        self.assertIn("shaft.outer", self.names("m.msh"))

    def test_where_the_module_is_missing_the_message_says_how_to_get_it(self):
        with unittest.mock.patch.dict(os.environ, {"ROTORDROP_MODULES": str(self.folder)}):
            done = self.call("mesh", "reference.toml", "-o", "m.msh")
        self.assertEqual(done.returncode, 2)
        self.assertIn("built without the mesh module", done.stderr)
        self.assertIn("install-dependencies", done.stderr)

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_a_folder_without_permission_is_named(self):
        locked = self.folder / "locked"
        locked.mkdir()
        locked.chmod(stat.S_IRUSR | stat.S_IXUSR)
        self.addCleanup(locked.chmod, stat.S_IRWXU)
        done = self.call("mesh", "reference.toml", "-o", "locked/m.msh")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("locked", done.stderr)

    def test_a_place_that_cannot_be_written_is_named(self):
        self.write("file", "")
        done = self.call("mesh", "reference.toml", "-o", "file/m.msh")
        self.assertEqual(done.returncode, 2)
        self.assertIn("file", done.stderr)


if __name__ == "__main__":
    unittest.main()
