"""Meshes of the stones of a scene, with lines graded towards joints, faces and forces."""

from dataclasses import dataclass

import numpy as np

import element as elements


def graded(count, ends=(0.0, 1.0), grading=0.95):
    """Lines over a length, closer at its ends: the cosine's, mixed with even ones."""
    even = np.linspace(0.0, 1.0, count + 1)
    mixed = (1.0 - grading) * even + grading * 0.5 * (1.0 - np.cos(np.pi * even))
    return ends[0] + (ends[1] - ends[0]) * mixed


@dataclass
class StoneMesh:
    """Lines along and radially as shares of the stone; the number of its first point in the lattice of all stones."""

    along: np.ndarray
    radial: np.ndarray
    first: int

    @property
    def size(self):
        """Points of the lattice, each way: two steps a cell."""
        return 2 * len(self.along) - 1, 2 * len(self.radial) - 1

    def number(self, i, j):
        return self.first + i * self.size[1] + j

    def joint(self, side):
        """Points on the joint before (0) or after (1), from intrados to extrados."""
        return self.number(side * (self.size[0] - 1), np.arange(self.size[1]))


@dataclass
class Mesh:
    element: type
    parts: list
    points: np.ndarray
    cells: list
    """Points of the elements: one table for each element of a cell, cells of stone after stone, along before radial."""

    def first_cell(self, stone):
        return sum((len(part.along) - 1) * (len(part.radial) - 1) for part in self.parts[:stone])


def build(scene, element, along, radial):
    """So many cells each way in every stone; a stone under a force has them on either side of it."""
    parts, points, cells, first = [], [], [[] for _ in element.lattice], 0
    for k, stone in enumerate(scene.stones):
        breaks = sorted({0.0, 1.0, *(force.along for force in scene.forces if force.stone == k)})
        pieces = [graded(along, pair) for pair in zip(breaks, breaks[1:])]
        part = StoneMesh(np.unique(np.concatenate(pieces)), graded(radial), first)
        parts.append(part)
        points.append(stone.place(*np.meshgrid(halved(part.along), halved(part.radial), indexing="ij")).reshape(-1, 2))
        first += len(points[-1])
        i, j = (g.ravel() for g in np.meshgrid(*(np.arange(len(x) - 1) for x in (part.along, part.radial)), indexing="ij"))
        for table, lattice in zip(cells, element.lattice):
            table.append(np.stack([part.number(2 * i + a, 2 * j + b) for a, b in lattice], axis=1))
    return Mesh(element, parts, np.concatenate(points), [np.concatenate(table) for table in cells])


def halved(lines):
    """The lines and those half-way between."""
    both = np.empty(2 * len(lines) - 1)
    both[::2], both[1::2] = lines, 0.5 * (lines[1:] + lines[:-1])
    return both


def strain_operator(mesh, table, at):
    """Strains per displacement of the nodes of elements (e, 3, 2 n), and the area per area, at one point of them all or at one
    point of each."""
    by_local = np.broadcast_to(elements.gradient(mesh.element, at), (len(table), 2, table.shape[1]))
    jacobian = by_local @ mesh.points[table]
    by_place = np.linalg.solve(jacobian, by_local)
    operator = np.zeros((len(table), 3, 2 * table.shape[1]))
    operator[:, 0, 0::2] = operator[:, 2, 1::2] = by_place[:, 0]
    operator[:, 1, 1::2] = operator[:, 2, 0::2] = by_place[:, 1]
    return operator, np.abs(np.linalg.det(jacobian))
