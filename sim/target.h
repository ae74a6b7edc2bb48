/* Displays by name, as --display takes them: a simulated panel, a panel on Linux's spidev, a display on USB. Whatever it is, what
 * comes of it is a tuile_display_t, and the same frame loop serves it. */
#ifndef SIM_TARGET_H
#define SIM_TARGET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../hal/display.h"
#include "../hal/linux/bus.h"
#include "../hal/usb/ax206.h"
#include "../hal/usb/gud.h"
#include "bus.h"
#include "error.h"
#include "mcu.h"
#include "panels.h"

typedef enum target_kind {
    TARGET_SIM,
    TARGET_SPI,
    TARGET_GUD,
    TARGET_AX206,
} target_kind_t;

/* A GPIO line by name: "gpiochip0:25", or "gpiochip0:25:low". */
typedef struct target_line {
    char chip[48]; /* "" = not connected */
    uint32_t offset;
    bool active_low;
} target_line_t;

/* What the text says. */
typedef struct target_config {
    target_kind_t kind;
    char text[256]; /* for messages */

    const sim_panel_t *module; /* of a panel on a bus: as it is sold */
    tuile_panel_t panel;       /* its data as the driver gets them, with what the text changes */
    const sim_mcu_t *mcu;      /* SIM: whose clocks it has; NULL: any */
    uint32_t clock_hz;         /* of pixels; 0 = the panel's usual one */
    uint32_t command_clock_hz; /* 0 = the panel's */
    uint32_t max_chunk_bytes;  /* SIM; 0 = no limit */
    char device[64];           /* SPI: the node */
    target_line_t dc, reset, backlight, tearing;
    uint32_t tearing_timeout_ms; /* 0 = frames do not wait */
    uint8_t mode;                /* SPI */
    bool no_worker;
    char serial[64];                  /* USB; "" = any */
    uint16_t mode_width, mode_height; /* GUD; 0 = as the device prefers */
    bool no_compression;              /* GUD */
    uint32_t timeout_ms, wait_ms;     /* USB: of a transfer, 0 = the driver's; for a display to be plugged in */
    uint8_t brightness;               /* 0 = full */
    bool identify;
} target_config_t;

extern const char target_usage[];

/* Reads "sim:ili9341,clock=40M,mcu=rp2040" and its kin. 0, or -1 and one line in error that names the part which is wrong. */
int target_parse(target_config_t *config, const char *text, sim_error_t *error);

/* The same for a panel that is named alone, on the simulated bus. */
int target_parse_panel(target_config_t *config, const char *name, sim_error_t *error);

/* Must not be moved while it is open. */
typedef struct target {
    target_config_t config;
    tuile_display_t display;
    uint8_t rotation;

    sim_chip_t *chip; /* SIM; else NULL */
    sim_bus_t bus;
    tuile_linux_t port; /* SPI */
    tuile_gud_t gud;
    tuile_ax206_t ax206;
    uint64_t begun_ns; /* of the frame: the time of the day */
} target_t;

/* Opens it and starts the display; wire: tuile_wire_t. 0, or -1 and one line in error; then nothing is left open. */
int target_open(target_t *target, const target_config_t *config, uint8_t rotation, uint8_t wire, sim_error_t *error);

/* Leaves the panel dark, and releases all. Does nothing for {0}, or when it was closed before. */
void target_close(target_t *target);

/* What the far end said of the last error, "" when it said nothing. */
const char *target_detail(const target_t *target);

/* Figures of a frame: from target_begin_frame on. bytes is 0 where nobody counts them. */
void target_begin_frame(target_t *target);
void target_frame_figures(const target_t *target, uint64_t *bytes, uint64_t *frame_ns);

/* Can it be looked at? Only what is simulated. */
bool target_is_simulated(const target_t *target);

/* What is seen by someone who holds the device so that it reads upright, and the glass as it lies at rotation 0: either may be
 * NULL. 0, or -1 and one line in error. */
int target_picture(const target_t *target, sim_picture_t *seen, sim_picture_t *glass, sim_error_t *error);

#endif
