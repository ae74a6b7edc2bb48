"""The charts say what was counted: scales, labels that do not lie over one another, bars as long as their figures.

    test_charts.py FOLDER
"""

import os
import sys
import unittest
import xml.etree.ElementTree

import charts
import rows

FOLDER = ""
SVG = "{http://www.w3.org/2000/svg}"


def made_row(target, method, shade, total, **more):
    part = total // 8
    phases = dict.fromkeys(rows.PHASES, part)
    phases["vertex"] += total - 7 * part
    return {"model": "spider", "target": target, "method": method, "shade": shade, "size": "320x240", "tile": "320x24", "memory": 4194304,
            "faces": 1312, "phases": phases, "total": total, **more}


def texts(path):
    """(left, top, right, bottom, text) of what is written: a digit of this font is 0.64 of its size wide."""
    found = []
    for item in xml.etree.ElementTree.parse(path).getroot().iter(SVG + "text"):
        x, y, size = (float(item.get(name)) for name in ("x", "y", "font-size"))
        width = 0.64 * size * len(item.text)
        if item.get("transform"):
            found.append((x - size, y - width / 2, x, y + width / 2, item.text))
            continue
        left = x - {"start": 0, "middle": width / 2, "end": width}[item.get("text-anchor")]
        found.append((left, y - 0.8 * size, left + width, y + 0.2 * size, item.text))
    return found


def over(path):
    """Pairs of texts that lie over one another, and texts that leave the picture."""
    root = xml.etree.ElementTree.parse(path).getroot()
    width, height = float(root.get("width")), float(root.get("height"))
    written = texts(path)
    faults = [(a[4], b[4]) for i, a in enumerate(written) for b in written[:i] if a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]]
    return faults + [(a[4], "the edge") for a in written if a[0] < 0 or a[1] < 0 or a[2] > width or a[3] > height]


class Scales(unittest.TestCase):
    def test_round_steps(self):
        for most, ticks in ((1.03, [0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2]), (21.4, [0, 5, 10, 15, 20, 25]), (6, [0, 1, 2, 3, 4, 5, 6])):
            self.assertEqual(len(charts.ticks_linear(most)), len(ticks))
            for tick, wanted in zip(charts.ticks_linear(most), ticks):
                self.assertAlmostEqual(tick, wanted)

    def test_logarithmic_ticks_hold_all(self):
        for least, most, wanted in ((0.6, 18, [0.5, 1, 2, 5, 10, 20]), (1, 2, [1, 2]), (0.02, 0.021, [0.02, 0.05])):
            ticks = charts.ticks_log(least, most)
            self.assertEqual(len(ticks), len(wanted))
            for tick, value in zip(ticks, wanted):
                self.assertAlmostEqual(tick, value)

    def test_labels_are_spread_in_their_order(self):
        places = charts.spread([100, 101, 300, 99], 17)
        self.assertEqual(places[2], 300)
        self.assertEqual(sorted(range(4), key=lambda i: places[i]), [3, 0, 1, 2])
        self.assertAlmostEqual(places[0] - places[3], 17)
        self.assertAlmostEqual(places[1] - places[0], 17)
        self.assertAlmostEqual(places[0], 100)  # the middle one of three stays


class Pictures(unittest.TestCase):
    def test_bars_are_as_long_as_their_phases(self):
        path = os.path.join(FOLDER, "bars.svg")
        row = made_row("x86-64", "zbuffer", "flat", 1000000)
        row["phases"] = dict(zip(rows.PHASES, (100000, 0, 500000, 300000, 50000, 0, 50000)))
        charts.draw_bars(path, "title", [("flat", [("x86-64", row)])])
        bars = [item for item in xml.etree.ElementTree.parse(path).getroot().iter(SVG + "rect") if float(item.get("height")) == charts.BAR - 6]
        scale = charts.WIDTH - charts.LEFT - charts.RIGHT  # of a million: the axis ends there
        self.assertEqual([item.get("fill") for item in bars], [charts.PHASE_COLOURS[p] for p in ("vertex", "setup", "span", "clear", "helpers")])
        for item, share in zip(bars, (0.1, 0.5, 0.3, 0.05, 0.05)):
            self.assertAlmostEqual(float(item.get("width")), share * scale, delta=0.06)
        for item, share in zip(bars, (0, 0.1, 0.6, 0.9, 0.95)):
            self.assertAlmostEqual(float(item.get("x")), charts.LEFT + share * scale, delta=0.06)
        self.assertEqual(over(path), [])

    def test_a_chart_of_each_kind_for_each_model(self):
        counted = [made_row(target, "zbuffer", shade, (i + 1) * 950000) for i, shade in enumerate(rows.SHADES) for target in (rows.HOST, *rows.GUESTS)]
        counted += [made_row(rows.HOST, method, shade, 31950000) for shade in rows.SHADES for method in rows.METHODS[1:]]
        counted += [made_row(rows.HOST, "zbuffer", "flat", 10, model="bunny"), dict(made_row("rp2040", "tree", "scene", 5), phases=None)]
        paths = charts.draw_phases(counted, FOLDER)
        self.assertEqual([os.path.basename(path) for path in paths], ["phases-spider.svg", "methods-spider.svg", "phases-bunny.svg"])
        for path in paths:
            self.assertEqual(over(path), [])
        words = [text for *_, text in texts(paths[0])]
        self.assertTrue({"Cortex-M0+", "RV32IMAC", "texture × Gouraud", "millions", "0.95", "2.85", "spans"} <= set(words), words)
        self.assertTrue({"Warnock", "tree", "31.95"} <= {text for *_, text in texts(paths[1])})

    def test_curves_have_their_axes_and_every_point(self):
        counted = [made_row(target, "zbuffer", shade, 800000 + 200 * faces + 10000 * number, faces=faces, axis="faces", model=f"bunny-{faces}")
                   for number, shade in enumerate(rows.SHADES) for target in (rows.HOST, "cortex-m3") for faces in (500, 1000, 4000, 69666)]
        counted += [made_row(rows.HOST, "zbuffer", "flat", 100 * width * width, size=f"{width}x{width * 3 // 4}", axis="pixels")
                    for width in (160, 320, 640)]
        counted += [made_row(rows.HOST, "zbuffer", "flat", 2 ** 40 // memory, memory=memory, axis="memory") for memory in (8192, 65536, 1048576)]
        paths = charts.draw_sweeps(counted, FOLDER)
        self.assertEqual([os.path.basename(path) for path in paths], ["faces.svg", "pixels.svg", "memory.svg"])
        for path, labels, points in zip(paths, (("69 666", "faces of the model", "Cortex-M3, Gouraud"), ("320×240", "pixels of the window"),
                                                ("8 K", "1 M", "bytes of the block")), (24, 3, 3)):
            self.assertEqual(over(path), [])
            words = [text for *_, text in texts(path)]
            for label in (*labels, "millions of instructions a frame"):
                self.assertIn(label, words)
            self.assertEqual(len(list(xml.etree.ElementTree.parse(path).getroot().iter(SVG + "circle"))), points)

    def test_a_point_stands_at_its_figures(self):
        path = os.path.join(FOLDER, "point.svg")
        counted = [made_row(rows.HOST, "zbuffer", "flat", total, faces=faces, axis="faces") for faces, total in ((100, 1500000), (1000, 2000000), (10000, 10000000))]
        charts.draw_curves(path, "title", "faces", counted)
        points = [(float(item.get("cx")), float(item.get("cy"))) for item in xml.etree.ElementTree.parse(path).getroot().iter(SVG + "circle")]
        left, top, right, bottom = charts.PLOT
        self.assertAlmostEqual(points[1][0], (left + right) / 2, delta=0.06)  # the geometric mean is in the middle
        self.assertAlmostEqual(points[0][1], bottom - 0.17609 * (bottom - top), delta=0.06)  # log 1.5; the axis begins at 1
        self.assertAlmostEqual(points[1][1], bottom - 0.30103 * (bottom - top), delta=0.06)  # log 2
        self.assertAlmostEqual(points[2][1], top, delta=0.06)


if __name__ == "__main__":
    FOLDER = sys.argv[1]
    os.makedirs(FOLDER, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
