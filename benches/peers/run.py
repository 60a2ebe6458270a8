"""What users would otherwise pick, on the scenes of `benches/chart`: one row of peers.csv per tool, setting and scene.

    python3 -m venv cra && cra/bin/pip install -r benches/peers/requirements-cra.txt
    python3 -m venv lmgc90 && lmgc90/bin/pip install -r benches/peers/requirements-lmgc90.txt
    cra/bin/python benches/peers/run.py --lmgc90 lmgc90/bin/python --out peers.csv
    cargo bench --bench chart -- --out cases/chart --peers peers.csv

Times are CPU seconds of the process, imports and (HiGHS, compas_cra) the making of geometry left out; those of `voussoir`
are of its analysis alone, measured at the end of this run. A search for the load counts all its trials. All of it takes
half an hour of CPU, which `--jobs` spreads over several cores. The rows in
cases/chart/peers.csv were gathered in several runs, our own time once for every scene; of 61 voussoirs one setting is
missing in each of the two scenes.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

# One thread for everyone, and before numpy is loaded.
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

from arch import arch, scenes, semicircles

COLUMNS = ["chart", "scene", "family", "model", "intensity", "error", "seconds", "base_seconds", "time_ratio", "note"]
# Settings of every tool, named in its own module; listed here because not every interpreter can import them all.
TOOLS = {
    "HiGHS": ["dual simplex", "interior point"],
    "RBE": ["tension below 1e-2", "tension below 1e-3", "tension below 1e-4"],
    "CRA": ["d 1e-3, eps 1e-4", "d 1e-2, eps 1e-3"],
    "LMGC90": ["step 2 ms", "step 1 ms", "step 2 ms, moment as given"],
}


def base_seconds(names):
    """Our own analysis with one subblock a stone: its time by scene."""
    with tempfile.TemporaryDirectory() as place:
        chosen = [word for name in names for word in ("--scene", name)]
        words = ["cargo", "bench", "--bench", "chart", "--", "--out", place, "--model", "1 x 1", *chosen]
        subprocess.run(words, check=True, capture_output=True)
        rows = csv.DictReader((Path(place) / "chart.csv").read_text().splitlines())
        return {row["scene"]: float(row["seconds"]) for row in rows if row["model"] == "1 x 1"}


def solve(tool, setting, scene, limit):
    """Runs in an interpreter of its own."""
    if tool == "HiGHS":
        import highs

        return highs.solve(arch(scene), setting, limit)
    if tool == "LMGC90":
        import lmgc90

        return lmgc90.solve(scene, setting, limit)
    import cra

    return cra.solve(arch(scene), setting, limit)


def run(options, tool, setting, scene):
    interpreter = options.lmgc90 if tool == "LMGC90" else sys.executable
    asked = json.dumps([tool, setting, scene, options.limit])
    done = subprocess.run([interpreter, __file__, "--solve", asked], capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith('{"intensity"')]
    told = json.loads(lines[-1]) if lines else None
    print(scene, tool, setting, told or done.stderr, file=sys.stderr, flush=True)
    return told


def row(tool, setting, scene, told, base):
    low, high = scenes()[scene]["intensity"]
    found = told["intensity"]
    error = "" if found is None else max(abs(found - low), abs(found - high)) / high
    seconds = told["seconds"]
    return dict(
        zip(
            COLUMNS,
            ["collapse", scene, tool, f"{tool}, {setting}", "" if found is None else found, error]
            + [seconds, base, seconds / base, told["note"]],
        )
    )


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("--lmgc90", help="interpreter that has compas_lmgc90; this one has to have compas_cra and scipy")
    words.add_argument("--out", type=Path, help="CSV to write")
    words.add_argument("--limit", type=float, default=600.0, help="most CPU seconds of one search (%(default)s)")
    words.add_argument("--jobs", type=int, default=1, help="searches at a time, each in its own process (%(default)s)")
    words.add_argument("--tools", nargs="+", default=list(TOOLS), choices=list(TOOLS))
    words.add_argument("--scenes", nargs="+", default=semicircles(), choices=semicircles())
    words.add_argument("--solve", help=argparse.SUPPRESS)
    options = words.parse_args()
    if options.solve:
        print("\n" + json.dumps(solve(*json.loads(options.solve))), flush=True)
        return
    asked = [(tool, setting, scene) for scene, tool in product(options.scenes, options.tools) for setting in TOOLS[tool]]
    with ThreadPoolExecutor(options.jobs) as pool:
        answers = list(pool.map(lambda one: run(options, *one), asked))
    found = [(*one, told) for one, told in zip(asked, answers) if told is not None]
    base = base_seconds(options.scenes)
    with options.out.open("w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows(row(*measured, base[measured[2]]) for measured in found)


if __name__ == "__main__":
    main()
