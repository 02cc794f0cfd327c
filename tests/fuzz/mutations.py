"""Random changes of texts, bytes, numbers and scenes."""

import json
import math
import re
import struct

import hdf5_bytes

NASTY_NUMBERS = ["0", "-0", "-1", "1", "1e-300", "5e-324", "1e308", "-1e308", "1e300", "1e30", "1e12", "1e-12", "1e9", "-1e9",
                 "nan", "inf", "-inf", "1e999", "99999999999999999999", "18446744073709551616", "-9223372036854775808",
                 "2147483648", "0x10", "1,5", "3e", "+5", "1e5e5", "0.1", "0.5", "2", "3", "10", "100", "1000"]
NASTY_WORDS = ["", " ", "%s%n", "a" * 5000, "\u00e9\u4e2d", "\x00", "\x1b[31m", "-", "true", "none", "../../etc", "/dev/null", "."]
FORMULAS = ["y=1e-5*t", "1,5*t", "t/0", "sqrt(-1)", "log(0)", "1e308*10", "exp(1000*t)", "((((t", "t)", "t t", "x=t", "sin", "0*t"]


class Mutator:
    """Random changes of texts, bytes and numbers."""

    def __init__(self, rng):
        self.rng = rng

    def number(self, near="1"):
        if self.rng.random() < 0.6:
            return self.rng.choice(NASTY_NUMBERS)
        try:
            value = float(near)
        except ValueError:
            value = 1.0
        factor = self.rng.choice([0.0, -1.0, 0.5, 2.0, 10.0, 0.1, 1e3, 1e-3, 1e6, 1e-6, 1e15, 1e-15])
        return repr(value * factor)

    def value(self, near="1"):
        pick = self.rng.random()
        if pick < 0.65:
            return self.number(near)
        if pick < 0.75:
            return self.rng.choice(FORMULAS)
        if pick < 0.85:
            return ", ".join(self.number(near) for _ in range(self.rng.randint(1, 4)))
        return self.rng.choice(NASTY_WORDS)

    def lines(self, text, separators=r"[ ,\t]+"):
        """One change of a text made of lines."""
        lines = text.split("\n")
        at = self.rng.randrange(len(lines))
        pick = self.rng.random()
        if pick < 0.12:
            del lines[at]
        elif pick < 0.20:
            lines.insert(at, lines[self.rng.randrange(len(lines))])
        elif pick < 0.28:
            other = self.rng.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        elif pick < 0.33:
            lines = lines[:at]
        elif pick < 0.85:
            fields = re.split(f"({separators})", lines[at])
            spots = [i for i in range(0, len(fields), 2) if fields[i]]
            if spots:
                spot = self.rng.choice(spots)
                fields[spot] = self.value(fields[spot])
            lines[at] = "".join(fields)
        else:
            return self.bytes("\n".join(lines).encode("utf-8", "replace")).decode("utf-8", "replace")
        return "\n".join(lines)

    def bytes(self, content):
        content = bytearray(content)
        for _ in range(self.rng.choice([1, 1, 2, 8])):
            pick = self.rng.random()
            at = self.rng.randrange(len(content)) if content else 0
            if pick < 0.4 and content:
                content[at] = self.rng.randrange(256)
            elif pick < 0.5 and content:
                blank = min(self.rng.choice([8, 64, 500]), len(content) - at)
                content[at:at + blank] = bytes(blank)
            elif pick < 0.65:
                content[at:at] = bytes(self.rng.randrange(256) for _ in range(self.rng.choice([1, 4, 64])))
            elif pick < 0.8 and content:
                del content[at:at + self.rng.choice([1, 8, 512])]
            elif pick < 0.9:
                content = content[:at]
            else:
                content[0:0] = self.rng.choice([b"\xef\xbb\xbf", b"\xff\xfe", b"\x00", b"\n" * 100])
        return bytes(content)

    def hdf5(self, content):
        """Bytes, or a number with its checksum made good."""
        arrays, singles = hdf5_bytes.chunks(content), hdf5_bytes.single_numbers(content)
        pick = self.rng.random()
        if pick < 0.2 or not arrays:
            return self.bytes(content)
        real = struct.pack("<d", self.rng.choice([math.nan, math.inf, -math.inf, 0.0, -1.0, 1e300, 1e-300, 1e9, -1e9, 0.5, 2.0]))
        whole = self.rng.choice([0, -1, 1, 2**31 - 1, -2**31, 10**6, 77])
        if pick < 0.35 and singles:
            packed = real if self.rng.random() < 0.5 else struct.pack("<q", self.rng.choice([whole, 2**62, -2**63]))
            return hdf5_bytes.write_single(content, self.rng.choice(singles), packed)
        packed = real if self.rng.random() < 0.6 else struct.pack(self.rng.choice(["<i", "<q"]), whole)
        fitting = [chunk for chunk in arrays if chunk[1] >= len(packed)]
        if not fitting:
            return self.bytes(content)
        chunk = self.rng.choice(fitting)
        return hdf5_bytes.write_number(content, chunk, self.rng.randrange(chunk[1] // len(packed)), packed)

    def scene(self, text):
        """One change of a parameter file: mostly of a value, sometimes of its form."""
        lines = text.split("\n")
        values = [i for i, line in enumerate(lines) if "=" in line]
        if not values:
            return self.lines(text)
        pick = self.rng.random()
        if pick < 0.6:
            at = self.rng.choice(values)
            key, value = lines[at].split("=", 1)
            lines[at] = f"{key}= {self.value(value.strip())}"
        elif pick < 0.7:
            at, other = self.rng.choice(values), self.rng.choice(values)
            lines[at] = lines[at].split("=")[0] + "=" + lines[other].split("=")[1]
        elif pick < 0.75:
            depth = self.rng.choice([33, 2000, 20000])
            lines[0:0] = ["subsection a"] * depth + ["end"] * depth
        elif pick < 0.78:
            at = self.rng.choice(values)
            lines[at] = lines[at].swapcase()
        else:
            return self.lines(text)
        return "\n".join(lines)


def as_json(text):
    """A parameter file as nested objects; one that is no longer well-formed stays text."""
    root, stack = {}, []
    stack.append(root)
    text = text.replace("\\\n", " ")
    for line in text.split("\n"):
        line = line.split("#")[0].strip()
        if line.startswith("subsection "):
            stack.append(stack[-1].setdefault(line[11:].strip(), {}))
        elif line == "end":
            stack.pop()
        elif line.startswith("set ") and "=" in line:
            key, value = line[4:].split("=", 1)
            stack[-1][key.strip()] = value.strip()
    return root


def unquoted_numbers(rng, node):
    for key, value in list(node.items()):
        if isinstance(value, dict):
            unquoted_numbers(rng, value)
        elif rng.random() < 0.5:
            try:
                node[key] = float(value)
            except ValueError:
                pass


def json_scene(mutator, text):
    rng = mutator.rng
    root = as_json(text)
    unquoted_numbers(rng, root)
    pick = rng.random()
    if pick < 0.5:
        node = root
        while True:
            key = rng.choice(list(node))
            if isinstance(node[key], dict) and node[key]:
                node = node[key]
                continue
            node[key] = rng.choice([mutator.value(str(node[key])), None, True, [1, 2], {}, 1e308, -1, 10**30, {"a": {}}])
            break
    content = json.dumps(root, indent=1) if rng.random() < 0.9 else "[" * rng.choice([10, 100000])
    if 0.5 <= pick < 0.6:
        depth = rng.choice([40, 3000, 100000])
        return '{"a":' * depth + content + "}" * depth
    return mutator.lines(content) if pick >= 0.6 else content
