/* tuile mcus: the microcontrollers that --mcu takes. */
#include "commands.h"
#include "mcu.h"

#include <stdio.h>
#include <string.h>

static const char usage[] =
    "Usage: tuile mcus\n"
    "\n"
    "Lists the microcontrollers that --mcu takes: their core, its clock, cycles of an instruction and where\n"
    "that figure is from; the fastest clock of SPI, and whether the core feeds it itself.\n";

int command_mcus(int count, char **arguments) {
    if (count > 0 && strcmp(arguments[0], "--help") == 0) {
        (void)fputs(usage, stdout);
        return command_finish();
    }
    if (count > 0) { return command_fail("mcus: takes no arguments, but got %s", arguments[0]), EXIT_USAGE; }
    for (size_t i = 0; i < sim_mcu_count; i++) {
        const sim_mcu_t *mcu = &sim_mcus[i];
        (void)printf("%-11s %3u MHz, %s at %.2f cycles (%s)", mcu->name, mcu->core_hz / 1000000u, mcu->core,
                     mcu->cycles_milli / 1000.0, mcu->cycles_from);
        (void)printf("; SPI up to %.1f MHz%s\n", mcu->source_hz / mcu->least / 1e6, mcu->polled ? ", fed by the core" : "");
    }
    return command_finish();
}
