#!/usr/bin/env python3
"""Proves answers anew from their JSON alone: python3 check.py ANSWER.json ...; exit code 1 where a proof fails or is none.

A load factor is borne if some joint forces balance every body and break no joint's law (static theorem). None is borne whose loads
do more work than the joints take, in some motion that no joint hinders (kinematic theorem; joints that slide dilate in it, soil resists
what moves into it, and what closes in an end that crushes does so against the strength)."""
import json, math, sys

NEAR, NEAR_ON_PATH = 1e-6, 1e-3  # of all loads together; where joints may crush on the path, whose contacts are springs
LAW = ("law", "friction_coefficient", "cohesion_n_per_m", "compressive_strength_pa")
rows, cross = lambda columns: list(zip(*columns.values())), lambda a, b: (a.conjugate() * b).imag

class Structure:
    def __init__(self, told):
        self.loads = [[list(body[of].values()) for of in ("fixed_load", "scaled_load")] for body in told["bodies"]]
        place = {body["name"]: (k, complex(*body["centroid_m"])) for k, body in enumerate(told["bodies"])}
        self.soil = [(place[e["body"]][0], math.copysign(1, e["direction"]), (complex(*e["at_m"]) - place[e["body"]][1]).imag, e["most_n_per_m"])
                     for e in told["passive_elements"]]  # body, way, height over its centroid, largest force
        self.joints = []  # law, and what forces of 1 (normal at the first end, at the second, shear) do: (body, [F_x, F_y, M]), ...
        for joint in told["joints"]:
            a, b = (complex(*end) for end in joint["ends_m"])
            along, sides = (b - a) / abs(b - a), [(*place[s], sign) for s, sign in zip(joint["between"], (-1, 1)) if s in place]
            units = [(a, -1j * along), (b, -1j * along), (a, along)]
            effects = [[(k, [sign * x for x in (f.real, f.imag, cross(at - c, f))]) for k, c, sign in sides] for at, f in units]
            self.joints.append((*(joint[of] or 0 for of in LAW), abs(b - a), effects))

    # Whether forces balance these factors of the two loads and break no law; bodies with unknown ones are left out.
    def borne(self, factors, forces, soil, why="instability"):
        parts = [[[factor * x for x in load] for factor, load in zip(factors, loads)] for loads in self.loads]
        size, broken = sum(math.hypot(*load[:2]) for of in parts for load in of), []
        sums = [[f + s for f, s in zip(*both)] for both in parts]
        for (k, way, height, most), force in zip(self.soil, soil):
            sums[k] = [of + x for of, x in zip(sums[k], (way * force, 0, -height * way * force))]
            broken += [-force, force - abs(factors[0]) * most]
        unknown = {k for joint, force in zip(self.joints, forces) if not force for k, _ in joint[5][0]}
        for (law, friction, cohesion, strength, length, effects), force in zip(self.joints, forces):
            i, e, t = force or (0, 0, 0)
            for k, x, unit in ((k, x, unit) for x, effect in zip((i, e, t), effects) for k, unit in effect):
                sums[k] = [of + x * u for of, u in zip(sums[k], unit)]
            crushed, beyond = (law in ("dry", "wall") and "crushing" in why) * (i + e) ** 2 / (2 * strength * length), abs(t) - friction * (i + e)
            broken += [crushed - i, crushed - e] * (law in ("dry", "wall")) + [beyond - abs(factors[0]) * cohesion] * (law != "bonded")
        return max([abs(x) for k, of in enumerate(sums) for x in of if k not in unknown] + broken) <= (NEAR_ON_PATH if "path" in why else NEAR) * size

    # Whether no joint hinders the motion, and loads beyond `at` (sign 0: all) do more work in it than the joints take.
    def falls(self, motion, at, sign, crushes=False):
        fixed, scaled = zip(*([sum(f * v for f, v in zip(load, of)) for load in loads] for loads, of in zip(self.loads, motion)))
        taken, gained, hindered, fastest = -sum(fixed), sum(scaled), [0], max(math.hypot(*v[:2]) for v in motion)
        for law, friction, cohesion, strength, length, effects in self.joints:
            a, b, slip = (sum(f * v for k, unit in effect for f, v in zip(unit, motion[k])) for effect in effects)
            low, high = min(a, b) - friction * abs(slip), max(a, b) - friction * abs(slip)
            taken, closes = taken + cohesion * abs(slip), crushes and law in ("dry", "wall") and low < -1e-12 * fastest
            taken += closes and strength * length * (-(low + high) / 2 if high <= 0 else low ** 2 / 2 / (high - low))
            hindered += [-low * (not closes)] if law in ("dry", "wall") else [abs(a), abs(b), abs(slip) * (law == "bonded")]
        for k, way, height, most in self.soil:
            taken += most * max(0, -way * (motion[k][0] - motion[k][2] * height))
        near = 1e-6 * fastest * sum(abs(by) * math.hypot(*load[:2]) for loads in self.loads for by, load in zip((1, at), loads))
        drives = abs(at * gained - taken) <= near and sign * gained > 0 if sign else -taken > 1e6 * abs(gained)
        return drives and max(hindered) <= 1e-6 * fastest

def check(answer):
    why = "limit analysis gave no answer" if "structure" in answer else "an answer of one structure has one, a curve and a curved beam have none"
    if not answer.get("proof"): return False, f"without a proof: {why}"
    structure, proof, window = Structure(answer["structure"]), answer["proof"], answer["limit_window_load_factor"]
    if window is None: return proof["falls"] and structure.falls(rows(proof["falls"]), 0, 0), "no load factor is borne"
    same, good, said = lambda a, b: math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9), [], f"borne from {window[0]} to {window[1]}"
    for end, value, sign in zip((proof["lowest"], proof["highest"]), window, (-1, 1)):
        good += [structure.borne((1, end["load_factor"]), rows(end["forces"]), end["passive_n_per_m"]),
                 end["ray"] and structure.borne((0, sign), rows(end["ray"]), [0] * len(structure.soil)) if value is None else
                 same(value, end["load_factor"]) and end["motion"] and structure.falls(rows(end["motion"]), value, sign)]
    for end in answer["ends"] if answer["outcome"] in ("collapse", "stands_in_window") else []:
        at, which = end["load_factor"], ("lowest", "highest").index(end["which"])
        why = end["governed_by"] + " on the path" * (answer["request"].get("crushing_in_path", False) or end["governed_by"] == "crushing" and bool(end["range"]))
        exact = window[which] is not None and same(at, window[which]) or why == "crushing"
        inside = window[which] is None or same(at, window[which]) or (at < window[which]) == (which == 1)
        line = {k: (n * (0.5 - off / structure.joints[k][4]), n * (0.5 + off / structure.joints[k][4]), t)
                for k, n, t, off, *_ in rows(end["thrust_line"])}
        good += [structure.borne((1, at), [line.get(k) for k in range(len(structure.joints))], end["passive_n_per_m"], why),
                 inside, exact or why != "instability",
                 why != "crushing" or structure.falls(rows(end["velocities"]) + [(0, 0, 0)] * 2, at, 2 * which - 1, True)]
        said += f"; falls at {at} by {why}" + ("" if exact else ": borne there, but an upper bound is not claimed")
    return all(good), said

def no_number(word): raise ValueError(f"{word} is no number")

results = [(name, *check(json.load(open(name), parse_constant=no_number))) for name in sys.argv[1:]]
print(*(f"{name}: {'' if proved else 'NOT PROVED: '}load factors {said}".replace("None", "no end") for name, proved, said in results), sep="\n")
sys.exit(not all(proved for _, proved, _ in results))
