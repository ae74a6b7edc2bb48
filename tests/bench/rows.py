"""Rows of figures: what a frame costs with one model, on one target, by one method, in one shading. Counted by row.sh."""

import concurrent.futures
import json
import os
import subprocess
import sys
import threading

HERE = os.path.dirname(os.path.abspath(__file__))
HOST = "x86-64"
GUESTS = ("cortex-m0plus", "cortex-m3", "cortex-m4", "cortex-m33", "rv32imac")
BOARDS = ("atmega328p", "rp2040")
SHADES = ("flat", "gouraud", "textured-gouraud")
METHODS = ("zbuffer", "scanline", "warnock", "painter", "tree")
PHASES = ("vertex", "cull", "setup", "span", "clear", "resolve", "helpers")
KEY = ("model", "target", "shade", "size", "tile", "memory", "method")
UNITS = {"K": 1024, "M": 1024 * 1024}


class BenchError(Exception):
    """One line for the user."""


def words(text, allowed, what):
    """The words of an option; every one must be allowed."""
    given = text.split()
    for word in given:
        if word not in allowed:
            raise BenchError(f"{what}={word}: there is none; there are: {' '.join(allowed)}")
    return given


def size_of(text, what):
    """Width and height of WxH; a tile's height may be 0, as high as suits the memory."""
    parts = text.split("x")
    if len(parts) != 2 or not all(part.isdigit() for part in parts) or int(parts[0]) == 0:
        raise BenchError(f"{what}={text}: not WIDTHxHEIGHT")
    return int(parts[0]), int(parts[1])


def bytes_of(text):
    """Of 64K, 4M or a number."""
    digits, unit = (text[:-1], UNITS[text[-1]]) if text[-1:] in UNITS else (text, 1)
    if not digits.isdigit():
        raise BenchError(f"MEMORY={text}: not a number of bytes, as 64K or 4M")
    return int(digits) * unit


class Models:
    """Models by name or file, compiled for the bench: with their textures, and with a display tree where that is asked for.

    known: name to (file, most faces or 0). NAME-N is a known model with at most N faces."""

    def __init__(self, tuile, known, folder):
        self.tuile, self.known, self.folder = tuile, known, folder

    def source(self, word):
        """(name, file, most faces) of what the user calls a model."""
        if word in self.known:
            return (word, *self.known[word])
        name, _, faces = word.rpartition("-")
        if name in self.known and faces.isdigit():
            return word, self.known[name][0], int(faces)
        if not os.path.exists(word):
            raise BenchError(f"MODEL={word}: neither a file nor a model by name; those are: {' '.join(self.known)}, or NAME-FACES")
        return os.path.splitext(os.path.basename(word))[0], word, 0

    def compiled(self, word, tree=False):
        """(name, path of the compiled model)."""
        name, file, faces = self.source(word)
        if file.endswith(".tuile") and not faces:
            if tree:
                raise BenchError(f"{file} is compiled already: the tree's method wants the model that it was made of")
            return name, file
        path = os.path.join(self.folder, "tree" if tree else "plain", name + ".tuile")
        if not os.path.exists(path) or os.path.getmtime(path) < max(os.path.getmtime(file), os.path.getmtime(self.tuile)):
            os.makedirs(os.path.dirname(path), exist_ok=True)
            command = [self.tuile, "mesh", file, "-o", path + ".new.tuile"]
            command += (["--max-faces", str(faces)] if faces else []) + (["--tree"] if tree else [])
            result = subprocess.run(command, capture_output=True, text=True, check=False)
            if result.returncode:
                raise BenchError(f"{file}: {result.stderr.strip() or 'it cannot be compiled'}")
            os.replace(path + ".new.tuile", path)
        return name, path


class Counter:
    """Counts rows, several at a time.

    programs: bench and guest_scene; root: the folder with the raster/ that they were made of; out: a folder for each row."""

    def __init__(self, programs, guest, plugin, out, root=".", jobs=0):
        self.programs, self.out, self.lock = programs, out, threading.Lock()
        self.environment = dict(os.environ, GUEST=os.path.abspath(guest), PLUGIN=os.path.abspath(plugin), ROOT=root)
        self.jobs = jobs or os.cpu_count() or 1

    def count(self, spec, path):
        """The row of a spec, a dictionary of KEY; None when there is no such method for this model."""
        name = "-".join(str(spec[key]) for key in KEY)
        command = ["sh", os.path.join(HERE, "row.sh"), os.path.join(self.out, name), spec["target"], *self.programs, path, spec["size"],
                   spec["tile"], spec["shade"], str(spec["memory"]), spec["method"]]
        result = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        if result.returncode == 3:
            return None
        if result.returncode or not result.stdout:
            raise BenchError(f"{describe(spec)} could not be counted: {result.stderr.strip() or f'exit code {result.returncode}'}")
        fields = result.stdout.split()
        numbers = dict(zip(fields[::2], map(int, fields[1::2])))
        return {**spec, "unit": "instructions", "faces": numbers["faces"], "passes": numbers["passes"] / numbers["frames"],
                "peak": numbers["peak"], "phases": {phase: numbers[phase] for phase in PHASES}, "total": numbers["total"],
                "raster": numbers["raster"]}

    def all(self, wanted, fails=None):
        """Rows of (spec, path) in their order, as they come. An error that fails(spec, error) takes leaves its row out."""
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            futures = [pool.submit(self.count, spec, path) for spec, path in wanted]
            try:
                for (spec, _), future in zip(wanted, futures):
                    try:
                        row = future.result()
                    except BenchError as error:
                        if not fails or not fails(spec, error):
                            raise
                        continue
                    if row:
                        yield row
                    else:
                        print(f"{describe(spec)}: not for this model", file=sys.stderr)
            finally:
                for future in futures:
                    future.cancel()


def describe(spec):
    return f"{spec['model']} {spec['target']} {spec['method']} {spec['shade']} {spec['size']} in {spec['tile']}"


def write_json(rows, path):
    with open(path, "w", encoding="utf-8") as file:
        file.write("[\n" + ",\n".join("  " + json.dumps(row) for row in rows) + "\n]\n")


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        raise BenchError(f"{path} is not there: run make bench first") from None


COLUMNS = "{:<12} {:<13} {:<8} {:<16} {:<8} {:>7} {:>7} {:>10}" + " {:>9}" * len(PHASES)


def head():
    return COLUMNS.format("model", "target", "method", "shade", "window", "tile", "faces", "total", *PHASES)


def line(row):
    phases = row["phases"] or {}
    text = COLUMNS.format(row["model"], row["target"], row["method"], row["shade"], row["size"], row["tile"], row["faces"] or "",
                          row["total"], *(phases.get(phase, "") for phase in PHASES)).rstrip()
    return text + ("  cycles" if row["unit"] == "cycles" else "")
