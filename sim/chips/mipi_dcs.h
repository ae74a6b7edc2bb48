/* Chips of the MIPI DCS family: one engine, one table per chip.
 *
 * Decoded: resets, sleep, inversion, display on and off, windows, memory write and continue, tearing line, address mode, pixel
 * format, scan directions, byte order. Vendor commands are checked for their count of parameters, and for the keys that some chips
 * want before them. What would change the picture in a way that is not modelled (partial mode, scrolling, idle mode, colour tables,
 * other interfaces) is refused as such, and so are the commands that burn the chip's fuses.
 *
 * The chip is one struct of constant data and the module another: a chip does not know which part of its memory is seen, nor which
 * way the glass lies. */
#ifndef SIM_CHIPS_MIPI_DCS_H
#define SIM_CHIPS_MIPI_DCS_H

#include "chip.h"

typedef struct sim_dcs_command {
    uint8_t code;
    uint8_t least, most; /* parameters */
    bool locked;         /* taken only when the part's locks are open */
} sim_dcs_command_t;

/* A parameter of which only some values are modelled. */
typedef struct sim_dcs_rule {
    uint8_t code, index; /* of the command; of the parameter, from 0 */
    uint8_t mask, value; /* refused unless these bits have this value */
} sim_dcs_rule_t;

/* A command that opens or closes locks. */
typedef struct sim_dcs_key {
    uint8_t code, parameter; /* the parameter counts if the command has one */
    uint8_t after;           /* the command that has to stand right before it; 0 = any */
    uint8_t opens, closes;   /* bits */
} sim_dcs_key_t;

typedef struct sim_dcs_format {
    uint8_t code; /* the three low bits of COLMOD */
    uint8_t bits; /* 3 (two pixels a byte), 12 (two pixels in three bytes), 16, 18 (a byte a component) */
} sim_dcs_format_t;

typedef struct sim_dcs_part {
    const char *name;
    uint16_t width, height;            /* of the memory, in pixels */
    const sim_dcs_command_t *commands; /* those that the engine does not decode; the vendor's */
    size_t command_count;
    const sim_dcs_rule_t *rules;
    size_t rule_count;
    const sim_dcs_key_t *keys;
    size_t key_count;
    uint8_t locks;               /* bits that must all be open for a locked command */
    sim_dcs_format_t formats[3]; /* what the serial interface takes; unused ones have no bits */
    uint8_t parallel;            /* bit n: the RGB interface's half of COLMOD may be n, though nothing depends on it */
    uint8_t format_at_reset;
    uint8_t scan_command;        /* whose second parameter has GS (40h) and SS (20h); 0 = none */
    uint8_t wrap_command;        /* whose first parameter has WEMODE (01h): pixels wrap in the window; 0 = they always do */
    uint8_t ram_control_command; /* whose second parameter has EPF (30h), 3 at reset, and ENDIAN (08h); 0 = none */
    bool row_first;              /* where rows and columns are exchanged, columns are taken only right after rows */
    bool no_nop;                 /* NOP disturbs the chip */
    uint8_t id_command, id[3];
    uint32_t rated_clock_hz;
    uint32_t settle_ms; /* after reset, sleep in, sleep out: before any command */
    uint32_t sleep_ms;  /* between sleep in and sleep out, either way; and from a reset of the awake chip to sleep out */
    uint32_t reset_pulse_us;
} sim_dcs_part_t;

/* How the glass is wired to the chip. Lines are counted in pixels from S1 and G1. */
typedef struct sim_dcs_module {
    bool columns_reversed, rows_reversed; /* the first line is at the right or bottom */
    bool bgr;                             /* the colour filter's order from the first line on */
    bool normally_black;                  /* IPS: dark without voltage, so that colours are right when inverted */
    bool round;                           /* the glass is the circle in its rectangle */
    uint16_t first_column, first_row;     /* the lowest lines that have glass */
    uint16_t width, height;               /* of the glass; 0 = all of the memory */
} sim_dcs_module_t;

/* A chip that has just been powered, with noise in its memory. part outlives it. NULL and one line in error without memory. */
sim_chip_t *sim_dcs_create(const sim_dcs_part_t *part, const sim_dcs_module_t *module, sim_error_t *error);

/* The 18 bits of a pixel of the memory, red in the highest 6; column and row as the chip numbers them without mirroring. */
uint32_t sim_dcs_memory(const sim_chip_t *chip, uint32_t column, uint32_t row);

#endif
