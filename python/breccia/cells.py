"""A periodic cell of particles as a material point."""

import os
from typing import NamedTuple, Optional

import numpy

from . import _breccia
from ._breccia import InputError
from .values import as_text


class CellAnswer(NamedTuple):
    """What a cell answers to a strain."""

    stress: numpy.ndarray  # (6) [Pa]
    tangent: Optional[numpy.ndarray]  # (6, 6) [Pa]: derivative of the stress by the strain, particles in equilibrium
    parts: int  # that the step was taken in
    relaxation_steps: int  # above 0: a cascade, equilibrium was found by dynamics


class Cell:
    """A periodic cell of particles, whose links damage and slide, in equilibrium at small strain (doc/theory/periodic-cell.md).

    packing: a file with a periodic cell. Links reach up to interaction_ratio (>= 1) times the sum of radii and obey a law, by its name and a
    dictionary of constants. thickness [m]: of a packing of discs. rotations: whether particles turn. contact_reach: particles that no link
    joins are watched for contact within this part of the sum of their radii; tolerance: of the unbalanced force; growth_step: largest
    growth of a link's damaging strain in one part of a step. Raises InputError.

    Strains and stresses are in the order xx yy zz yz zx xy, with engineering shears, tension positive. Cells of discs answer to xx, yy and xy
    alone. copy() makes another one that shares what is the same of both. stiffness: elastic (6, 6) [Pa], volume [m^3], particles, links.
    """

    def __init__(self, packing, interaction_ratio, law, constants, thickness=0.0, rotations=True, contact_reach=0.1, tolerance=1e-9,
                 growth_step=0.5):
        if interaction_ratio < 1 or thickness < 0 or contact_reach < 0:
            raise InputError("Cell: interaction_ratio must be 1 or more, thickness and contact_reach not below 0.")
        words = [f"{name}={as_text(value)}" for name, value in constants.items()]
        self._take(_breccia.LiveCell(os.fspath(packing), law, words, interaction_ratio, thickness, rotations, contact_reach, tolerance,
                                     growth_step))

    def _take(self, cell):
        self._cell = cell
        self.stiffness, self.volume, self.particles, self.links = cell.stiffness, cell.volume, cell.particles, cell.links

    def respond(self, strain, tangent=True):
        """What the cell answers to a whole strain (6) [-], from the committed state: CellAnswer. Other threads go on. Raises InputError,
        and NumericalError if no equilibrium is found."""
        answer = self._cell.respond(strain, tangent)
        return CellAnswer(answer.stress, answer.tangent if tangent else None, answer.parts, answer.relaxation_steps)

    def commit(self):
        """Make the last answer the state."""
        self._cell.commit()

    def begin_step(self):
        """Another step is sought: no answer since the committed state shall matter for the next, not even in the last digits."""
        self._cell.begin_step()

    def copy(self):
        """Another cell in the same state."""
        other = Cell.__new__(Cell)
        other._take(self._cell.copy())
        return other

    def __deepcopy__(self, memo):
        return self.copy()

    @property
    def state(self):
        """All that is committed, an array of numbers to be kept, sent elsewhere, and set again."""
        return self._cell.state()

    @state.setter
    def state(self, row):
        self._cell.set_state(row)

    @property
    def strain(self):
        """Committed (6) [-]."""
        return self._cell.strain

    @property
    def energies(self):
        """Of the committed state since the cell was made, by name [J]."""
        return self._cell.energies()
