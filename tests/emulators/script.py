"""What the scripts of QEMU's boards have in common: their arguments, and how frames and the end are told."""

import argparse
import os
import sys

from qemu import EmulatorError


def verdict(name, faults, frames):
    """Prints how a test ended; returns whether it passed. frames: None when it was not run to its end."""
    for fault in faults:
        print(f"{name}: {fault}")
    if frames and not faults:
        print(f"{name}: {sum(frames.shown.values())} frames of {len(frames.shown)} scenes by methods are the simulator's, bit for bit; "
              f"stack {frames.stack[0]} of {frames.stack[1]} bytes; faults are told")
    return not faults


def show_frame(line, told, picture, instructions, folder):
    """Saves a frame as PNG, and prints its line with the file. told: its scene, method and number; instructions: None when not counted."""
    path = os.path.join(folder, "{}-{}-{:02d}.png".format(*told))
    picture.write(path)
    print(line + (f" instructions {instructions}" if instructions else "") + f" {path}")


def show_end(complaints, code, more=""):
    """Prints what QEMU complained of and a code other than 0, with what else is to be told of it. Returns the script's exit code."""
    for text in complaints:
        if not text.startswith("instructions "):
            print(text, file=sys.stderr)
    if code:
        print(f"ended with {code}{more}", file=sys.stderr)
    return 1 if code else 0


def run_script(doc, test, show, more):
    """The main of a board's script: more(parser) adds what is the board's own. Returns the exit code."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("test", "show"))
    parser.add_argument("image")
    more(parser)
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
