"""Debian's chromium without a window, driven through chromium-driver by the WebDriver protocol (`./install-dependencies --tests`)."""

import contextlib
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

DRIVER, BROWSER = shutil.which("chromedriver"), shutil.which("chromium")


def started_driver(command=(DRIVER, "--port=0"), trials=3):
    """Starts the driver; its process and port. It has ended before it listened (seen once in some hundred runs, and never because of a page): then it is started again, `trials` times at most."""
    said = []
    for _ in range(trials):
        driver = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        for line in driver.stdout:
            said.append(line)
            if found := re.search(r"started successfully on port (\d+)", line):
                return driver, found[1]
        driver.stdout.close()
        said.append(f"ended with exit code {driver.wait()}\n")
    raise AssertionError(f"{command[0]} ended before it listened, {trials} times:\n" + "".join(said))


class Browser:
    """Chromium without a window, by WebDriver."""

    def __init__(self):
        self.driver, port = started_driver()
        self.folder = tempfile.TemporaryDirectory(prefix="rotordrop-browser-")
        self.url = f"http://127.0.0.1:{port}"
        # Root has no sandbox in a container; /dev/shm may be small there.
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--window-size=1366,900", f"--user-data-dir={self.folder.name}",
                     "--disable-background-networking", "--no-first-run"]
        wanted = {"browserName": "chrome", "goog:chromeOptions": {"binary": BROWSER, "args": arguments}, "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}
        try:
            answer = self.call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        except Exception:
            self.close()
            raise
        self.url += "/session/" + answer["sessionId"]
        self.call("POST", "/timeouts", {"script": 20000, "pageLoad": 60000})

    def call(self, method, path, body=None):
        request = urllib.request.Request(self.url + path, method=method, data=None if body is None else json.dumps(body).encode(), headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(json.load(error)["value"]["message"]) from None

    def open(self, path):
        self.call("POST", "/url", {"url": "about:blank"})  # the browser's own first page asks for much
        self.log("performance"), self.log("browser")
        self.call("POST", "/url", {"url": pathlib.Path(path).resolve().as_uri()})

    def run(self, script, *arguments):
        return self.call("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def log(self, kind):
        return self.call("POST", "/se/log", {"type": kind})

    def requests(self):
        """Addresses that the page has asked for since it was opened."""
        messages = (json.loads(entry["message"])["message"] for entry in self.log("performance"))
        asked = (m["params"] for m in messages if m["method"] == "Network.requestWillBeSent")
        return [m["request"]["url"] for m in asked if not m["documentURL"].startswith("chrome:")]

    def point(self, *actions):
        """Mouse: ("move", x, y), ("down",), ("up",) in the window."""
        steps = {"move": lambda x, y: {"type": "pointerMove", "duration": 0, "x": round(x), "y": round(y)}, "down": lambda: {"type": "pointerDown", "button": 0}, "up": lambda: {"type": "pointerUp", "button": 0}}
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [steps[name](*rest) for name, *rest in actions]}]})

    def close(self):
        with contextlib.suppress(Exception):
            if "/session/" in self.url:
                self.call("DELETE", "")
        self.driver.terminate()
        self.driver.wait()
        self.driver.stdout.close()
        for _ in range(20):  # its children may still be writing
            try:
                self.folder.cleanup()
                break
            except OSError:
                time.sleep(0.1)
