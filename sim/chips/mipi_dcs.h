/* Chips of the MIPI DCS family: one engine, one table per chip.
 *
 * Decoded: resets, sleep, inversion, display on and off, windows, memory write and continue, tearing line, address mode, pixel
 * format, scan directions. Vendor commands are checked for their count of parameters. What would change the picture in a way that
 * is not modelled (partial mode, scrolling, idle mode, colour tables, other data formats) is refused as such, and so are the
 * commands that burn the chip's fuses. */
#ifndef SIM_CHIPS_MIPI_DCS_H
#define SIM_CHIPS_MIPI_DCS_H

#include "chip.h"

typedef struct sim_dcs_command {
    uint8_t code;
    uint8_t least, most; /* parameters */
} sim_dcs_command_t;

typedef struct sim_dcs_part {
    const char *name;
    uint16_t width, height;            /* of the memory, in pixels */
    const sim_dcs_command_t *commands; /* those that the engine does not decode; the vendor's */
    size_t command_count;
    uint8_t scan_command;      /* whose second parameter has GS (40h) and SS (20h); 0 = none */
    uint8_t interface_command; /* refused unless its parameters are the defaults, but for bit 0 of the first, WEMODE; 0 = none */
    uint8_t id4[3];
    uint32_t rated_clock_hz;
    uint32_t settle_ms; /* after reset, sleep in, sleep out: before any command */
    uint32_t sleep_ms;  /* between sleep in and sleep out, either way; and from a reset of the awake chip to sleep out */
    uint32_t reset_pulse_us;
} sim_dcs_part_t;

/* How the glass is wired to the chip. */
typedef struct sim_dcs_module {
    bool columns_reversed, rows_reversed; /* column or row 0 at the right or bottom with SS = 0, GS = 0 */
    bool bgr;                             /* the colour filter's order */
} sim_dcs_module_t;

/* A chip that has just been powered, with noise in its memory. part outlives it. NULL and one line in error without memory. */
sim_chip_t *sim_dcs_create(const sim_dcs_part_t *part, const sim_dcs_module_t *module, sim_error_t *error);

/* The 18 bits of a pixel of the memory, red in the highest 6; column and row as the chip numbers them without mirroring. */
uint32_t sim_dcs_memory(const sim_chip_t *chip, uint32_t column, uint32_t row);

#endif
