"""Open the traceability page in headless Chromium and look at what a reviewer would stumble over.

Run it from the repository's folder: ``python benchmarks/trace_page.py [PAGE] [--pictures DIR]``. Without a
page it writes one of the project as it is. It needs ``chromium`` and ``chromedriver``, which no test
needs: what tests can see without a browser, they see. It ends with 1 if something is wrong.
"""

from __future__ import annotations

import argparse
import base64
import json
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

WIDTHS = (1400, 400)
PORT = 9517
ARGUMENTS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars")
ARGUMENTS += ("--disable-background-networking", "--disable-component-update", "--disable-sync")

WIDER_THAN_THE_SCREEN = "return document.documentElement.scrollWidth - window.innerWidth"
FILTER = """
const search = document.getElementById("search"), gaps = document.getElementById("gaps-only");
const rows = () => document.querySelectorAll("[data-row]:not([hidden])").length;
const all = rows();
search.value = "there is no such word"; gaps.dispatchEvent(new Event("change"));
const none = rows();
search.value = ""; gaps.dispatchEvent(new Event("change"));
return [all > 0, none, rows() === all];
"""
KEYBOARD = """
const press = (key) => document.activeElement.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true}));
const table = document.querySelector("table.matrix");
table.querySelector("td").focus();
press("ArrowDown"); press("End"); press("ArrowUp"); press("Home");
const cell = document.activeElement;
return [cell.tagName, cell.cellIndex, cell.parentElement.rowIndex, document.querySelector(".told").textContent !== ""];
"""
STICKY = """
const box = document.querySelector("#matrix-system-architecture .scroll");
box.scrollIntoView(); box.scrollTop = 300; box.scrollLeft = 300;
const edge = box.getBoundingClientRect();
const head = box.querySelector("thead th:nth-child(2)").getBoundingClientRect();
const row = box.querySelector("tbody th").getBoundingClientRect();
return [Math.abs(head.top - edge.top) < 3, Math.abs(row.left - edge.left) < 3];
"""
CONTRAST = """
const channel = (value) => { const c = value / 255; return c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };
const parts = (colour) => colour.match(/[\\d.]+/g).map(Number);
const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
const below = (element) => {
  for (let one = element; one; one = one.parentElement) {
    const colour = parts(getComputedStyle(one).backgroundColor);
    if (colour.length < 4 || colour[3] > 0) return colour;
  }
  return [255, 255, 255];
};
let least = 21;
for (const element of document.querySelectorAll("h1, p, a, th, td, summary, dt, dd, span, label, text")) {
  if (!element.textContent.trim() || element.closest("svg")) continue;
  const [a, b] = [light(parts(getComputedStyle(element).color)), light(below(element))].sort((x, y) => y - x);
  least = Math.min(least, (a + 0.05) / (b + 0.05));
}
return Math.round(least * 100) / 100;
"""


def main() -> int:
    """Check the page at every width, light and dark; write a table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", nargs="?", type=Path, help="the page (default: one of the project as it is)")
    parser.add_argument("--pictures", type=Path, metavar="DIR", help="keep a picture of the top of each view")
    arguments = parser.parse_args()
    missing = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    if missing:
        sys.stderr.write(f"{missing[0]} is not installed\n")
        return 2
    with tempfile.TemporaryDirectory() as folder:
        page = arguments.page or Path(folder) / "trace.html"
        if arguments.page is None:
            subprocess.run([sys.executable, "-m", "rgss.cli.main", "trace", "-o", str(page)], check=True)  # noqa: S603
        with _browser(folder) as browser:
            wrong = _look(browser, page.resolve().as_uri(), arguments.pictures)
    return 1 if wrong else 0


def _look(browser: Browser, address: str, pictures: Path | None) -> int:
    out = sys.stdout
    out.write("| width | scheme | load (s) | wider by (px) | filter | arrow keys | sticky | least contrast | log |\n")
    out.write("|---" * 9 + "|\n")
    wrong = 0
    for width in WIDTHS:
        for scheme in ("light", "dark"):
            browser.emulate(width, scheme)
            begin = time.perf_counter()
            browser.open(address)
            seconds = time.perf_counter() - begin
            if pictures is not None:
                pictures.mkdir(parents=True, exist_ok=True)
                (pictures / f"trace-{width}-{scheme}.png").write_bytes(browser.picture())
            wider = browser.run(WIDER_THAN_THE_SCREEN)
            filtered = browser.run(FILTER) == [True, 0, True]
            moved = browser.run(KEYBOARD) == ["TD", 1, 1, True]
            sticky = browser.run(STICKY) == [True, True]
            contrast = browser.run(CONTRAST)
            log = browser.log()
            good = wider <= 0 and filtered and moved and sticky and contrast >= 4.5 and not log
            wrong += not good
            told = ["yes" if one else "NO" for one in (filtered, moved, sticky)]
            out.write(
                f"| {width} | {scheme} | {seconds:.2f} | {wider} | {' | '.join(told)} | {contrast} | {len(log)} |\n"
            )
            for line in log:
                sys.stderr.write(f"{line}\n")
    return wrong


class Browser:
    """A session of chromedriver."""

    def __init__(self, folder: str) -> None:
        options = {"binary": shutil.which("chromium"), "args": [*ARGUMENTS, f"--user-data-dir={folder}/profile"]}
        capabilities = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        self._session = ""
        session = self._call("POST", "session", {"capabilities": {"alwaysMatch": capabilities}})
        self._session = f"session/{session['sessionId']}/"

    def emulate(self, width: int, scheme: str) -> None:
        """Make the screen as wide as that, and the reader's scheme light or dark."""
        metrics = {"width": width, "height": 1200, "deviceScaleFactor": 1, "mobile": width < 600}
        self._command("Emulation.setDeviceMetricsOverride", metrics)
        self._command("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def open(self, address: str) -> None:
        """Open a page and wait until it is loaded."""
        self._call("POST", "url", {"url": address})

    def run(self, script: str) -> Any:
        """What a script in the page gives back."""
        return self._call("POST", "execute/sync", {"script": script, "args": []})

    def picture(self) -> bytes:
        """What is on the screen, as PNG."""
        return base64.b64decode(self._command("Page.captureScreenshot", {"format": "png"})["data"])

    def log(self) -> list[str]:
        """What the page complained about."""
        return [entry["message"] for entry in self._call("POST", "se/log", {"type": "browser"})]

    def close(self) -> None:
        """End the session."""
        self._call("DELETE", "", None)

    def _command(self, name: str, parameters: dict[str, Any]) -> Any:
        return self._call("POST", "goog/cdp/execute", {"cmd": name, "params": parameters})

    def _call(self, method: str, path: str, body: dict[str, Any] | None) -> Any:
        address = f"http://127.0.0.1:{PORT}/{self._session}{path}".rstrip("/")
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(address, method=method, data=data)  # noqa: S310 - this machine alone
        with urllib.request.urlopen(request, timeout=120) as answer:  # noqa: S310
            return json.load(answer)["value"]


@contextmanager
def _browser(folder: str) -> Iterator[Browser]:
    command = [shutil.which("chromedriver") or "", f"--port={PORT}"]
    driver = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # noqa: S603
    try:
        for attempt in range(50):
            try:
                browser = Browser(folder)
                break
            except OSError:
                if attempt == 49:
                    raise
                time.sleep(0.1)
        try:
            yield browser
        finally:
            browser.close()
    finally:
        driver.terminate()
        driver.wait()


if __name__ == "__main__":
    sys.exit(main())
