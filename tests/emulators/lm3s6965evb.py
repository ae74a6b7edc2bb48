"""The LM3S6965 board in QEMU: each frame of its panel, as QEMU's own SSD0323 shows it, against the simulator's.

    lm3s6965evb.py test IMAGE --cpu cortex-m0,cortex-m3 ...   compares every frame; faults on purpose must be told apart
    lm3s6965evb.py show IMAGE --out FOLDER [--plugin LIB]     saves the frames as PNG, and tells instructions of each
"""

import argparse
import os
import sys

from expected import Simulator, differ
from frames import FAULTS, Frames, read_wanted
from picture import read_ppm, reduce
from qemu import EmulatorError, Qemu, counted_frames

MAGNIFIED = 4  # QEMU draws a pixel of the panel as a square of 4 x 4, and a level v of 15 as 17 v


def look(qemu, path):
    """The panel's picture as it is."""
    qemu.screendump(path)
    return reduce(read_ppm(path), MAGNIFIED)


def run_frames(image, cpu, simulator, wanted, count, folder, limit_s):
    """Faults of one run, as lines; and its Frames."""
    frames, faults = Frames(), []
    with Qemu("lm3s6965evb", image, f"frames={count}", cpu, limit_s) as qemu:
        while (line := qemu.line()) is not None:
            told = frames.take(line)
            if not told:
                continue
            scene, method, number = told
            try:
                seen = look(qemu, os.path.join(qemu.folder.name, "screen.ppm"))
                fault = differ(seen, simulator.frames(scene, method, count)[number], f"{cpu}-{scene}-{method}-{number}", folder)
            except ValueError as error:
                fault = f"{scene} {method} {number}: the screen is no magnified picture: {error}"
            if fault:
                faults.append(fault)
                if len(faults) == 3:
                    return faults + ["and so on"], frames
            qemu.go_on()
        code, complaints = qemu.end()
        if code:
            faults.append(f"ended with {code}{qemu.told()}")
        faults += [f"QEMU: {line}" for line in complaints[:5]]
    return faults + frames.faults + frames.missing(wanted, count), frames


def run_fault(image, cpu, name, limit_s):
    """A fault on purpose must end the program with its code."""
    with Qemu("lm3s6965evb", image, f"fault={name}", cpu, limit_s) as qemu:
        while qemu.line() is not None:
            pass
        code, _ = qemu.end()
        return [] if code == FAULTS[name] else [f"fault={name}: ended with {code}, not {FAULTS[name]}{qemu.told()}"]


def test(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    wanted = read_wanted(arguments.wanted)
    simulator = Simulator(arguments.tuile, arguments.models, "ssd0323", os.path.join(arguments.out, "simulator"))
    failed = False
    for pair in arguments.cpu.split(","):
        cpu, image = pair.split(":") if ":" in pair else (pair, arguments.image)
        try:
            faults, frames = run_frames(image, cpu, simulator, wanted, arguments.frames, arguments.out, arguments.limit)
            for name in FAULTS:
                faults += run_fault(image, cpu, name, arguments.limit)
            if frames.stack and arguments.stack and frames.stack[0] > arguments.stack:
                faults.append(f"{frames.stack[0]} bytes of stack were used, but the call graph has at most {arguments.stack}")
        except EmulatorError as error:
            faults, frames = [str(error)], None
        for fault in faults:
            print(f"{cpu}: {fault}")
        failed = failed or bool(faults)
        if frames and not faults:
            print(f"{cpu}: {sum(frames.shown.values())} frames of {len(frames.shown)} scenes by methods are the simulator's, bit for bit; "
                  f"stack {frames.stack[0]} of {frames.stack[1]} bytes; faults are told")
    return 1 if failed else 0


def show(arguments):
    os.makedirs(arguments.out, exist_ok=True)
    more = []
    if arguments.plugin:
        more = counted_frames(arguments.plugin, arguments.image)
    frames, shown = Frames(), 0
    cpu = arguments.cpu.split(",")[0]
    with Qemu("lm3s6965evb", arguments.image, arguments.options, cpu, arguments.limit, more) as qemu:
        while (line := qemu.line()) is not None:
            told = frames.take(line)
            if not told:
                print(line)
                continue
            path = os.path.join(arguments.out, "{}-{}-{:02d}.png".format(*told))
            look(qemu, os.path.join(qemu.folder.name, "screen.ppm")).write(path)
            shown += 1
            counted = qemu.counted(shown) if arguments.plugin else None
            print(line + (f" instructions {counted}" if counted else "") + f" {path}")
            qemu.go_on()
        code, complaints = qemu.end()
        for text in complaints:
            if not text.startswith("instructions "):
                print(text, file=sys.stderr)
        if code:
            print(f"ended with {code}{qemu.told()}", file=sys.stderr)
    return 1 if code else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("test", "show"))
    parser.add_argument("image")
    parser.add_argument("--cpu", default="cortex-m3", help="names of QEMU, each with an image of its own behind a colon or without")
    parser.add_argument("--wanted", help="the board's list of scenes and methods")
    parser.add_argument("--tuile", default="build/tuile")
    parser.add_argument("--models", default="build/firmware/models")
    parser.add_argument("--frames", type=int, default=8)
    parser.add_argument("--out", required=True, help="folder for pictures")
    parser.add_argument("--limit", type=float, default=60, help="seconds of one run")
    parser.add_argument("--stack", type=int, help="most bytes of stack that the call graph allows")
    parser.add_argument("--plugin", help="counter of instructions")
    parser.add_argument("--options", default="", help="of the program, like 'scene=spider frames=4'")
    arguments = parser.parse_args()
    try:
        return (test if arguments.what == "test" else show)(arguments)
    except (EmulatorError, RuntimeError) as error:
        print(error, file=sys.stderr)
        return 1


sys.exit(main())
