"""The bench finds what it looks for: counts above the budget, figures of the README that are not the counted ones, what emulators print.

    test_bench.py FOLDER OPTIONS   the options are those of budget.py
"""

import json
import os
import subprocess
import sys
import unittest

import bench
import boards
import budget
import compare
import readme
import rows
from rows import BenchError

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER, OPTIONS = None, []  # without one nothing is written: its files have the names of the tree
LINE = "room cortex-m3 zbuffer flat 320x24 4M"


def spot(target, tile, counts):
    return [{"model": "spot", "target": target, "tile": tile, "method": "zbuffer", "size": "320x240", "shade": shade, "total": count}
            for shade, count in zip(rows.SHADES, counts)]


SPOT = (spot("x86-64", "320x24", (1924524, 2036629, 3478000)) + spot("x86-64", "32x32", (2300000, 2410000, 3890000))
        + spot("cortex-m0plus", "320x24", (5063895, 6095147, 10200000)))
SPEED = """| **Tuile, strips of 24 rows** | 1.92 | 2.04 | 3.48 | 46 KB, textured 61 KB |
| **Tuile, tiles of 32×32** | 2.30 | 2.41 | 3.89 | 6 KB, textured 8 KB |

Cortex-M0+ takes 5.06, 6.10 and 10.2 million.
"""


def option(name):
    return OPTIONS[OPTIONS.index(name) + 1]


def awk(script, text, *options):
    return subprocess.run(["awk", *options, "-f", os.path.join(HERE, script)], input=text, capture_output=True, text=True, check=True).stdout


class Judging(unittest.TestCase):
    def test_one_per_cent_above_passes_and_one_instruction_more_fails(self):
        self.assertEqual(budget.judge(101000, 100000), (None, None))
        self.assertEqual(budget.judge(101001, 100000)[0], "takes 101001 instructions, 1.0 % above its budget of 100000")

    def test_more_than_one_per_cent_below_is_said_and_passes(self):
        self.assertEqual(budget.judge(99000, 100000), (None, None))
        self.assertEqual(budget.judge(98999, 100000), (None, "takes 98999 instructions, 1.0 % below its budget of 100000"))

    def test_a_line_that_was_never_counted_fails(self):
        self.assertIn("bench-budget-write", budget.judge(5, None)[0])

    def test_the_host_counts_functions_of_raster_only(self):
        self.assertEqual(budget.counted_of({"target": "x86-64", "raster": 5, "total": 7}), 5)
        self.assertEqual(budget.counted_of({"target": "rv32imac", "raster": 5, "total": 7}), 7)


class BudgetFile(unittest.TestCase):
    def test_it_is_read(self):
        self.assertEqual(budget.parse_budget(f"# a comment\n\n{LINE} 120 # why\n"), {tuple(LINE.split()): 120})
        self.assertEqual(budget.parse_budget(f"{LINE} -\n"), {tuple(LINE.split()): None})

    def test_what_is_wrong_is_said(self):
        for text, word in ((f"{LINE}\n", "line 1"), (f"\n{LINE} many\n", "line 2"), (f"{LINE} 1\n{LINE} 2\n", "already"), ("# none\n", "no lines"),
                           (LINE.replace("cortex-m3", "z80") + " 1\n", "z80"), (LINE.replace("zbuffer", "rays") + " 1\n", "rays"),
                           (LINE.replace("flat", "round") + " 1\n", "round")):
            with self.assertRaisesRegex(BenchError, word):
                budget.parse_budget(text)

    def test_only_counts_and_compilers_are_written_anew(self):
        text = f"# Counted with gcc 1.\n# other\n{LINE} 120 # why\n"
        first, other, line = budget.replaced(text, {tuple(LINE.split()): 98765}, "gcc 2").splitlines()
        self.assertEqual((first, other), ("# Counted with gcc 2.", "# other"))
        self.assertEqual(line.split(), [*LINE.split(), "98765", "#", "why"])


class Readme(unittest.TestCase):
    def test_three_digits(self):
        for count, text in ((1924524, "1.92"), (10200000, "10.2"), (848424, "0.848"), (123456789, "123"), (1999999, "2.00"), (99990000, "100")):
            self.assertEqual(readme.millions(count), text)

    def test_tile_memory(self):  # 320 x 24 pixels of two colours and a depth of two bytes each: 46 080
        self.assertEqual(readme.memory_text("320x24"), "46 KB, textured 61 KB")
        self.assertEqual(readme.memory_text("32x32"), "6 KB, textured 8 KB")

    def test_the_rows_of_speed(self):
        lines, guests = readme.speed(SPOT, "spot")
        self.assertEqual(lines, SPEED.splitlines()[:2])
        self.assertEqual(list(guests), ["cortex-m0plus"])
        with self.assertRaisesRegex(BenchError, "has not been counted"):
            readme.speed(SPOT[:3], "spot")

    def test_each_figure_is_compared(self):
        self.assertEqual(readme.check_speed(SPEED, SPOT, "spot"), [])
        for said, false in (("1.92", "1.89"), ("2.04", "2.07"), ("3.48", "3.44"), ("2.30", "2.20"), ("3.89", "4.89"), ("5.06", "5.16"),
                            ("10.2", "9.2"), ("strips of 24", "strips of 8")):
            self.assertEqual(len(readme.check_speed(SPEED.replace(said, false), SPOT, "spot")), 1, (said, false))

    def test_a_readme_without_marks_is_left_alone(self):
        self.assertIsNone(readme.splice("text", ["| |"]))

    def test_the_table_stands_between_its_marks(self):
        text = f"before\n{readme.MARK_BEGIN}\nold\n{readme.MARK_END}\nbehind\n"
        once = readme.splice(text, ["| a |"])
        self.assertEqual(once, f"before\n{readme.MARK_BEGIN}\n\n| a |\n\n{readme.MARK_END}\nbehind\n")
        self.assertEqual(readme.splice(once, ["| a |"]), once)
        for wrong in (text.replace(readme.MARK_END, ""), text + text, readme.MARK_END + readme.MARK_BEGIN):
            with self.assertRaises(BenchError):
                readme.splice(wrong, ["| a |"])

    def test_the_table_of_a_budget(self):
        table = readme.budget_table([("x86-64", "zbuffer", "flat", 848424), ("x86-64", "zbuffer", "gouraud", 870423),
                                     ("x86-64", "tree", "gouraud", 4343643)])
        self.assertEqual(table[2:], ["| x86-64 | 0.848 | 0.870 | – |", "| x86-64, tree | – | 4.34 | – |"])


class Boards(unittest.TestCase):
    def test_frames_of_the_uno(self):
        text = ("cube tree 0: 1003826 cycles, 62 ms, 1072 bytes, x.png\ncube tree 4: 1003828 cycles, 62 ms, 1072 bytes, x.png\n"
                "uno: 24 frames; 132014965 cycles; stack down to 0x511, 294 bytes never used\n")
        row, = boards.mean_rows(boards.uno_frames(text), "atmega328p", "128x64")
        self.assertEqual((row["model"], row["method"], row["total"], row["unit"]), ("cube", "tree", 1003827, "cycles"))
        self.assertNotIn("asleep", row)

    def test_frames_of_the_rp2040(self):
        text = ("board 240 240 at 245.004\nframe cube zbuffer 0 passes 1 ms 10.000 asleep 2.500 wire 14.924 cycles 1000000 at 262.595\n"
                "frame cube zbuffer 1 passes 3 ms 20.000 asleep 0.000 wire 14.924 cycles 2000000 at 279.557\nstack 3428 of 8160 at 300.000\n")
        row, = boards.mean_rows(boards.rp2040_frames(text), "rp2040", "240x240")
        self.assertEqual((row["total"], row["asleep"], row["passes"]), (1500000, 125000, 2))

    def test_an_emulator_that_fails_or_is_silent(self):
        for command, word in (("echo broken >&2; exit 1", "broken"), ("true", "no frame")):
            with self.assertRaisesRegex(BenchError, word):
                boards.count("rp2040", command)


class Words(unittest.TestCase):
    def test_models_by_name_by_faces_and_by_file(self):
        models = rows.Models("tuile", bench.known_models(["spider=a/spider.obj", "bunny=b/bunny.obj:6000"]), "out")
        self.assertEqual(models.source("bunny"), ("bunny", "b/bunny.obj", 6000))
        self.assertEqual(models.source("bunny-500"), ("bunny-500", "b/bunny.obj", 500))
        self.assertEqual(models.source(__file__), ("test_bench", __file__, 0))
        for word in ("horse", "horse-500", "bunny-few"):
            with self.assertRaisesRegex(BenchError, "neither a file nor"):
                models.source(word)

    def test_what_is_not_a_size_or_a_number_of_bytes(self):
        self.assertEqual((rows.size_of("320x0", "TILE"), rows.bytes_of("24K"), rows.bytes_of("4M"), rows.bytes_of("99")), ((320, 0), 24576, 4194304, 99))
        for text in ("320", "x", "0x24", "axb", "1x2x3"):
            with self.assertRaises(BenchError):
                rows.size_of(text, "TILE")
        for text in ("", "K", "4G", "-1"):
            with self.assertRaises(BenchError):
                rows.bytes_of(text)

    def test_all_targets_for_the_first_method_and_tile_only(self):
        class Made:
            source = staticmethod(lambda word: (word, word, 0))
            compiled = staticmethod(lambda word, tree: (word, word + "-tree" * tree))
        wanted = bench.wanted_rows(Made, ["a"], ["x86-64", "cortex-m3"], ["zbuffer", "tree"], ["flat"], "320x240", ["320x24", "32x32"], 1)
        self.assertEqual([(spec["target"], spec["method"], spec["tile"], path) for spec, path in wanted],
                         [("x86-64", "zbuffer", "320x24", "a"), ("cortex-m3", "zbuffer", "320x24", "a"), ("x86-64", "tree", "320x24", "a-tree"),
                          ("x86-64", "zbuffer", "32x32", "a"), ("x86-64", "tree", "32x32", "a-tree")])


class Comparing(unittest.TestCase):
    def test_per_cent_of_what_it_took(self):
        for before, after, text in ((200, 250, "+25.0"), (200, 100, "-50.0"), (100000, 100001, "0.0"), (100000, 99999, "0.0"), (0, 5, "new"), (0, 0, ""),
                                    (10, 9, "-10.0")):
            self.assertEqual(compare.change(before, after), text)

    def test_the_table_has_before_after_and_change(self):
        rows_of_two = [dict(zip(rows.KEY, ("a", "x86-64", "flat", "320x240", "320x24", 1, "tree")), total=total,
                            phases=dict(zip(rows.PHASES, (total, 0, 0, 0, 0, 0, 0)))) for total in (1000, 900)]
        name, head, before, after, change = compare.table([rows_of_two])
        self.assertEqual((name, head.split()[:2]), ("a x86-64 tree flat 320x240 in 320x24", ["total", "vertex"]))
        self.assertEqual((before.split()[:3], after.split()[:3], change.split()), (["before", "1000", "1000"], ["after", "900", "900"], ["%", "-10.0", "-10.0"]))

    def test_a_base_that_is_none(self):
        for base, word in (("", "BASE=REVISION is wanted"), ("no-such-revision", "no such revision"), ("--all", "no such revision")):
            with self.assertRaisesRegex(BenchError, word):
                compare.commit_of(base)


class Profiles(unittest.TestCase):
    def test_callgrind_lines_with_names_shortened_and_calls_left_out(self):
        text = ("fl=(1) /x/raster/a.c\nfn=(1) one\n10 5\n+2 7\ncfi=(2) /x/raster/b.c\ncfn=(2) two\ncalls=1 30\n* 100\n* 3\n"
                "fi=(3) /x/raster/c.h\n4 2\nfl=(2)\nfn=(2)\n30 100\n")
        self.assertEqual(awk("lines.awk", text).splitlines(), [
            "5 one /x/raster/a.c /x/raster/a.c 10", "7 one /x/raster/a.c /x/raster/a.c 12", "3 one /x/raster/a.c /x/raster/a.c 12",
            "2 one /x/raster/a.c /x/raster/c.h 4", "100 two /x/raster/b.c /x/raster/b.c 30"])

    def test_phases(self):
        text = "".join(f"{cost} {function} {file} {file} {line}\n" for cost, function, file, line in (
            (800, "v", "/x/raster/geometry/vertex.c", 1), (400, "c", "/x/raster/geometry/cull.c", 1), (200, "b", "/x/raster/frame/bin.c", 1),
            (104, "s", "/x/raster/fill/small.h", 20), (40, "s", "/x/raster/fill/small.h", 60), (16, "tile_clear", "/x/raster/frame/frame.c", 1),
            (8, "r", "/x/raster/resolve/mean.c", 1), (24, "memset", "/libc/memset.S", 1), (32, "__udivsi3", "??", 1)))
        self.assertEqual(list(map(int, awk("phases.awk", text, "-v", "frames=8", "-v", "small=10-50").split())),
                         [203, 100, 50, 30, 13, 5, 1, 4, 196])  # 1624 in all, 56 of them outside of raster/, in eight frames


class Whole(unittest.TestCase):
    """The whole of it, by a budget of one line: a count that is above it fails, as a slowed function would."""

    def run_budget(self, command, count, table="", more=()):
        paths = [os.path.join(FOLDER, name) for name in ("budget", "README.md")]
        for path, text in zip(paths, (f"# Counted with -.\n{LINE} {count}\n", table)):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        result = subprocess.run([sys.executable, os.path.join(HERE, "budget.py"), command, *OPTIONS, *more, "--file", paths[0], "--readme",
                                 paths[1]], capture_output=True, text=True, check=False)
        with open(paths[0], encoding="utf-8") as file:
            written = file.read()
        return result, written

    def test_a_count_above_the_budget_fails(self):
        result, written = self.run_budget("write", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("arm-none-eabi-gcc", written)
        count = int(written.split()[-1])
        self.assertGreater(count, 50000)
        for most, code, word in ((count, 0, "+0.0 %"), (count * 100 // 102, 1, "above its budget"), (count * 102 // 100, 0, "below its budget"),
                                 ("-", 1, "has no budget yet")):
            result, _ = self.run_budget("check", most)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(word, result.stdout + result.stderr)
        self.assertIn("below", self.run_budget("check", count * 2)[0].stdout)

    def test_a_table_that_is_not_the_budgets_fails(self):
        result, _ = self.run_budget("check", 10 ** 9, f"{readme.MARK_BEGIN}\n{readme.MARK_END}\n")
        self.assertEqual(result.returncode, 1)
        self.assertIn("its table is not the budget's", result.stderr)

    def test_a_target_that_draws_another_picture_fails(self):
        path = os.path.join(FOLDER, "other-bench")
        with open(path, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/sh\n{option('--bench')} \"$@\" | sed 's/^hash ./hash x/'\n")
        os.chmod(path, 0o755)
        result, _ = self.run_budget("check", 10 ** 9, more=("--bench", path))
        self.assertEqual(result.returncode, 1)
        self.assertIn("cortex-m3 draws another picture than this machine", result.stderr)

    def test_what_cannot_be_counted_fails(self):
        result, _ = self.run_budget("check", 10 ** 9, more=("--plugin", "/nonexistent.so"))
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, "could not be counted: QEMU has counted nothing:\n.*nonexistent.so")

    def test_both_ways_of_counting_agree(self):
        """By address, over all frames, and in one sum for each time that the guest draws: all that runs is in the program."""
        folder = os.path.join(FOLDER, "guest")
        os.makedirs(folder, exist_ok=True)
        environment = dict(os.environ, ROOT=".", GUEST=os.path.abspath(option("--guest")), PLUGIN=os.path.abspath(option("--plugin")))
        subprocess.run(["sh", os.path.join(HERE, "qemu", "run.sh"), folder, "cortex-m3", option("--scene"), "tests/models/room.obj", "64", "48", "64",
                        "24", "flat", "1048576"], env=environment, check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "lines.txt"), encoding="utf-8") as file:
            by_address = sum(int(line.split()[0]) for line in file)
        with open(os.path.join(folder, "symbols.txt"), encoding="utf-8") as file:
            addresses = {fields[2]: fields[0] for fields in map(str.split, file) if len(fields) == 3}
        result = subprocess.run(f". {HERE}/qemu/target.sh; target cortex-m3; $qemu -display none -monitor none -serial none -semihosting-config "
                                f"enable=on,target=native -plugin file=$PLUGIN,from=0x{addresses['guest_from']},to=0x{addresses['guest_to']} "
                                f"-kernel {folder}/guest.elf", shell=True, env=environment, capture_output=True, text=True, check=True)
        sums = [int(line.split()[1]) for line in result.stderr.splitlines() if line.startswith("instructions ")]
        self.assertEqual(len(sums), 8 * 3)  # frames; of each, two tiles and the end
        self.assertEqual(sum(sums), by_address)

    def test_rows_are_written_as_json(self):
        path = os.path.join(FOLDER, "rows.json")
        rows.write_json([{"a": 1}, {"a": None}], path)
        with open(path, encoding="utf-8") as file:
            self.assertEqual(json.load(file), [{"a": 1}, {"a": None}])
        with self.assertRaisesRegex(BenchError, "make bench"):
            rows.read_json(path + ".not")


if __name__ == "__main__":
    FOLDER, OPTIONS = sys.argv[1], sys.argv[2:]
    os.makedirs(FOLDER, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
