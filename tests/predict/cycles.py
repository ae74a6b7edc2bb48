"""Cycles of counted instructions, by the tables of the cores' technical reference manuals.

Cortex-M0+: DDI 0484, table 3-1, with the single-cycle multiplier. Cortex-M4: DDI 0439, table 3-1: a branch that is taken refills the
pipeline in P = 1 to 3 cycles, taken as 2; a load or store of one register behind another takes 1 cycle instead of 2; a division
takes 2 to 12, taken as 7. Memory without wait states.
"""
import re
import subprocess

LINE = re.compile(r"^\s*([0-9a-f]+):\s+(\S+)\s*([^;@]*)")
CONDITIONS = "eq ne cs cc mi pl vs vc hi ls ge lt gt le hs lo".split()
TARGET = re.compile(r"([0-9a-f]+) <")


class Instruction:
    def __init__(self, address, name, operands):
        self.address = address
        self.name = name.replace(".n", "").replace(".w", "")
        self.operands = operands.strip()
        self.count = 0
        self.taken = 0.0

    @property
    def is_conditional(self):
        return self.name in ("cbz", "cbnz") or (self.name[0] == "b" and self.name[1:] in CONDITIONS)

    @property
    def is_jump(self):
        return self.name == "b"

    @property
    def target(self):
        found = TARGET.search(self.operands)
        return int(found.group(1), 16) if found else None

    @property
    def registers(self):
        braces = self.operands[self.operands.find("{") + 1:self.operands.find("}")]
        total = 0
        for part in braces.split(","):
            ends = [int(n) for n in re.findall(r"r(\d+)", part)]
            total += ends[1] - ends[0] + 1 if len(ends) == 2 else 1
        return total

    @property
    def is_single(self):
        return self.name[:3] in ("ldr", "str") and self.name not in ("ldrd", "strd")


def read(objdump, elf, counts):
    program = []
    for line in subprocess.run([objdump, "-d", "--no-show-raw-insn", elf], check=True, stdout=subprocess.PIPE).stdout.decode().splitlines():
        found = LINE.match(line)
        if found and not found.group(2).startswith("."):
            program.append(Instruction(int(found.group(1), 16), found.group(2), found.group(3)))
    by_address = {i.address: i for i in program}
    with open(counts, encoding="ascii") as file:
        for line in file:
            address, count = line.split()
            by_address[int(address, 16)].count = int(count)
    return program, by_address


def tell_taken(program, by_address):
    """How often conditional branches jump: what comes to the instruction behind one falls through, but for what jumps there."""
    pairs = [(branch, behind) for branch, behind in zip(program, program[1:]) if branch.is_conditional and branch.count]
    for i in program:
        i.taken = float(i.count) if i.is_jump else 0.0
    for _ in range(50):
        come = {}
        for i in program:
            if i.taken and i.target in by_address:
                come[i.target] = come.get(i.target, 0.0) + i.taken
        for branch, behind in pairs:
            falls = min(branch.count, max(0.0, behind.count - come.get(behind.address, 0.0)))
            branch.taken = branch.count - falls


def m0plus(i, _):
    if i.is_conditional:
        return i.count + i.taken
    if i.name in ("b", "bx", "blx"):
        return 2 * i.count
    if i.name == "bl":
        return 3 * i.count
    if i.name in ("push", "pop") or i.name[:3] in ("ldm", "stm"):
        return (i.registers + (3 if "pc" in i.operands else 1)) * i.count
    if i.is_single:
        return 2 * i.count
    return i.count


def m4(i, before):
    refill = 2
    if i.is_conditional:
        return i.count + refill * i.taken
    if i.name in ("b", "bx", "blx", "bl"):
        return (1 + refill) * i.count
    if i.name in ("tbb", "tbh"):
        return (2 + refill) * i.count
    if i.name in ("push", "pop") or i.name[:3] in ("ldm", "stm"):
        return (1 + i.registers + (refill if "pc" in i.operands else 0)) * i.count
    if i.name in ("ldrd", "strd"):
        return 3 * i.count
    if i.is_single:
        return (1 if before is not None and before.is_single else 2) * i.count
    if i.name in ("udiv", "sdiv"):
        return 7 * i.count
    return i.count


TABLES = {"cortex-m0plus": m0plus, "cortex-m4": m4}


def of_run(core, elf, counts):
    """(instructions, cycles) of what was counted, None for a core without a table."""
    if core not in TABLES:
        return None
    program, by_address = read("arm-none-eabi-objdump", elf, counts)
    tell_taken(program, by_address)
    before, cycles = None, 0.0
    for i in program:
        if i.count:
            cycles += TABLES[core](i, before)
        before = i
    return sum(i.count for i in program), cycles
