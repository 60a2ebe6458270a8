"""Writes the reference stresses of the chart's scenes: one table of sample points each, with the error it has itself.

    python benches/fe/fields.py --out benches/fe/fields     # a quarter of an hour of CPU
"""

import argparse
import time
from pathlib import Path

import numpy as np

import beam
import mesh
import scene
from element import Q8, T6
from solve import equilibrium, square, stress_at

FIELDS = Path(__file__).parent / "fields"
# Cells of a stone, along and radially: the last makes the field, those before and the triangles tell its error.
LEVELS = [(Q8, 0.375), (Q8, 0.67), (Q8, 1.0), (T6, 0.67)]
RADIAL = 64
# Where little of a joint is pressed, or the program is nearly as exact, more.
FINER = {"closed.csv": 128, "nine-tenths.csv": 96, "seven.csv": 96, "sixty-one.csv": 96}
# Sample points in all of a scene, at least so many in a stone.
POINTS, LEAST = 8000, 250
# No sample is nearer to a point force than this share of the thickness: stresses have no bound there.
CLEAR = 0.1


def samples(stones):
    """Points of every stone, their weights in m2 and their shares of the stone: spread evenly (the R2 sequence of Roberts), then drawn
    towards the sides, where stresses are steepest."""
    count = max(LEAST, POINTS // len(stones))
    root = 1.324717957244746
    spread = [np.modf(0.5 + np.arange(k * count + 1, (k + 1) * count + 1)[:, None] / [root, root**2])[0] for k in range(len(stones))]
    shares = [even**3 * (10.0 - 15.0 * even + 6.0 * even**2) for even in spread]
    weights = [np.prod(30.0 * even**2 * (1.0 - even) ** 2, axis=1) / count for even in spread]
    places = np.stack([stone.place(*share.T) for stone, share in zip(stones, shares)])
    areas = np.stack([stone.area_per_share(*share.T) * weight for stone, share, weight in zip(stones, shares, weights)])
    return np.stack(shares), places, areas


def clear_of(forces, stones, places):
    """Whether points are far enough from all point forces."""
    thickness = np.hypot(*(stones[0].corners[3] - stones[0].corners[0]))
    clear = np.ones(places.shape[:-1], bool)
    for force in forces:
        at = stones[force.stone].place(np.array(force.along), np.array(1.0))
        clear &= np.hypot(*np.moveaxis(places - at, -1, 0)) > CLEAR * thickness
    return clear


def cells(stones, radial):
    """Cells of a stone each way: about twice as many radially as along, fewer along narrow stones."""
    inner, after, outer, _ = stones[0].corners
    slender = np.hypot(*(after - inner)) / np.hypot(*(outer - after))
    return max(4, round(radial / 5), round(radial * min(0.5, 0.7 * slender))), round(radial)


def solve_levels(asked, shares, radial, told):
    """Stresses at the samples on every mesh, and what was solved."""
    start, stresses, words = None, [], []
    for element, level in LEVELS:
        began = time.process_time()
        grid = mesh.build(asked, element, *cells(asked.stones, level * radial))
        state = equilibrium(asked, grid, start)
        if element is Q8:
            start = state
        stresses.append(np.stack([stress_at(asked, grid, state.displacement, k, s) for k, s in enumerate(shares)]))
        size = f"{len(grid.parts[0].along) - 1} x {len(grid.parts[0].radial) - 1}"
        words.append(f"{element.name} {size}")
        told(f"{asked.name}: {words[-1]}, {state.iterations} iterations, {state.residual:.0e}, {time.process_time() - began:.0f} s")
    return stresses, words, state


def differences(stresses, areas):
    """Of every mesh but the field's own to the field: over all, and of the worst stone."""
    field = stresses[2]
    whole = square(field, areas)
    found = []
    for other in (stresses[0], stresses[1], stresses[3]):
        apart = square(other - field, areas)
        found.append((np.sqrt(apart.sum() / whole.sum()), np.sqrt((apart / whole).max())))
    return found


def field(name, request, radial, told):
    """Header and rows of a scene's table."""
    asked = scene.read(name, request)
    shares, places, areas = samples(asked.stones)
    clear = clear_of(asked.forces, asked.stones, places)
    areas = areas * clear
    stresses, words, state = solve_levels(asked, shares, radial, told)
    apart = differences(stresses, areas)
    pressed = [np.average(state.normal[state.layer.joint == k] > 0.0, weights=state.layer.stiffness[state.layer.joint == k, 0]) for k in range(len(shares) + 1)]
    header = [
        f"Stresses at load factor 1 by finite elements ({words[2]} cells a stone); compression is negative.",
        f"own error: {100 * max(a for a, _ in apart[1:]):.2f} %",
        *(f"difference to {words[k]}: {100 * a:.2f} %, of one voussoir at most {100 * b:.2f} %" for k, (a, b) in zip((0, 1, 3), apart)),
        f"joints open somewhere: {sum(share < 0.9999 for share in pressed)} of {len(pressed)}; the least share pressed: {min(pressed):.3f}",
    ]
    if asked.forces:
        header.append(f"clear of point forces by {CLEAR} of the thickness")
    rows = [(k, *places[k, i], areas[k, i], *stresses[2][k, i]) for k in range(len(shares)) for i in np.flatnonzero(clear[k])]
    return header, np.array(rows)


def write(file, name, header, rows):
    """Columns: voussoir, place in m, area in m2, stresses in kPa to about five digits of their root mean square."""
    level = np.sqrt(np.mean(rows[:, 4:] ** 2)) / 1e3
    digits = int(np.clip(np.ceil(4.0 - np.log10(level)), 0, 6))
    lines = [f"# {line}" for line in (name, *header)]
    lines.append("voussoir,x_m,y_m,area_m2,sigma_x_kpa,sigma_y_kpa,tau_xy_kpa")
    for voussoir, x, y, area, *stress in rows:
        lines.append(",".join([f"{voussoir:.0f}", f"{x:.5f}", f"{y:.5f}", f"{area:.4g}", *(f"{s / 1e3:.{digits}f}" for s in stress)]))
    file.write_text("\n".join(lines) + "\n")


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("--out", type=Path, default=FIELDS, help="folder of the tables (%(default)s)")
    words.add_argument("--scene", action="append", help="only this scene; may be given several times")
    options = words.parse_args()
    done = set()
    for name, one in scene.scenes().items():
        file = options.out / one["field"]
        if (options.scene and name not in options.scene) or file in done:
            continue
        done.add(file)
        told = lambda text: print(text, flush=True)
        if "curved_beam" in one["request"]:
            found = beam.field(one["request"]["curved_beam"])
        else:
            found = field(name, one["request"], FINER.get(one["field"], RADIAL), told)
        write(file, name, *found)
        for line in found[0]:
            print("   ", line, flush=True)


if __name__ == "__main__":
    main()
