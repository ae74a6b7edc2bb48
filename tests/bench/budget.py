"""Holds counts against the budget file, whose lines are also the list of what is counted.

    budget.py check OPTIONS --file BUDGET --readme README   fails where a count is more than one per cent above its line
    budget.py write OPTIONS --file BUDGET --readme README   writes the counts into the file, and the README's table of them

A line: model, target, method, shade, tile, memory, instructions of a frame at 320x240 ("-": not counted yet). On x86-64 only functions of
raster/ count: what the C library takes for a copy depends on this machine's processor. On the others all that runs counts.
"""

import argparse
import subprocess
import sys

import bench
import readme
import rows
from rows import BenchError

PER_CENT = 1
SIZE = "320x240"
TABLE_OF = ("spider", "320x24", "4M")  # model, tile and memory of the lines that the README shows
COMPILERS = ("gcc", "arm-none-eabi-gcc", "riscv64-unknown-elf-gcc")
COMPILERS_LINE = "# Counted with "
LAYOUT = "{:<8} {:<13} {:<8} {:<16} {:<8} {:<6}"


def parse_line(text, at):
    """A line of the file: (six words, count or None), or None for a comment."""
    fields = text.split("#")[0].split()
    if not fields:
        return None
    if len(fields) != 7 or not (fields[6].isdigit() or fields[6] == "-"):
        raise BenchError(f"line {at} of the budget is not: model target method shade tile memory instructions")
    rows.words(fields[1], (rows.HOST, *rows.GUESTS), f"budget, line {at}: target")
    rows.words(fields[2], rows.METHODS, f"budget, line {at}: method")
    rows.words(fields[3], rows.SHADES, f"budget, line {at}: shade")
    return tuple(fields[:6]), None if fields[6] == "-" else int(fields[6])


def parse_budget(text):
    """{six words: count}."""
    budget = {}
    for at, line in enumerate(text.splitlines(), 1):
        parsed = parse_line(line, at)
        if parsed and parsed[0] in budget:
            raise BenchError(f"line {at} of the budget: {' '.join(parsed[0])} is there already")
        if parsed:
            budget[parsed[0]] = parsed[1]
    if not budget:
        raise BenchError("the budget has no lines")
    return budget


def judge(count, most):
    """What is to be said of a count: (fault or None, note or None)."""
    if most is None:
        return "has no budget yet: make bench-budget-write", None
    change = 100 * (count - most) / most
    if count * 100 > most * (100 + PER_CENT):
        return f"takes {count} instructions, {change:.1f} % above its budget of {most}", None
    if count * 100 < most * (100 - PER_CENT):
        return None, f"takes {count} instructions, {-change:.1f} % below its budget of {most}"
    return None, None


def counted_of(row):
    return row["raster"] if row["target"] == rows.HOST else row["total"]


def count(arguments, budget):
    """Counts the lines of a budget: {six words: row}."""
    models, wanted, words = bench.models_of(arguments), [], []
    for line in budget:
        model, target, method, shade, tile, memory = line
        name, path = models.compiled(model, method == "tree")
        wanted.append((bench.spec_of(name, target, method, shade, SIZE, tile, rows.bytes_of(memory)), path))
        words.append(line)
    counted = list(bench.counter_of(arguments).all(wanted))
    if len(counted) != len(words):
        raise BenchError("a line of the budget has a method that its model cannot be drawn by")
    return dict(zip(words, counted))


def compilers():
    found = []
    for name in COMPILERS:
        result = subprocess.run([name, "-dumpfullversion"], capture_output=True, text=True, check=False)
        found.append(f"{name} {result.stdout.strip()}")
    return ", ".join(found)


def readme_table(budget):
    return readme.budget_table([(line[1], line[2], line[3], number) for line, number in budget.items()
                                if (line[0], line[4], line[5]) == TABLE_OF and number is not None])


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def replaced(text, counts, made_by):
    """The budget file with other counts; all else stays."""
    lines = []
    for at, line in enumerate(text.splitlines(), 1):
        parsed = parse_line(line, at)
        if parsed:
            comment = line[line.index("#"):] if "#" in line else ""
            line = f"{LAYOUT.format(*parsed[0])} {counts[parsed[0]]:>13} {comment}".rstrip()
        elif line.startswith(COMPILERS_LINE):
            line = COMPILERS_LINE + made_by + "."
        lines.append(line)
    return "\n".join(lines) + "\n"


def check(arguments, text, budget):
    faults, notes = [], []
    for line, row in count(arguments, budget).items():
        number = counted_of(row)
        fault, note = judge(number, budget[line])
        print(f"{LAYOUT.format(*line)} {number:>10} of {budget[line] or '-':>10}"
              + (f" {100 * (number / budget[line] - 1):+6.1f} %" if budget[line] else ""), flush=True)
        if fault:
            faults.append(f"{' '.join(line)} {fault}\n    " + ", ".join(f"{phase} {cost}" for phase, cost in row["phases"].items()))
        if note:
            notes.append(f"{' '.join(line)} {note}")
    if notes:
        notes.append("Write the budget anew, so that it stays so: make bench-budget-write")
    if faults and COMPILERS_LINE + compilers() + "." not in text:
        faults.append(f"The compilers are others than the file's, here: {compilers()}")
    shown = read(arguments.readme)
    wanted = readme.splice(shown, readme_table(budget))
    if wanted is not None and wanted != shown:
        faults.append(f"{arguments.readme}: its table is not the budget's: make bench-budget-write")
    for note in notes:
        print(note)
    for fault in faults:
        print(f"bench-budget: {fault}", file=sys.stderr)
    return 1 if faults else 0


def write(arguments, text, budget):
    counts = {line: counted_of(row) for line, row in count(arguments, budget).items()}
    for line, number in counts.items():
        if number != budget[line]:
            print(f"{' '.join(line)}: {budget[line] or '-'} -> {number}")
    with open(arguments.file, "w", encoding="utf-8") as file:
        file.write(replaced(text, counts, compilers()))
    shown = read(arguments.readme)
    wanted = readme.splice(shown, readme_table(counts))
    if wanted is not None and wanted != shown:
        with open(arguments.readme, "w", encoding="utf-8") as file:
            file.write(wanted)
        print(f"{arguments.readme}: its table is written anew")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("check", "write"))
    parser.add_argument("--file", required=True)
    parser.add_argument("--readme", required=True)
    bench.add_common(parser)
    arguments = parser.parse_args()
    try:
        text = read(arguments.file)
        return (check if arguments.command == "check" else write)(arguments, text, parse_budget(text))
    except BenchError as error:
        print(f"bench-budget: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
