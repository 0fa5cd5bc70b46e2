"""The table of docs/theory/model.md that says where each equation of the paper is: files and functions exist, and name the equation."""

import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LAST = 28  #: equations in the paper


def faults_of(document, source=SOURCE):
    """What is wrong with the table of a document, one line each."""
    table = document.split("## 15 Where each equation is")[1]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line.startswith("| (")]
    faults = [f"({n}) is not in the table" for n in range(1, LAST + 1) if not any(row[0] == f"({n})" for row in rows)]
    for equation, _, file, function in rows:
        if not file:
            continue
        path = source / file.strip("`")
        if not path.is_file():
            faults.append(f"{equation}: {file} does not exist")
            continue
        text = path.read_text(encoding="utf-8")
        if not re.search(rf"\b{function.strip('`')}\b", text):
            faults.append(f"{equation}: {file} has no {function}")
        if not re.search(rf"[Ee]qs?\. (\(\d+\)(, | and ))*{re.escape(equation)}", text):
            faults.append(f"{equation}: {file} does not name it")
    return faults


class Equations(unittest.TestCase):
    def setUp(self):
        self.document = (SOURCE / "docs/theory/model.md").read_text(encoding="utf-8")

    def test_each_is_where_the_table_says(self):
        self.assertEqual(faults_of(self.document), [])

    def test_a_name_that_changed_is_found(self):
        for old, new, fault in (("`press_ball`", "`squeeze_ball`", "(6): `src/bearing/row/ball_terms.h` has no `squeeze_ball`"),
                                ("`src/laws/heat/heat_flow.h`", "`src/laws/heat_flow.h`", "(16): `src/laws/heat_flow.h` does not exist"),
                                ("| (14) |", "| (15) |", "(14) is not in the table"),
                                ("| (23) | spin moment of a ball | `src/laws/bearing_friction.h` | `spin_moment`", "| (23) | spin moment of a ball | `src/laws/ball_kinematics.h` | `spin_speeds`",
                                 "(23): `src/laws/ball_kinematics.h` does not name it")):
            with self.subTest(new=new):
                self.assertIn(old, self.document)
                self.assertEqual(faults_of(self.document.replace(old, new)), [fault])


if __name__ == "__main__":
    unittest.main()
