"""`check` and the keys' own sentences say which convention a value has: radius or diameter, row or pair."""

import sys
import unittest

sys.path.insert(0, __file__.rpartition("/")[0])
from program import ProgramTest, settings  # noqa: E402


class Conventions(ProgramTest):
    def words(self, *options):
        return " ".join(self.succeed("check", "reference.toml", *options).stdout.split())

    def test_a_deep_groove_bearing_has_radial_and_diametral_clearance(self):
        said = self.words(*settings(bearings__TB1__radial_clearance="19 um", bearings__TB1__housing_fit="7.5 um", bearings__TB1__air_gap="200 um"))
        self.assertIn("TB1: node 2 at x = 45 mm; journal 69.6 mm in a bore of 70 mm, the shaft there has 69.5 mm; air gap 200 um by radius (400 um by diameter), radial clearance 19 um (catalogue's radial internal clearance, diametral: 38 um), "
                      "housing fit 7.5 um of interference by radius (15 um by diameter), C0 31 kN", said)

    def test_a_pair_has_a_preload_and_a_rating_of_one_and_of_both(self):
        said = self.words()
        self.assertIn("air gap 250 um by radius (500 um by diameter), preload 290 N on each row (catalogues call this the pair's preload),", said)
        self.assertIn("C0 62 kN of all 2 rows (31 kN of one, as the catalogue has one bearing)", said)
        tandem = self.words(*settings(bearings__TB2__arrangement="tandem"))
        self.assertIn("preload 290 N on each row, housing fit", tandem)

    def test_the_keys_say_it_too(self):
        said = " ".join(self.succeed("defaults").stdout.replace("#", " ").split())
        for words in ("half of a catalogue's radial internal clearance", "half of what fits are given by, the diameter", "which is the preload that catalogues give for a pair",
                      "Static load rating of all rows together; for a pair twice the catalogue value of a single"):
            self.assertIn(words, said)


if __name__ == "__main__":
    unittest.main()
