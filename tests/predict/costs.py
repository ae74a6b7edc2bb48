"""Instructions of the events that frames consist of (sim/predict.h), fitted to counted ones.

    costs.py fit    OPTIONS   counts the frames of SCENES and TEXTURED by QEMU on each core, and writes sim/predict_costs.c
    costs.py check  OPTIONS   counts those of OTHERS, of which the fit knows nothing; fails where the table is more than LIMIT off (LIMIT_TEXTURED)
    costs.py cycles OPTIONS   cycles of an instruction by the cores' reference manuals (cycles.py), for sim/mcu.c
"""
import argparse
import os
import re
import statistics
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "bench"))
import bench  # noqa: E402
import cycles  # noqa: E402
import rows  # noqa: E402

CORES = ("cortex-m0plus", "cortex-m4", "rv32imac")
PLAIN = ("flat", "gouraud")
TEXTURED_SHADES = ("textured-flat", "textured-gouraud")
KINDS = ("small", "large", "polygon")
EVENTS = ("frame", "cluster", "vertex", "face tested", "polygon tested", "face clipped", "face binned", "face set up", "tile", "tile sample",
          *(f"{kind} {what}" for what in ("in tile", "row", "fragment") for kind in KINDS))
# Byte summed: so many instructions has the loop of firmware/update.c for sixteen bytes, by the listings of gcc 12; of -Os for the M0+, as
# the Pico is built: -O2 makes 72 of it, since it takes that core's multiplication for slow.
SUMMED = {"cortex-m0plus": 21 / 16, "cortex-m4": 16 / 16, "rv32imac": 27 / 16}
MEMORY = 3 << 20
FRAMES = 8
LIMIT, LIMIT_TEXTURED = 0.15, 0.35
TABLE = "sim/predict_costs.c"

# Which events a phase of `make bench` consists of. Helpers, which all phases call, are fitted to all.
IN_TILE, ROW, FRAGMENT = EVENTS[10:13], EVENTS[13:16], EVENTS[16:19]
PHASES = {
    "vertex": ("cluster", "vertex"),
    "cull": ("frame", "cluster", "face clipped"),
    "setup": ("frame", "face tested", "polygon tested", "face clipped", "face binned", "face set up", "tile", *IN_TILE, *ROW),
    "span": ("tile", "tile sample", *IN_TILE, *ROW, *FRAGMENT),
    "clear": ("tile", "tile sample"),
    "resolve": ("tile", "tile sample"),
    "helpers": EVENTS,
}

# Models of small and of large faces, of triangles and of polygons, in windows and tiles of all kinds.
SCENES = (
    ("sphere", "320x240", "320x24"), ("sphere", "128x128", "128x8"), ("sphere", "480x320", "32x32"), ("sphere", "240x240", "240x240"),
    ("spider", "320x240", "320x8"), ("spider", "240x240", "240x24"), ("spider", "128x160", "128x160"), ("spider", "480x320", "480x16"),
    ("bunny", "240x240", "240x24"), ("bunny", "160x128", "160x8"), ("bunny", "480x320", "480x16"), ("bunny", "320x240", "32x32"),
    ("bunny-1500", "320x240", "320x8"), ("bunny-1500", "240x320", "240x16"), ("bunny-400", "240x240", "240x8"), ("bunny-400", "480x320", "480x24"),
    ("room", "320x240", "320x24"), ("room", "128x128", "128x8"), ("room", "480x320", "64x32"),
    ("beams", "240x320", "240x16"), ("beams", "480x320", "480x8"), ("beams", "480x320", "480x320"),
    ("ball-8", "480x320", "480x24"), ("ball-8", "240x240", "240x8"), ("ball-4", "320x240", "320x24"), ("ball-4", "480x320", "64x32"),
    ("house", "480x320", "480x16"), ("house", "128x128", "128x16"), ("spider", "128x160", "128x16"),
    ("inside-1", "320x240", "320x24"), ("inside-1", "240x240", "240x8"), ("inside-3", "240x240", "240x16"), ("inside-3", "128x160", "128x16"),
    ("cube", "240x240", "240x24"), ("cube", "128x64", "128x8"), ("cube", "480x320", "32x32"),
)
TEXTURED = (
    ("ball-24", "320x240", "320x24"), ("ball-24", "128x128", "128x8"), ("ball-24", "480x320", "32x32"),
    ("ball-8", "320x240", "320x24"), ("ball-8", "480x320", "480x16"), ("ball-8", "160x128", "160x8"), ("ball-60", "320x240", "320x24"),
    ("ball-60", "160x128", "160x16"), ("spider", "320x240", "320x24"), ("spider", "128x160", "128x16"), ("spider", "480x320", "480x16"),
    ("spider", "240x240", "240x240"), ("floor", "320x240", "320x24"), ("floor", "128x128", "128x8"), ("floor", "480x320", "480x16"),
)
OTHERS = (
    ("sphere", "240x320", "240x16"), ("spider", "320x240", "320x24"), ("bunny", "320x240", "320x24"), ("bunny-3000", "240x240", "240x22"),
    ("bunny-800", "128x160", "128x16"), ("room", "240x240", "240x16"), ("beams", "320x240", "320x24"), ("cube", "320x240", "320x24"),
    ("house", "320x240", "320x24"), ("ball-6", "320x240", "320x16"),
    ("inside-2", "240x240", "240x24"),
)
OTHERS_TEXTURED = (
    ("ball-36", "240x320", "240x16"), ("ball-14", "320x240", "320x24"), ("spider", "240x320", "240x16"), ("floor", "240x240", "240x16"),
)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("fit", "check", "cycles"))
    bench.add_common(parser)
    parser.add_argument("--events", required=True, help="predict_events")
    return parser.parse_args()


def write_ball(folder, belts):
    """A sphere of triangles with a texture that goes round it four times."""
    sides = 2 * belts
    path = os.path.join(folder, f"ball-{belts}.obj")
    os.makedirs(folder, exist_ok=True)
    from math import cos, pi, sin
    with open(path, "w", encoding="ascii") as file:
        file.write(f"mtllib ball-{belts}.mtl\nusemtl tiles\n")
        for i in range(belts + 1):
            for j in range(sides + 1):
                a, b = pi * i / belts, 2 * pi * j / sides
                file.write(f"v {sin(a) * sin(b):.6f} {cos(a):.6f} {sin(a) * cos(b):.6f}\nvt {4 * j / sides:.6f} {2 * (1 - i / belts):.6f}\n")
        for i in range(belts):
            for j in range(sides):
                a = i * (sides + 1) + j + 1
                b = a + sides + 1
                for face in ((a, b, b + 1),) * (i + 1 < belts) + ((a, b + 1, a + 1),) * (i > 0):
                    file.write("f " + " ".join(f"{v}/{v}" for v in face) + "\n")
    with open(path[:-3] + "mtl", "w", encoding="ascii") as file:
        file.write(f"newmtl tiles\nKd 1 1 1\nmap_Kd {os.path.abspath('tests/models/tiles.png')}\n")
    return path


def write_inside(folder, parts):
    """A room, each wall of parts times parts quads, that the turntable takes round the camera: walls pass through the near plane."""
    path = os.path.join(folder, f"inside-{parts}.obj")
    os.makedirs(folder, exist_ok=True)
    centre, size, corners = (0.0, 0.0, 2.6), 1.0, 0
    with open(path, "w", encoding="ascii") as file:
        for axis in range(3):
            for side in (-1, 1):
                for i in range(parts):
                    for j in range(parts):
                        for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                            place = [0.0, 0.0, 0.0]
                            place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side * size, size * (2 * a / parts - 1), size * (2 * b / parts - 1)
                            file.write("v " + " ".join(f"{c + p:.6f}" for c, p in zip(centre, place)) + "\n")
                        ring = range(corners + 1, corners + 5)
                        file.write("f " + " ".join(str(v) for v in (ring if side < 0 else reversed(ring))) + "\n")
                        corners += 4
    return path


MADE = {"ball": write_ball, "inside": write_inside}


def compiled(models, folder, name):
    kind, _, number = name.partition("-")
    if kind in MADE:
        models.known[name] = (MADE[kind](folder, int(number)), 0)
    return models.compiled(name)[1]


def events_of(program, model, size, tile, shade):
    command = [program, model, *size.split("x"), *tile.split("x"), shade, str(MEMORY)]
    for line in subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines():
        if line.startswith("events "):
            return [int(word) / FRAMES for word in line.split()[1:1 + len(EVENTS)]]
    raise rows.BenchError(f"{model}: no events")


def counted(arguments, plain, textured):
    """By core and shading: lists of (name, row of the bench, events), of a frame's."""
    models, folder = bench.models_of(arguments), os.path.join(arguments.out, "balls")
    wanted, found = [], {}
    for scenes, shades in ((plain, PLAIN), (textured, TEXTURED_SHADES)):
        for name, size, tile in scenes:
            path = compiled(models, folder, name)
            for shade in shades:
                events = events_of(arguments.events, path, size, tile, shade)
                wanted += [(dict(bench.spec_of(name, core, "zbuffer", shade, size, tile, MEMORY), events=events), path) for core in CORES]
    for row in bench.counter_of(arguments).all(wanted):
        found.setdefault((row["target"], row["shade"]), []).append((f"{row['model']} {row['size']} in {row['tile']}", row, row["events"]))
        print(rows.line(row), flush=True)
    rows.write_json([row for some in found.values() for _, row, _ in some], os.path.join(arguments.out, "predict.json"))
    return found


def least_squares(equations, wanted, unknowns):
    """No unknown below 0: one after another, until nothing moves."""
    found, rest = {i: 0.0 for i in unknowns}, list(wanted)
    squares = {i: sum(e[i] * e[i] for e in equations) for i in unknowns}
    for _ in range(20000):
        moved = 0.0
        for i in unknowns:
            if squares[i] == 0:
                continue
            now = max(0.0, found[i] + sum(e[i] * r for e, r in zip(equations, rest)) / squares[i])
            step = now - found[i]
            if step:
                rest = [r - e[i] * step for e, r in zip(equations, rest)]
                moved = max(moved, abs(step) / (now + 1))
                found[i] = now
        if moved < 1e-8:
            break
    return found


def fit(some):
    """Instructions of each event: phase by phase, errors relative to the whole frame."""
    costs = [0.0] * len(EVENTS)
    equations = [[e / row["total"] for e in events] for _, row, events in some]
    for phase, names in PHASES.items():
        wanted = [row["phases"][phase] / row["total"] for _, row, _ in some]
        for i, cost in least_squares(equations, wanted, [EVENTS.index(name) for name in names]).items():
            costs[i] += cost
    return costs


def errors(costs, some):
    return [(sum(c * e for c, e in zip(costs, events)) / row["total"] - 1, name) for name, row, events in some]


def write(fits):
    with open(TABLE, "w", encoding="ascii") as file:
        file.write('/* Instructions of an event, times 1000. Generated by `make predict-costs`; do not edit. */\n#include "predict.h"\n\n'
                   "/* clang-format off */\nconst predict_costs_t predict_costs[] = {\n    /* " + ", ".join((*EVENTS, "byte summed")) + " */\n")
        for (core, shade), costs in fits.items():
            numbers = ", ".join(str(round(1000 * c)) for c in (*costs, SUMMED[core]))
            file.write(f'    {{"{core}", {"TUILE_GOURAUD" if "gouraud" in shade else "TUILE_FLAT"}, '
                       f'{"true" if shade.startswith("textured-") else "false"}, {{{numbers}}}}},\n')
        file.write("};\n/* clang-format on */\nconst unsigned predict_costs_count = sizeof predict_costs / sizeof predict_costs[0];\n")


def read():
    fits = {}
    with open(TABLE, encoding="ascii") as file:
        for core, shade, textured, numbers in re.findall(r'\{"(.*?)", TUILE_(\w+), (\w+), \{(.*?)\}\}', file.read()):
            fits[core, ("textured-" if textured == "true" else "") + shade.lower()] = [int(n) / 1000 for n in numbers.split(",")]
    return fits


def tell(fits, found):
    """Prints how far off the fits are; returns whether all are within LIMIT."""
    within = True
    for key, some in found.items():
        all_errors = errors(fits[key], some)
        off, name = max(all_errors, key=lambda e: abs(e[0]))
        mean = statistics.fmean(abs(e[0]) for e in all_errors)
        within = within and abs(off) <= (LIMIT_TEXTURED if key[1].startswith("textured") else LIMIT)
        print(f"{key[0]:<14} {key[1]:<17} {len(some):>3} scenes: {100 * mean:4.1f} % off in the mean, at worst {100 * off:+.1f} % ({name})")
    return within


def count_cycles(arguments):
    models = bench.models_of(arguments)
    counter = bench.counter_of(arguments)
    folder = os.path.join(arguments.out, "cycles")
    os.makedirs(folder, exist_ok=True)
    for core in cycles.TABLES:
        each = []
        for name, size, tile in SCENES[::3]:
            for shade in PLAIN:
                command = ["sh", os.path.join(rows.HERE, "qemu/run.sh"), folder, core, counter.programs[1], compiled(models, folder, name), *size.split("x"),
                           *tile.split("x"), shade, str(MEMORY)]
                subprocess.run(command, env=counter.environment, check=True, stdout=subprocess.DEVNULL)
                instructions, taken = cycles.of_run(core, os.path.join(folder, "guest.elf"), os.path.join(folder, "counts.txt"))
                each.append(taken / instructions)
                print(f"{core} {name} {shade} {size} in {tile}: {each[-1]:.3f} cycles an instruction", flush=True)
        print(f"{core}: {statistics.fmean(each):.3f} in the mean, {min(each):.3f} to {max(each):.3f}")


def main():
    arguments = parse()
    try:
        if arguments.command == "cycles":
            count_cycles(arguments)
            return 0
        if arguments.command == "check":
            if tell(read(), counted(arguments, OTHERS, OTHERS_TEXTURED)):
                return 0
            raise rows.BenchError(f"predicted instructions are more than {100 * LIMIT:.0f} % off, or {100 * LIMIT_TEXTURED:.0f} with textures; make predict-costs fits them anew")
        found = counted(arguments, SCENES, TEXTURED)
        fits = {key: fit(some) for key, some in found.items()}
        write(fits)
        tell(fits, found)
    except rows.BenchError as error:
        print(f"predict: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
