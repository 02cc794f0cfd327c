"""Changes single numbers in HDF5 files without the library, and writes the checksums anew, so that a reader meets the number
and not a damaged file. Knows just what this program writes: little-endian, version-1 chunk trees, Fletcher 32."""

import struct

UNDEFINED = 0xFFFFFFFFFFFFFFFF


def fletcher32(data):
    """The checksum as HDF5 defines it: 16-bit big-endian words, an odd last byte in the upper half."""
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


def chunks(content):
    """(offset, length) of the raw data of every chunk with a valid checksum."""
    found, start = [], 0
    while (start := content.find(b"TREE\x01\x00", start)) >= 0:
        entries = struct.unpack_from("<H", content, start + 6)[0]
        for dimensions in (1, 2):
            key = 8 + 8 * (dimensions + 1)
            for n in range(entries):
                at = start + 24 + n * (key + 8)
                if at + key + 8 > len(content):
                    break
                size = struct.unpack_from("<I", content, at)[0]
                address = struct.unpack_from("<Q", content, at + key)[0]
                if size <= 4 or address == UNDEFINED or address + size > len(content):
                    break
                data, stored = content[address:address + size - 4], content[address + size - 4:address + size]
                if same_checksum(struct.unpack("<I", stored)[0], fletcher32(data)):
                    found.append((address, size - 4))
        start += 4
    return sorted(set(found))


def single_numbers(content):
    """Offsets of single numbers of eight bytes: contiguous data, whose layout message tells address and size."""
    found, start = [], 0
    while (start := content.find(b"\x03\x01", start)) >= 0:
        if start + 18 <= len(content):
            address, size = struct.unpack_from("<QQ", content, start + 2)
            if size == 8 and 0 < address <= len(content) - 8:
                found.append(address)
        start += 1
    return sorted(set(found))


def write_number(content, chunk, index, packed):
    """A copy of the content with one number of a chunk changed, its checksum made good."""
    offset, length = chunk
    changed = bytearray(content)
    at = offset + index * len(packed)
    changed[at:at + len(packed)] = packed
    changed[offset + length:offset + length + 4] = struct.pack("<I", fletcher32(bytes(changed[offset:offset + length])))
    return bytes(changed)
