"""Holds the elements against theory: a uniform stress, a joint that opens over a part of it, the weight of an arch, the curved beam.

    python benches/fe/check.py     # prints errors; fails where one is not what it should be
"""

import numpy as np

import beam
import mesh
import scene
from element import Q8, T6
from solve import equilibrium, law, layer, stiffness, stress_at

BEAM = {"inner_radius_m": 0.5, "outer_radius_m": 0.7, "end_shear_n_per_m": 2500.0}


def wedge():
    """A scene of one stone with no right angle, and its mesh for an element."""
    corners = np.array([[0.0, 0.0], [2.0, 0.3], [1.8, 1.5], [-0.2, 1.1]])
    return scene.Scene("wedge", [scene.Stone(corners, None)], [], 0.0, scene.elasticity(2e9, 0.3, "stress"), 0.5, np.array([1e9, 1e9]))


def linear_displacements(element):
    """Displacements that are linear have the stress of their strain everywhere, and forces on the boundary only."""
    asked = wedge()
    grid = mesh.build(asked, element, 3, 4)
    slope = np.array([[3e-4, -1e-4], [2e-4, 5e-4]])
    u = grid.points @ slope.T
    strain = np.array([slope[0, 0], slope[1, 1], slope[0, 1] + slope[1, 0]])
    found = stress_at(asked, grid, u, 0, np.random.default_rng(1).random((50, 2)))
    whole = stiffness(asked, grid)
    i, j = (g.ravel() for g in np.meshgrid(*(np.arange(1, n - 1) for n in grid.parts[0].size), indexing="ij"))
    inside = grid.parts[0].number(i, j)
    force = (whole @ u.ravel()).reshape(-1, 2)
    return np.abs(found / (asked.elasticity @ strain) - 1.0).max(), np.abs(force[inside]).max() / np.abs(force).max()


def layer_of_a_turned_stone(element):
    """A stone is pushed into its first joint and turned about the middle of it, so that the joint opens over a part: force, moment
    and friction of the springs against those of the triangle that the pressure is. Largest error."""
    asked = wedge()
    grid = mesh.build(asked, element, 3, 24)
    joints = layer(asked, grid)
    foot, top = asked.stones[0].corners[[0, 3]]
    length, along = np.hypot(*(top - foot)), (top - foot) / np.hypot(*(top - foot))
    across = np.array([along[1], -along[0]])
    off = (grid.points - 0.5 * (foot + top)) @ along
    push, turn, slid = 1e-4, 4e-4, 5e-5
    u = (-push + turn * off)[:, None] * across + slid * along
    normal, shear, sliding = law(asked, joints, joints.gap @ u.ravel(), joints.slip @ u.ravel())
    first = joints.joint == 0
    pressed = push / turn + 0.5 * length
    force = 0.5 * asked.layer[0] / length * turn * pressed**2
    arm = (joints.place[first] - 0.5) * length
    found = np.array([normal[first].sum(), arm @ normal[first], -shear[first].sum()])
    # Slip is the same everywhere and pressure grows from nothing, so both laws of friction are met.
    stuck = pressed - asked.layer[1] / asked.layer[0] * slid / (asked.friction * turn)
    grip = asked.layer[1] / length * slid * stuck + 0.5 * asked.friction * asked.layer[0] / length * turn * (pressed - stuck) ** 2
    right = np.array([force, force * (pressed / 3.0 - 0.5 * length), grip])
    assert 0.0 < stuck < pressed < length and (sliding[first] != 0.0).any()
    return np.abs(found / right - 1.0).max()


def weight_arrives(element):
    """The springings of an arch push up with its weight; error of it."""
    arch = {"profile": {"circular": {"radius_m": 10, "opening_angle_deg": 180}}, "thickness": {"constant_m": 1.5}, "voussoirs": 9}
    asked = scene.read("arch", {"arch": arch, "loads": [{"load": {"self_weight": {}}}]})
    state = equilibrium(asked, mesh.build(asked, element, 4, 8))
    up = sum(state.normal[state.layer.joint == k].sum() for k in (0, 9))
    area = 0.5 * (10.75**2 - 9.25**2) * 9 * np.sin(np.pi / 9)
    return abs(up / (area * asked.weight) - 1.0)


def main():
    for element in (Q8, T6):
        stress, force = linear_displacements(element)
        turned, arrived = layer_of_a_turned_stone(element), weight_arrives(element)
        print(f"{element.name}: uniform stress {stress:.0e}, forces inside {force:.0e}, layer {turned:.0e}, weight {arrived:.0e}")
        assert max(stress, force) < 1e-10 and turned < 1e-4 and arrived < 1e-7
        errors = [beam.held_against_theory(BEAM, element, 4 * n, n) for n in (4, 8, 16, 32)]
        print(f"{element.name}: curved beam {', '.join(f'{100 * e:.3f} %' for e in errors)}")
        assert all(3.5 < coarse / fine < 4.5 for coarse, fine in zip(errors, errors[1:])) and errors[-1] < 6e-4


if __name__ == "__main__":
    main()
