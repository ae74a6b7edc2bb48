"""The tables of README.md that are made of counts.

    readme.py print OUT/bench.json MODEL         the rows of "Speed" that are Tuile's, and what emulated processors take
    readme.py check OUT/bench.json MODEL README  that the README says the same, within one per cent

The table between MARK_BEGIN and MARK_END is made of the budget (budget.py).
"""

import re
import sys

import rows
from rows import BenchError

MARK_BEGIN = "<!-- made by `make bench-budget-write` -->"
MARK_END = "<!-- end of what is made -->"
TILES = (("320x24", "strips of 24 rows"), ("32x32", "tiles of 32×32"))
NAMES = {"x86-64": "x86-64", "cortex-m0plus": "Cortex-M0+", "cortex-m3": "Cortex-M3", "cortex-m4": "Cortex-M4", "cortex-m33": "Cortex-M33",
         "rv32imac": "RV32IMAC"}
METHOD_NAMES = {"zbuffer": "z-buffer", "scanline": "scan line", "warnock": "Warnock", "painter": "painter", "tree": "tree"}
SHADE_NAMES = {"flat": "flat", "gouraud": "Gouraud", "textured-gouraud": "texture × Gouraud"}
SENTENCE = "{} takes {}, {} and {} million"


def millions(count):
    """Three significant digits."""
    value = count / 1e6
    for decimals in (3, 2, 1):
        text = f"{value:.{decimals}f}"
        if len(text.replace(".", "").lstrip("0")) <= 3:
            return text
    return f"{value:.0f}"


def memory_text(tile):
    """Bytes of two tiles of colours and one of depth; with textures also of which face is seen where."""
    width, height = rows.size_of(tile, "TILE")
    plain, textured = (round(width * height * each / 1000) for each in (6, 8))
    return f"{plain} KB, textured {textured} KB"


def totals(counted, model, target, tile):
    """Of the three shadings, by the z-buffer; None where one is missing."""
    found = {row["shade"]: row["total"] for row in counted
             if (row["model"], row["target"], row["tile"], row["method"], row["size"]) == (model, target, tile, "zbuffer", "320x240")}
    return [found[shade] for shade in rows.SHADES] if all(shade in found for shade in rows.SHADES) else None


def speed(counted, model):
    """What the README is to have of a model: (rows of its table, {target: three counts})."""
    lines = []
    for tile, name in TILES:
        counts = totals(counted, model, rows.HOST, tile)
        if not counts:
            raise BenchError(f"{model} in {tile} has not been counted: make bench MODEL=... TILE='320x24 32x32'")
        lines.append(f"| **Tuile, {name}** | {' | '.join(map(millions, counts))} | {memory_text(tile)} |")
    guests = {target: totals(counted, model, target, TILES[0][0]) for target in rows.GUESTS}
    return lines, {target: counts for target, counts in guests.items() if counts}


def agree(said, counted):
    return abs(float(said) * 1e6 - counted) * 100 <= counted


def check_speed(text, counted, model):
    """Faults of a README, lines. Every figure that it has of Tuile's must be a counted one."""
    faults = []
    lines, guests = speed(counted, model)
    for (tile, name), wanted in zip(TILES, lines):
        row = re.search(rf"^\| \*\*Tuile, {name}\*\* \|(.*)\|$", text, re.MULTILINE)
        said = re.findall(r"[\d.]+", row[1]) if row else []
        counts = totals(counted, model, rows.HOST, tile)
        if len(said) < 3 or not all(map(agree, said, counts)):
            faults.append(f"{row[0] if row else 'no row of ' + name}\n  is to be {wanted}")
    for target, counts in guests.items():
        said = re.search(rf"{re.escape(NAMES[target])}(?: takes)? ([\d.]+\d), ([\d.]+\d) and ([\d.]+\d)", text)
        if said and not all(map(agree, said.groups(), counts)):
            faults.append(f"{said[0]}\n  is to be {SENTENCE.format(NAMES[target], *map(millions, counts))}")
    return faults


# ---- the table that is made of the budget ----------------------------------------------------------------------------------

def budget_table(lines):
    """Markdown of budget lines of one model: (target, method, shade, count)."""
    counts = {(target, method, shade): count for target, method, shade, count in lines}
    groups = []
    for target, method, _, _ in lines:
        if (target, method) not in groups:
            groups.append((target, method))
    table = ["| | " + " | ".join(SHADE_NAMES[shade] for shade in rows.SHADES) + " |", "|---|---|---|---|"]
    for target, method in groups:
        name = NAMES[target] + ("" if method == "zbuffer" else ", " + METHOD_NAMES[method])
        cells = [counts.get((target, method, shade)) for shade in rows.SHADES]
        table.append(f"| {name} | " + " | ".join("–" if cell is None else millions(cell) for cell in cells) + " |")
    return table


def splice(text, table):
    """The README with the table between its marks; None when it has no marks."""
    begin, end = text.find(MARK_BEGIN), text.find(MARK_END)
    if begin < 0 and end < 0:
        return None
    if not 0 <= begin < end or text.count(MARK_BEGIN) > 1 or text.count(MARK_END) > 1:
        raise BenchError(f"README: one {MARK_BEGIN} and one {MARK_END} behind it are wanted")
    return text[:begin + len(MARK_BEGIN)] + "\n\n" + "\n".join(table) + "\n\n" + text[end:]


def main():
    command, path, model = sys.argv[1:4]
    try:
        counted = rows.read_json(path)
        if command == "print":
            lines, guests = speed(counted, model)
            print("\n".join(lines))
            print("\n".join(SENTENCE.format(NAMES[target], *map(millions, counts)) for target, counts in guests.items()))
            return 0
        with open(sys.argv[4], encoding="utf-8") as file:
            faults = check_speed(file.read(), counted, model)
    except BenchError as error:
        faults = [str(error)]
    for fault in faults:
        print(f"README: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
