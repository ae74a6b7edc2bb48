"""The most bytes of stack that a program may take, from what gcc wrote beside its objects (-fcallgraph-info=su).

    stack.py IMAGE FOLDER --tools PREFIX --calls FILE [--room BYTES] [--entry NAME] [--without NAME ...]

FOLDER holds the .ci files of the image's objects; those of objects NAME, which belong to other images, are left out. Only functions that are in the image count. Functions that gcc has not compiled
(libgcc's), and naked ones, are read from the disassembly. A call through a pointer goes to every function that the sources assign to a field of that
name, `.field = function` or `->field = function`; FILE says so where that is not enough, a line each:

    CALLER: TARGET TARGET ...    what this function's pointers can be, in place of what the sources say; * stands for any letters
    CALLER: not TARGET ...       as the sources say, but for these
    CALLER: -                    its pointers are NULL on a board
    .FIELD: -                    this field is NULL on a board
    recursion FUNCTION DEPTH     this function is on the stack so many times at most

Fails on a pointer without a target, on recursion without a depth, on a frame whose size is not known when it is compiled, and on
more than --room. Prints the longest chain.
"""

import argparse
import fnmatch
import os
import re
import subprocess
import sys

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]*)")?')
CALL_FIELD = re.compile(r'(?:->|\.)(\w+)(?:\[[^\]]*\])?\s*\)?\(')
ASSIGNED = re.compile(r'(?:->|\.)(\w+)(?:\[[^\]]*\])?\s*=\s*([^;,}=][^;,}]*)')


def base(name):
    """A function's own name: without its file, and without what gcc appends to copies of it."""
    return re.sub(r"\.(constprop|isra|part|cold|lto_priv).*", "", name.split(":")[-1])


class Graph:
    def __init__(self):
        self.bytes = {}  # function: bytes of its frame; functions of one file only are "file:name"
        self.calls = {}  # function: set of functions
        self.pointers = []  # (function, "file:line")
        self.faults = []

    def read(self, path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for title, label in NODE.findall(text):
            size = re.search(r"(\d+) bytes \((\w[\w,]*)\)", label)
            if not size:
                continue
            if size.group(2) == "dynamic":
                self.faults.append(f"{title}: its frame has no bound")
            self.bytes[title] = int(size.group(1))
            self.calls.setdefault(title, set())
        for source, target, label in EDGE.findall(text):
            if target == "__indirect_call":
                self.pointers.append((source, ":".join(label.split(":")[:2])))
            else:
                self.calls.setdefault(source, set()).add(target)


def read_sources():
    """Of each field: the functions, with their files, that are assigned to it anywhere."""
    fields = {}
    for folder in ("raster", "hal", "firmware"):
        for at, _, names in os.walk(folder):
            for name in names:
                if not name.endswith((".c", ".h")):
                    continue
                path = os.path.join(at, name)
                with open(path, encoding="utf-8") as file:
                    for field, value in ASSIGNED.findall(file.read()):
                        for word in re.findall(r"[A-Za-z_]\w*", value):
                            fields.setdefault(field, set()).add((path, word))
    return fields


def read_calls(path):
    """What the file says: targets of callers, and depths of recursion."""
    targets, depths = {}, {}
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.split("#")[0].strip()
            if line.startswith("recursion "):
                depths[line.split()[1]] = int(line.split()[2])
            elif line:
                caller, _, rest = line.partition(":")
                targets[caller.strip()] = [] if rest.strip() == "-" else rest.split()
    return targets, depths


def disassembled(image, tools):
    """Of each function in the image: bytes that it pushes, and what it calls. For functions without a .ci file."""
    text = subprocess.run([tools + "objdump", "-d", "--no-show-raw-insn", image], capture_output=True, text=True, check=True).stdout
    found, name = {}, None
    for line in text.splitlines():
        head = re.match(r"[0-9a-f]+ <([^>]+)>:", line)
        if head:
            name = head.group(1)
            found[name] = [0, set()]
            continue
        fields = line.split("\t")
        if not name or len(fields) < 2:
            continue
        operation, operands = fields[1].strip(), "\t".join(fields[2:])
        if operation.startswith(("push", "stmdb")) and "{" in operands:
            registers = operands[operands.index("{") + 1:operands.index("}")].split(",")
            for register in registers:
                ends = re.findall(r"\d+", register)
                found[name][0] += 4 * (int(ends[1]) - int(ends[0]) + 1 if len(ends) == 2 else 1)
        elif operation.startswith("sub") and operands.startswith("sp") and "#" in operands:
            found[name][0] += int(re.search(r"#(\d+)", operands).group(1))
        elif operation.startswith(("addi", "c.addi")) and operands.startswith("sp,sp,-"):
            found[name][0] += int(operands[len("sp,sp,-"):].split()[0])
        target = re.search(r"<([\w.$]+)(?:\+0x[0-9a-f]+)?>", operands)
        if target and operation.startswith(("b", "j", "c.j", "tail", "call")) and target.group(1) != name:
            found[name][1].add(target.group(1))
    return found


def line_of(place, cache={}):
    path, number = place.rsplit(":", 1)
    if path not in cache:
        with open(path, encoding="utf-8") as file:
            cache[path] = file.read().splitlines()
    return cache[path][int(number) - 1]


def fields_called(line):
    """Names of the fields that a source line may call: x->field(...), or, of a choice, (x->field ? x->field : ...)(...)."""
    return set(CALL_FIELD.findall(line)) | (set(re.findall(r"(?:->|\.)(\w+)", line)) if ")(" in line else set())


def assigned(graph, fields, targets, line, path):
    """The functions that the pointers of a source line can be."""
    words = set()
    if ")(" in line:  # a choice may name functions
        words = {(path, word) for word in re.findall(r"(?<![\w>.])([A-Za-z_]\w*)\b(?!\()", line)}
    for field in fields_called(line):
        if "." + field not in targets:
            words |= fields.get(field, set())
    return {name for at, word in words for name in (f"{at}:{word}", word) if name in graph.bytes}


def resolve(graph, fields, targets, present):
    """Adds what calls through pointers reach."""
    for caller, place in graph.pointers:
        if base(caller) not in present:
            continue
        line, said = line_of(place), targets.get(base(caller))
        if said is not None and said[:1] != ["not"]:
            reached = {name for name in graph.bytes if any(fnmatch.fnmatchcase(base(name), target) for target in said)}
        else:
            reached = {name for name in assigned(graph, fields, targets, line, place.rsplit(":", 1)[0]) if base(name) not in (said or [])}
        known = said is not None or reached or any("." + field in targets or field in fields for field in fields_called(line))
        if not known or (said and said[0] != "not" and not reached):
            graph.faults.append(f"{base(caller)}: what does the pointer call at {place}?    {line.strip()}")
        graph.calls[caller] |= reached


def longest(graph, entry, depths):
    """Bytes and chain of the worst way down from the entry."""
    known, under_way = {}, []

    def down(name):
        if name in known:
            return known[name]
        if name in under_way:
            chain = under_way[under_way.index(name):]
            if not any(base(n) in depths for n in chain):
                graph.faults.append("recursion without a stated depth: " + " -> ".join(base(n) for n in chain + [name]))
            return 0, []
        under_way.append(name)
        best = max((down(target) for target in sorted(graph.calls.get(name, ()))), key=lambda found: found[0], default=(0, []))
        under_way.pop()
        own = graph.bytes[name] * depths.get(base(name), 1)
        known[name] = own + best[0], [name] + best[1]
        return known[name]

    return down(entry)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("image")
    parser.add_argument("folder")
    parser.add_argument("--tools", default="")
    parser.add_argument("--calls", required=True)
    parser.add_argument("--entry", default="reset")
    parser.add_argument("--room", type=int)
    parser.add_argument("--without", nargs="*", default=[], help="objects of other images, without .o")
    parser.add_argument("--quiet", action="store_true", help="prints the bytes alone")
    arguments = parser.parse_args()

    graph = Graph()
    for at, _, names in os.walk(arguments.folder):
        for name in names:
            if name.endswith(".ci") and name[:-3] not in arguments.without:
                graph.read(os.path.join(at, name))
    in_image = disassembled(arguments.image, arguments.tools)
    present = {base(name) for name in in_image}
    for name, (size, calls) in in_image.items():
        if not any(base(other) == base(name) for other in graph.bytes):
            graph.bytes[name], graph.calls[name] = size, calls
    for name in graph.bytes:
        size, calls = in_image.get(base(name), (0, ()))
        if size and graph.bytes[name] == 0:  # naked: gcc has seen nothing of what it is made of
            graph.bytes[name] = size
            graph.calls[name] |= set(calls)
    targets, depths = read_calls(arguments.calls)
    resolve(graph, read_sources(), targets, present)
    for name in graph.calls:
        graph.calls[name] = {target for target in graph.calls[name] if target in graph.bytes and base(target) in present}
    if arguments.entry not in graph.bytes:
        graph.faults.append(f"there is no {arguments.entry}")
        total, chain = 0, []
    else:
        total, chain = longest(graph, arguments.entry, depths)
    for fault in graph.faults:
        print(f"stack: {fault}", file=sys.stderr)
    if arguments.quiet:
        print(total)
    else:
        for name in chain:
            print(f"{graph.bytes[name] * depths.get(base(name), 1):6} {base(name)}")
        print(f"{total:6} bytes of stack at most" + (f", of {arguments.room}" if arguments.room else ""))
    if arguments.room and total > arguments.room:
        print(f"stack: {total} bytes are more than the {arguments.room} that the linker script reserves", file=sys.stderr)
        return 1
    return 1 if graph.faults else 0


sys.exit(main())
