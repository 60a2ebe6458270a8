"""LMGC90 (contact dynamics of rigid polyhedra, 3D) through compas_lmgc90, searched for the largest load.

A trial: half a second under self weight, the load raised over another half, then held for three. What has moved by more
than 20 mm since the load began has fallen. LMGC90 holds one simulation a process, so each trial is a process; its imports
are not counted."""

import json
import subprocess
import sys

import numpy as np

from arch import DENSITY, arch as read_arch, largest_load, timed

SETTLE, RAMP, HOLD = 0.5, 0.5, 3.0
FALLEN, LOST = 0.02, 0.5
TOLERANCE = 5e-3
# Time step, s; and whether the moment of the eccentric load is turned into the block's principal frame, in which LMGC90
# takes it. compas_lmgc90 passes it on as it is given.
SETTINGS = {
    "step 2 ms": (2e-3, True),
    "step 1 ms": (1e-3, True),
    "step 2 ms, moment as given": (2e-3, False),
}


def solver(arch, load, step, turned):
    from compas_lmgc90.solver import Solver

    made = Solver(dt=step, theta=1.0, density=DENSITY)
    made.geometry_from_v_f([{"vertices": vertices, "faces": faces} for vertices, faces in arch.prisms()])
    count = len(arch.blocks)
    for support in (count, count + 1):
        made.v_drvdof[support] = {component: np.zeros(6) for component in range(1, 7)}
    end = SETTLE + RAMP + HOLD + 1.0
    times, push = [0.0, SETTLE, SETTLE + RAMP, end], load * 1e3
    moment = np.array([0.0, push * arch.lever, 0.0])
    if turned is not None:
        moment = turned @ moment
    for component, value in zip(("Fz", "Mx", "My", "Mz"), (-push, *moment)):
        if abs(value) > 1e-6:
            made.apply_force(arch.loaded, component, np.array([times, [0.0, 0.0, value, value]]))
    made.contact_law("IQS_CLB", arch.friction)
    made.preprocess()
    return made


def moved(arch, load, step, turned):
    """Largest displacement of a block since the load began, m."""
    made = solver(arch, load, step, turned)
    settled, steps = round(SETTLE / step), round((SETTLE + RAMP + HOLD) / step)
    start, way = None, 0.0
    for k in range(steps):
        places = np.array(made.lmgc90.compute_one_step().bodies)[: len(arch.blocks)]
        if k == settled:
            start = places
        if start is not None:
            way = float(np.abs(places - start).max())
            if way > LOST:
                break
    return way


def trial(name, load, setting):
    """One line of JSON from a process of its own: `frame` of the loaded block if `load` is None, or `moved` and `seconds`."""
    arch, (step, _) = read_arch(name), SETTINGS[setting["name"]]
    if load is None:
        frame = solver(arch, 1.0, step, None).init_frame[arch.loaded]
        return {"frame": np.array(frame).reshape(3, 3).tolist()}
    turned = None if setting["frame"] is None else np.array(setting["frame"])
    way, seconds = timed(lambda: moved(arch, load, step, turned))
    return {"moved": way, "seconds": seconds}


def in_a_process(name, load, setting):
    asked = json.dumps([name, load, setting])
    run = subprocess.run([sys.executable, __file__, asked], capture_output=True, text=True, timeout=3600)
    lines = [line for line in run.stdout.splitlines() if line.startswith("{")]
    if not lines:
        raise RuntimeError(run.stderr[-500:])
    return json.loads(lines[-1])


def solve(name, setting, limit):
    with_frame = SETTINGS[setting][1]
    frame = in_a_process(name, None, {"name": setting})["frame"] if with_frame else None

    def stands(load):
        told = in_a_process(name, load, {"name": setting, "frame": frame})
        return told["moved"] < FALLEN, told["seconds"]

    return largest_load(stands, read_arch(name).weight, TOLERANCE, limit)


if __name__ == "__main__":
    print("\n" + json.dumps(trial(*json.loads(sys.argv[1]))), flush=True)
