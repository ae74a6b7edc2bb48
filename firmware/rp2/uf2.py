"""A UF2 file of a flash image, as the boot ROMs of RP2040 and RP2350 take it over USB.

uf2.py FAMILY ADDRESS IMAGE OUT.uf2     FAMILY and ADDRESS in hexadecimal

Blocks of 512 bytes, each with 256 bytes of the image, their address, and the family that they are for (USB Flashing Format specification; RP2040
data sheet, 2.8.5).
"""
import struct
import sys

MAGIC_0, MAGIC_1, MAGIC_END = 0x0a324655, 0x9e5d5157, 0x0ab16f30
FLAG_FAMILY = 0x2000
PAYLOAD = 256


def uf2(family, address, image):
    count = -(-len(image) // PAYLOAD)
    for number in range(count):
        payload = image[number * PAYLOAD:(number + 1) * PAYLOAD].ljust(476, b"\0")
        yield struct.pack("<8I", MAGIC_0, MAGIC_1, FLAG_FAMILY, address + number * PAYLOAD, PAYLOAD, number, count,
                          family) + payload + struct.pack("<I", MAGIC_END)


def main():
    family, address = (int(text, 16) for text in sys.argv[1:3])
    with open(sys.argv[3], "rb") as file:
        image = file.read()
    with open(sys.argv[4], "wb") as file:
        file.writelines(uf2(family, address, image))


main()
