#!/usr/bin/env python3
"""Proves answers anew from their JSON alone: python3 check.py ANSWER.json ...; exit code 1 where a proof fails.

A load factor is borne if some joint forces balance every body and break no joint's law (static theorem). None is borne whose loads
do more work than cohesion takes, in some motion that no joint hinders (kinematic theorem; joints that slide dilate in it)."""
import json, math, sys

NEAR = {"instability": 1e-6, "sliding": 1e-6, "crushing": 1e-3}  # of the largest force, of the work, of the fastest velocity
rows, cross = lambda columns: list(zip(*columns.values())), lambda a, b: (a.conjugate() * b).imag

class Structure:
    def __init__(self, told):
        self.loads = [[list(body[of].values()) for of in ("fixed_load", "scaled_load")] for body in told["bodies"]]
        place = {body["name"]: (k, complex(*body["centroid_m"])) for k, body in enumerate(told["bodies"])}
        self.joints = []  # law, and what forces of 1 (normal at the first end, at the second, shear) do: (body, [F_x, F_y, M]), ...
        for joint in told["joints"]:
            a, b = (complex(*end) for end in joint["ends_m"])
            along, sides = (b - a) / abs(b - a), [(*place[s], sign) for s, sign in zip(joint["between"], (-1, 1)) if s in place]
            units = [(a, -1j * along), (b, -1j * along), (a, along)]
            effects = [[(k, [sign * x for x in (f.real, f.imag, cross(at - c, f))]) for k, c, sign in sides] for at, f in units]
            law = (joint[of] or 0 for of in ("law", "friction_coefficient", "cohesion_n_per_m", "compressive_strength_pa"))
            self.joints.append((*law, abs(b - a), effects))

    def borne(self, factors, forces, why="instability"):
        """Whether forces balance these factors of the two loads and break no law; bodies with unknown ones are left out."""
        parts = [[[factor * x for x in load] for factor, load in zip(factors, loads)] for loads in self.loads]
        size, broken = max(abs(x) for of in (*sum(parts, []), *filter(None, forces)) for x in of), []
        sums, unknown = [[f + s for f, s in zip(*both)] for both in parts], set()
        for (law, friction, cohesion, strength, length, effects), force in zip(self.joints, forces):
            i, e, t = force or (0, 0, 0)
            for k, x, unit in ((k, x, unit) for x, effect in zip((i, e, t), effects) for k, unit in effect):
                sums[k] = [of + x * u for of, u in zip(sums[k], unit)]
            unknown |= set() if force else {k for k, _ in effects[0]}
            crushed = (i + e) ** 2 / (2 * strength * length) if law == "dry" and why == "crushing" else 0
            broken += [crushed - i, crushed - e] if law in ("dry", "wall") else []
            broken += [abs(t) - friction * (i + e) - abs(factors[0]) * cohesion] if law != "bonded" else []
        return max([abs(x) for k, of in enumerate(sums) for x in of if k not in unknown] + broken) <= NEAR[why] * size

    def falls(self, motion, at, sign):
        """Whether no joint hinders the motion, and loads beyond `at` (sign 0: all) do more work in it than cohesion takes."""
        fixed, scaled = zip(*([sum(f * v for f, v in zip(load, of)) for load in loads] for loads, of in zip(self.loads, motion)))
        taken, gained, hindered = -sum(fixed), sum(scaled), [0]
        for law, friction, cohesion, _, _, effects in self.joints:
            a, b, slip = (sum(f * v for k, unit in effect for f, v in zip(unit, motion[k])) for effect in effects)
            taken, dilates = taken + cohesion * abs(slip), friction * abs(slip)
            hindered += [dilates - a, dilates - b] if law in ("dry", "wall") else [abs(a), abs(b), abs(slip) * (law == "bonded")]
        fastest = max(math.hypot(*v[:2]) for v in motion)
        size = fastest * sum(abs(by) * math.hypot(*load[:2]) for loads in self.loads for by, load in zip((1, at), loads))
        drives = abs(at * gained - taken) <= NEAR["instability"] * size and sign * gained > 0 if sign else -taken > 1e6 * abs(gained)
        return drives and max(hindered) <= NEAR["instability"] * fastest

def check(answer):
    structure, proof, window = Structure(answer["structure"]), answer["proof"], answer["limit_window_load_factor"]
    if window is None:
        return structure.falls(rows(proof["falls"]), 0, 0), "no load factor is borne"
    same, good, said = lambda a, b: math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9), [], f"borne from {window[0]} to {window[1]}"
    for end, value, sign in zip((proof["lowest"], proof["highest"]), window, (-1, 1)):
        good += [structure.borne((1, end["load_factor"]), rows(end["forces"]))]
        good += [end["ray"] and structure.borne((0, sign), rows(end["ray"])) if value is None else
                 same(value, end["load_factor"]) and structure.falls(rows(end["motion"]), value, sign)]
    if answer["outcome"] == "collapse":
        at, why, forces = answer["collapse"]["load_factor"], answer["collapse"]["governed_by"], [None] * len(structure.joints)
        for joint, n, t, off, *_ in rows(answer["thrust_line"]):
            forces[joint] = n / 2 - n * off / structure.joints[joint][4], n / 2 + n * off / structure.joints[joint][4], t
        exact = any(end is not None and same(at, end) for end in window)
        why = "sliding" if answer["slides"] and not exact and why == "instability" else why
        good += [structure.borne((1, at), forces, why), exact or why != "instability"]
        said += f"; falls at {at}" + ("" if exact else f" by {why}: borne there, but an upper bound is not claimed")
    return all(good), said

results = [(name, *check(json.load(open(name)))) for name in sys.argv[1:]]
print(*(f"{name}: {'' if proved else 'NOT PROVED: '}load factors {said}".replace("None", "no end") for name, proved, said in results), sep="\n")
sys.exit(not all(proved for _, proved, _ in results))
