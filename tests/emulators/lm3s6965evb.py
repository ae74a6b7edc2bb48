"""The LM3S6965 board in QEMU: each frame of its panel, as QEMU's own SSD0323 shows it, against the simulator's.

    lm3s6965evb.py test IMAGE --cpu cortex-m0,cortex-m3 ...   compares every frame; faults on purpose must be told apart
    lm3s6965evb.py show IMAGE --out FOLDER [--plugin LIB]     saves the frames as PNG, and tells instructions of each
"""

import os
import sys

from expected import Simulator, differ
from frames import FAULTS, Frames, read_wanted
from qemu import EmulatorError, Qemu, counted_frames
from script import run_script, show_end, show_frame, verdict


def run_frames(image, cpu, options, simulator, wanted, count, folder, limit_s):
    """Faults of one run, as lines; and its Frames."""
    frames, faults = Frames(), []
    with Qemu("lm3s6965evb", image, f"frames={count} {options}", cpu, limit_s) as qemu:
        while (line := qemu.line()) is not None:
            told = frames.take(line)
            if not told:
                continue
            scene, method, number = told
            try:
                seen = qemu.panel()
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
            faults, frames = run_frames(image, cpu, arguments.options, simulator, wanted, arguments.frames, arguments.out, arguments.limit)
            for name in FAULTS:
                faults += run_fault(image, cpu, name, arguments.limit)
            faults += frames.too_much_stack(arguments.stack)
        except EmulatorError as error:
            faults, frames = [str(error)], None
        failed = not verdict(cpu, faults, frames) or failed
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
            shown += 1
            show_frame(line, told, qemu.panel(), qemu.counted(shown) if arguments.plugin else None, arguments.out)
            qemu.go_on()
        code, complaints = qemu.end()
        return show_end(complaints, code, qemu.told())


def more(parser):
    parser.add_argument("--cpu", default="cortex-m3", help="names of QEMU, each with an image of its own behind a colon or without")


sys.exit(run_script(__doc__, test, show, more))
