/* Runs the Black Pill's program as it is flashed: unicorn has the Cortex-M4, what the program uses of an STM32F411 is modelled here
 * (stm32f411.c), and its panel's wires are written down (trace.h).
 *
 * Usage: blackpill PROGRAM.bin TRACE [SECONDS]   SECONDS: the limit, 120 by default
 *
 * The chip is as slow as it may be: it goes on only while the program looks at it or sleeps, so a wait that is left out is seen.
 * The program's lines go to stdout. Exit code 0 when the program ended with 0; else 1 and one line on stderr that begins with the
 * reason. */
#include "stm32f411.h"

#include <stdlib.h>
#include <string.h>
#include <unicorn/unicorn.h>

#define FLASH_AT 0x08000000u
#define FLASH_BYTES (512u * 1024u)
#define RAM_AT 0x20000000u
#define RAM_BYTES (128u * 1024u)
#define PERIPHERALS_AT 0x40000000u
#define PERIPHERALS_BYTES 0x30000u
#define SYSTEM_AT 0xe000e000u
#define SYSTEM_BYTES 0x1000u

#define EXCEPTION_BREAK 7u /* unicorn's numbers: BKPT, and a branch to EXC_RETURN */
#define EXCEPTION_RETURN 8u
#define SYS_EXIT_EXTENDED 0x20u
#define WFI 0xbf30u
#define CPSIE 0xb662u              /* of interrupts */
#define BACK_TO_THREAD 0xfffffff9u /* EXC_RETURN (DDI 0403, B1.5.8) */

typedef struct machine {
    uc_engine *uc;
    stm32f411_t chip;
    bool ended, handling;
    uint32_t code;
    uint64_t limit_us;
} machine_t;

static uint32_t get(uc_engine *uc, int which) {
    uint32_t value = 0;

    (void)uc_reg_read(uc, which, &value);
    return value;
}

static void set(uc_engine *uc, int which, uint32_t value) { (void)uc_reg_write(uc, which, &value); }

static void stop_if_refused(machine_t *machine) {
    if (machine->chip.fault[0]) { (void)uc_emu_stop(machine->uc); }
}

static uint64_t read_peripheral(uc_engine *uc, uint64_t offset, unsigned size, void *context) {
    machine_t *machine = context;
    const uint32_t value = stm32f411_read(&machine->chip, PERIPHERALS_AT + (uint32_t)offset, size);

    (void)uc;
    stop_if_refused(machine);
    return value;
}

static void write_peripheral(uc_engine *uc, uint64_t offset, unsigned size, uint64_t value, void *context) {
    machine_t *machine = context;

    (void)uc;
    stm32f411_write(&machine->chip, PERIPHERALS_AT + (uint32_t)offset, size, (uint32_t)value);
    stop_if_refused(machine);
}

static uint64_t read_system(uc_engine *uc, uint64_t offset, unsigned size, void *context) {
    return read_peripheral(uc, SYSTEM_AT - PERIPHERALS_AT + offset, size, context);
}

static void write_system(uc_engine *uc, uint64_t offset, unsigned size, uint64_t value, void *context) {
    write_peripheral(uc, SYSTEM_AT - PERIPHERALS_AT + offset, size, value, context);
}

/* A handler's end, semihosting's, or what should not be. */
static void interrupt(uc_engine *uc, uint32_t number, void *context) {
    machine_t *machine = context;
    uint32_t block[2] = {0};

    if (number == EXCEPTION_RETURN && machine->handling) {
        (void)uc_emu_stop(uc);
        return;
    }
    if (number != EXCEPTION_BREAK || get(uc, UC_ARM_REG_R0) != SYS_EXIT_EXTENDED ||
        uc_mem_read(uc, get(uc, UC_ARM_REG_R1), block, sizeof block)) {
        stm32f411_refuse(&machine->chip, "exception %u at 0x%08x", number, get(uc, UC_ARM_REG_PC));
    }
    machine->ended = true;
    machine->code = block[1];
    (void)uc_emu_stop(uc);
}

static bool read_memory(void *context, uint32_t address, uint8_t *bytes, uint32_t size_bytes) {
    machine_t *machine = context;

    return address >= RAM_AT && address - RAM_AT <= RAM_BYTES && size_bytes <= RAM_BYTES - (address - RAM_AT) &&
           uc_mem_read(machine->uc, address, bytes, size_bytes) == UC_ERR_OK;
}

/* Until the program ends or sleeps, a handler returns, or PC is `until` (0: any). */
static bool go(machine_t *machine, uint32_t until) {
    const uint32_t pc = get(machine->uc, UC_ARM_REG_PC);
    const uc_err error = uc_emu_start(machine->uc, pc | 1u, until, machine->limit_us, 0);
    size_t late = 0;

    if (machine->chip.fault[0]) { return false; }
    if (error != UC_ERR_OK) {
        stm32f411_refuse(&machine->chip, "%s at 0x%08x", uc_strerror(error), get(machine->uc, UC_ARM_REG_PC));
        return false;
    }
    if (uc_query(machine->uc, UC_QUERY_TIMEOUT, &late) == UC_ERR_OK && late) {
        stm32f411_refuse(&machine->chip, "not done after %u s", (unsigned)(machine->limit_us / 1000000u));
        return false;
    }
    return true;
}

/* The handler as a call from between two instructions, with the frame that the core would have pushed. */
static bool handle(machine_t *machine, unsigned irq) {
    uc_context *before = NULL;
    const uint32_t sp = get(machine->uc, UC_ARM_REG_SP);
    uint32_t handler = 0;
    bool done;

    if (uc_context_alloc(machine->uc, &before) || uc_context_save(machine->uc, before)) { return false; }
    (void)uc_mem_read(machine->uc, FLASH_AT + 4u * (16u + irq), &handler, sizeof handler);
    set(machine->uc, UC_ARM_REG_SP, (sp & ~7u) - 32u);
    set(machine->uc, UC_ARM_REG_LR, BACK_TO_THREAD);
    set(machine->uc, UC_ARM_REG_PC, handler);
    machine->handling = true;
    done = go(machine, 0);
    machine->handling = false;
    (void)uc_context_restore(machine->uc, before);
    (void)uc_context_free(before);
    if (done && stm32f411_pending(&machine->chip)) {
        stm32f411_refuse(&machine->chip, "the handler of interrupt %u leaves its request standing", irq);
    }
    return done && !machine->chip.fault[0];
}

/* The core sleeps: what is on its way arrives, and wakes it. The interrupt is let in after the next instruction, which must be
 * CPSIE: what else a program might do there is not modelled. */
static bool sleep_and_wake(machine_t *machine) {
    const uint32_t pc = get(machine->uc, UC_ARM_REG_PC);
    uint16_t next = 0;

    stm32f411_sleep(&machine->chip);
    (void)uc_mem_read(machine->uc, pc, &next, sizeof next);
    if (!stm32f411_pending(&machine->chip)) { stm32f411_refuse(&machine->chip, "the core sleeps, and nothing will wake it"); }
    if (!(get(machine->uc, UC_ARM_REG_PRIMASK) & 1u) || next != CPSIE) {
        stm32f411_refuse(&machine->chip, "WFI at 0x%08x is not one with interrupts held back before it and let in behind it",
                         pc - 2u);
    }
    return !machine->chip.fault[0] && go(machine, pc + 2u) && handle(machine, (unsigned)stm32f411_irq(&machine->chip));
}

static void run(machine_t *machine) {
    while (go(machine, 0) && !machine->ended) {
        const uint32_t pc = get(machine->uc, UC_ARM_REG_PC);
        uint16_t at[2] = {0};

        (void)uc_mem_read(machine->uc, pc - 2u, at, sizeof at);
        if (at[0] != WFI && at[1] != WFI) {
            stm32f411_refuse(&machine->chip, "stopped at 0x%08x", pc);
            return;
        }
        if (at[0] != WFI) { set(machine->uc, UC_ARM_REG_PC, (pc + 2u) | 1u); }
        if (!sleep_and_wake(machine)) { return; }
    }
}

static bool load(machine_t *machine, const char *path) {
    static uint8_t flash[FLASH_BYTES];
    FILE *file = fopen(path, "rb");
    uint32_t first[2];
    size_t size_bytes;

    if (!file) { return false; }
    size_bytes = fread(flash, 1, sizeof flash, file);
    (void)fclose(file);
    if (size_bytes < sizeof first) { return false; }
    memcpy(first, flash, sizeof first);
    if (uc_open(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS, &machine->uc) ||
        uc_ctl_set_cpu_model(machine->uc, UC_CPU_ARM_CORTEX_M4) ||
        uc_mem_map(machine->uc, FLASH_AT, FLASH_BYTES, UC_PROT_READ | UC_PROT_EXEC) ||
        uc_mem_map(machine->uc, RAM_AT, RAM_BYTES, UC_PROT_READ | UC_PROT_WRITE) ||
        uc_mmio_map(machine->uc, PERIPHERALS_AT, PERIPHERALS_BYTES, read_peripheral, machine, write_peripheral, machine) ||
        uc_mmio_map(machine->uc, SYSTEM_AT, SYSTEM_BYTES, read_system, machine, write_system, machine) ||
        uc_mem_write(machine->uc, FLASH_AT, flash, size_bytes)) {
        return false;
    }
    set(machine->uc, UC_ARM_REG_SP, first[0]);
    set(machine->uc, UC_ARM_REG_PC, first[1]);
    return true;
}

int main(int count, char **arguments) {
    static machine_t machine;
    uc_hook hook;
    FILE *trace = count >= 3 ? fopen(arguments[2], "wb") : NULL;

    if (!trace) {
        (void)fputs("Usage: blackpill PROGRAM.bin TRACE [SECONDS]\n", stderr);
        return 2;
    }
    machine.limit_us = 1000000u * (count > 3 ? strtoull(arguments[3], NULL, 10) : 120u);
    stm32f411_open(&machine.chip, trace, read_memory, &machine);
    if (!load(&machine, arguments[1])) {
        (void)fprintf(stderr, "blackpill: %s cannot be loaded\n", arguments[1]);
        return 1;
    }
    (void)uc_hook_add(machine.uc, &hook, UC_HOOK_INTR, (void *)(uintptr_t)interrupt, &machine, 1, 0);
    run(&machine);
    stm32f411_close(&machine.chip);
    (void)uc_close(machine.uc);
    (void)fflush(stdout);
    if (!machine.chip.fault[0] && machine.code == 0 && fclose(trace) == 0) { return 0; }
    if (!machine.chip.fault[0]) { stm32f411_refuse(&machine.chip, "the program ended with %u", machine.code); }
    (void)fprintf(stderr, "blackpill: %s; after %.3f ms; last told: %s\n", machine.chip.fault, (double)machine.chip.now_ns / 1e6,
                  machine.chip.line[0] ? machine.chip.line : "nothing");
    return 1;
}
