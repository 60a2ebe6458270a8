"""A whole process, from its start to its end: CPU seconds of the process and what it says the load is."""

import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from arch import scenes, spread

REPETITIONS = 11
HIGHS = Path(__file__).parent / "highs.py"


def highs(scene, setting):
    """Python, scipy, the matrices and HiGHS."""
    return timed([sys.executable, str(HIGHS), scene, setting], float)


def ours(scene, program):
    """`voussoir solve`, which reads the request and writes the whole answer."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(scenes()[scene]["request"], file)
        file.flush()
        return timed([program, "solve", "--json", file.name], instability)


def instability(answer):
    return json.loads(answer)["ends"][0]["instability"]["intensity"]


def timed(words, read):
    """The same again and again; the first time, which finds files cold, does not count."""
    seconds = []
    for _ in range(REPETITIONS + 1):
        before = cpu()
        said = subprocess.run(words, check=True, capture_output=True, env=os.environ).stdout
        seconds.append(cpu() - before)
    return {"intensity": read(said), **spread(seconds[1:]), "note": ""}


def cpu():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
