#!/usr/bin/env python3
"""Tries the page in a real browser: Debian's chromium, driven by playwright-core, against the running program.

    python3 tests/page/run.py target/debug/voussoir

Needs chromium, node and npm, and the npm registry. Versions are pinned in package-lock.json. Everything is written to a temporary
folder; `SCREENSHOTS=folder` (an absolute path) keeps pictures of the views, `ONLY=word` runs what has that word in its name,
`CHROMIUM=path` takes another browser."""
import os, pathlib, shutil, subprocess, sys, tempfile

HERE = pathlib.Path(__file__).resolve().parent

with tempfile.TemporaryDirectory() as folder:
    for file in [*HERE.glob("*.json"), *HERE.glob("*.mjs")]:
        shutil.copy(file, folder)
    subprocess.run(["npm", "ci", "--silent", "--no-audit", "--no-fund"], cwd=folder, check=True)
    program = pathlib.Path(sys.argv[1]).resolve()
    browser = os.environ.get("CHROMIUM") or shutil.which("chromium") or sys.exit("chromium is missing: apt-get install chromium")
    ran = subprocess.run(["node", "run.mjs", program, HERE.parents[1]], cwd=folder, env={**os.environ, "CHROMIUM": browser})
sys.exit(ran.returncode)
