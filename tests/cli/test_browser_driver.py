"""The browser's driver that ends before it listens is started again, and what it said is told."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from browser import started_driver  # noqa: E402

LISTENS = "echo 'ChromeDriver was started successfully on port 4711.'; exec sleep 60"


class StartedDriver(unittest.TestCase):
    def test_is_the_first_that_listens(self):
        with tempfile.TemporaryDirectory() as folder:
            driver, port = started_driver(("sh", "-c", f'if [ -e "{folder}/tried" ]; then {LISTENS}; fi; touch "{folder}/tried"; exit 3'))
            self.addCleanup(driver.stdout.close)
            self.addCleanup(driver.wait)
            self.addCleanup(driver.kill)
            self.assertEqual(port, "4711")
            self.assertIsNone(driver.poll())
            self.assertTrue(pathlib.Path(folder, "tried").exists())

    def test_is_given_up_with_all_that_was_said(self):
        with self.assertRaises(AssertionError) as given_up:
            started_driver(("sh", "-c", "echo no display; exit 3"), trials=2)
        self.assertEqual(str(given_up.exception).count("no display\nended with exit code 3\n"), 2)
        self.assertIn("2 times", str(given_up.exception))


if __name__ == "__main__":
    unittest.main()
