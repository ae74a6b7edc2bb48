"""Boards whose emulator has no panel, in QEMU: what they put on the wire, read by the model of a panel's chip, against the simulator's frames.

    wire_board.py test IMAGE --board sifive_e --wire-trace PROGRAM   compares every frame; faults on purpose must be told apart
    wire_board.py show IMAGE --board sifive_e --wire-trace PROGRAM --out FOLDER   saves the frames as PNG
"""

import os
import sys

from expected import Simulator, differ
from frames import FAULTS, Frames, read_wanted
from picture import read_ppm
from qemu import Qemu, counted_frames
from script import run_script, show_end, show_frame, verdict
from wire import read_wire

# The machine, its core, and the panel: firmware/BOARD/board.c, or firmware/mps2/ with the board's other objects.
BOARDS = {
    "sifive_e": ("sifive_e", "rv32imac", "ili9341"),
    "blackpill": ("mps2-an386", "cortex-m4", "st7789-240x240"),
    "pico2": ("mps2-an505", "cortex-m33", "st7789-240x240"),
}


def run(arguments, options, folder):
    """The lines that were told, what is to be complained of, and the exit code; the pictures are in the folder."""
    machine, _, panel = BOARDS[arguments.board]
    more = counted_frames(arguments.plugin, arguments.image) if arguments.plugin else []
    with Qemu(machine, arguments.image, options, None, arguments.limit, more) as qemu:
        while qemu.line() is not None:
            pass
        code, complaints = qemu.end()
        lines, refused = read_wire(arguments.wire_trace, panel, qemu, folder)
    return lines, complaints + refused, code


def test(arguments):
    wanted, frames = read_wanted(arguments.wanted), Frames()
    _, core, panel = BOARDS[arguments.board]
    simulator = Simulator(arguments.tuile, arguments.models, panel, os.path.join(arguments.out, "simulator"))
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
    return 0 if verdict(f"{arguments.board}, {core}", faults, frames) else 1


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
        seen = read_ppm(os.path.join(folder, "{}-{}-{:02d}.ppm".format(*told)))
        show_frame(line, told, seen, next(counted, None), arguments.out)
    return show_end(complaints, code)


def more(parser):
    parser.add_argument("--board", required=True, choices=tuple(BOARDS))
    parser.add_argument("--wire-trace", required=True, help="the program that reads the trace")


sys.exit(run_script(__doc__, test, show, more))
