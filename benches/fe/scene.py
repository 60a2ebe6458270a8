"""A scene of cases/chart/scenes.json as finite elements need it: stones, material, joints, loads; read from its request.

Circular arches of constant thickness with normal joints, weight and point loads: what the scenes are made of. What else a
request may say is refused.
"""

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
GRAVITY = 9.81
# What a request leaves out (docs/reference.md).
STONE = {
    "density_kg_m3": 2300.0,
    "youngs_modulus_pa": 1e9,
    "poissons_ratio": 0.25,
    "friction_angle_deg": 30.0,
    "cohesion_pa": 0.0,
    "plane": "stress",
    "penalty_ratio": 10.0,
    "shear_penalty_ratio": 1.0,
    "compressive_strength_pa": None,
}


@dataclass
class Stone:
    """One voussoir: corners (intrados before and after, extrados after and before), and the centre of its arcs, if it has some."""

    corners: np.ndarray
    centre: np.ndarray | None

    def place(self, along, radial):
        """Points at shares of the stone: along from the joint before to that after, radial from intrados to extrados."""
        along, radial = np.broadcast_arrays(along, radial)
        if self.centre is None:
            a, b, c, d = self.corners
            inner = a + along[..., None] * (b - a)
            outer = d + along[..., None] * (c - d)
            return inner + radial[..., None] * (outer - inner)
        radius, angle = self.polar(along, radial)
        return self.centre + radius[..., None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    def polar(self, along, radial):
        inner, after, _, outer = self.corners - self.centre
        radii = np.hypot(*inner), np.hypot(*outer)
        first = math.atan2(inner[1], inner[0])
        turn = math.atan2(inner[0] * after[1] - inner[1] * after[0], inner @ after)
        return radii[0] + radial * (radii[1] - radii[0]), first + turn * along

    def area_per_share(self, along, radial):
        """Area per unit of both shares, m2."""
        if self.centre is None:
            a, b, c, d = self.corners
            by_along = (b - a) + radial[..., None] * ((c - d) - (b - a))
            by_radial = (d - a) + along[..., None] * ((c - b) - (d - a))
            cross = by_along[..., 0] * by_radial[..., 1] - by_along[..., 1] * by_radial[..., 0]
            return np.abs(cross)
        inner, after, _, outer = self.corners - self.centre
        turn = math.atan2(inner[0] * after[1] - inner[1] * after[0], inner @ after)
        return self.polar(along, radial)[0] * abs(turn) * abs(np.hypot(*outer) - np.hypot(*inner))


@dataclass
class PointForce:
    """A force at a point of a stone's extrados, that share of the stone along it, N/m."""

    stone: int
    along: float
    force: np.ndarray


@dataclass
class Scene:
    name: str
    stones: list
    """Loads at load factor 1."""
    forces: list
    weight: float
    """Weight per area, N/m2 per metre of depth: density times g."""
    elasticity: np.ndarray
    friction: float
    layer: np.ndarray
    """Normal and tangential stiffness of a whole joint, N/m per metre of depth."""


def scenes():
    """The stress scenes of the chart that have a field, by name."""
    listed = json.loads((ROOT / "cases/chart/scenes.json").read_text())["stress"]
    return {scene["name"]: scene for scene in listed}


def read(name, request):
    """The scene of a request at load factor 1."""
    known(request, {"arch", "loads", "stone", "load_factor", "report"})
    stone = {**STONE, **request.get("stone", {})}
    known(stone, set(STONE))
    if stone["cohesion_pa"]:
        raise ValueError(f"{name}: joints have no cohesion here")
    stones = voussoirs(request["arch"])
    weight, forces = 0.0, []
    for entry in request["loads"]:
        [(kind, load)] = entry["load"].items()
        if kind == "self_weight":
            weight += stone["density_kg_m3"] * GRAVITY
        elif kind == "point_load":
            known(load, {"force_n_per_m", "x_m"})
            forces.append(point_force(stones, load["x_m"], load["force_n_per_m"]))
        else:
            raise ValueError(f"{name}: {kind} is not read here")
    # A contact at each end of a joint has the penalty, so the joint has it twice.
    whole = 2.0 * stone["penalty_ratio"] * stone["youngs_modulus_pa"]
    return Scene(
        name,
        stones,
        forces,
        weight,
        elasticity(stone["youngs_modulus_pa"], stone["poissons_ratio"], stone["plane"]),
        math.tan(math.radians(stone["friction_angle_deg"])),
        np.array([whole, whole * stone["shear_penalty_ratio"]]),
    )


def known(asked, fields):
    if set(asked) - fields:
        raise ValueError(f"{sorted(set(asked) - fields)} are not read here")


def voussoirs(arch):
    known(arch, {"profile", "thickness", "voussoirs", "curved_sides"})
    circle, count, thickness = arch["profile"]["circular"], arch["voussoirs"], arch["thickness"]["constant_m"]
    opening = math.radians(circle["opening_angle_deg"])
    radius = circle["radius_m"]
    # The springings are at height 0.
    centre = np.array([0.0, -radius * math.cos(opening / 2.0)])
    angles = math.pi / 2.0 + opening * (0.5 - np.arange(count + 1) / count)
    rays = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    inner, outer = (centre + rays * (radius + s * thickness / 2.0) for s in (-1.0, 1.0))
    curved = centre if arch.get("curved_sides") else None
    return [Stone(np.array([inner[k], inner[k + 1], outer[k + 1], outer[k]]), curved) for k in range(count)]


def point_force(stones, x, force):
    """A force downwards on the extrados at x."""
    for k, stone in enumerate(stones):
        (after, before), centre = stone.corners[2:], stone.centre
        if not before[0] <= x <= after[0]:
            continue
        share = (x - before[0]) / (after[0] - before[0])
        if centre is not None:
            radius, (first, turned) = np.hypot(*(before - centre)), (math.acos((p - centre)[0] / np.hypot(*(p - centre))) for p in (before, after))
            share = (first - math.acos((x - centre[0]) / radius)) / (first - turned)
        return PointForce(k, share, np.array([0.0, -force]))
    raise ValueError(f"there is no extrados at x = {x}")


def elasticity(modulus, ratio, plane):
    """Stress (x, y, xy) per strain (x, y, engineering shear), Pa."""
    if plane == "strain":
        modulus, ratio = modulus / (1.0 - ratio**2), ratio / (1.0 - ratio)
    shear = (1.0 - ratio) / 2.0
    return modulus / (1.0 - ratio**2) * np.array([[1.0, ratio, 0.0], [ratio, 1.0, 0.0], [0.0, 0.0, shear]])
