"""The harness itself: emulators that hang, die or are not there, frames that differ, are missing or come out of turn, broken traces.

    test_harness.py IMAGE WIRE_TRACE PLUGIN FOLDER   IMAGE: the LM3S6965 board's program; PLUGIN: the counter of instructions
"""

import os
import struct
import subprocess
import sys
import time
import unittest

from expected import differ
from frames import Frames
from picture import Picture, read_ppm, reduce
from qemu import EmulatorError, Qemu, counted_frames

IMAGE, WIRE_TRACE, PLUGIN, FOLDER = sys.argv[1:5]


class Emulator(unittest.TestCase):
    def test_a_program_that_waits_for_ever_ends_by_the_limit(self):
        start = time.monotonic()
        with Qemu("lm3s6965evb", IMAGE, "frames=2", "cortex-m3", 1.5) as machine, self.assertRaises(EmulatorError) as raised:
            while machine.line() is not None:
                pass
        self.assertIn("no end within 1.5 s", str(raised.exception))
        self.assertIn("frame cube zbuffer 0", str(raised.exception))  # its last output
        self.assertLess(time.monotonic() - start, 10)
        self.assertIsNotNone(machine.process.poll())

    def test_an_emulator_that_dies_is_told_by_its_signal(self):
        with Qemu("lm3s6965evb", IMAGE, "frames=2", "cortex-m3", 20) as machine:
            machine.line()
            machine.process.kill()
            while machine.line() is not None:
                pass
            code, _ = machine.end()
        self.assertEqual(code, -9)

    def test_a_missing_image_is_complained_of(self):
        with Qemu("lm3s6965evb", IMAGE + ".none", "", "cortex-m3", 20) as machine:
            while machine.line() is not None:
                pass
            code, complaints = machine.end()
        self.assertNotEqual(code, 0)
        self.assertIn(".none", " ".join(complaints))

    def test_a_missing_emulator_is_told_by_name(self):
        path, os.environ["PATH"] = os.environ["PATH"], ""
        try:
            with self.assertRaises(EmulatorError) as raised:
                Qemu("lm3s6965evb", IMAGE)
        finally:
            os.environ["PATH"] = path
        self.assertIn("qemu-system-arm is not there", str(raised.exception))


    def test_the_bin_and_the_hex_file_are_the_program(self):
        binary, hexadecimal = IMAGE.replace(".elf", ".bin"), IMAGE.replace(".elf", ".hex")
        with Qemu("lm3s6965evb", binary, "frames=1", "cortex-m3", 20) as machine:
            self.assertEqual([machine.line(), machine.line()], ["board 128 64", "frame cube zbuffer 0 passes 1"])
        back = os.path.join(FOLDER, "back.bin")
        subprocess.run(["arm-none-eabi-objcopy", "-I", "ihex", "-O", "binary", hexadecimal, back], check=True)
        with open(binary, "rb") as one, open(back, "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_a_board_that_nobody_answers_has_no_options_and_does_not_end(self):
        with Qemu("lm3s6965evb", IMAGE, "", "cortex-m3", 1.5, semihosting=False) as machine, self.assertRaises(EmulatorError) as raised:
            while machine.line() is not None:
                pass
            self.fail(f"it ended with {machine.end()}")  # QEMU gives up on a processor that locks up
        self.assertIn("no end within 1.5 s", str(raised.exception))
        self.assertEqual(machine.last, ["board 128 64", "frame cube zbuffer 0 passes 1"])


class Counter(unittest.TestCase):
    # By hand: of frame_begins one instruction (bx), then movs, 100 times subs and bne, and bl: 1 + 1 + 200 + 1.
    PROGRAM = """
        .syntax unified
        .cpu cortex-m3
        .thumb
        .word 0x20001000, start + 1
        .type frame_begins, %function
        .globl frame_begins, frame_ends, start
    frame_begins: bx lr
        .type frame_ends, %function
    frame_ends: bx lr
        .type start, %function
    start: bl frame_begins
        movs r0, #100
    1:  subs r0, #1
        bne 1b
        bl frame_ends
        bl frame_begins
        bl frame_ends
        movs r0, #0x20
        ldr r1, =block
        bkpt 0xab
        .balign 4
    block: .word 0x20026, 0
    """

    def test_instructions_are_those_that_were_counted_by_hand(self):
        source, image = os.path.join(FOLDER, "count.s"), os.path.join(FOLDER, "count.elf")
        with open(source, "w", encoding="ascii") as file:
            file.write(self.PROGRAM)
        subprocess.run(["arm-none-eabi-gcc", "-mcpu=cortex-m3", "-mthumb", "-nostdlib", "-Wl,-Ttext=0,-e,start", source, "-o", image], check=True)
        with Qemu("lm3s6965evb", image, "", "cortex-m3", 20, counted_frames(PLUGIN, image)) as machine:
            self.assertEqual((machine.counted(1), machine.counted(2)), ("203", "2"))


class Pictures(unittest.TestCase):
    def test_one_pixel_is_found_and_both_pictures_are_written(self):
        one = Picture(3, 2, bytes(range(18)))
        other = Picture(3, 2, bytes(range(18)).replace(b"\x0c", b"\xff"))  # pixel 4: x 1, y 1
        text = differ(one, other, "pair", FOLDER)
        self.assertIn("1 of 6 pixels differ, the first at 1,1: (12, 13, 14) on the board, (255, 13, 14) in the simulator", text)
        for who in ("board", "simulator"):
            with open(os.path.join(FOLDER, f"pair-{who}.png"), "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertIsNone(differ(one, Picture(3, 2, bytes(range(18))), "pair", FOLDER))

    def test_sizes_that_differ_are_told(self):
        self.assertIn("the board shows 3x2", differ(Picture(3, 2, bytes(18)), Picture(2, 3, bytes(18)), "size", FOLDER))

    def test_a_magnified_picture_is_reduced_and_no_other(self):
        small = [bytes([1, 2, 3]), bytes([4, 5, 6])]
        row = small[0] * 4 + small[1] * 4
        self.assertEqual(reduce(Picture(8, 4, row * 4), 4), Picture(2, 1, small[0] + small[1]))
        for at in (0, 23, 24 * 2 + 5):
            broken = bytearray(row * 4)
            broken[at] ^= 1
            with self.assertRaises(ValueError):
                reduce(Picture(8, 4, bytes(broken)), 4)

    def test_files_are_read_as_they_were_written(self):
        picture = Picture(2, 1, b"\n \t123")  # bytes that look like the header's blanks
        picture.write(os.path.join(FOLDER, "blanks.ppm"))
        self.assertEqual(read_ppm(os.path.join(FOLDER, "blanks.ppm")), picture)


class Lines(unittest.TestCase):
    WANTED = [("cube", "zbuffer"), ("cube", "tree")]

    def take(self, *lines):
        frames = Frames()
        for line in lines:
            frames.take(line)
        return frames

    def test_missing_frames_are_told(self):
        frames = self.take("frame cube zbuffer 0 passes 1", "frame cube zbuffer 1 passes 1", "frame cube tree 0 passes 1")
        self.assertEqual(frames.missing(self.WANTED, 2), ["cube by tree: 1 of 2 frames"])
        self.assertEqual(frames.missing(self.WANTED, 1), [])

    def test_frames_that_nobody_lists_are_told(self):
        self.assertEqual(self.take("frame cube zbuffer 0 passes 1").missing([], 1), ["cube by zbuffer: not in the board's list"])

    def test_frames_out_of_turn_and_errors_are_faults(self):
        self.assertEqual(len(self.take("frame cube zbuffer 1 passes 1").faults), 1)
        self.assertEqual(self.take("error cube zbuffer 0 gone").faults, ["error cube zbuffer 0 gone"])
        self.assertEqual(self.take("nonsense").faults, ["nonsense"])


class Trace(unittest.TestCase):
    """A trace of an ILI9341, by hand: trace.h has the format."""

    def record(self, kind, flag, payload=b"", ms=0):
        return struct.pack("<BBHIQ", kind, flag, 0, len(payload), ms * 1000000) + payload

    def send(self, data, payload, ms):
        return self.record(1, data, struct.pack("<I", 10000000) + payload, ms)

    def command(self, code, payload=b"", ms=300):
        return self.send(0, bytes([code]), ms) + (self.send(1, payload, ms) if payload else b"")

    def setUp(self):
        self.reset = self.record(2, 0, ms=0) + self.record(2, 1, ms=1)
        self.awake = self.command(0x11, ms=130) + self.command(0x3a, b"\x55") + self.command(0x29)
        self.window = self.command(0x2a, b"\0\5\0\5") + self.command(0x2b, b"\0\7\0\7") + self.command(0x2c)
        self.line = self.record(4, 0, b"frame one two 3", 300)

    def run_trace(self, trace, *arguments):
        return subprocess.run([WIRE_TRACE, *(arguments or ("ili9341", "0", FOLDER))], input=trace, capture_output=True, check=False)

    def test_a_pixel_arrives_where_it_was_sent(self):
        pictures = []
        for pixel in (b"\xf8\0", b"\0\x1f"):
            result = self.run_trace(self.reset + self.awake + self.window + self.send(1, pixel, 300) + self.line)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (0, b"frame one two 3\n", b""))
            pictures.append(read_ppm(os.path.join(FOLDER, "one-two-03.ppm")))
        places = pictures[0].differences(pictures[1])  # all else is what the memory holds when power comes up
        self.assertEqual(len(places), 1)
        self.assertIn(places[0], [(x, y) for x in (5, 239 - 5) for y in (7, 319 - 7)])  # the glass may lie either way
        self.assertEqual(pictures[0].pixel(*places[0])[::-1], pictures[1].pixel(*places[0]))  # red and blue

    def test_what_the_chip_refuses_is_an_error(self):
        for trace in (self.reset + self.send(1, b"\x11", 130), self.reset + self.command(0x11, ms=2),
                      self.reset + self.awake + self.command(0x2a, b"\0\5\0") + self.command(0x2c)):
            result = self.run_trace(trace)
            self.assertEqual(result.returncode, 1)
            self.assertIn(b"ILI9341", result.stderr)

    def test_broken_traces_are_errors(self):
        whole = self.reset + self.line
        for trace in (b"", whole[:7], whole[:-1], self.record(9, 0), self.record(1, 0, b"abc"), b"\2\1\1\0" + bytes(12)):
            result = self.run_trace(trace)
            self.assertEqual(result.returncode, 1, trace)
            self.assertEqual(result.stderr.count(b"\n"), 1)

    def test_wrong_arguments_are_told(self):
        self.assertEqual(self.run_trace(b"", "vt100", "0", FOLDER).returncode, 2)
        self.assertEqual(self.run_trace(b"", "ili9341", "45", FOLDER).returncode, 2)


os.makedirs(FOLDER, exist_ok=True)
unittest.main(argv=sys.argv[:1])
