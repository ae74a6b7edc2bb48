"""The SiFive E in QEMU: what it puts on the wire, read by the model of the panel's chip, against the simulator's frames.

    sifive_e.py test IMAGE --wire-trace PROGRAM   compares every frame; faults on purpose must be told apart
    sifive_e.py show IMAGE --wire-trace PROGRAM --out FOLDER   saves the frames as PNG
"""

import argparse
import os
import subprocess
import sys

from expected import Simulator, differ
from frames import FAULTS, Frames, read_wanted
from picture import read_ppm
from qemu import EmulatorError, Qemu, counted_frames

PANEL = "ili9341"


def run(arguments, options, folder):
    """The lines that were told, what is to be complained of, and the exit code; the pictures are in the folder."""
    more = counted_frames(arguments.plugin, arguments.image) if arguments.plugin else []
    with Qemu("sifive_e", arguments.image, options, None, arguments.limit, more) as qemu:
        while qemu.line() is not None:
            pass
        code, complaints = qemu.end()
        trace = os.path.join(qemu.folder.name, "wire.trace")
        os.makedirs(folder, exist_ok=True)
        if not os.path.exists(trace):
            return [], complaints + ["there is no wire.trace"], code
        with open(trace, "rb") as file:
            result = subprocess.run([arguments.wire_trace, PANEL, "0", folder], stdin=file, capture_output=True, text=True, check=False)
    complaints += result.stderr.splitlines()
    if result.returncode and not result.stderr:
        complaints.append(f"wire_trace ended with {result.returncode}")
    return result.stdout.splitlines(), complaints, code


def test(arguments):
    wanted, frames = read_wanted(arguments.wanted), Frames()
    simulator = Simulator(arguments.tuile, arguments.models, PANEL, os.path.join(arguments.out, "simulator"))
    folder = os.path.join(arguments.out, "board")
    lines, faults, code = run(arguments, f"frames={arguments.frames}", folder)
    if code:
        faults.append(f"ended with {code}; the last line was: {lines[-1] if lines else ''}")
    for line in lines:
        told = frames.take(line)
        if not told or len(faults) >= 3:
            continue
        scene, method, number = told
        seen = read_ppm(os.path.join(folder, f"{scene}-{method}-{number:02d}.ppm"))
        fault = differ(seen, simulator.frames(scene, method, arguments.frames)[number], f"{scene}-{method}-{number}", arguments.out)
        if fault:
            faults.append(fault)
    faults += frames.faults + frames.missing(wanted, arguments.frames)
    for name, expected in FAULTS.items():
        _, _, code = run(arguments, f"fault={name}", folder)
        if code != expected:
            faults.append(f"fault={name}: ended with {code}, not {expected}")
    if frames.stack and arguments.stack and frames.stack[0] > arguments.stack:
        faults.append(f"{frames.stack[0]} bytes of stack were used, but the call graph has at most {arguments.stack}")
    for fault in faults:
        print(f"rv32imac: {fault}")
    if not faults:
        print(f"rv32imac: {sum(frames.shown.values())} frames of {len(frames.shown)} scenes by methods are the simulator's, bit for bit; "
              f"stack {frames.stack[0]} of {frames.stack[1]} bytes; faults are told")
    return 1 if faults else 0


def show(arguments):
    folder = os.path.join(arguments.out, "board")
    lines, complaints, code = run(arguments, arguments.options, folder)
    frames = Frames()
    counted = iter([text.split()[1] for text in complaints if text.startswith("instructions ")])
    for line in lines:
        told = frames.take(line)
        if not told:
            print(line)
            continue
        path = os.path.join(arguments.out, "{}-{}-{:02d}.png".format(*told))
        read_ppm(os.path.join(folder, "{}-{}-{:02d}.ppm".format(*told))).write(path)
        count = next(counted, None)
        print(line + (f" instructions {count}" if count else "") + f" {path}")
    for text in complaints:
        if not text.startswith("instructions "):
            print(text, file=sys.stderr)
    if code:
        print(f"ended with {code}", file=sys.stderr)
    return 1 if code else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("test", "show"))
    parser.add_argument("image")
    parser.add_argument("--wire-trace", required=True, help="the program that reads the trace")
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
