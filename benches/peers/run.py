"""What users would otherwise pick, on the scenes of `benches/chart`: one row of peers.csv per tool, setting and scene.

    python3 -m venv cra && cra/bin/pip install -r benches/peers/requirements-cra.txt
    python3 -m venv lmgc90 && lmgc90/bin/pip install -r benches/peers/requirements-lmgc90.txt
    cargo build --release --locked
    cra/bin/python benches/peers/run.py --lmgc90 lmgc90/bin/python --out peers.csv
    cargo bench --bench chart -- --out cases/chart --peers peers.csv

Times are CPU seconds of the process, imports and (HiGHS, compas_cra) the making of geometry left out; those of whole processes
leave nothing out. The chart sets them beside its own. A search for the load counts all its trials.
All of it takes half an hour of CPU, which `--jobs` spreads over several cores; HiGHS and the whole processes, `--tools HiGHS "HiGHS,
whole process" "whole process"`, take two minutes, and `--keep FILE` puts the rows of other tools before them. The rows in
cases/chart/peers.csv were gathered in several runs; of 61 voussoirs one setting of the slow tools is missing in each of the
two scenes.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from itertools import product
from pathlib import Path

# One thread for everyone, and before numpy is loaded.
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

from arch import ROOT, arch, scenes, semicircles, small

COLUMNS = (
    "chart,scene,family,model,intensity,error,error_worst_voussoir,error_peak,error_of_reference,estimate,"
    "met,seconds,least_seconds,greatest_seconds,repetitions,base_seconds,time_ratio,note"
).split(",")
# Settings of every tool, named in its own module; listed here because not every interpreter can import them all.
FAST = ["HiGHS", "HiGHS, whole process", "whole process"]
TOOLS = {
    "HiGHS": ["dual simplex", "interior point"],
    "HiGHS, whole process": ["dual simplex", "interior point"],
    "whole process": ["voussoir solve"],
    "RBE": ["tension below 1e-2", "tension below 1e-3", "tension below 1e-4"],
    "CRA": ["d 1e-3, eps 1e-4", "d 1e-2, eps 1e-3"],
    "LMGC90": ["step 2 ms", "step 1 ms", "step 2 ms, moment as given"],
}


def solve(tool, setting, scene, limit, program):
    """Runs in an interpreter of its own."""
    if tool in ("HiGHS, whole process", "whole process"):
        import whole

        return whole.ours(scene, program) if tool == "whole process" else whole.highs(scene, setting)
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
    asked = json.dumps([tool, setting, scene, options.limit, str(options.voussoir)])
    done = subprocess.run([interpreter, __file__, "--solve", asked], capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith('{"intensity"')]
    told = json.loads(lines[-1]) if lines else None
    print(scene, tool, setting, told or done.stderr, file=sys.stderr, flush=True)
    return told


def row(tool, setting, scene, told):
    low, high = scenes()[scene]["intensity"]
    found = told["intensity"]
    model = {"HiGHS, whole process": f"HiGHS, {setting}, whole process", "whole process": setting}.get(tool, f"{tool}, {setting}")
    known = {"chart": "collapse", "scene": scene, "family": tool, "model": model, **told}
    if found is not None:
        known["error"] = max(abs(found - low), abs(found - high)) / high
    return known


def kept(options):
    """Rows of another table, of the tools that are not run."""
    if options.keep is None:
        return []
    return [row for row in csv.DictReader(options.keep.read_text().splitlines()) if row["family"] not in options.tools]


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("--lmgc90", help="interpreter that has compas_lmgc90; this one has to have compas_cra and scipy")
    words.add_argument("--out", type=Path, help="CSV to write")
    words.add_argument("--limit", type=float, default=600.0, help="most CPU seconds of one search (%(default)s)")
    words.add_argument("--jobs", type=int, default=1, help="searches at a time, each in its own process (%(default)s)")
    words.add_argument("--tools", nargs="+", default=list(TOOLS), choices=list(TOOLS))
    words.add_argument("--scenes", nargs="+", default=semicircles(), choices=semicircles())
    words.add_argument("--voussoir", type=Path, default=ROOT / "target/release/voussoir", help="our program (%(default)s)")
    words.add_argument("--keep", type=Path, help="CSV whose rows of other tools are written as well")
    words.add_argument("--solve", help=argparse.SUPPRESS)
    options = words.parse_args()
    if options.solve:
        print("\n" + json.dumps(solve(*json.loads(options.solve))), flush=True)
        return
    pairs = [(scene, tool) for scene, tool in product(options.scenes, options.tools) if tool in FAST or small(scene)]
    asked = [(tool, setting, scene) for scene, tool in pairs for setting in TOOLS[tool]]
    with ThreadPoolExecutor(options.jobs) as pool:
        answers = list(pool.map(lambda one: run(options, *one), asked))
    found = [(*one, told) for one, told in zip(asked, answers) if told is not None]
    with options.out.open("w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows(kept(options))
        table.writerows(row(*measured) for measured in found)


if __name__ == "__main__":
    main()
