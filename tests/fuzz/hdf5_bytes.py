"""Changes single numbers in HDF5 files without the library, and writes the checksums anew, so that a reader meets the number
and not a damaged file. Knows just what this program writes of small arrays: object headers of version 2, one chunk an array
with Fletcher 32, single numbers and texts in the header itself (HDF5 File Format Specification 3.0, IV.A)."""

import struct

UNDEFINED = 0xFFFFFFFFFFFFFFFF
LAYOUT, CONTINUED = 0x08, 0x10  # types of messages
COMPACT, CHUNKED = 0, 2
ONE_CHUNK, FILTERED = 1, 2


def fletcher32(data):
    """The checksum of arrays as HDF5 defines it: 16-bit big-endian words, an odd last byte in the upper half."""
    low = high = 0
    words = struct.unpack(f">{len(data) // 2}H", data[: len(data) // 2 * 2])
    for word in words:
        low = (low + word) % 65535
        high = (high + low) % 65535
    if len(data) % 2:
        low = (low + (data[-1] << 8)) % 65535
        high = (high + low) % 65535
    return high << 16 | low


def same_checksum(stored, found):
    """Sums modulo 65535: 0 and 65535 are the same."""
    return all((a - b) % 65535 == 0 for a, b in ((stored >> 16, found >> 16), (stored & 0xFFFF, found & 0xFFFF)))


def rotated(value, by):
    return (value << by | value >> (32 - by)) & 0xFFFFFFFF


def lookup3(data):
    """The checksum of headers: lookup3 of Jenkins (2006), little-endian words, initial value 0."""
    a = b = c = (0xDEADBEEF + len(data)) & 0xFFFFFFFF
    if not data:
        return c
    last = (len(data) - 1) // 12 * 12
    for start in range(0, last, 12):
        words = struct.unpack_from("<3I", data, start)
        a, b, c = ((x + y) & 0xFFFFFFFF for x, y in zip((a, b, c), words))
        for by in (4, 6, 8, 16, 19, 4):
            a = (a - c) & 0xFFFFFFFF ^ rotated(c, by)
            c = (c + b) & 0xFFFFFFFF
            a, b, c = b, c, a
    words = struct.unpack("<3I", data[last:].ljust(12, b"\0"))
    a, b, c = ((x + y) & 0xFFFFFFFF for x, y in zip((a, b, c), words))
    for by in (14, 11, 25, 16, 4, 14, 24):
        c = ((c ^ b) - rotated(b, by)) & 0xFFFFFFFF
        a, b, c = b, c, a
    return b


def blocks(content):
    """(begin, first message, end, bytes of a message's head) of every part of an object header whose checksum is right."""
    at = content.find(b"OHDR\x02")
    while at >= 0:
        flags = content[at + 5]
        width = 1 << (flags & 3)
        first = at + 6 + (16 if flags & 0x20 else 0) + (4 if flags & 0x10 else 0)
        end = first + width + int.from_bytes(content[first:first + width], "little")
        pending = [(at, first + width, end)]
        head = 6 if flags & 4 else 4
        while pending:
            begin, first, end = pending.pop()
            if end + 4 > len(content) or struct.unpack_from("<I", content, end)[0] != lookup3(content[begin:end]):
                continue
            yield begin, first, end, head
            for kind, place, _ in messages(content, first, end, head):
                if kind == CONTINUED:
                    begin, length = struct.unpack_from("<QQ", content, place)
                    pending.append((begin, begin + 4, begin + length - 4))
        at = content.find(b"OHDR\x02", at + 4)


def messages(content, first, end, head):
    """(type, place, size) of each message of a block."""
    while first + head <= end:
        kind, size = struct.unpack_from("<BH", content, first)
        yield kind, first + head, size
        first += head + size


def layouts(content):
    """(class, place behind it, block) of every layout message."""
    for begin, first, end, head in blocks(content):
        for kind, place, _ in messages(content, first, end, head):
            if kind == LAYOUT:
                yield content[place + 1], place + 2, (begin, end)


def chunks(content):
    """(offset, length) of the raw data of every array of one chunk with a valid checksum."""
    found = []
    for layout, place, _ in layouts(content):
        if layout != CHUNKED:
            continue
        flags, dimensions, width = content[place:place + 3]
        index = place + 3 + dimensions * width
        if content[index] != ONE_CHUNK or not flags & FILTERED:
            continue
        size, _, address = struct.unpack_from("<QIQ", content, index + 1)
        if size <= 4 or address == UNDEFINED or address + size > len(content):
            continue
        data, stored = content[address:address + size - 4], content[address + size - 4:address + size]
        if same_checksum(struct.unpack("<I", stored)[0], fletcher32(data)):
            found.append((address, size - 4))
    return sorted(set(found))


def single_numbers(content):
    """(offset, block) of single numbers of eight bytes, which lie in the headers of their arrays."""
    return [(place + 2, block) for layout, place, block in layouts(content)
            if layout == COMPACT and struct.unpack_from("<H", content, place)[0] == 8]


def write_number(content, chunk, index, packed):
    """A copy of the content with one number of a chunk changed, its checksum made good."""
    offset, length = chunk
    changed = bytearray(content)
    at = offset + index * len(packed)
    changed[at:at + len(packed)] = packed
    changed[offset + length:offset + length + 4] = struct.pack("<I", fletcher32(bytes(changed[offset:offset + length])))
    return bytes(changed)


def write_single(content, single, packed):
    """A copy of the content with a single number changed, the checksum of its header made good."""
    offset, (begin, end) = single
    changed = bytearray(content)
    changed[offset:offset + 8] = packed
    changed[end:end + 4] = struct.pack("<I", lookup3(bytes(changed[begin:end])))
    return bytes(changed)
