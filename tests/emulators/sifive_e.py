"""The SiFive E in QEMU: what it puts on the wire, read by the model of the panel's chip, against the simulator's frames.

    sifive_e.py test IMAGE --wire-trace PROGRAM   compares every frame; faults on purpose must be told apart
    sifive_e.py show IMAGE --wire-trace PROGRAM --out FOLDER   saves the frames as PNG
"""

import os
import subprocess
import sys

from expected import Simulator, differ
from frames import FAULTS, Frames, read_wanted
from picture import read_ppm
from qemu import Qemu, counted_frames
from script import run_script, verdict

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
    faults += frames.too_much_stack(arguments.stack)
    return 0 if verdict("rv32imac", faults, frames) else 1


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


def more(parser):
    parser.add_argument("--wire-trace", required=True, help="the program that reads the trace")


sys.exit(run_script(__doc__, test, show, more))
