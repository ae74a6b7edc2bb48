/* Controllers of small OLED panels (SSD13xx, SSD0323, SH1106): one engine, and for each chip a table of its commands and what they
 * do.
 *
 * The engine reads the wire (commands, their parameters and which level of D/C those take, data), keeps the window and its pointer,
 * and shows the memory through what is between it and the glass: multiplex ratio, display offset, start line, scan direction,
 * wiring of the commons, inversion, all on, all off, currents. Voltages, clocks and tables of grey scales are checked for their
 * number of parameters and change nothing: grey v of 15 looks like 17 v. Scrolling, drawing commands, partial display and reading
 * are refused as not modelled.
 *
 * Column remap is applied to data as they are written and does not move what is there already, which the SSD1306's data sheet says
 * (10.1.8) and the others' leave open. The scan direction moves all of the picture at once. */
#ifndef SIM_CHIPS_OLED_H
#define SIM_CHIPS_OLED_H

#include "chip.h"

typedef struct sim_oled sim_oled_t;

enum {
    SIM_OLED_GUARDED = 1,      /* locked after a reset, until FDh B1h */
    SIM_OLED_NOT_MODELLED = 2, /* in the data sheet, but not here */
};

typedef struct sim_oled_command {
    uint8_t first, last; /* codes: more than one where the lower bits are the argument */
    uint8_t parameters;
    uint8_t flags;
} sim_oled_command_t;

typedef struct sim_oled_part {
    const char *name;
    uint16_t width, height;            /* of the memory, in pixels: segments and commons */
    uint8_t column_pixels, row_pixels; /* what a column's and a row's number counts */
    uint8_t unit_bytes;                /* data that are written at a time, 1 or 2, and then the pointer moves on */
    uint32_t white;                    /* the largest value of a pixel */
    bool parameters_low;               /* with D/C low, like their command */
    bool write_command;                /* data are taken after one; otherwise after any complete command */
    bool reverses_all;                 /* the reversed scan begins at the last common, not at that of the multiplex ratio */
    const sim_oled_command_t *commands;
    size_t command_count;
    void (*defaults)(sim_oled_t *oled);                                   /* registers after a reset, those that are not 0 */
    int (*execute)(sim_oled_t *oled, uint8_t code, const uint8_t *p);     /* 0, or -1 and chip.fault */
    void (*store)(sim_oled_t *oled, const uint8_t *bytes);                /* unit_bytes to the pointer's place */
    void (*colour)(const sim_oled_t *oled, uint32_t value, uint8_t *rgb); /* of a pixel at full current */
    uint32_t rated_clock_hz;
    uint32_t reset_pulse_us; /* least */
    uint32_t settle_us;      /* from the end of a reset to the first command */
} sim_oled_part_t;

/* The glass, and how it is wired to the chip. */
typedef struct sim_oled_module {
    uint16_t width, height;
    uint16_t first_segment;                   /* the lowest that is wired; the commons begin with 0 */
    bool segments_reversed, commons_reversed; /* the lowest is at the right; at the bottom */
    bool commons_split;                       /* even ones come from one side of the chip and odd ones from the other */
    uint8_t full[3];                          /* contrast from which a colour is at its brightest, with full master current */
} sim_oled_module_t;

typedef struct sim_oled_range {
    uint16_t first, last;
} sim_oled_range_t;

struct sim_oled {
    sim_chip_t chip;
    const sim_oled_part_t *part;
    sim_oled_module_t module;
    uint32_t *memory; /* a pixel each, rows of `width` segments */

    /* registers: 0 after a reset unless the part's defaults say otherwise */
    sim_oled_range_t columns, rows; /* the window */
    uint16_t column, row;           /* the pointer */
    uint8_t placed;                 /* COLUMNS, ROWS: told since the reset, and since what they mean was changed */
    bool vertical;                  /* the pointer runs along the rows' numbers first */
    bool column_ends;               /* it stops after the last column: there is no going on without telling it where */
    bool segments_remapped, commons_remapped, nibbles_remapped, commons_split, colours_swapped;
    uint16_t multiplex; /* commons that are scanned */
    uint16_t offset, start_line;
    bool on, inverse, all_on, all_off;
    bool unpowered; /* the charge pump that feeds the glass stands still */
    uint8_t contrast[3];
    uint8_t master; /* 15 = full */
    uint8_t addressing;
    bool locked, guarded;

    /* the wire */
    const sim_oled_command_t *command; /* the one that parameters belong to, or NULL */
    uint8_t code, parameters[64];
    size_t parameter_count;
    bool writing;
    uint8_t cut[2];
    size_t cut_count;

    /* time */
    bool held;
    uint64_t held_since_ns, ready_ns;
};

enum { SIM_OLED_COLUMNS = 1, SIM_OLED_ROWS = 2 };

#define SIM_OLED_REFUSE(oled, ...) sim_fail(&(oled)->chip.fault, __VA_ARGS__)

/* ---- for the chips' own files ---------------------------------------------------------------------------------- */

/* A chip that has just been powered, with noise in its memory. part outlives it. NULL and one line in error without memory. */
sim_chip_t *sim_oled_create(const sim_oled_part_t *part, const sim_oled_module_t *module, sim_error_t *error);

/* First and last of the window, in numbers of columns or rows; the pointer goes to the first. Refused out of the memory or
 * backwards. */
int sim_oled_columns(sim_oled_t *oled, uint8_t first, uint8_t last);
int sim_oled_rows(sim_oled_t *oled, uint8_t first, uint8_t last);

/* Where the pointer goes in its page, half a number at a time; whether it is in the memory shows at the data. */
int sim_oled_page_column(sim_oled_t *oled, unsigned column);

/* 0, or -1 and chip.fault when a parameter is not in least ... most. */
int sim_oled_check(sim_oled_t *oled, const char *what, unsigned value, unsigned least, unsigned most);

/* FDh: the parameter of a command lock. */
int sim_oled_lock(sim_oled_t *oled, uint8_t parameter, bool guards);

/* The memory of a segment in a row. */
uint32_t *sim_oled_at(const sim_oled_t *oled, unsigned segment, unsigned row);

/* Chips of 1 bit a pixel, 8 rows to a byte, D0 the upper one: the commands that they share, and the rest of a part. */
int sim_oled_mono_execute(sim_oled_t *oled, uint8_t code, const uint8_t *p);
void sim_oled_mono_store(sim_oled_t *oled, const uint8_t *bytes);
void sim_oled_mono_colour(const sim_oled_t *oled, uint32_t value, uint8_t *rgb);

/* Greys of 15 as 17 v. */
void sim_oled_grey(const sim_oled_t *oled, uint32_t value, uint8_t *rgb);

/* ---- for tests ------------------------------------------------------------------------------------------------- */

/* A pixel of the memory of any chip made by this engine. */
uint32_t sim_oled_memory(const sim_chip_t *chip, unsigned segment, unsigned row);

#endif
