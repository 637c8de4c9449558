"""Reads 8-bit RGB PNG files with the standard library alone."""

import pathlib
import struct
import zlib


class Png:
    """A decoded picture: width, height and at(x, y) -> (red, green, blue)."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        if data[:8] != b"\x89PNG\r\n\x1a\n":
            raise ValueError("not a PNG file")
        packed = b""
        position = 8
        while position < len(data):
            size, kind = struct.unpack_from(">I4s", data, position)
            body = data[position + 8:position + 8 + size]
            check, = struct.unpack_from(">I", data, position + 8 + size)
            if zlib.crc32(kind + body) != check:
                raise ValueError(f"bad checksum in {kind}")
            if kind == b"IHDR":
                self.width, self.height, depth, colour = struct.unpack_from(">IIBB", body)
                if (depth, colour) != (8, 2):
                    raise ValueError(f"depth {depth}, colour type {colour}")
            if kind == b"IDAT":
                packed += body
            position += 12 + size
        self.rows = self._unfilter(zlib.decompress(packed))

    def _unfilter(self, data):
        stride = 3 * self.width
        rows = []
        before = bytes(stride)
        for y in range(self.height):
            start = y * (stride + 1)
            kind = data[start]
            row = bytearray(data[start + 1:start + 1 + stride])
            for i in range(stride):
                left = row[i - 3] if i >= 3 else 0
                up = before[i]
                corner = before[i - 3] if i >= 3 else 0
                row[i] = (row[i] + predict(kind, left, up, corner)) & 0xFF
            rows.append(bytes(row))
            before = rows[-1]
        return rows

    def at(self, x, y):
        return tuple(self.rows[y][3 * x:3 * x + 3])

    def pixels(self):
        for row in self.rows:
            for x in range(self.width):
                yield tuple(row[3 * x:3 * x + 3])


def predict(kind, left, up, corner):
    """The byte that the filter of a row expects."""
    if kind == 4:
        guess = left + up - corner
        return min((left, up, corner), key=lambda value: abs(guess - value))
    return (0, left, up, (left + up) // 2)[kind]
