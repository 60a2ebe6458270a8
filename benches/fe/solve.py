"""Equilibrium of elastic stones with layers of springs between them that bear no tension and slide by Coulomb's law."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.linalg import splu

import element as elements
from mesh import strain_operator

# Points of the layer on every edge of an element: the edge of what is pressed together falls between them.
LAYER_POINTS = 8
TOLERANCE = 1e-8
MOST_ITERATIONS = 80


@dataclass
class Layer:
    """Points of all joints: the displacements that make their gap and slip, their stiffness, N/m, which joint and where on it."""

    gap: csr_array
    slip: csr_array
    stiffness: np.ndarray
    joint: np.ndarray
    place: np.ndarray


def stiffness(scene, mesh):
    """Of the stones, bonded to nothing."""
    at, weight = mesh.element.quadrature()
    parts = []
    for table in mesh.cells:
        operator = [strain_operator(mesh, table, point) for point in at]
        block = sum(w * area[:, None, None] * np.swapaxes(b, 1, 2) @ scene.elasticity @ b for w, (b, area) in zip(weight, operator))
        unknowns = (2 * table[:, :, None] + np.arange(2)).reshape(len(table), -1)
        row, column = np.broadcast_arrays(unknowns[:, :, None], unknowns[:, None, :])
        parts.append((block.ravel(), row.ravel(), column.ravel()))
    value, row, column = (np.concatenate(p) for p in zip(*parts))
    size = 2 * len(mesh.points)
    return coo_array((value, (row, column)), shape=(size, size)).tocsc()


def loads(scene, mesh):
    """Of weight and point forces on all displacements, N/m."""
    force = np.zeros((len(mesh.points), 2))
    at, weight = mesh.element.quadrature()
    for table in mesh.cells:
        for point, w in zip(at, weight):
            area = strain_operator(mesh, table, point)[1]
            np.add.at(force[:, 1], table, -scene.weight * w * area[:, None] * elements.shape(mesh.element, point))
    for one in scene.forces:
        part = mesh.parts[one.stone]
        i = 2 * int(np.argmin(np.abs(part.along - one.along)))
        force[part.number(i, part.size[1] - 1)] += one.force
    return force.ravel()


def edge_rule(points):
    """Gauss points of an edge from 0 to 1, their weights, and there the shape functions of the edge's three nodes."""
    at, weight = leggauss(points)
    at = 0.5 * (at + 1.0)
    return at, 0.5 * weight, np.stack([(1 - at) * (1 - 2 * at), 4 * at * (1 - at), at * (2 * at - 1)], axis=1)


def layer(scene, mesh):
    """The joints, the springings among them: the ground does not move."""
    at, weight, shape = edge_rule(LAYER_POINTS)
    count = len(scene.stones)
    rows, columns, across, along, stiff, joints, places, first = [], [], [], [], [], [], [], 0
    for joint in range(count + 1):
        sides = [(joint - 1, 1, -1.0), (joint, 0, 1.0)]
        sides = [side for side in sides if 0 <= side[0] < count]
        stone, side, _ = sides[0]
        inner, outer = scene.stones[stone].corners[[1, 2] if side else [0, 3]]
        tangent = (outer - inner) / np.hypot(*(outer - inner))
        normal = np.array([tangent[1], -tangent[0]])
        lines = mesh.parts[stone].radial
        share = np.diff(lines)[:, None] * weight
        edges, points = share.shape
        row = first + np.arange(edges * points).reshape(edges, points)
        first += edges * points
        stiff.append(share.ravel()[:, None] * scene.layer)
        joints.append(np.full(edges * points, joint))
        places.append((lines[:-1, None] + np.diff(lines)[:, None] * at).ravel())
        for number, end, sign in sides:
            nodes = mesh.parts[number].joint(end)
            for k in range(3):
                for d in range(2):
                    rows.append(row.ravel())
                    columns.append(np.repeat(2 * nodes[k : k + 2 * edges : 2] + d, points))
                    value = np.tile(sign * shape[:, k], edges)
                    across.append(value * normal[d])
                    along.append(value * tangent[d])
    size = (first, 2 * len(mesh.points))
    row, column = np.concatenate(rows), np.concatenate(columns)
    gap, slip = (coo_array((np.concatenate(v), (row, column)), shape=size).tocsr() for v in (across, along))
    return Layer(gap, slip, *(np.concatenate(parts) for parts in (stiff, joints, places)))


@dataclass
class State:
    """Displacements of all points, m; of the layer's points the pressure's force, N/m, and the sense in which they slide, or 0."""

    displacement: np.ndarray
    layer: Layer
    normal: np.ndarray
    sliding: np.ndarray
    iterations: int
    residual: float


def law(scene, joints, gap, slip):
    """Forces of the layer's points across (pressure positive) and along, and the sense in which they slide, or 0."""
    normal = np.maximum(-joints.stiffness[:, 0] * gap, 0.0)
    trial = -joints.stiffness[:, 1] * slip
    most = scene.friction * normal
    return normal, np.clip(trial, -most, most), np.where(np.abs(trial) > most, np.sign(trial), 0.0)


def first_guess(joints, start):
    """Which points of the layer are pressed, and the sense in which they slide: as on a coarser mesh, else closed and stuck."""
    if start is None:
        return np.ones(len(joints.joint), bool), np.zeros(len(joints.joint))
    before, now = (layer.joint + 0.5 * layer.place for layer in (start.layer, joints))
    near = np.clip(np.searchsorted(before, now), 0, len(before) - 1)
    return start.normal[near] > 0.0, start.sliding[near]


def equilibrium(scene, mesh, start=None):
    """Newton's method, with a search along each step for where its work vanishes."""
    whole, force, joints = stiffness(scene, mesh), loads(scene, mesh), layer(scene, mesh)
    # The lattice has points in the middle of cells that are no nodes of some elements.
    used = np.flatnonzero(whole.diagonal() > 0.0)
    whole, force = whole[used][:, used], force[used]
    gap, slip = joints.gap[:, used], joints.slip[:, used]

    def solved(pressed, sliding, right):
        across = joints.stiffness[:, 0] * pressed
        along = joints.stiffness[:, 1] * (pressed & (sliding == 0.0))
        turned = scene.friction * sliding * across
        tangent = whole + gap.T @ (diags_array(across) @ gap) + slip.T @ (diags_array(along) @ slip + diags_array(turned) @ gap)
        return splu(tangent.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options={"SymmetricMode": True}).solve(right)

    def off(u):
        normal, shear, sliding = law(scene, joints, gap @ u, slip @ u)
        return whole @ u - force - gap.T @ normal - slip.T @ shear, normal, sliding

    u = solved(*first_guess(joints, start), force)
    for iteration in range(MOST_ITERATIONS):
        left, normal, sliding = off(u)
        error = np.linalg.norm(left) / np.linalg.norm(force)
        if error < TOLERANCE:
            displacement = np.zeros(2 * len(mesh.points))
            displacement[used] = u
            return State(displacement.reshape(-1, 2), joints, normal, sliding, iteration, error)
        step = solved(normal > 0.0, sliding, -left)
        u = u + step * length(lambda share: step @ off(u + share * step)[0])
    raise RuntimeError(f"{scene.name}: no equilibrium in {MOST_ITERATIONS} iterations, {error:.1e} of the loads are left")


def length(work):
    """The share of a step at which its work vanishes, 1 if that is about 1."""
    if work(1.0) <= 0.0 or abs(work(1.0)) < 0.1 * abs(work(0.0)):
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(12):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if work(middle) < 0.0 else (low, middle)
    return 0.5 * (low + high)


def stress_at(scene, mesh, displacement, stone, shares):
    """Stresses (x, y, xy) at shares (along, radial) of a stone, Pa: by the derivatives of the displacements."""
    part = mesh.parts[stone]
    cell, inside = [], []
    for lines, share in zip((part.along, part.radial), shares.T):
        k = np.clip(np.searchsorted(lines, share, side="right") - 1, 0, len(lines) - 2)
        cell.append(k)
        inside.append((share - lines[k]) / (lines[k + 1] - lines[k]))
    number = mesh.first_cell(stone) + cell[0] * (len(part.radial) - 1) + cell[1]
    which, at = mesh.element.locate(np.stack(inside, axis=1))
    stresses = np.empty((len(shares), 3))
    for kind, cells in enumerate(mesh.cells):
        here = which == kind
        table = cells[number[here]]
        operator = strain_operator(mesh, table, at[here])[0]
        strain = np.einsum("ekn,en->ek", operator, displacement[table].reshape(len(table), -1))
        stresses[here] = strain @ scene.elasticity
    return stresses


def square(stress, weight):
    """Integral of the square of stress tensors (x, y, xy), over the last points."""
    return np.sum(weight * (stress[..., 0] ** 2 + stress[..., 1] ** 2 + 2.0 * stress[..., 2] ** 2), axis=-1)
