#!/usr/bin/env python3
"""Tries the page in a real browser: Debian's chromium, driven by playwright-core, against the running program.

    python3 tests/page/run.py target/debug/voussoir

Needs chromium, node and npm, and the npm registry. Versions are pinned in package-lock.json. Everything is written to a temporary
folder; `SCREENSHOTS=folder` keeps pictures of the views, `ONLY=word` runs what has that word in its name."""
import os, pathlib, shutil, subprocess, sys, tempfile

HERE = pathlib.Path(__file__).resolve().parent

with tempfile.TemporaryDirectory() as folder:
    for file in [*HERE.glob("*.json"), *HERE.glob("*.mjs")]:
        shutil.copy(file, folder)
    subprocess.run(["npm", "ci", "--silent", "--no-audit", "--no-fund"], cwd=folder, check=True)
    program = pathlib.Path(sys.argv[1]).resolve()
    ran = subprocess.run(["node", "run.mjs", program, HERE.parents[1]], cwd=folder)
sys.exit(ran.returncode)
