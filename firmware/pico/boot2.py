"""The second stage of an RP2040: 252 bytes and a check sum over them, which the boot ROM demands (RP2040 data sheet, 2.8.1.3.1).

boot2.py seal CODE OUT.c     the code, filled up and sealed, as a C array in the section .boot2
boot2.py check IMAGE         fails unless the image's first 256 bytes are sealed
"""
import sys

CODE_BYTES = 252


def crc32(data):
    """Polynomial 04c11db7, from ffffffff, highest bits first, not inverted."""
    crc = 0xffffffff
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04c11db7 if crc & 0x80000000 else 0)) & 0xffffffff
    return crc


def seal(code):
    if len(code) > CODE_BYTES:
        sys.exit(f"boot2: {len(code)} bytes, but there is room for {CODE_BYTES}")
    code = code.ljust(CODE_BYTES, b"\0")
    return code + crc32(code).to_bytes(4, "little")


def check(image):
    told = int.from_bytes(image[CODE_BYTES:CODE_BYTES + 4], "little")
    if len(image) < CODE_BYTES + 4 or told != crc32(image[:CODE_BYTES]):
        sys.exit(f"boot2: the check sum is {told:08x}, which the boot ROM will refuse: it should be {crc32(image[:CODE_BYTES]):08x}")


def main():
    # The check value of this CRC, as catalogues of CRCs give it for "123456789" (CRC-32/MPEG-2).
    assert crc32(b"123456789") == 0x0376e6e7
    if sys.argv[1] == "seal":
        with open(sys.argv[2], "rb") as file:
            sealed = seal(file.read())
        rows = [", ".join(f"0x{b:02x}" for b in sealed[i:i + 16]) for i in range(0, 256, 16)]
        with open(sys.argv[3], "w", encoding="ascii") as file:
            file.write("/* Made by boot2.py. */\n#include <stdint.h>\n\n"
                       '__attribute__((section(".boot2"), used)) static const uint8_t boot2[256] = {\n    '
                       + ",\n    ".join(rows) + ",\n};\n")
    else:
        with open(sys.argv[2], "rb") as file:
            check(file.read())


main()
