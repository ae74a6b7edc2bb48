"""The predicted pace of a Pico held against the emulated one: the time of whole frames, drawn and sent.

Usage: pico.py TUILE MODELS EMULATOR...
EMULATOR: the command that runs the board's program and prints its frames; --options is appended.
"""
import re
import subprocess
import sys

PANEL = "st7789-240x240"
BLOCK = "128K"  # the board's (firmware/rp2/board.c)
FRAMES = 3
LIMIT = 0.15
# Its walls are cut by several planes each, and what that takes is not among the events: only clipped faces are counted.
LIMITS = {"room": 0.35}


def emulated(command):
    """(scene, frame, ms) of the frames that the program prints."""
    text = subprocess.run([*command, "--options", f"panel={PANEL} method=zbuffer frames={FRAMES}"], check=True, capture_output=True, text=True).stdout
    return [(scene, frame, float(ms)) for scene, frame, ms in re.findall(r"^frame (\w+) zbuffer (\d+) .* ms ([\d.]+) ", text, re.MULTILINE)]


def predicted(tuile, models, scene, frame):
    """ms."""
    text = subprocess.run([tuile, "scene", scene, "--models", models, "--first", frame, "--panel", PANEL, "--clock", "62.5M", "--memory", BLOCK, "--mcu", "rp2040"],
                          check=True, capture_output=True, text=True).stdout
    return float(re.search(r"rp2040: .*?\(([\d.]+) ms", text).group(1))


def main():
    tuile, models, *command = sys.argv[1:]
    seen, failed = set(), False
    for scene, frame, ms in emulated(command):
        off, limit = predicted(tuile, models, scene, frame) / ms - 1, LIMITS.get(scene, LIMIT)
        seen.add(scene)
        print(f"{scene} {frame}: {ms:.2f} ms in the emulator, predicted {100 * off:+.1f} %")
        if abs(off) > limit:
            print(f"predict: {scene} {frame}: {100 * limit:.0f} % are allowed", file=sys.stderr)
            failed = True
    if not seen >= {"cube", "room", "spider", "bunny"}:
        print(f"predict: the emulator drew only {' '.join(sorted(seen)) or 'nothing'}", file=sys.stderr)
        failed = True
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
