"""Kills a run with SIGKILL at random moments, resumes it, and compares its result.json.

    python benchmarks/resume.py [--study three_sat] [--kills 20]

One undisturbed run, then for each kill a fresh run that is killed at a moment drawn evenly from the
undisturbed run's time, and resumed to its end. Two results are the same if every byte of
result.json is, but for `started` and `wall_s` in `provenance`. POSIX only.
"""

from __future__ import annotations

import argparse
import json
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--study", default="three_sat")
    parser.add_argument("--kills", type=int, default=20)
    options = parser.parse_args()
    command = [sys.executable, "-m", "formation_opt", options.study, "--quiet", "--format", "none"]
    source = random.Random(1)
    with tempfile.TemporaryDirectory() as folder:
        whole = Path(folder) / "whole"
        began = time.monotonic()
        subprocess.run([*command, "--out", str(whole)], check=True)
        duration = time.monotonic() - began
        print(f"undisturbed: {duration:.2f} s")
        same = 0
        for number in range(1, options.kills + 1):
            out = Path(folder) / str(number)
            moment = source.uniform(0.0, duration)
            process = subprocess.Popen([*command, "--out", str(out)])
            time.sleep(moment)
            process.send_signal(signal.SIGKILL)
            process.wait()
            journal = out / "checkpoint.jsonl"
            kept = len(journal.read_bytes().splitlines()) if journal.exists() else 0
            subprocess.run([*command, "--out", str(out), "--resume"], check=True)
            equal = result(out) == result(whole)
            same += equal
            print(
                f"{number:3}: killed after {moment:5.2f} s with {kept:3} steps kept"
                f"{'' if process.returncode < 0 else ' (it had ended)'}: "
                f"{'identical' if equal else 'DIFFERENT'}",
                flush=True,
            )
    print(f"{same} of {options.kills} identical")


def result(folder: Path) -> Any:
    text = (folder / "result.json").read_text(encoding="utf-8")
    provenance = json.loads(text)["provenance"]
    for key in ("started", "wall_s"):
        text = text.replace(f'"{key}": {json.dumps(provenance[key])}', "")
    return text


if __name__ == "__main__":
    main()
