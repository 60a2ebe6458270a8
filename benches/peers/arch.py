"""A scene of cases/chart/scenes.json as the peers need it: blocks, supports, load. And the search for its collapse load."""

import json
import math
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
GRAVITY = 9.81
# Defaults of a request: kg/m3, degrees.
DENSITY, FRICTION_ANGLE = 2300.0, 30.0


@dataclass
class Arch:
    """Blocks as corners (n, 4, 2) in m, clockwise from the intrados at the joint before; two supports after the last block."""

    blocks: np.ndarray
    areas: np.ndarray
    centroids: np.ndarray
    loaded: int
    load_x: float
    friction: float
    weight: float
    """Total weight, kN per metre of depth."""

    @property
    def lever(self):
        """Distance of the point load from the loaded block's centroid, to the right, m."""
        return self.load_x - self.centroids[self.loaded, 0]

    def supports(self, depth=1.0):
        """One block below each springing joint, wider than the arch."""
        first, last = self.blocks[0], self.blocks[-1]
        left, right = sorted((first[0, 0], first[1, 0])), sorted((last[2, 0], last[3, 0]))
        return [
            np.array([[a - 1.0, -depth], [a - 1.0, 0.0], [b + 1.0, 0.0], [b + 1.0, -depth]])
            for a, b in (left, right)
        ]

    def prisms(self):
        """Vertices and outward faces of every block and support, one metre deep in y; z is up."""
        return [prism(corners) for corners in [*self.blocks, *self.supports()]]


def prism(corners):
    """A polygon in the plane of x and z, clockwise, as a polyhedron from y = 0 to y = 1."""
    n = len(corners)
    vertices = [[float(x), y, float(z)] for y in (0.0, 1.0) for x, z in corners]
    # Clockwise with z up is clockwise seen from -y, that is, counter-clockwise seen from +y.
    faces = [list(range(n))[::-1], list(range(n, 2 * n))]
    faces += [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return vertices, faces


def scenes():
    """Collapse scenes by name."""
    listed = json.loads((ROOT / "cases/chart/scenes.json").read_text())["collapse"]
    return {scene["name"]: scene for scene in listed}


def semicircles():
    """Names of the scenes that the peers are given: semicircles with a point load."""
    named = scenes().items()
    return [name for name, scene in named if "point_load" in str(scene) and not scene["request"].get("stone")]


def small(name):
    """Whether a scene is small enough for tools that take minutes of it."""
    return scenes()[name]["request"]["arch"]["voussoirs"] <= 61


def arch(name):
    """The arch of a scene with radial joints and straight-sided blocks."""
    request = scenes()[name]["request"]
    shape = request["arch"]
    circle, count = shape["profile"]["circular"], shape["voussoirs"]
    half = math.radians(circle["opening_angle_deg"]) / 2.0
    angles = math.pi / 2.0 + half - 2.0 * half * np.arange(count + 1) / count
    rays = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    inner, outer = (rays * (circle["radius_m"] + s * shape["thickness"]["constant_m"] / 2.0) for s in (-1.0, 1.0))
    blocks = np.stack([inner[:-1], outer[:-1], outer[1:], inner[1:]], axis=1)
    after = np.roll(blocks, -1, axis=1)
    cross = blocks[..., 0] * after[..., 1] - blocks[..., 1] * after[..., 0]
    areas = np.abs(cross.sum(axis=1)) / 2.0
    centroids = ((blocks + after) * cross[..., None]).sum(axis=1) / (3.0 * cross.sum(axis=1))[:, None]
    x = next(entry["load"]["point_load"]["x_m"] for entry in request["loads"] if entry.get("scaled"))
    loaded = int(np.searchsorted(outer[:, 0], x, side="right")) - 1
    weight = areas.sum() * DENSITY * GRAVITY / 1e3
    return Arch(blocks, areas, centroids, loaded, x, math.tan(math.radians(FRICTION_ANGLE)), weight)


def largest_load(stands, above, tolerance, limit):
    """Bisection: the middle of [a load that stands, one that does not], kN, and what there is to say about it.

    `stands(load)` gives (whether, CPU seconds); `above` is a load taken to be too much, and tried like any other;
    `limit` is the most CPU seconds of all trials. Without an answer the load is None.
    """
    spent, trials = 0.0, 0

    def attempt(load):
        nonlocal spent, trials
        held, seconds = stands(load)
        spent, trials = spent + seconds, trials + 1
        return held

    def told(load, note):
        return {"intensity": load, **spread([spent]), "note": f"{note}{trials} trials"}

    if not attempt(0.0):
        return told(None, "finds no equilibrium under self weight; ")
    if attempt(above):
        return told(None, "stands under as much load as the arch weighs; ")
    low, high = 0.0, above
    while high - low > tolerance * high:
        if spent > limit:
            return told(None, f"stopped after {limit:.0f} s of CPU between {low:.4g} and {high:.4g} kN; ")
        middle = (low + high) / 2.0
        low, high = (middle, high) if attempt(middle) else (low, middle)
    return told((low + high) / 2.0, f"between {low:.6g} and {high:.6g} kN; ")


def timed(run):
    """What `run` gives, and the CPU seconds it took."""
    start = time.process_time()
    result = run()
    return result, time.process_time() - start


def spread(seconds):
    """The median of some times, the least and the greatest, and how many there are."""
    ordered = sorted(seconds)
    middle, least, greatest = ordered[len(ordered) // 2], ordered[0], ordered[-1]
    return {"seconds": middle, "least_seconds": least, "greatest_seconds": greatest, "repetitions": len(ordered)}
