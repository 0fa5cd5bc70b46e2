"""count: a set of catalogue bearings has the mass, inertia, width and ratings of all."""

import re
import shutil
import sys
import tomllib
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import PARAMS, ProgramTest, settings  # noqa: E402


def quantity(text):
    """Number in SI of a catalogue's text."""
    value, unit = re.match(r"([0-9.e-]+) ?(.*)", str(text)).groups()
    return float(value) * {"mm": 1e-3, "kN": 1e3, "kg": 1, "kg m2": 1, "m": 1, "N": 1, "": 1}[unit]


class Sets(ProgramTest):
    def resolved(self, text, *options):
        case = self.case(text)
        self.succeed("run", case, "-o", "out", "--force", *settings(run__end_time="1 us"), *options)
        return tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]["TB2"]

    def test_a_pair_has_twice_of_one(self):
        one = tomllib.loads((PARAMS / "bearings/71914-25.toml").read_text())
        pair = self.resolved('[bearings.TB2]\ncatalogue = "71914-25"\ncount = 2\npreload = "290 N"\n')
        self.assertEqual(pair["rows"], 2)
        for key in ("width", "ring_mass", "ring_spin_inertia", "C0"):
            self.assertAlmostEqual(quantity(pair[key]), 2 * quantity(one[key]), delta=1e-12 * quantity(pair[key]), msg=key)
        self.assertAlmostEqual(quantity(pair["C"]), 2**0.7 * quantity(one["C"]), delta=1e-9 * quantity(pair["C"]), msg="ISO 281")
        for key in ("balls_per_row", "ball_diameter", "pitch_diameter", "inner_ring_diameters", "outer_ring_diameters"):
            self.assertEqual(pair[key], one[key], key)
        # The maker's pair that is in the catalogue, by other hands: mass and width are the same, C to its printed digits.
        other = tomllib.loads((PARAMS / "bearings/71914-25-pair-X.toml").read_text())
        for key, digits in (("ring_mass", 1e-9), ("width", 1e-9), ("C0", 1e-9), ("C", 1e-3)):
            self.assertAlmostEqual(quantity(pair[key]) / quantity(other[key]), 1, delta=digits, msg=key)

    def test_an_entry_may_lie_in_a_folder_of_the_catalogue(self):
        (self.folder / "bearings/own").mkdir(parents=True)
        shutil.copy(PARAMS / "bearings/71914-25.toml", self.folder / "bearings/own/one.toml")
        for name in ("own/one", "../bearings/own/one"):
            pair = self.resolved(f'[bearings.TB2]\ncatalogue = "{name}"\ncount = 2\npreload = "290 N"\n')
            self.assertEqual((pair["rows"], quantity(pair["width"])), (2, 32e-3), name)

    def test_what_the_case_gives_is_of_the_whole_set(self):
        pair = self.resolved('[bearings.TB2]\ncatalogue = "71914-25"\ncount = 2\nring_mass = "0.3 kg"\npreload = "290 N"\n')
        self.assertEqual(quantity(pair["ring_mass"]), 0.3)
        self.assertEqual(quantity(pair["width"]), 32e-3)

    def test_it_may_be_set_in_a_later_layer_and_is_made_once(self):
        self.write("middle.toml", 'base = "reference.toml"\n[bearings.TB2]\ncatalogue = "71914-25"\npreload = "290 N"\nrows = 2\n')
        self.write("drop.toml", 'base = "middle.toml"\n')
        self.succeed("run", "drop.toml", "-o", "out", *settings(run__end_time="1 us", bearings__TB2__count="2"))
        first = tomllib.loads((self.folder / "out/parameters.toml").read_text())["bearings"]["TB2"]
        self.assertEqual((first["rows"], quantity(first["width"])), (2, 32e-3))
        self.succeed("run", "out/parameters.toml", "-o", "again")
        again = tomllib.loads((self.folder / "again/parameters.toml").read_text())["bearings"]["TB2"]
        self.assertEqual(again, first)
        self.succeed("rerun", "out/results.h5", "-o", "rerun")

    def test_mistakes_are_found(self):
        for text, says in (('[bearings.TB2]\ncount = 2\n', "catalogue is not given"),
                           ('[bearings.TB2]\ncatalogue = "71914-25"\ncount = 2\nrows = 1\n', "count = 2 bearings have 2 rows"),
                           ('[bearings.TB2]\ncatalogue = "71914-25"\ncount = 0\n', "out of range")):
            done = self.call("check", self.case(text))
            self.assertEqual(done.returncode, 2, says)
            self.assertRegex(done.stderr, says)

    def test_rows_over_a_single_bearing_of_the_catalogue_warn(self):
        done = self.succeed("check", self.case('[bearings.TB2]\ncatalogue = "71914-25"\nrows = 2\npreload = "290 N"\n'))
        self.assertRegex(done.stderr, r"warning: .*rows = 2, but .*are those of one bearing")
        self.assertIn("count = 2", done.stderr)


if __name__ == "__main__":
    unittest.main()
