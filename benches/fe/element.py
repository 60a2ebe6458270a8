"""Two plane elements of second order: the serendipity quadrilateral of eight nodes and the triangle of six.

Both stand on the same lattice of points, two steps a cell each way, and have the same edges.
"""

import numpy as np
from numpy.polynomial.legendre import leggauss


class Q8:
    """Eight nodes in the square -1..1, corners first, counter-clockwise, then the middles of the sides; 3 x 3 Gauss points."""

    name = "Q8"
    # Places in the 3 x 3 lattice of a cell.
    lattice = [[(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]]
    nodes = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]], float)

    @staticmethod
    def quadrature():
        at, weight = leggauss(3)
        x, y = np.meshgrid(at, at)
        return np.stack([x.ravel(), y.ravel()], axis=1), np.outer(weight, weight).ravel()

    @classmethod
    def terms(cls, point):
        """The monomials of the element's span."""
        x, y = point[..., 0], point[..., 1]
        return np.stack([x**0, x, y, x * x, x * y, y * y, x * x * y, x * y * y], axis=-1)

    @classmethod
    def slopes(cls, point):
        x, y = point[..., 0], point[..., 1]
        zero, one = 0.0 * x, x**0
        by_x = [zero, one, zero, 2 * x, y, zero, 2 * x * y, y * y]
        by_y = [zero, zero, one, zero, x, 2 * y, x * x, 2 * x * y]
        return np.stack([np.stack(by_x, axis=-1), np.stack(by_y, axis=-1)], axis=-2)

    @staticmethod
    def locate(shares):
        """Which element of a cell, and where in it, a point at shares 0..1 of the cell lies."""
        return np.zeros(len(shares), int), 2.0 * shares - 1.0


class T6:
    """Six nodes in the triangle (0, 0), (1, 0), (0, 1); two of them make a cell; seven points, exact to the fifth degree."""

    name = "T6"
    lattice = [
        [(0, 0), (2, 0), (2, 2), (1, 0), (2, 1), (1, 1)],
        [(0, 0), (2, 2), (0, 2), (1, 1), (1, 2), (0, 1)],
    ]
    nodes = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5]])

    @staticmethod
    def quadrature():
        root = np.sqrt(15.0)
        points, weights = [[1 / 3, 1 / 3]], [9 / 80]
        for a, weight in (((6 - root) / 21, (155 - root) / 2400), ((6 + root) / 21, (155 + root) / 2400)):
            points += [[a, a], [1 - 2 * a, a], [a, 1 - 2 * a]]
            weights += [weight] * 3
        return np.array(points), np.array(weights)

    @classmethod
    def terms(cls, point):
        x, y = point[..., 0], point[..., 1]
        return np.stack([x**0, x, y, x * x, x * y, y * y], axis=-1)

    @classmethod
    def slopes(cls, point):
        x, y = point[..., 0], point[..., 1]
        zero, one = 0.0 * x, x**0
        by_x, by_y = [zero, one, zero, 2 * x, y, zero], [zero, zero, one, zero, x, 2 * y]
        return np.stack([np.stack(by_x, axis=-1), np.stack(by_y, axis=-1)], axis=-2)

    @staticmethod
    def locate(shares):
        x, y = shares[:, 0], shares[:, 1]
        upper = y > x
        lower_at, upper_at = np.stack([x - y, y], axis=1), np.stack([x, y - x], axis=1)
        return upper.astype(int), np.where(upper[:, None], upper_at, lower_at)


def shape(element, point):
    """Value of every node's shape function at points."""
    return element.terms(point) @ np.linalg.inv(element.terms(element.nodes))


def gradient(element, point):
    """Their derivatives by both coordinates of the element."""
    return element.slopes(point) @ np.linalg.inv(element.terms(element.nodes))
