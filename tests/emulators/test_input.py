"""Wrong input to the targets of boards: unknown boards, a compiler that is not there, models that are none or do not fit.

    test_input.py BUILD    the programs of the boards lm3s6965evb and sifive_e are built there
"""

import hashlib
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

BUILD = sys.argv[1]
FOLDER = tempfile.TemporaryDirectory(prefix="tuile-input-")
CUBE, BEAMS = "firmware/models/cube.obj", "tests/models/beams.obj"


def make(*arguments, **environment):
    """What a user gets who enters it."""
    inherited = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "MODEL")}
    return subprocess.run(["/usr/bin/make", *arguments], env={**inherited, **environment}, capture_output=True, text=True, check=False,
                          timeout=500)


def put(name, text):
    path = os.path.join(FOLDER.name, name)
    with open(path, "w", encoding="ascii") as file:
        file.write(text)
    return path


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def sphere(rings, sides):
    """An OBJ of 2 * sides * (rings - 1) triangles."""
    lines = []
    for ring in range(rings + 1):
        for side in range(sides):
            polar, angle = math.pi * ring / rings, 2 * math.pi * side / sides
            lines.append(f"v {math.sin(polar) * math.cos(angle):.6f} {math.cos(polar):.6f} {math.sin(polar) * math.sin(angle):.6f}")
    for ring in range(rings):
        for side in range(sides):
            a, b = ring * sides + side + 1, ring * sides + (side + 1) % sides + 1
            lines += ([f"f {a} {b} {b + sides}"] if ring > 0 else []) + ([f"f {a} {b + sides} {a + sides}"] if ring < rings - 1 else [])
    return "\n".join(lines) + "\n"


def prism(corners):
    """An OBJ with two faces of so many corners."""
    lines = [f"v {math.cos(2 * math.pi * i / corners):.6f} {math.sin(2 * math.pi * i / corners):.6f} {z}" for z in (0, 1) for i in range(corners)]
    lines.append("f " + " ".join(str(i) for i in range(corners, 0, -1)))
    lines.append("f " + " ".join(str(corners + i) for i in range(1, corners + 1)))
    lines += [f"f {i + 1} {(i + 1) % corners + 1} {corners + (i + 1) % corners + 1} {corners + i + 1}" for i in range(corners)]
    return "\n".join(lines) + "\n"


class Input(unittest.TestCase):
    def refused(self, result, *words):
        """It failed, and one line of stderr, beside make's own, has all the words in it."""
        self.assertNotEqual(result.returncode, 0)
        lines = [line for line in result.stderr.splitlines() if not line.startswith("make")]
        self.assertEqual(len(lines), 1, result.stderr)
        for word in words:
            self.assertIn(word, lines[0])
        return lines[0]

    def test_unknown_boards_are_told_with_those_that_there_are(self):
        for verb in ("firmware", "emulate", "flash", "stack", "size-firmware", "test-firmware"):
            self.refused(make(f"{verb}-arduino"), "There is no board arduino", "pico")

    def test_a_compiler_that_is_not_in_the_path_is_told_by_name(self):
        for board, compiler in (("lm3s6965evb", "arm-none-eabi-gcc"), ("sifive_e", "riscv64-unknown-elf-gcc"), ("uno", "avr-gcc")):
            path = os.path.join(FOLDER.name, compiler)
            os.mkdir(path)
            for name in os.listdir("/usr/bin"):
                if not name.startswith(compiler[:-3]):
                    os.symlink(os.path.join("/usr/bin", name), os.path.join(path, name))
            self.refused(make(f"toolchain-{board}", PATH=path), f"{board}: {compiler} is not there", "PATH")

    def flash_blackpill(self, *tools):
        """With no other flashing tools than these, which are scripts that say how they are called."""
        path = tempfile.mkdtemp(dir=FOLDER.name)
        os.symlink("/usr/bin/grep", os.path.join(path, "grep"))
        for name, text in tools:
            with open(os.path.join(path, name), "w", encoding="ascii") as file:
                file.write(f"#!/bin/sh\n{text}\n")
            os.chmod(os.path.join(path, name), 0o755)
        return subprocess.run(["/bin/sh", "firmware/blackpill/flash.sh", "x.elf", "x.bin"], env={"PATH": path}, capture_output=True, text=True, check=False)

    def test_a_black_pill_is_flashed_by_what_there_is(self):
        found = ("dfu-util", 'case $1 in -l) echo "Found DFU: [0483:df11] alt=0" ;; *) echo "dfu-util $*" ;; esac')
        none = ("dfu-util", 'case $1 in -l) echo "none" ;; *) exit 1 ;; esac')
        st_flash, openocd = ("st-flash", 'echo "st-flash $*"'), ("openocd", 'echo "openocd $*"')
        for tools, wanted in (((found, st_flash), "dfu-util -d 0483:df11 -a 0 -s 0x08000000:leave -D x.bin"), ((none, st_flash, openocd), "st-flash --reset write x.bin 0x08000000"),
                              ((none, openocd), "openocd -f interface/stlink.cfg -f target/stm32f4x.cfg -c program x.elf verify reset exit")):
            result = self.flash_blackpill(*tools)
            self.assertEqual((result.returncode, result.stdout.splitlines()[-1]), (0, wanted))
        self.refused(self.flash_blackpill(none), "hold BOOT0", "openocd")
        self.refused(self.flash_blackpill(), "dfu-util", "apt-get install")

    def test_models_that_are_none_are_told_as_by_tuile_mesh(self):
        for path, word in ((os.path.join(FOLDER.name, "none.obj"), "No such file"), (put("empty.obj", ""), "is empty"), (FOLDER.name, "is a folder"),
                           (put("text.obj", "This is no model.\n"), "text.obj")):
            self.refused(make("firmware-lm3s6965evb", f"MODEL={path}"), path, word)
        self.refused(make("firmware-lm3s6965evb", f"MODEL={CUBE}", "MAX_FACES=many"), "--max-faces many")
        self.refused(make("firmware-uno", f"MODEL={CUBE}"), "uno: no MODEL=FILE")

    def test_a_model_too_large_for_the_flash_is_told_in_bytes_with_a_number_of_faces_that_fits(self):
        path = put("large.obj", sphere(120, 100))
        line = self.refused(make("firmware-lm3s6965evb", f"MODEL={path}"), "lm3s6965evb: ", path)
        size, over, faces = map(int, re.search(r"takes (\d+) bytes of flash, (\d+) more than there are; (\d+) faces fit", line).groups())
        self.assertEqual(size, os.path.getsize(f"{BUILD}/firmware/model/model.tuile"))
        self.assertEqual(make("firmware-lm3s6965evb", f"MODEL={path}", f"MAX_FACES={faces}").returncode, 0)
        room = 262144 - os.path.getsize(f"{BUILD}/firmware/lm3s6965evb-model/demo.bin")
        smaller = os.path.getsize(f"{BUILD}/firmware/model/model.tuile")
        self.assertLessEqual(abs(size - over - (smaller + room)), 8)  # words, and the end of .text, are aligned
        self.assertLess(room, 0.2 * smaller)

    def test_a_model_too_large_for_the_ram_is_told_in_bytes(self):
        path = put("prism.obj", prism(250))
        line = self.refused(make("firmware-sifive_e", f"MODEL={path}"), "sifive_e: ", path)
        least, over = map(int, re.search(r"takes (\d+) bytes of RAM, (\d+) more than", line).groups())
        self.assertEqual(least - over, 10 * 1024)  # the board's block

    def test_another_model_is_built_anew_and_without_one_the_scenes_are_back(self):
        elf, own = (f"{BUILD}/firmware/lm3s6965evb{kind}/demo.elf" for kind in ("", "-model"))
        self.assertEqual(make("firmware-lm3s6965evb").returncode, 0)
        before, seen = digest(elf), []
        for model in (CUBE, BEAMS, CUBE):
            self.assertEqual(make("firmware-lm3s6965evb", f"MODEL={model}").returncode, 0)
            seen.append(digest(own))
        self.assertEqual(seen[0], seen[2])
        self.assertNotEqual(seen[0], seen[1])
        self.assertEqual(make("firmware-lm3s6965evb").returncode, 0)
        self.assertEqual(digest(elf), before)

    def test_the_board_shows_the_model(self):
        wanted = put("wanted", "model zbuffer scanline warnock painter tree\n")
        self.assertEqual(make("firmware-lm3s6965evb", f"MODEL={CUBE}", "TREE=1").returncode, 0)
        result = subprocess.run([sys.executable, "tests/emulators/demo.py", "lm3s6965evb", f"{BUILD}/firmware/lm3s6965evb-model/demo.elf", "--wanted",
                                 wanted, "--tuile", f"{BUILD}/tuile", "--models", f"{BUILD}/firmware/model", "--out", FOLDER.name],
                                capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))


unittest.main(argv=sys.argv[:1])
