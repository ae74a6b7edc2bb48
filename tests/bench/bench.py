"""Counts what frames cost, and prints a table and OUT/bench.json.

    bench.py rows  OPTIONS MODEL...   every method, tile and shading
    bench.py sweep OPTIONS MODEL      OUT/sweep.json for the charts: the cost against faces, pixels and memory

The first of the methods in the first of the tiles is counted on every target, all else on x86-64. A board's rows are those of its own
scenes, in cycles.
"""

import argparse
import os
import sys

import boards
import rows
from rows import BenchError

FACES = (500, 1000, 2000, 4000, 8000, 16000, 32000, 69666)
SIZES = ("160x120", "240x180", "320x240", "480x360", "640x480")
MEMORIES = ("8K", "16K", "32K", "64K", "128K", "256K", "512K", "1M", "2M", "4M")
ROOM = 4 * 1024 * 1024  # of a frame in one pass, where nothing else is asked for


def parse():
    parser = parser_of(__doc__, ("rows", "sweep"))
    parser.add_argument("--board", action="append", default=[], metavar="TARGET=COMMAND", help="what prints the frames of a board")
    return parser.parse_args()


def parser_of(doc, commands=()):
    """What this script and compare.py take: models, where things are, and what is to be counted."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    if commands:
        parser.add_argument("command", choices=commands)
    parser.add_argument("models", nargs="+")
    add_common(parser)
    add_choice(parser)
    return parser


def add_common(parser):
    parser.add_argument("--bench", required=True)
    parser.add_argument("--scene", required=True, help="guest_scene")
    parser.add_argument("--guest", required=True, help="folder of the targets' objects")
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--tuile", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--known", action="append", default=[], metavar="NAME=FILE[:FACES]")
    parser.add_argument("--jobs", type=int, default=0)


def add_choice(parser):
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--tiles", default="320x24")
    parser.add_argument("--targets", default=rows.HOST)
    parser.add_argument("--methods", default="zbuffer")
    parser.add_argument("--shades", default=" ".join(rows.SHADES))
    parser.add_argument("--memory", default="4M")


def known_models(texts):
    known = {}
    for text in texts:
        name, _, rest = text.partition("=")
        file, _, faces = rest.partition(":")
        known[name] = (file, int(faces or 0))
    return known


def counter_of(arguments):
    return rows.Counter((arguments.bench, arguments.scene), arguments.guest, arguments.plugin, os.path.join(arguments.out, "rows"),
                        jobs=arguments.jobs)


def models_of(arguments):
    return rows.Models(arguments.tuile, known_models(arguments.known), os.path.join(arguments.out, "models"))


def spec_of(model, target, method, shade, size, tile, memory):
    return dict(zip(rows.KEY, (model, target, shade, size, tile, memory, method)))


def wanted_rows(models, names, targets, methods, shades, size, tiles, memory):
    """Lists of (spec, path): see the head of this file."""
    wanted = []
    if len({models.source(word)[0] for word in names}) < len(names):
        raise BenchError("two models have one name")
    for word in names:
        for tile in tiles:
            for method in methods:
                name, path = models.compiled(word, method == "tree")
                first = tile == tiles[0] and method == methods[0]
                wanted += [(spec_of(name, target, method, shade, size, tile, memory), path)
                           for shade in shades for target in targets if first or target == rows.HOST]
    return wanted


def count_rows(arguments):
    targets = rows.words(arguments.targets, (rows.HOST, *rows.GUESTS, *rows.BOARDS), "TARGETS")
    methods = rows.words(arguments.methods, rows.METHODS, "METHODS")
    shades = rows.words(arguments.shades, (*rows.SHADES, "textured-flat"), "SHADES")
    commands = dict(text.split("=", 1) for text in arguments.board)
    tiles = arguments.tiles.split()
    rows.size_of(arguments.size, "SIZE")
    for tile in tiles:
        rows.size_of(tile, "TILE")
    if not (targets and methods and shades and tiles):
        raise BenchError("TARGETS, METHODS, SHADES and TILE have one word at least")
    wanted = wanted_rows(models_of(arguments), arguments.models, [t for t in targets if t not in rows.BOARDS], methods, shades,
                         arguments.size, tiles, rows.bytes_of(arguments.memory))
    counted, faults = [], []

    def goes_on(_, error):
        faults.append(error)
        print(f"bench: {error}", file=sys.stderr)
        return True

    print(rows.head(), flush=True)
    for row in counter_of(arguments).all(wanted, goes_on):
        print(rows.line(row), flush=True)
        counted.append(row)
    for target in targets:
        for row in boards.count(target, commands[target]) if target in rows.BOARDS else []:
            print(rows.line(row), flush=True)
            counted.append(row)
    rows.write_json(counted, os.path.join(arguments.out, "bench.json"))
    if faults:
        raise BenchError(f"{len(faults)} of {len(wanted)} rows could not be counted")


def sweep(arguments):
    """Faces: of the first model, reduced; pixels and memory: of the second."""
    targets = rows.words(arguments.targets, (rows.HOST, *rows.GUESTS), "SWEEP_TARGETS")
    many, usual = arguments.models[0], arguments.models[-1]
    models = models_of(arguments)
    wanted = []

    def add(axis, word, shades, size, tile, memory):
        name, path = models.compiled(word)
        wanted.extend((dict(spec_of(name, target, "zbuffer", shade, size, tile, memory), axis=axis), path)
                      for shade in shades for target in targets)

    for faces in FACES:
        add("faces", f"{many}-{faces}", rows.SHADES[:2], "320x240", "320x24", ROOM)
    for size in SIZES:
        add("pixels", usual, rows.SHADES, size, size.split("x")[0] + "x24", ROOM)
    for memory in MEMORIES:
        add("memory", usual, rows.SHADES, "320x240", "320x0", rows.bytes_of(memory))

    def too_small(spec, error):
        small = spec["axis"] == "memory" and "wants" in str(error)
        if small:
            print(f"{rows.describe(spec)}: {spec['memory']} bytes are too few", file=sys.stderr)
        return small

    counted = []
    print(rows.head(), flush=True)
    for row in counter_of(arguments).all(wanted, too_small):
        print(rows.line(row), flush=True)
        counted.append(row)
    rows.write_json(counted, os.path.join(arguments.out, "sweep.json"))


def main():
    arguments = parse()
    try:
        (count_rows if arguments.command == "rows" else sweep)(arguments)
    except BenchError as error:
        print(f"bench: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
