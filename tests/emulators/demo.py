"""The demo on boards in QEMU: each frame, with the text over it, against the simulator's.

    demo.py lm3s6965evb IMAGE --wanted FILE --out FOLDER                      also presses the board's select switch
    demo.py sifive_e IMAGE --wanted FILE --out FOLDER --wire-trace PROGRAM    the panel is the model of its chip

FILE has the scenes, and the methods that the board draws each by, in the order in which the demo shows them. With one scene only the switch is left alone.
"""

import argparse
import os
import subprocess
import sys
import time

from expected import differ
from frames import read_wanted
from picture import read_ppm
from qemu import EmulatorError, Qemu
from wire import read_wire

PANELS = {"lm3s6965evb": "ssd0323", "sifive_e": "ili9341"}
# Of the select switch: QEMU's board has it at the key Ctrl (hw/arm/stellaris.c).
KEY = {"type": "qcode", "data": "ctrl"}


class Shown:
    """A line "demo SCENE METHOD PHASE RATE" or "skip SCENE METHOD wants BYTES" (firmware/demo/demo.c)."""

    def __init__(self, line):
        words = line.split()
        if len(words) != 5 or words[0] not in ("demo", "skip"):
            raise EmulatorError(f"the demo says: {line}")
        self.scene, self.method, self.phase, self.rate = words[1:]
        self.pair = self.scene, self.method
        self.skipped = words[0] == "skip"  # a moment of a scene for which memory did not suffice
        self.name = f"{self.scene}-{self.method}-{self.phase}"


def simulated(arguments, shown):
    """The simulator's picture of a frame."""
    os.makedirs(arguments.out, exist_ok=True)
    out = os.path.join(arguments.out, "simulator.ppm")
    result = subprocess.run([arguments.tuile, "scene", shown.scene, "--models", arguments.models, "--panel", PANELS[arguments.board],
                             "--method", shown.method, "--phase", shown.phase, "--show-rate", shown.rate, "--show-method", "--out", out],
                            capture_output=True, text=True, check=False)
    if result.returncode:
        raise EmulatorError(f"the simulator cannot draw {shown.name}: {result.stderr.strip()}")
    return read_ppm(out)


def in_turn(told, wanted):
    """Faults: where the pairs leave the order of the list, which begins anew at its end; and what of it was never shown."""
    pairs = [shown.pair for shown in told if shown.pair in wanted]
    shown = {shown.pair for shown in told if not shown.skipped}
    return ([f"change {i} is to {' by '.join(pair)}, not {' by '.join(wanted[i % len(wanted)])}" for i, pair in enumerate(pairs)
             if pair != wanted[i % len(wanted)]][:1] + [f"{' by '.join(pair)} was never shown" for pair in wanted if pair not in shown])


def finish(qemu, faults):
    code, complaints = qemu.end()
    return faults + ([f"ended with {code}{qemu.told()}"] if code else []) + [f"QEMU: {line}" for line in complaints[:5]]


def compare_panel(arguments, qemu, shown):
    try:
        seen = qemu.panel()
    except ValueError as error:
        return [f"{shown.name}: the screen is no magnified picture: {error}"]
    fault = differ(seen, simulated(arguments, shown), shown.name, arguments.out)
    return [fault] if fault else []


def tour_by_time(arguments, wanted):
    """Rounds in which each frame is another scene or method; the faults of them, as lines."""
    faults, told = [], []
    with Qemu("lm3s6965evb", arguments.image, f"tell=1 every=1 frames={3 * len(wanted)}", "cortex-m3", arguments.limit) as qemu:
        while (line := qemu.line()) is not None and len(faults) < 3:
            told.append(Shown(line))
            if told[-1].skipped:
                continue
            faults += compare_panel(arguments, qemu, told[-1])
            qemu.go_on()
        faults = faults if len(faults) >= 3 else finish(qemu, faults)
    return faults + in_turn(told, wanted)


def key(qemu, down):
    qemu.execute("input-send-event", events=[{"type": "key", "data": {"down": down, "key": KEY}}])


def press(arguments, qemu, held_s, wanted_pair):
    """Holds the switch down for so long; frames until the wanted pair is shown. Faults."""
    start, down = time.monotonic(), True
    key(qemu, True)
    while (line := qemu.line()) is not None:
        shown = Shown(line)
        if shown.skipped:
            continue
        if down and time.monotonic() - start >= held_s:
            key(qemu, False)
            down = False
        if not down and shown.pair == wanted_pair and shown.rate != "0":
            return compare_panel(arguments, qemu, shown)
        if time.monotonic() - start > held_s + 5:
            return [f"after {held_s} s of a press {' by '.join(shown.pair)} is shown, not {' by '.join(wanted_pair)}"]
        qemu.go_on()
    return [f"the demo has ended{qemu.told()}"]


def tour_by_hand(arguments, wanted):
    """A short press shows the next method, a long one the next scene, as soon as a rate is known; and nothing moves by itself."""
    faults = []
    first = wanted[0][0]
    other = next(pair for pair in wanted if pair[0] != first)
    with Qemu("lm3s6965evb", arguments.image, "tell=1 every=100000", "cortex-m3", arguments.limit) as qemu:
        qemu.line()
        for down in (True, False):  # until the first key QEMU has the switch at the level of one that is held down
            key(qemu, down)
        for _ in range(10):  # frames in which the demo sees that it is not
            qemu.go_on()
            qemu.line()
            time.sleep(0.01)
        qemu.go_on()
        for held_s, pair in ((0.15, wanted[1]), (1.0, other), (0.15, wanted[wanted.index(other) + 1])):
            faults += press(arguments, qemu, held_s, pair)
            qemu.go_on()
    return faults


def alone(arguments):
    """Without a debugger that answers it, as a board on a desk: frames go on coming."""
    pictures = []
    with Qemu("lm3s6965evb", arguments.image, "", "cortex-m3", arguments.limit, semihosting=False) as qemu:
        for _ in range(2):
            time.sleep(0.7)
            pictures.append(qemu.panel())
    lit = sum(pictures[1].pixel(x, y)[0] == 255 for x in range(128) for y in range(10))
    return ([] if pictures[0] != pictures[1] else ["without a debugger nothing moves"]) + ([] if lit > 60 else ["without a debugger there is no text"])


def trace(arguments, wanted):
    """The frames that a board without a panel has put on its wire."""
    folder, faults, told = os.path.join(arguments.out, "board"), [], []
    with Qemu("sifive_e", arguments.image, f"tell=1 every=1 frames={2 * len(wanted)}", None, arguments.limit) as qemu:
        while qemu.line() is not None:
            pass
        faults = finish(qemu, faults)
        lines, refused = read_wire(arguments.wire_trace, PANELS["sifive_e"], qemu, folder)
    faults += refused
    for line in lines:
        shown = Shown(line)
        told.append(shown)
        if shown.skipped:
            continue
        seen = read_ppm(os.path.join(folder, f"{shown.scene}-{shown.method}-{int(shown.phase):02d}.ppm"))
        fault = differ(seen, simulated(arguments, shown), shown.name, arguments.out)
        faults += [fault] if fault else []
    return faults + in_turn(told, wanted)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("board", choices=tuple(PANELS))
    parser.add_argument("image")
    parser.add_argument("--wanted", required=True)
    parser.add_argument("--tuile", default="build/tuile")
    parser.add_argument("--models", default="build/firmware/models")
    parser.add_argument("--out", required=True, help="folder for pictures")
    parser.add_argument("--wire-trace", help="the program that reads the trace")
    parser.add_argument("--limit", type=float, default=60, help="seconds of one run")
    arguments = parser.parse_args()
    wanted = read_wanted(arguments.wanted)
    try:
        if arguments.board == "sifive_e":
            faults = trace(arguments, wanted)
        else:
            faults = tour_by_time(arguments, wanted) + (tour_by_hand(arguments, wanted) + alone(arguments) if len(dict(wanted)) > 1 else [])
    except EmulatorError as error:
        faults = [str(error)]
    for fault in faults:
        print(f"{arguments.board} demo: {fault}", file=sys.stderr)
    if not faults:
        print(f"{arguments.board} demo: {len(wanted)} scenes by methods, with their text, are the simulator's, bit for bit" +
              ("" if arguments.board == "sifive_e" or len(dict(wanted)) < 2 else "; the switch changes them"))
    return 1 if faults else 0


sys.exit(main())
