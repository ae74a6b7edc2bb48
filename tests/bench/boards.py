"""Cycles of a frame on the boards that have an emulator which counts them: rows of the scenes that their programs draw.

A frame's cycles are those from its begin to its end, sending included; while the RP2040's bytes go out by DMA it draws on, and "asleep"
is the part of the cycles in which it waited for the wire. The Uno draws eight frames of each scene, the RP2040 as many as are asked for.
"""

import re
import subprocess

from rows import BenchError

UNO = re.compile(r"(\w+) (\w+) \d+: (\d+) cycles, \d+ ms, \d+ bytes, ")
RP2040 = re.compile(r"frame (\w+) (\w+) \d+ passes (\d+) ms ([\d.]+) asleep ([\d.]+) wire [\d.]+ cycles (\d+)( at [\d.]+)?$")


def mean_rows(frames, target, size):
    """Rows of frames, lists of (scene, method, passes, cycles, cycles asleep or None)."""
    groups = {}
    for scene, method, *numbers in frames:
        groups.setdefault((scene, method), []).append(numbers)
    rows = []
    for (scene, method), of_all in groups.items():
        passes, cycles, asleep = zip(*of_all)
        row = {"model": scene, "target": target, "shade": "scene", "size": size, "tile": "scene", "memory": None, "method": method,
               "unit": "cycles", "faces": None, "passes": sum(passes) / len(passes), "phases": None,
               "total": round(sum(cycles) / len(cycles))}
        if None not in asleep:
            row["asleep"] = round(sum(asleep) / len(asleep))
        rows.append(row)
    return rows


def uno_frames(text):
    return [(m[1], m[2], 1, int(m[3]), None) for m in map(UNO.match, text.splitlines()) if m]


def rp2040_frames(text):
    return [(m[1], m[2], int(m[3]), int(m[6]), int(m[6]) * float(m[5]) / float(m[4])) for m in map(RP2040.match, text.splitlines()) if m]


READERS = {"atmega328p": (uno_frames, "128x64"), "rp2040": (rp2040_frames, "240x240")}


def count(target, command):
    """Rows of a board, by the command that runs its program in the emulator and prints its frames."""
    result = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
    reader, size = READERS[target]
    frames = reader(result.stdout)
    if result.returncode or not frames:
        raise BenchError(f"{target}: {(result.stderr or result.stdout).strip() or 'the emulator has printed no frame'}")
    return mean_rows(frames, target, size)
