"""The checks of linked images find what they look for: small programs that have it must fail, and their twins without it pass.

    test_checks.py FOLDER
"""

import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
TOOLS = "arm-none-eabi-"
FLAGS = ["-mcpu=cortex-m3", "-mthumb", "-std=c11", "-Os", "-ffreestanding", "-ffunction-sections", "-fdata-sections", "-fno-inline",
         "-fno-optimize-sibling-calls", "-fstack-usage", "-fcallgraph-info=su,da"]
RASTER = "int raster(int a) { return a + 1; }\n"  # the checks want something of raster/ and of hal/
HAL = "int hal(int a) { return a + 2; }\n"
MAIN = "int raster(int); int hal(int); volatile int seen;\n"
PLAIN = MAIN + "void reset(void) { seen = raster(seen) + hal(seen); }\n"
# 200 bytes of a buffer on top of what calls it.
DEEP = MAIN + """static void deep(volatile char *at) { volatile char room[200]; room[0] = *at; *at = room[0]; }
void reset(void) { char c = 0; seen = raster(seen) + hal(seen); deep(&c); }
"""
POINTER = MAIN + """typedef struct { void (*unheard)(int); } table_t; table_t table;
static void far_away(int a) { volatile char room[400]; room[0] = (char)a; seen = room[0]; }
void reset(void) { seen = raster(seen) + hal(seen); far_away(0);
    table.unheard(1); }
"""
CHOICE = MAIN + """typedef struct { void (*told)(int); } table_t; table_t table;
static void far_away(int a) { volatile char room[400]; room[0] = (char)a; seen = room[0]; }
static void near_by(int a) { volatile char room[40]; room[0] = (char)a; seen = room[0]; }
void set(void); void set(void) { table.told = near_by; }
void reset(void) { seen = raster(seen) + hal(seen); set();
    (table.told ? table.told : far_away)(1); }
"""
RECURSION = MAIN + """static int again(int a) { volatile char room[16]; room[0] = (char)a; return a ? again(a - 1) + room[0] : 0; }
void reset(void) { seen = raster(seen) + hal(seen) + again(seen); }
"""
DYNAMIC = MAIN + """static int grows(int a) { volatile char room[a]; room[a - 1] = 1; return room[0]; }
void reset(void) { seen = raster(seen) + hal(seen) + grows(seen); }
"""
# 36 + 164 bytes, and 100 of what it calls.
NAKED = MAIN + """void beyond(void); void beyond(void) { volatile char room[100]; room[0] = 1; }
__attribute__((naked, noipa)) void bare(void) { __asm__("push {r4-r11, lr}\\n sub sp, sp, #164\\n bl beyond\\n add sp, sp, #164\\n pop {r4-r11, pc}"); }
void reset(void) { seen = raster(seen) + hal(seen); bare(); }
"""

failed = False


def build(folder, name, main, raster=RASTER, hal=HAL, library=""):
    """A program with parts named as the project's: (image, map, folder)."""
    at = os.path.join(folder, name)
    objects = []
    for part, text in (("raster/r", raster), ("hal/h", hal), ("firmware/f", main), ("firmware/l", library)):
        path = os.path.join(at, part)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path + ".c", "w", encoding="utf-8") as file:
            file.write(text + "typedef int nothing_t;\n")
        subprocess.run([TOOLS + "gcc", *FLAGS, "-c", path + ".c", "-o", path + ".o"], check=True)
        objects.append(path + ".o")
    image, chart = os.path.join(at, "frames.elf"), os.path.join(at, "frames.map")
    subprocess.run([TOOLS + "gcc", *FLAGS, "-nostdlib", "-nostartfiles", "-Wl,-e,reset", "-Wl,--gc-sections", f"-Wl,-Map,{chart}", *objects,
                    "-lgcc", "-o", image], check=True)
    return image, chart, at


def expect(what, command, word):
    """The command fails, and its complaint has the word in it; without a word it succeeds."""
    global failed
    result = subprocess.run([sys.executable, *command], capture_output=True, text=True, check=False)
    if (result.returncode == 0) if word else (result.returncode != 0):
        print(f"{what}: ended with {result.returncode}: {result.stdout}{result.stderr}")
        failed = True
    elif word and word not in result.stderr:
        print(f"{what}: no word of '{word}' in: {result.stderr}")
        failed = True


def image_check(built, budget=None):
    return [f"{HERE}/image.py", built[0], built[1], "--tools", TOOLS] + (["--budget", budget] if budget else [])


def stack_check(built, calls, *more):
    return [f"{HERE}/stack.py", built[0], built[2], "--tools", TOOLS, "--calls", calls, *more]


def write(folder, name, text):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def check_images(folder):
    plain = build(folder, "plain", PLAIN)
    expect("a plain program", image_check(plain), None)
    expect("single precision", image_check(build(folder, "float", PLAIN, raster="float f = 1; int raster(int a) { return (int)(a / f); }\n")),
           "floating point: __aeabi_fdiv")
    expect("double precision", image_check(build(folder, "double", PLAIN, raster="int raster(int a) { return (int)(a * 1.5); }\n")),
           "floating point: __aeabi_dmul")
    expect("division of 64 bits", image_check(build(folder, "long", PLAIN, raster="int raster(int a) { return (int)(0x123456789ll / a); }\n")), None)
    expect("a heap", image_check(build(folder, "heap", PLAIN, raster="void *malloc(unsigned n); int raster(int a) { return *(int *)malloc(a); }\n",
                                       library="static char heap[64]; void *malloc(unsigned n) { return heap + n; }\n")), "a function of a heap: malloc")
    expect("initialised data", image_check(build(folder, "data", PLAIN, raster="int raster(int a) { static int n = 3; return n += a; }\n")),
           "raster/ has 4 bytes of data")
    expect("zeroed data", image_check(build(folder, "bss", PLAIN, hal="int hal(int a) { static int n[3]; return n[a]++; }\n")),
           "hal/ has 12 bytes of data")
    # raster: adds r0, #1; bx lr: 4 bytes.
    expect("a budget that suffices", image_check(plain, write(folder, "enough", "raster 4 0\nhal 4 0\nfirmware 64 4\n")), None)
    expect("a budget that does not", image_check(plain, write(folder, "tight", "raster 3 0\nhal 4 0\nfirmware 64 4\n")),
           "raster takes 4 bytes of flash, 1 more than its budget of 3")
    expect("too much RAM", image_check(plain, write(folder, "ram", "raster 4 0\nhal 4 0\nfirmware 64 3\n")),
           "firmware takes 4 bytes of RAM, 1 more")
    expect("a module that nobody budgets", image_check(plain, write(folder, "none", "raster 4 0\nhal 4 0\n")), "firmware is not in the budget")


def check_stacks(folder):
    nothing = write(folder, "calls", "")
    deep = build(folder, "deep", DEEP)
    expect("a deep stack", stack_check(deep, nothing, "--room", "400"), None)
    expect("a stack without room", stack_check(deep, nothing, "--room", "200"), "more than the 200")
    pointer = build(folder, "pointer", POINTER)
    expect("a pointer to nobody knows", stack_check(pointer, nothing), "what does the pointer call")
    expect("a pointer that is told", stack_check(pointer, write(folder, "told", "reset: far_away\n"), "--room", "500"), None)
    expect("a pointer that is told, in too little room", stack_check(pointer, write(folder, "told", "reset: far_away\n"), "--room", "400"), "more")
    expect("a pointer to a function that is not there", stack_check(pointer, write(folder, "told", "reset: gone\n")), "what does the pointer call")
    choice = build(folder, "choice", CHOICE)
    expect("a choice of pointers", stack_check(choice, nothing, "--room", "500"), None)
    expect("a choice of pointers, in too little room", stack_check(choice, nothing, "--room", "400"), "more")
    recursion = build(folder, "recursion", RECURSION)
    expect("recursion", stack_check(recursion, nothing), "recursion without a stated depth: again -> again")
    expect("recursion of a depth", stack_check(recursion, write(folder, "depth", "recursion again 10\n"), "--room", "400"), None)
    expect("recursion of a depth, in too little room", stack_check(recursion, write(folder, "depth", "recursion again 10\n"), "--room", "200"), "more")
    expect("an array of any length", stack_check(build(folder, "dynamic", DYNAMIC), nothing), "no bound")
    naked = build(folder, "naked", NAKED)
    expect("assembly", stack_check(naked, nothing, "--room", "400"), None)
    expect("assembly in too little room for what it calls", stack_check(naked, nothing, "--room", "300"), "more than the 300")
    expect("no entry", stack_check(deep, nothing, "--entry", "nobody"), "there is no nobody")


def main():
    check_images(sys.argv[1])
    check_stacks(sys.argv[1])
    if not failed:
        print("The checks of images and stacks find what they look for")
    return 1 if failed else 0


sys.exit(main())
