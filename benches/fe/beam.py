"""The curved beam: a quarter ring bent by a shear force at its end. Theory of elasticity, and the elements held against it."""

import math

import numpy as np
from scipy.sparse.linalg import splu

import mesh
import scene
import solve

POINTS = 2000


def stress(r, theta, inner, outer, shear):
    """sigma_r, sigma_theta and tau by Golovin's solution (Timoshenko and Goodier, Theory of Elasticity, article 33): the end at
    theta = 0 bears shear alone, that at 90 degrees bending."""
    a, b = inner, outer
    scale = shear / (a * a - b * b + (a * a + b * b) * math.log(b / a))
    one, other = r + (a * b) ** 2 / r**3, (a * a + b * b) / r
    radial = scale * (one - other)
    hoop = scale * (3.0 * r - (a * b) ** 2 / r**3 - other)
    return radial * np.sin(theta), hoop * np.sin(theta), -radial * np.cos(theta)


def cartesian(theta, radial, hoop, shear):
    """Stresses (x, y, xy) of polar ones."""
    c, s = np.cos(theta), np.sin(theta)
    return np.stack(
        [
            radial * c * c + hoop * s * s - 2.0 * shear * s * c,
            radial * s * s + hoop * c * c + 2.0 * shear * s * c,
            (radial - hoop) * s * c + shear * (c * c - s * s),
        ],
        axis=-1,
    )


def exact(request, r, theta):
    beam = [request[name] for name in ("inner_radius_m", "outer_radius_m", "end_shear_n_per_m")]
    return cartesian(theta, *stress(r, theta, *beam))


def field(request):
    """Header and rows of the beam's table, by theory."""
    inner, outer = request["inner_radius_m"], request["outer_radius_m"]
    root = 1.324717957244746
    share = np.modf(0.5 + np.arange(1, POINTS + 1)[:, None] / [root, root**2])[0]
    r, theta = inner + share[:, 0] * (outer - inner), 0.5 * math.pi * share[:, 1]
    area = r * (outer - inner) * 0.5 * math.pi / POINTS
    place = r[:, None] * np.stack([np.cos(theta), np.sin(theta)], axis=1)
    rows = np.column_stack([np.zeros(POINTS), place, area, exact(request, r, theta)])
    return ["Stresses by the theory of elasticity; compression is negative.", "own error: 0.00 %"], rows


def held_against_theory(request, element, along, radial, points=12):
    """Error of the elements: of a mesh of so many cells under the end tractions of theory, which balance each other."""
    inner, outer = request["inner_radius_m"], request["outer_radius_m"]
    corners = np.array([[0.0, inner], [inner, 0.0], [outer, 0.0], [0.0, outer]])
    stone = scene.Stone(corners, np.zeros(2))
    material = scene.elasticity(scene.STONE["youngs_modulus_pa"], scene.STONE["poissons_ratio"], "stress")
    asked = scene.Scene("curved beam", [stone], [], 0.0, material, 0.0, np.zeros(2))
    grid = mesh.build(asked, element, along, radial)
    whole = solve.stiffness(asked, grid)
    force = end_forces(request, grid, stone, points)
    # Three displacements hold the ring where it is; the tractions balance, so nothing passes through them.
    first, last = grid.parts[0].joint(0)[[0, -1]]
    free = np.setdiff1d(np.flatnonzero(whole.diagonal() > 0.0), [2 * first, 2 * first + 1, 2 * last])
    u = np.zeros(whole.shape[0])
    u[free] = splu(whole[free][:, free].tocsc()).solve(force[free])
    rows = field(request)[1]
    r, theta = np.hypot(rows[:, 1], rows[:, 2]), np.arctan2(rows[:, 2], rows[:, 1])
    shares = np.stack([1.0 - theta / (0.5 * math.pi), (r - inner) / (outer - inner)], axis=1)
    apart = solve.stress_at(asked, grid, u.reshape(-1, 2), 0, shares) - rows[:, 4:]
    return math.sqrt(solve.square(apart, rows[:, 3]) / solve.square(rows[:, 4:], rows[:, 3]))


def end_forces(request, grid, stone, points):
    """Of the tractions of theory on both ends."""
    force = np.zeros((len(grid.points), 2))
    at, weight, shape = solve.edge_rule(points)
    lines = grid.parts[0].radial
    for side, theta, outward in ((0, 0.5 * math.pi, np.array([-1.0, 0.0])), (1, 0.0, np.array([0.0, -1.0]))):
        nodes = grid.parts[0].joint(side)
        for k, (low, high) in enumerate(zip(lines, lines[1:])):
            r = stone.polar(np.array(0.5), low + (high - low) * at)[0]
            xx, yy, xy = exact(request, r, np.full_like(r, theta)).T
            traction = np.stack([xx * outward[0] + xy * outward[1], xy * outward[0] + yy * outward[1]], axis=1)
            width = (high - low) * (request["outer_radius_m"] - request["inner_radius_m"])
            np.add.at(force, nodes[2 * k : 2 * k + 3], shape.T @ (traction * (weight * width)[:, None]))
    return force.ravel()
