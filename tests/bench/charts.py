"""Draws OUT/*.svg from what has been counted.

    charts.py OUT

OUT/bench.json: phases-MODEL.svg, the phases of a frame on each target, and methods-MODEL.svg, by each method. OUT/sweep.json: faces.svg,
pixels.svg and memory.svg, the cost against these. What has not been counted is not drawn.
"""

import math
import os
import sys
from xml.sax.saxutils import escape

import rows
from readme import METHOD_NAMES, NAMES, SHADE_NAMES

FONT = 'font-family="DejaVu Sans, Verdana, sans-serif"'
PHASE_COLOURS = dict(zip(rows.PHASES, ("#3b6fb6", "#8fb8de", "#d98032", "#57a05a", "#b0b0b0", "#8c6bb1", "#c9a227")))
PHASE_NAMES = dict(zip(rows.PHASES, ("vertices", "culling", "set-up", "spans", "clear", "resolve", "helpers")))
SHADE_COLOURS = dict(zip(rows.SHADES, ("#3b6fb6", "#d98032", "#57a05a")))
DASHES = ("", "7 4", "2 4", "9 3 2 3")  # by target
AXES = {"faces": ("faces of the model", lambda row: row["faces"], lambda value: f"{value:,}".replace(",", " ")),
        "pixels": ("pixels of the window", lambda row: pixels_of(row), None),
        "memory": ("bytes of the block", lambda row: row["memory"], lambda value: f"{value >> 20} M" if value >> 20 else f"{value >> 10} K")}


def pixels_of(row):
    width, height = rows.size_of(row["size"], "SIZE")
    return width * height


# ---- the pen ---------------------------------------------------------------------------------------------------------------

class Drawing:
    def __init__(self, width, height):
        self.parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" {FONT}>',
                      f'<rect width="{width}" height="{height}" fill="#ffffff"/>']

    def text(self, x, y, text, size=12, anchor="start", colour="#222222", turned=False):
        turn = f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turned else ""
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="{colour}"{turn}>{escape(text)}</text>')

    def line(self, x1, y1, x2, y2, colour="#dddddd"):
        self.parts.append(f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}"/>')

    def bar(self, x, y, width, height, colour):
        self.parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{colour}"/>')

    def curve(self, points, colour, dash):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashed = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"{dashed}/>')
        self.parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in points]

    def save(self, path):
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(self.parts) + "\n</svg>\n")


# ---- scales ----------------------------------------------------------------------------------------------------------------

def round_step(most, count):
    """The smallest of 1, 2, 5 times a power of ten of which count reach most."""
    step = 1.0
    while step * count >= most:
        step /= 10
    while True:
        for factor in (1, 2, 5):
            if step * factor * count >= most:
                return step * factor
        step *= 10


def ticks_linear(most, count=6):
    step = round_step(most, count)
    return [step * i for i in range(int(most / step + 1.999999))]


def ticks_log(least, most):
    """1, 2, 5 times powers of ten: all of those between, and the next ones on both sides."""
    ticks, power = [], 1e-6
    while power <= most * 10:
        ticks += [power * factor for factor in (1, 2, 5)]
        power *= 10
    first = max(i for i, tick in enumerate(ticks) if tick <= least * 1.000001)
    last = min(i for i, tick in enumerate(ticks) if tick >= most * 0.999999)
    return ticks[first:last + 1]


def number(value):
    return f"{value:.6g}"


def spread(wanted, distance):
    """Places that are as near as can be to the wanted ones, in their order, and no nearer than the distance to one another."""
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    groups = []  # [first place, members]
    for i in order:
        groups.append([wanted[i], [i]])
        while len(groups) > 1 and groups[-2][0] + distance * len(groups[-2][1]) > groups[-1][0]:
            members = groups[-2][1] + groups[-1][1]
            groups[-2:] = [[sum(wanted[m] - distance * k for k, m in enumerate(members)) / len(members), members]]
    places = [0.0] * len(wanted)
    for first, members in groups:
        for k, member in enumerate(members):
            places[member] = first + distance * k
    return places


# ---- bars: a panel for each shading, in it a bar of phases for each of what is compared --------------------------------------

LEFT, RIGHT, BAR, WIDTH = 110, 90, 22, 860


def draw_bars(path, title, panels):
    """panels: (name, [(label, row)])."""
    height = 76 + sum(64 + BAR * len(bars) for _, bars in panels)
    drawing = Drawing(WIDTH, height)
    drawing.text(16, 26, title, 16)
    x = 16
    used = [phase for phase in rows.PHASES if any(row["phases"][phase] for _, bars in panels for _, row in bars)]
    for phase in used:
        drawing.bar(x, 42, 12, 12, PHASE_COLOURS[phase])
        drawing.text(x + 17, 52, PHASE_NAMES[phase])
        x += 40 + 7.5 * len(PHASE_NAMES[phase])
    top = 84
    for name, bars in panels:
        ticks = ticks_linear(max(row["total"] for _, row in bars) / 1e6)
        scale = (WIDTH - LEFT - RIGHT) / ticks[-1]
        bottom = top + BAR * len(bars)
        drawing.text(16, top - 6, name, 13)
        for tick in ticks:
            drawing.line(LEFT + tick * scale, top, LEFT + tick * scale, bottom + 4)
            drawing.text(LEFT + tick * scale, bottom + 17, number(tick), 11, "middle", "#555555")
        drawing.text(WIDTH - RIGHT + 22, bottom + 17, "millions", 11, colour="#555555")
        for i, (label, row) in enumerate(bars):
            x, y = LEFT, top + BAR * i
            drawing.text(LEFT - 8, y + 15, label, anchor="end")
            for phase in used:
                width = row["phases"][phase] / 1e6 * scale
                drawing.bar(x, y + 3, width, BAR - 6, PHASE_COLOURS[phase])
                x += width
            drawing.text(x + 6, y + 15, f"{row['total'] / 1e6:.2f}", 11)
        drawing.line(LEFT, top, LEFT, bottom + 4, "#555555")
        top = bottom + 64
    drawing.save(path)


def bars_of(counted, label_of):
    """Panels of rows that differ in what label_of tells."""
    panels = [(SHADE_NAMES[shade], [(label_of(row), row) for row in counted if row["shade"] == shade]) for shade in rows.SHADES]
    return [(name, bars) for name, bars in panels if bars]


def draw_phases(counted, out):
    counted = [row for row in counted if row["phases"]]
    paths = []
    for model in dict.fromkeys(row["model"] for row in counted):
        own = [row for row in counted if row["model"] == model]
        first = own[0]
        where = f"{first['size']} in tiles of {first['tile']}".replace("x", "×")
        same = [row for row in own if (row["size"], row["tile"]) == (first["size"], first["tile"])]
        targets = [row for row in same if row["method"] == first["method"]]
        methods = [row for row in same if row["target"] == rows.HOST]
        for kind, title, group, label_of in (
                ("phases", f"{model}, {METHOD_NAMES[first['method']]}, {where}: instructions of a frame", targets, lambda row: NAMES[row["target"]]),
                ("methods", f"{model}, x86-64, {where}: instructions of a frame by method", methods, lambda row: METHOD_NAMES[row["method"]])):
            panels = bars_of(group, label_of)
            if panels and (kind == "phases" or any(len(bars) > 1 for _, bars in panels)):
                paths.append(os.path.join(out, f"{kind}-{model}.svg"))
                draw_bars(paths[-1], title, panels)
    return paths


# ---- curves: the cost against something, both logarithmic -------------------------------------------------------------------

PLOT = (70, 60, 640, 420)  # left, top, right, bottom


def draw_curves(path, title, axis, counted):

    name, value_of, text_of = AXES[axis]
    left, top, right, bottom = PLOT
    drawing = Drawing(890, 490)
    values = sorted({value_of(row) for row in counted})
    costs = [row["total"] / 1e6 for row in counted]
    ticks = ticks_log(min(costs), max(costs))

    def x_of(value):
        whole = math.log(values[-1] / values[0]) or 1
        return left + 20 + (right - left - 40) * math.log(value / values[0]) / whole

    def y_of(cost):
        return bottom - (bottom - top) * math.log(cost / ticks[0]) / (math.log(ticks[-1] / ticks[0]) or 1)

    drawing.text(16, 26, title, 16)
    drawing.text(20, (top + bottom) / 2, "millions of instructions a frame", 12, "middle", turned=True)
    drawing.text((left + right) / 2, bottom + 50, name, 12, "middle")
    for tick in ticks:
        drawing.line(left, y_of(tick), right, y_of(tick))
        drawing.text(left - 8, y_of(tick) + 4, number(tick), 11, "end", "#555555")
    labels = {value_of(row): text_of(value_of(row)) if text_of else row["size"].replace("x", "×") for row in counted}
    for value in values:
        drawing.line(x_of(value), top, x_of(value), bottom)
        drawing.text(x_of(value), bottom + 18, labels[value], 11, "middle", "#555555")
    drawing.line(left, bottom, right, bottom, "#555555")
    drawing.line(left, top, left, bottom, "#555555")
    targets = list(dict.fromkeys(row["target"] for row in counted))
    curves = []
    for shade in rows.SHADES:
        for target in targets:
            points = sorted((value_of(row), row["total"] / 1e6) for row in counted if (row["shade"], row["target"]) == (shade, target))
            if points:
                curves.append((f"{NAMES[target]}, {SHADE_NAMES[shade]}", SHADE_COLOURS[shade], DASHES[targets.index(target) % len(DASHES)],
                               [(x_of(value), y_of(cost)) for value, cost in points]))
    places = spread([points[-1][1] for *_, points in curves], 17)
    for (label, colour, dash, points), y in zip(curves, places):
        drawing.curve(points, colour, dash)
        drawing.line(points[-1][0] + 5, points[-1][1], right + 12, y, "#bbbbbb")
        drawing.text(right + 16, y + 4, label, 12, colour=colour)
    drawing.save(path)


def draw_sweeps(counted, out):
    paths = []
    for axis in AXES:
        own = [row for row in counted if row["axis"] == axis]
        if not own:
            continue
        model = own[0]["model"].split("-")[0]
        where = {"faces": f"{own[0]['size']} in tiles of {own[0]['tile']}".replace("x", "×"), "pixels": "in strips of 24 rows",
                 "memory": f"{own[0]['size'].replace('x', '×')} in strips as high as the memory allows"}[axis]
        paths.append(os.path.join(out, axis + ".svg"))
        draw_curves(paths[-1], f"{model}, z-buffer, {where}", axis, own)
    return paths


def main():
    out, paths = sys.argv[1], []
    for name, draw in (("bench.json", draw_phases), ("sweep.json", draw_sweeps)):
        if os.path.exists(os.path.join(out, name)):
            paths += draw(rows.read_json(os.path.join(out, name)), out)
    print(f"Charts: {' '.join(paths)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
