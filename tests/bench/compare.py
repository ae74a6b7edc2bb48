"""What a change did: counts another revision and this tree, with the same models and the same bench, and prints both by phase.

    compare.py OPTIONS --base REVISION MODEL...

The revision is unpacked and built in OUT/base/COMMIT, with this tree's tests/bench in the place of its own. Per cent are of what it took.
"""

import os
import shutil
import subprocess
import sys

import bench
import rows
from rows import BenchError

SHOWN = ("total", *rows.PHASES)
PROGRAMS = ("build/release/bench", "build/release/guest_scene")


def run(command, what, **options):
    result = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if result.returncode:
        last = (result.stderr.strip() or result.stdout.strip()).splitlines()[-5:]
        raise BenchError(what + ("".join("\n    " + line for line in last) if last else ""))
    return result.stdout.strip()


def commit_of(revision):
    if not revision:
        raise BenchError("BASE=REVISION is wanted: make bench-compare BASE=HEAD~1")
    return run(["git", "rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{commit}"],
               f"BASE={revision}: there is no such revision")


def unpack(commit, folder):
    """The commit's files, once; and tests/bench of this tree, as it is now."""
    if not os.path.exists(os.path.join(folder, "Makefile")):
        os.makedirs(folder, exist_ok=True)
        archive = os.path.join(folder, "tree.tar")
        run(["git", "archive", "-o", archive, commit], f"{commit} cannot be unpacked")
        run(["tar", "-xf", archive, "-C", folder], f"{archive} cannot be unpacked")
        os.remove(archive)
        if not os.path.isdir(os.path.join(folder, "raster")) or not os.path.exists(os.path.join(folder, "Makefile")):
            raise BenchError(f"BASE={commit[:12]} has no Makefile or no raster/")
    here = os.path.dirname(os.path.abspath(__file__))
    there = os.path.join(folder, "tests", "bench")
    shutil.rmtree(there, ignore_errors=True)
    shutil.copytree(here, there, ignore=shutil.ignore_patterns("__pycache__"))  # with its times: nothing is built twice


def build(folder, make, jobs, guests):
    """The host's programs by the revision's own Makefile, hardly optimising what is not counted; raster/ for the targets by this one."""
    what = f"{folder} cannot be built with this tree's bench:"
    environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MAKEOVERRIDES")}
    run([make, "--no-print-directory", f"-j{jobs}", "-C", folder, "CFLAGS_HOST=-std=c11 -O1 -D_GNU_SOURCE", *PROGRAMS], what, env=environment)
    if guests:
        run([make, "--no-print-directory", f"-j{jobs}", "bench-guests", f"ROOT={folder}/", f"BENCH_GUEST={folder}/build/guest",
             f"GUESTS={' '.join(guests)}"], what, env=environment)


def change(before, after):
    if before == 0:
        return "new" if after else ""
    return f"{100 * (after - before) / before:+.1f}".replace("-0.0", "0.0").replace("+0.0", "0.0")


def figures(row):
    return [row["total"], *(row["phases"][phase] for phase in rows.PHASES)]


def table(pairs):
    """Lines: of each pair of rows what was, what is, and the change in per cent."""
    layout = "  {:<8}" + " {:>10}" * len(SHOWN)
    lines = []
    for before, after in pairs:
        old, new = figures(before), figures(after)
        lines += [rows.describe(after), layout.format("", *SHOWN), layout.format("before", *old), layout.format("after", *new),
                  layout.format("%", *map(change, old, new))]
    return lines


def compare(arguments):
    targets = [t for t in rows.words(arguments.targets, (rows.HOST, *rows.GUESTS, *rows.BOARDS), "TARGETS") if t not in rows.BOARDS]
    methods = rows.words(arguments.methods, rows.METHODS, "METHODS")
    shades = rows.words(arguments.shades, (*rows.SHADES, "textured-flat"), "SHADES")
    models = bench.models_of(arguments)
    wanted = bench.wanted_rows(models, arguments.models, targets, methods, shades, arguments.size, arguments.tiles.split(),
                               rows.bytes_of(arguments.memory))
    if not wanted:
        raise BenchError("nothing is to be counted: boards cannot be compared")
    commit = commit_of(arguments.base)
    folder = os.path.join(arguments.out, "base", commit[:12])
    print(f"Building {arguments.base} ({commit[:12]}) in {folder}", flush=True)
    unpack(commit, folder)
    build(folder, arguments.make, arguments.jobs or 1, [t for t in targets if t in rows.GUESTS])
    base = rows.Counter([os.path.join(folder, program) for program in PROGRAMS], os.path.join(folder, "build", "guest"), arguments.plugin,
                        os.path.join(folder, "build", "rows"), folder, arguments.jobs)
    both = {}
    for side, counter in enumerate((base, bench.counter_of(arguments))):
        for row in counter.all(wanted):
            both.setdefault(tuple(row[key] for key in rows.KEY), [None, None])[side] = row
    pairs = [pair for pair in both.values() if None not in pair]
    print("\n".join(table(pairs)))
    if not pairs:
        raise BenchError("there is nothing that both can draw")


def main():
    parser = bench.parser_of(__doc__)
    parser.add_argument("--base", required=True)
    parser.add_argument("--make", default="make")
    try:
        compare(parser.parse_args())
    except BenchError as error:
        print(f"bench-compare: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
