"""Cells of particles behind the integration points of another code, by the Micro Manager of preCICE (doc/tutorials/micro_manager.md).

    # micro.py, which the Micro Manager imports
    import breccia, breccia.micro_manager

    cell = breccia.Cell("cell.h5", 1.5, "CPM", {"Normal modulus": 25e9, ...})
    MicroSimulation = breccia.micro_manager.simulation_of(cell)
"""

import numpy

from ._breccia import InputError

VOIGT = ("xx", "yy", "zz", "yz", "zx", "xy")
UPPER = [(i, j) for i in range(6) for j in range(i, 6)]  # of a symmetric matrix, row by row


def simulation_of(cell, order=VOIGT, mandel=False, strains="strains", stresses="stresses", tangent="cmat"):
    """A class MicroSimulation as the Micro Manager wants it, whose objects are copies of a cell.

    order: of the components in the other code, "xx" ... "xy"; mandel: its shears are sqrt(2) times the tensor's, in strain and stress; otherwise
    strains have engineering shears. Data, in vectors of three: strains + "1to3", "4to6" come in, stresses + "1to3", "4to6" and tangent + "1" ...
    "7" go out, the latter the upper triangle of the symmetric part of the tangent, row by row; tangent="": none. Raises InputError for an
    order that does not name each component once.
    """
    to_voigt = _positions(order)
    scale = numpy.array([1.0 if name[0] == name[1] or not mandel else 2**0.5 for name in order])

    class MicroSimulation:
        """A cell of particles behind one point."""

        def __init__(self, sim_id=0, *_):
            self.sim_id = sim_id
            self.cell = cell.copy()

        def initialize(self, *_):
            """What the cell answers before anything has happened."""
            return self._out(numpy.zeros(6), self.cell.stiffness)

        def solve(self, macro_data, dt):
            """A step from the present state to the strain given; its end is the present state then. The length of the step dt [s] does not
            matter: particles are in equilibrium. Raises NumericalError."""
            given = numpy.concatenate([macro_data[strains + "1to3"], macro_data[strains + "4to6"]]) * scale
            whole = numpy.empty(6)
            whole[to_voigt] = given
            self.cell.begin_step()
            answer = self.cell.respond(whole, tangent=bool(tangent))
            self.cell.commit()
            return self._out(answer.stress, answer.tangent)

        def get_state(self):
            """To go back to, or to go on from elsewhere."""
            return self.cell.state

        def set_state(self, state):
            self.cell.state = state

        def get_global_id(self):
            return self.sim_id

        def set_global_id(self, sim_id):
            self.sim_id = sim_id

        def _out(self, stress, stiffness):
            s = stress[to_voigt] * scale
            data = {stresses + "1to3": s[:3], stresses + "4to6": s[3:]}
            if tangent:
                c = 0.5 * (stiffness + stiffness.T)[numpy.ix_(to_voigt, to_voigt)] * numpy.outer(scale, scale)
                upper = numpy.array([c[i, j] for i, j in UPPER])
                data.update({f"{tangent}{k + 1}": upper[3 * k : 3 * k + 3] for k in range(7)})
            return data

    return MicroSimulation


def tangent_of(data, tangent="cmat"):
    """The matrix (6, 6) that stands in data of an answer, in the order of the other code."""
    matrix = numpy.empty((6, 6))
    for (i, j), value in zip(UPPER, numpy.concatenate([data[f"{tangent}{k + 1}"] for k in range(7)]), strict=True):
        matrix[i, j] = matrix[j, i] = value
    return matrix


def _positions(order):
    """Where each component of an order stands in VOIGT."""
    names = [name if name in VOIGT else name[::-1] for name in order]
    if sorted(names) != sorted(VOIGT):
        raise InputError(f"order: found {', '.join(map(str, order))}; expected each of {', '.join(VOIGT)} once.")
    return [VOIGT.index(name) for name in names]
