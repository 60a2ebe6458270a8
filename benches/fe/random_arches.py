"""Asks the program for random arches to an accuracy, and holds its stresses against finite elements.

    python benches/fe/random_arches.py target/release/voussoir --arches 32     # a quarter of an hour of CPU

Every arch bears its weight, and most a force on the extrados that is a share of what the program says it collapses at. Errors are those
of the tables: the root mean square, by area, of all components of the stress over that of the stress itself. Tables and program leave out
the same around a force, but in narrow stones, where the program leaves out less.
"""

import argparse
import json
import math
import random
import subprocess

import numpy as np

import fields

ASKED = [0.1, 0.05, 0.02, 0.01]
SHARES = [0.0, 0.3, 0.5, 0.5, 0.7, 0.9]
RADIAL = 72
# Corners of a subblock, from -1 to 1 either way.
SIGNS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
NEWTON_STEPS = 8


def answer(program, request):
    named = json.dumps({"name": "random arch", **request})
    ran = subprocess.run([program, "solve", "--json", "/dev/stdin"], input=named, capture_output=True, text=True)
    if ran.returncode:
        raise RuntimeError(ran.stderr)
    return json.loads(ran.stdout)


def arch(seed, program):
    """A random request, and what it is in a few words; None where its collapse load is not one to take a share of."""
    dice = random.Random(seed)
    radius, opening = round(dice.uniform(3, 20), 2), round(dice.uniform(50, 180), 1)
    thickness = round(radius * dice.uniform(0.08 if opening < 150 else 0.13, 0.25), 3)
    voussoirs, share = dice.choice([5, 7, 9, 12, 15, 20, 27, 33, 41]), dice.choice(SHARES)
    stone = {
        "friction_angle_deg": round(dice.uniform(42, 60), 1),
        "poissons_ratio": round(dice.uniform(0, 0.3), 2),
        "penalty_ratio": dice.choice([1, 3, 10, 30]),
        "plane": dice.choice(["stress", "strain"]),
        "density_kg_m3": round(dice.uniform(1800, 2700)),
    }
    request = {
        "arch": {
            "profile": {"circular": {"radius_m": radius, "opening_angle_deg": opening}},
            "thickness": {"constant_m": thickness},
            "voussoirs": voussoirs,
            "curved_sides": dice.random() < 0.4,
        },
        "stone": stone,
        "loads": [{"load": {"self_weight": {}}}],
    }
    half = radius * math.sin(math.radians(opening / 2))
    if share:
        force = {"force_n_per_m": 1000, "x_m": round(half * dice.uniform(-0.7, 0.1), 3)}
        request["loads"].append({"load": {"point_load": force}, "scaled": True})
        found = answer(program, request)
        if found["outcome"] != "collapse":
            return None
        force["force_n_per_m"] = round(1000 * share * found["ends"][0]["load_factor"], 1)
    request["load_factor"] = {"cap": 1}
    request["report"] = {"stress_fields": ["unit_load"]}
    return request, f"{voussoirs} voussoirs, t/R {thickness / radius:.2f}, penalty {stone['penalty_ratio']}, share {share}"


def places(corners, points):
    """Of points in a subblock, from -1 to 1 either way where they lie inside."""
    at = np.zeros_like(points)
    for _ in range(NEWTON_STEPS):
        x, y = at[:, :1], at[:, 1:]
        by_x = 0.25 * SIGNS[:, 0] * (1 + SIGNS[:, 1] * y) @ corners
        by_y = 0.25 * SIGNS[:, 1] * (1 + SIGNS[:, 0] * x) @ corners
        miss = points - shares(at) @ corners
        turn = lambda a, b: a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        at = np.clip(at + np.stack([turn(miss, by_y), turn(by_x, miss)], axis=1) / turn(by_x, by_y)[:, None], -9, 9)
    return at


def shares(at):
    """Of the four corners at places in a subblock."""
    return 0.25 * (1 + SIGNS[:, 0] * at[:, :1]) * (1 + SIGNS[:, 1] * at[:, 1:])


def stresses(told, rows):
    """What an answer says at the points of a table, Pa: bilinear in the subblock in which a point lies deepest."""
    of, found = np.array(told["voussoir"]), np.zeros((len(rows), 3))
    all_corners = np.stack([np.array(told[f"corners_{c}_m"]) for c in "xy"], axis=-1)
    all_stress = np.stack([np.array(told[f"corner_{c}_pa"]) for c in ("sigma_x", "sigma_y", "tau_xy")], axis=-1)
    depth = np.full(len(rows), np.inf)
    for voussoir, corners, stress in zip(of, all_corners, all_stress):
        length = max(np.hypot(*(corners[k] - corners[k + 2])) for k in (0, 1))
        here = (rows[:, 0] == voussoir) & (np.hypot(*(rows[:, 1:3] - corners.mean(axis=0)).T) < length)
        if not here.any():
            continue
        at = places(corners, rows[here, 1:3])
        outside = np.abs(at).max(axis=1)
        deeper = outside < depth[here]
        chosen = np.flatnonzero(here)[deeper]
        depth[chosen], found[chosen] = outside[deeper], (shares(at) @ stress)[deeper]
    return found


def error(found, rows):
    square = lambda s: rows[:, 3] @ (s[:, 0] ** 2 + s[:, 1] ** 2 + 2 * s[:, 2] ** 2)
    return math.sqrt(square(found - rows[:, 4:]) / square(rows[:, 4:]))


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    words.add_argument("program", help="the voussoir to ask")
    words.add_argument("--first", type=int, default=0, help="seed of the first arch")
    words.add_argument("--arches", type=int, default=32, help="how many")
    options = words.parse_args()
    print("seed,asked,estimate,met,error,own_error,arch")
    for seed in range(options.first, options.first + options.arches):
        made = arch(seed, options.program)
        if made is None:
            continue
        request, said = made
        header, rows = fields.field(f"random arch {seed}", request, RADIAL, lambda _: None)
        own = header[1].split(": ")[1]
        for asked in ASKED:
            told = answer(options.program, {**request, "accuracy": {"stress": asked}})
            stress = told["plan"]["stress"]
            found = stresses(told["stress_fields"][0]["subblocks"], rows)
            print(f"{seed},{asked},{stress['estimate']:.5f},{stress['met']},{error(found, rows):.5f},{own},\"{said}\"", flush=True)


if __name__ == "__main__":
    main()
