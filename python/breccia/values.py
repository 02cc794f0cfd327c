"""Values of entries as the text of scenes, and back."""

import os


def as_text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "__iter__"):
        return ", ".join(as_text(each) for each in value)
    return repr(value.item() if hasattr(value, "item") else value)  # every bit of a number


def as_value(text, unit, kind):
    if text == "":
        return None
    if unit:  # it may stand behind the number
        text = text.removesuffix(f" {unit}")
    if kind == "number":
        return float(text)
    if kind == "whole number":
        return int(text)
    if kind == "switch":
        return text.lower() == "true"
    if kind == "three numbers":
        return tuple(float(each) for each in text.split(","))
    return text
