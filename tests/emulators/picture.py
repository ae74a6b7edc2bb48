"""Pictures of 8-bit red, green, blue: binary PPM in, PPM and PNG out."""

import struct
import zlib


class Picture:
    """width * height pixels, rows from the top, 3 bytes each."""

    def __init__(self, width, height, rgb):
        if len(rgb) != 3 * width * height:
            raise ValueError(f"{len(rgb)} bytes are no picture of {width}x{height}")
        self.width, self.height, self.rgb = width, height, bytes(rgb)

    def __eq__(self, other):
        return (self.width, self.height, self.rgb) == (other.width, other.height, other.rgb)

    def pixel(self, x, y):
        at = 3 * (y * self.width + x)
        return tuple(self.rgb[at:at + 3])

    def differences(self, other):
        """The pixels that differ, as a list of (x, y)."""
        return [(i % self.width, i // self.width) for i in range(self.width * self.height)
                if self.rgb[3 * i:3 * i + 3] != other.rgb[3 * i:3 * i + 3]]

    def write(self, path):
        path = str(path)
        with open(path, "wb") as file:
            if path.endswith(".ppm"):
                file.write(b"P6\n%d %d\n255\n" % (self.width, self.height) + self.rgb)
                return
            row = 3 * self.width
            lines = b"".join(b"\0" + self.rgb[row * y:row * (y + 1)] for y in range(self.height))
            file.write(b"\x89PNG\r\n\x1a\n")
            for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)),
                               (b"IDAT", zlib.compress(lines)), (b"IEND", b"")):
                file.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))


def read_ppm(path):
    with open(path, "rb") as file:
        data = file.read()
    fields, at = [], 0
    while len(fields) < 4:
        end = at
        while data[end:end + 1] not in (b" ", b"\n", b"\t"):
            end += 1
        fields.append(data[at:end])
        at = end + 1
    if fields[0] != b"P6" or fields[3] != b"255":
        raise ValueError(f"{path}: no binary PPM of 8 bits")
    return Picture(int(fields[1]), int(fields[2]), data[at:])


def reduce(picture, factor):
    """The picture of which this one is a magnification, each pixel a square of factor x factor; ValueError when it is none."""
    rows = []
    row = 3 * picture.width
    for y in range(0, picture.height, factor):
        first = picture.rgb[row * y:row * (y + 1)]
        small = b"".join(first[at:at + 3] for at in range(0, row, 3 * factor))
        whole = b"".join(small[at:at + 3] * factor for at in range(0, len(small), 3))
        if any(picture.rgb[row * (y + k):row * (y + k + 1)] != whole for k in range(factor)):
            raise ValueError(f"rows {y} to {y + factor - 1} are not a magnified row")
        rows.append(small)
    return Picture(picture.width // factor, picture.height // factor, b"".join(rows))
