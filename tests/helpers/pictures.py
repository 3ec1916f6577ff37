"""Pictures that tests look at, without a library for them."""

import struct
import zlib


def _unfiltered(method, line, before):
    """A line of a PNG of three bytes a pixel, whose bytes were told as differences."""
    if method == 2:
        return bytearray((a + b) & 255 for a, b in zip(line, before))
    for i, value in enumerate(line):
        left, up = line[i - 3] if i >= 3 else 0, before[i]
        if method == 1:
            line[i] = (value + left) & 255
        elif method == 3:
            line[i] = (value + (left + up) // 2) & 255
        elif method == 4:
            corner = before[i - 3] if i >= 3 else 0
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            line[i] = (value + (left if a <= b and a <= c else up if b <= c else corner)) & 255
    return line


def read_png(path):
    """Width, height and rows of (r, g, b) of an 8-bit RGB image without interlacing."""
    data, at, packed, width, height = path.read_bytes(), 8, b"", 0, 0
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 2)
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    raw, stride, rows, before = zlib.decompress(packed), 3 * width, [], bytearray(3 * width)
    for y in range(height):
        start = y * (stride + 1)
        before = _unfiltered(raw[start], bytearray(raw[start + 1:start + 1 + stride]), before)
        rows.append(list(zip(before[::3], before[1::3], before[2::3])))
    return width, height, rows


def rows_of(path):
    """The rows of a trajectory in CSV, by the names of its columns."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names = [word.split()[0].split("(")[0] for word in lines[0].split(",")]
    return [dict(zip(names, map(float, line.split(",")))) for line in lines[1:]]
