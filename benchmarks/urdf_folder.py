"""Try every URDF of some folders: a project round it, its check and one trial.

    python benchmarks/urdf_folder.py FOLDER... [--only REGEX] [--jobs 2] [--limit 300] [--fidelity kinematic] [--json F]

For each file that differs from those before it, `rgss init --robot`, `rgss check` and `rgss run 1` run in a scratch
folder as a user would run them. Where init refuses a URDF for want of masses or of torques, it is tried once more with
`--mass`, a guess by the arm's kind that is good enough to see whether the rest works. Printed are one line for each
file and how often each outcome occurred; nothing is fetched. Exit status 1 if a command ended with a traceback or ran
into the limit.
"""

from __future__ import annotations

import argparse
import collections
import hashlib
import json
import re
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

GUESSED_MASS_KG = 20
BROKEN = ("traceback", "limit")


def main() -> int:
    """Try the files and print the outcomes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--limit", type=float, default=300.0, help="seconds for one command")
    parser.add_argument("--fidelity", default="kinematic")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    files = [path for path in _different(options.folders) if re.search(options.only, str(path))]

    def tried(path: Path) -> dict[str, object]:
        found = _tried(path, limit_s=options.limit, fidelity=options.fidelity)
        sys.stdout.write(f"{found['outcome']:10s} {found['seconds']:6.1f} s  {path}  {found['message']}\n")
        sys.stdout.flush()
        return found

    with ThreadPoolExecutor(options.jobs) as pool:
        found = list(pool.map(tried, files))
    counts = collections.Counter(str(one["outcome"]) for one in found)
    sys.stdout.write("\n" + "".join(f"{count:4d}  {name}\n" for name, count in counts.most_common()))
    if options.json is not None:
        options.json.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    return int(any(counts[name] for name in BROKEN))


def _different(folders: list[Path]) -> list[Path]:
    """The URDFs of some folders that have a movable joint, without copies of the same content."""
    kept: dict[str, Path] = {}
    for folder in folders:
        for path in [folder] if folder.is_file() else sorted(folder.rglob("*.urdf")):
            content = path.read_bytes()
            if re.search(rb'type\s*=\s*["\'](revolute|continuous|prismatic)', content):
                kept.setdefault(hashlib.sha256(content).hexdigest(), path)
    return list(kept.values())


def _tried(path: Path, *, limit_s: float, fidelity: str) -> dict[str, object]:
    begun = time.monotonic()
    found: dict[str, object] = {"file": str(path), "joints": _joints(path), "mass": "stated"}
    with tempfile.TemporaryDirectory() as scratch:
        folder = str(Path(scratch) / "project")
        begin = ("init", "--robot", str(path), folder)
        status, text = _ran(*begin, limit_s=limit_s)
        if status == 2 and "--mass" in text:
            found["mass"] = "guessed"
            status, text = _ran(*begin, "--mass", f"{GUESSED_MASS_KG} kg", limit_s=limit_s)
        found["init_s"] = round(time.monotonic() - begun, 1)
        outcome = "works"
        if status != 0:
            outcome = "refused"
        else:
            checked, said = _ran("check", "--project", folder, limit_s=limit_s)
            found["check"] = said.splitlines() if checked else []
            status, text = _ran("run", "1", "--fidelity", fidelity, "--project", folder, limit_s=limit_s)
            if checked not in (0, 1):
                outcome, text = "check", said
            elif checked == 1:
                outcome = "findings"
            if status != 0:
                outcome = "fails"
    if "Traceback" in text:
        outcome = "traceback"
    elif status is None:
        outcome = "limit"
    message = "" if outcome in ("works", "findings") else " ".join(text.replace(str(path), path.name).split())[-600:]
    return {**found, "outcome": outcome, "seconds": time.monotonic() - begun, "message": message}


def _ran(*arguments: str, limit_s: float) -> tuple[int | None, str]:
    """Exit status and output; no status at the limit."""
    command = (sys.executable, "-m", "rgss", *arguments)
    try:
        ended = subprocess.run(command, capture_output=True, text=True, timeout=limit_s, check=False)  # noqa: S603
    except subprocess.TimeoutExpired:
        return None, f"{arguments[0]} took longer than {limit_s:g} s"
    return ended.returncode, (ended.stderr or ended.stdout) if ended.returncode else ""


def _joints(path: Path) -> int:
    """Number of movable joints in a URDF; 0 where it cannot be read."""
    try:
        root = ET.fromstring(path.read_bytes())  # noqa: S314 - counted, not trusted
    except ET.ParseError:
        return 0
    return sum(joint.get("type") in ("revolute", "continuous", "prismatic") for joint in root.findall("joint"))


if __name__ == "__main__":
    sys.exit(main())
