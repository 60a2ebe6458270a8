#!/usr/bin/env python3
"""Generates clients from openapi/voussoir.json, in Python and in TypeScript, and uses them against the running program.

    python3 tests/clients/run.py target/debug/voussoir

Needs Python with venv, npm, and the registries of both. The generators may not warn; the Python client (client.py) is
type-checked, submits a case and reads its answer; what it reads has to be what the case expects. The TypeScript
(client.ts) is type-checked against the types generated. meshio reads a stress field (field.py). Everything is written to a temporary folder."""
import os, pathlib, shutil, socket, subprocess, sys, tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DOCUMENT = ROOT / "openapi" / "voussoir.json"


def run(*command, folder, **environment):
    """What a command prints; the end where it fails."""
    done = subprocess.run(list(map(str, command)), cwd=folder, env={**os.environ, **environment}, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


def generate(folder, *command, **environment):
    """Runs a generator, which may not warn."""
    said = run(*command, folder=folder, **environment)
    if "warn" in said.lower() or "Skipping" in said:
        sys.exit(said)


def python(folder, program):
    run(sys.executable, "-m", "venv", "venv", folder=folder)
    programs = folder / "venv" / "bin"
    run(programs / "pip", "install", "--quiet", "--no-compile", "--disable-pip-version-check", "-r",
        HERE / "requirements.txt", folder=folder)
    path = f"{programs}:{os.environ['PATH']}"
    package = folder / "voussoir_client"
    generate(folder, programs / "openapi-python-client", "generate", "--path", DOCUMENT, "--meta", "none",
             "--output-path", package, "--config", HERE / "python.yaml", "--fail-on-warning", PATH=path)
    shutil.copy(HERE / "client.py", folder)
    print(run(programs / "mypy", "--strict", "--follow-imports=silent", "client.py", folder=folder), end="")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = "127.0.0.1:%d" % free.getsockname()[1]
    server = subprocess.Popen([program, "serve", "--bind", address, "--log", "warn", "--token", "t"])
    try:
        while subprocess.run([program, "health", "--bind", address], capture_output=True).returncode != 0:
            if server.poll() is not None:
                sys.exit("the service does not start")
        case = ROOT / "cases" / "first-arch"
        print(run(programs / "python", "client.py", f"http://{address}", "t", case, folder=folder), end="")
        print(run(programs / "python", HERE / "field.py", f"http://{address}", "t", case, folder=folder), end="")
    finally:
        server.terminate()
        server.wait()


def typescript(folder):
    for name in ["package.json", "package-lock.json", "client.ts"]:
        shutil.copy(HERE / name, folder)
    run("npm", "ci", "--silent", "--no-audit", "--no-fund", folder=folder)
    programs = folder / "node_modules" / ".bin"
    # Fields with a default may be left out of a request.
    generate(folder, programs / "openapi-typescript", DOCUMENT, "--default-non-nullable", "false", "-o", "document.d.ts")
    run(programs / "tsc", "--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "client.ts", folder=folder)
    print("client.ts: types hold")


with tempfile.TemporaryDirectory() as folder:
    python(pathlib.Path(folder), pathlib.Path(sys.argv[1]).resolve())
    typescript(pathlib.Path(folder))
