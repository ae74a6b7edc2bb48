"""What is in a linked program: no heap, no floating point, no data in raster/ and hal/, and no more bytes than its budget.

    image.py IMAGE MAP --tools PREFIX [--budget FILE]

MAP is the linker's. FILE has a line for each module: its name, and the most bytes that it may take in flash and in RAM. Prints the
table; every fault is a line on stderr, with the figure.
"""

import argparse
import re
import subprocess
import sys

HEAP = re.compile(r"_?(malloc|calloc|realloc|free|sbrk|memalign)(_r)?|_(malloc|free)_r")
# The soft-float helpers: Arm's run-time ABI (IHI 0043, 4.1), and gcc's own names, which RISC-V has. On a soft-float build there is no
# floating point without them. 64-bit integers are divided by others.
FLOAT = re.compile(r"__aeabi_([fd](add|sub|rsub|mul|div|neg|cmp.*|2.*)|[cu]?[il]?l?2[fd]|ul2[fd]|ui2[fd]|[cf]?[fd]r?cmp.*|h2f.*|f2h.*|d2h.*)"
                   r"|__(add|sub|mul|div|neg|powi|cmp|unord|eq|ne|lt|le|gt|ge)[sdt]f[234]?"
                   r"|__(fix|fixuns|float|floatun|floatuns|extend|trunc)(si|di|ti|hf|sf|df|tf){1,2}2?"
                   r"|(sin|cos|tan|sqrt|pow|floor|ceil|round|fabs)[fl]?")
SECTION = re.compile(r"^ (\.?[\w.$]+|COMMON)(?:\s+0x([0-9a-f]+)\s+0x([0-9a-f]+)\s+(\S+))?$")
REST = re.compile(r"^\s+0x([0-9a-f]+)\s+0x([0-9a-f]+)\s+(\S+)$")


def module_of(path):
    """raster, hal, firmware, models or the compiler's library."""
    if "libgcc" in path:
        return "libgcc"
    if "/model_" in path and "/raster/" not in path:
        return "models"
    for name in ("raster", "hal", "firmware"):
        if f"/{name}/" in path.split("build/firmware/")[-1]:
            return name
    return "other"


def read_map(path):
    """Of each module: bytes in flash, bytes in RAM, bytes of its own data (initialised or not)."""
    modules, output, name = {}, None, None
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for line in text[text.index("Linker script and memory map"):].splitlines():
        head = re.match(r"^(\.[\w.]+|/DISCARD/)", line)
        if head:
            output = head.group(1)
        found = SECTION.match(line)
        if found and found.group(2) is None:
            name = found.group(1)
            continue
        found = found or (REST.match(line) if name else None)
        name = None
        if not found or output not in (".text", ".fast", ".data", ".bss", ".vectors", ".boot2"):
            continue
        size, source = int(found.group(found.lastindex - 1), 16), found.group(found.lastindex)
        if size == 0 or not (source.endswith(".o") or source.endswith(".o)")):
            continue
        flash_ram_data = modules.setdefault(module_of(source), [0, 0, 0])
        if output != ".bss":
            flash_ram_data[0] += size
        if output in (".bss", ".data", ".fast"):
            flash_ram_data[1] += size
        if output in (".bss", ".data"):
            flash_ram_data[2] += size
    return modules


def symbols(image, tools):
    text = subprocess.run([tools + "nm", image], capture_output=True, text=True, check=True).stdout
    return {fields[2]: int(fields[0], 16) for fields in map(str.split, text.splitlines()) if len(fields) == 3}


def read_budget(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.split("#")[0].split() for line in file]
    return {fields[0]: (int(fields[1]), int(fields[2])) for fields in lines if fields}


def check(modules, budget):
    faults = []
    for name in ("raster", "hal"):
        if name not in modules:
            faults.append(f"the map has nothing of {name}/")
        elif modules[name][2]:
            faults.append(f"{name}/ has {modules[name][2]} bytes of data of its own")
    for name, (flash, ram, _) in modules.items():
        if budget is None:
            continue
        if name not in budget:
            faults.append(f"{name} is not in the budget")
            continue
        for what, is_now, most in (("flash", flash, budget[name][0]), ("RAM", ram, budget[name][1])):
            if is_now > most:
                faults.append(f"{name} takes {is_now} bytes of {what}, {is_now - most} more than its budget of {most}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("image")
    parser.add_argument("map")
    parser.add_argument("--tools", default="")
    parser.add_argument("--budget")
    arguments = parser.parse_args()

    modules, names = read_map(arguments.map), symbols(arguments.image, arguments.tools)
    if "stack_top" in names:
        modules["stack"] = [0, names["stack_top"] - names["stack_bottom"], 0]
    budget = read_budget(arguments.budget) if arguments.budget else None
    faults = check(modules, budget)
    faults += [f"a function of a heap: {name}" for name in names if HEAP.fullmatch(name)]
    faults += [f"floating point: {name}" for name in names if FLOAT.fullmatch(name)]
    print(f"{'':10} {'flash':>8} {'RAM':>8}" + (f" {'of at most':>18}" if budget else ""))
    for name, (flash, ram, _) in modules.items():
        most = budget.get(name) if budget else None
        print(f"{name:10} {flash:8} {ram:8}" + (f" {most[0]:9} {most[1]:8}" if most else ""))
    print(f"{'in all':10} {sum(m[0] for m in modules.values()):8} {sum(m[1] for m in modules.values()):8}")
    for fault in faults:
        print(f"{arguments.image}: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
