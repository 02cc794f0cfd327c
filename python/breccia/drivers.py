"""One link or one point along a path, and the moduli of a packing."""

import json
import os

from . import _breccia
from ._breccia import InputError, NumericalError
from .values import as_text


def link_test(law, constants, path, dimension=3, thickness=1.0, radius_1=1e-3, radius_2=1e-3, gap=0.0, row_time=0.0):
    """Drive one link along a path, as `breccia link-test` does, which lists the columns.

    law: its name. constants: a dictionary by the names that scenes have, {"Normal modulus": 25e9}. path: a dictionary of arrays or a
    frame, one value a step: normal_strain and shear strains, or displacements and forces of two particles of the radii and the gap given
    [m]; discs of a thickness [m] in two dimensions. row_time: from value to value [s], for laws that depend on the rate; 0: no time passes,
    as for slow paths. Returns a pandas frame with attrs["units"]. Raises InputError, and NumericalError
    where the link can no longer follow.
    """
    words, columns = _words_of(constants), _columns_of(path)
    if dimension not in (2, 3) or not min(thickness, radius_1, radius_2) > 0 or not row_time >= 0:
        raise InputError("link_test: dimension must be 2 or 3, thickness and radii above 0, row_time not below 0.")
    answer, broke_off = _breccia.link_test(law, words, columns, dimension, thickness, radius_1, radius_2, gap, float(row_time))
    if broke_off:
        raise NumericalError(broke_off)
    return _frame_of(answer)


def point_test(material, constants, path):
    """Drive one point of a continuum along a path, as `breccia point-test` does.

    material: its name. constants: a dictionary by the names that scenes have, {"Young modulus": 30e9}. path: a dictionary of arrays or a
    frame, one value a step: strain_xx ... strain_xy (order xx yy zz yz zx xy, engineering shear) [-] or stress_xx ... [Pa]; a component
    that is not given keeps zero strain. Returns a pandas frame with attrs["units"]. Raises InputError, which names the step that could not
    be reached, from 1.
    """
    return _frame_of(_breccia.point_test(material, _words_of(constants), _columns_of(path)))


def _words_of(constants):
    return [f"{name}={as_text(value)}" for name, value in constants.items()]


def _columns_of(path):
    return {name: [float(value) for value in path[name]] for name in path}


def _frame_of(answer):
    import pandas

    frame = pandas.DataFrame({name: values for name, _, values in answer})
    frame.attrs["units"] = {name: unit for name, unit, _ in answer}
    return frame


def homogenise(packing, interaction_ratio, normal_modulus=0.0, shear_ratio=0.0, law="", constants=None, thickness=0.0):
    """Macroscopic stiffness of a periodic packing (a file), as `breccia homogenise` finds it.

    Links reach up to interaction_ratio (>= 1) times the sum of radii. They obey either normal_modulus [Pa] and shear_ratio [-], or a law by
    its name with a dictionary of constants. thickness [m]: of a packing of discs. Returns a dictionary like homogenised.json: of
    "statistics", "affine" and "relaxed" (the answer) each "E" [Pa], "nu" [-] and "stiffness", an array (6, 6) [Pa] with engineering shears
    in the order xx yy zz yz zx xy. Raises InputError, NumericalError.
    """
    if bool(law) == bool(normal_modulus > 0 and shear_ratio > 0) or interaction_ratio < 1:
        raise InputError("homogenise: give normal_modulus and shear_ratio above 0, or a law; interaction_ratio from 1 on.")
    import numpy

    words = _words_of(constants or {})
    found = json.loads(
        _breccia.homogenise(os.fspath(packing), law, words, interaction_ratio, normal_modulus, shear_ratio, thickness)
    )
    for way in ("statistics", "affine", "relaxed"):
        found[way]["stiffness"] = numpy.array(found[way]["stiffness"])
    return found
