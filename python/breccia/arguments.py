"""Arguments of functions, checked where they come in: what was found, and what is expected."""

import math
import operator

from ._breccia import InputError


def number(name, value):
    """A finite one."""
    try:
        found = float(value)
    except (TypeError, ValueError):
        found = math.nan
    if not math.isfinite(found):
        raise InputError(f"{name} = {value!r}: expected a finite number.")
    return found


def three(name, values):
    """Numbers of a vector, finite."""
    try:
        found = [float(value) for value in values]
    except (TypeError, ValueError):
        found = []
    if len(found) != 3 or not all(map(math.isfinite, found)):
        raise InputError(f"{name} = {values!r}: expected three finite numbers.")
    return found


def whole(name, value):
    """From 0 on: a count, or the number of something."""
    try:
        found = operator.index(value)
    except TypeError:
        found = -1
    if found < 0:
        raise InputError(f"{name} = {value!r}: expected a whole number from 0 on.")
    return found


def wholes(name, values):
    """A list of them, or an array."""
    if not hasattr(values, "__iter__"):
        raise InputError(f"{name} = {values!r}: expected a list of whole numbers.")
    return [whole(name, value) for value in values]


def switches(name, values, count):
    """So many of true or false."""
    found = [bool(value) for value in values] if hasattr(values, "__iter__") else []
    if len(found) != count:
        raise InputError(f"{name} = {values!r}: expected {count} of True or False.")
    return found
