"""Rigid-block limit analysis as a linear programme, solved by HiGHS: load, joint forces, no displacement and no stress.

    python highs.py SCENE SETTING     # prints the load, kN: what is timed as a whole process
"""

import sys

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_array

from arch import DENSITY, GRAVITY, arch, spread, timed

SETTINGS = {"dual simplex": "highs-ds", "interior point": "highs-ipm"}
REPETITIONS = 21


def programme(arch):
    """Unknowns: two corner forces and a shear force on every joint, then the load in kN. Static theorem, Coulomb friction
    with its normal rule."""
    n = len(arch.blocks)
    inner, outer = (np.vstack([arch.blocks[:, a], arch.blocks[-1:, b]]) for a, b in ((0, 3), (1, 2)))
    along = (outer - inner) / np.linalg.norm(outer - inner, axis=1)[:, None]
    into_next = np.stack([along[:, 1], -along[:, 0]], axis=1)
    rows, columns, values = [], [], []

    def add(row, column, value):
        rows.append(row), columns.append(column), values.append(value)

    for joint in range(n + 1):
        for k, (at, direction) in enumerate(((inner, into_next), (outer, into_next), (inner, along))):
            for block, sign in ((joint, 1.0), (joint - 1, -1.0)):
                if 0 <= block < n:
                    force, arm = sign * direction[joint], at[joint] - arch.centroids[block]
                    for i, part in enumerate((*force, arm[0] * force[1] - arm[1] * force[0])):
                        add(3 * block + i, 3 * joint + k, part)
    add(3 * arch.loaded + 1, 3 * n + 3, -1.0)
    add(3 * arch.loaded + 2, 3 * n + 3, -arch.lever)
    equilibrium = coo_array((values, (rows, columns)), shape=(3 * n, 3 * n + 4)).tocsc()
    right = np.zeros(3 * n)
    right[1::3] = arch.areas * DENSITY * GRAVITY / 1e3
    joint, mu = np.arange(n + 1), np.full(n + 1, arch.friction)
    cone = [(2 * joint + s, 3 * joint + k, v) for s in (0, 1) for k, v in ((0, -mu), (1, -mu), (2, mu * 0 + 1 - 2 * s))]
    row, column, value = (np.concatenate(part) for part in zip(*cone))
    friction = coo_array((value, (row, column)), shape=(2 * n + 2, 3 * n + 4)).tocsc()
    bounds = [(0, None), (0, None), (None, None)] * (n + 1) + [(0, None)]
    cost = np.zeros(3 * n + 4)
    cost[-1] = -1.0
    return dict(c=cost, A_ub=friction, b_ub=np.zeros(2 * n + 2), A_eq=equilibrium, b_eq=right, bounds=bounds)


def solve(arch, setting, _limit):
    """CPU times of `linprog` alone; the matrices are made before."""
    asked = programme(arch)
    runs = [timed(lambda: linprog(**asked, method=SETTINGS[setting])) for _ in range(REPETITIONS)]
    return {"intensity": intensity(runs[0][0]), **spread([seconds for _, seconds in runs]), "note": ""}


def intensity(found):
    return float(found.x[-1]) if found.status == 0 else None


if __name__ == "__main__":
    scene, setting = sys.argv[1:]
    print(intensity(linprog(**programme(arch(scene)), method=SETTINGS[setting])))
