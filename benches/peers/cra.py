"""compas_cra: rigid-block equilibrium (RBE) and coupled rigid-block analysis (CRA), searched for the largest load.

Neither maximises a load. The load enters the equations of the loaded block; geometry and interfaces are made once."""

import contextlib
import io

import numpy as np
from compas.datastructures import Mesh
from compas_assembly.datastructures import Block
from compas_cra.algorithms import assembly_interfaces_numpy
from compas_cra.datastructures import CRA_Assembly
from compas_cra.equilibrium import cra_nlp, cra_solve, rbe_solve

from arch import DENSITY, GRAVITY, largest_load, timed

# RBE always finds forces and grants tension at a price: the tension, over a block's mean weight, that passes for none.
RBE = {"tension below 1e-2": 1e-2, "tension below 1e-3": 1e-3, "tension below 1e-4": 1e-4}
# CRA: bound of the virtual displacements and overlap, m; the package's defaults first. (1e-1, 1e-2) finds no equilibrium
# under self weight either, in 113 s.
CRA = {"d 1e-3, eps 1e-4": (1e-3, 1e-4), "d 1e-2, eps 1e-3": (1e-2, 1e-3)}
RBE_TOLERANCE, CRA_TOLERANCE = 1e-4, 5e-3


def assembly(arch):
    """Blocks, supports and the interfaces between them."""
    made = CRA_Assembly()
    for vertices, faces in arch.prisms():
        made.add_block(Mesh.from_vertices_and_faces(vertices, faces).copy(cls=Block))
    count = len(arch.blocks)
    made.set_boundary_conditions([count, count + 1])
    with contextlib.redirect_stdout(io.StringIO()):
        assembly_interfaces_numpy(made, nmax=10, amin=1e-2, tmax=1e-6)
    return made


def loads(arch, load):
    """Forces and moments (six a block) over the weight per area, in the order of the package: moment of a force -P z at a
    lever in x is +P lever about y."""
    forces = np.zeros((len(arch.blocks), 6))
    forces[:, 2] = -arch.areas
    push = load * 1e3 / (DENSITY * GRAVITY)
    forces[arch.loaded, [2, 4]] += [-push, push * arch.lever]
    return forces.reshape(-1, 1)


def largest_tension(made):
    edges = made.graph.edges()
    interfaces = (face for edge in edges for face in made.graph.edge_attribute(edge, "interfaces"))
    return max(point["c_nn"] for face in interfaces for point in face.forces)


def solve(arch, setting, limit):
    made, mean = assembly(arch), float(arch.areas.mean())
    rbe = setting in RBE

    def equilibrium():
        with contextlib.redirect_stdout(io.StringIO()):
            if rbe:
                rbe_solve(made, mu=arch.friction)
                return largest_tension(made) < RBE[setting] * mean
            bound, overlap = CRA[setting]
            try:
                cra_solve(made, mu=arch.friction, d_bnd=bound, eps=overlap)
            except ValueError:
                # The package says so of every end that is no solution.
                return False
            return True

    def stands(load):
        cra_nlp.external_force_setup = lambda _assembly, _density: loads(arch, load)
        return timed(equilibrium)

    return largest_load(stands, arch.weight, RBE_TOLERANCE if rbe else CRA_TOLERANCE, limit)
