/* What a board port writes: how bytes and a few pins get to a panel.
 *
 * A port fills in one tuile_bus_t. A function that the board has no use for stays NULL; command, data and delay_ms must
 * be there. Every function gets `context` back, returns 0 or a tuile_hal_error_t, and may block unless stated otherwise.
 * The display above never calls a bus from two threads at once, and never starts a transfer before the one before it has
 * been waited for, so a port needs no queue and no lock. One whose wire should never rest between two transfers may have a queue of
 * one, and says so by wait_one.
 *
 * D/C: panels tell commands from what follows by a line that is low for commands. Which of a command's bytes are sent with
 * the line low is the panel's habit, so it comes with each call and a port need not know the panel.
 */
#ifndef TUILE_HAL_BUS_H
#define TUILE_HAL_BUS_H

#include <stddef.h>
#include <stdint.h>

/* Negative, and apart from the renderer's codes (-1 ... -31), so that one int can carry either. */
typedef enum tuile_hal_error {
    TUILE_HAL_OK = 0,
    TUILE_HAL_ARGUMENT = -33,    /* a value is out of the range stated here; nothing was sent */
    TUILE_HAL_STATE = -34,       /* the call does not fit here: write without a window, asleep ...; nothing was sent */
    TUILE_HAL_UNSUPPORTED = -35, /* this bus or panel cannot do it; nothing was sent */
    TUILE_HAL_IO = -36,          /* a transfer failed; what arrived is unknown */
    TUILE_HAL_TIMEOUT = -37,     /* a transfer, or the tearing line, did not come to an end */
    TUILE_HAL_PROTOCOL = -38,    /* the far end refused what it got */
    TUILE_HAL_GONE = -39,        /* the device is no longer there: final until it is opened anew */
    TUILE_HAL_BUSY = -40,        /* somebody else has the line or the device */
    TUILE_HAL_NOT_FOUND = -41,   /* no such device, line or chip */
    TUILE_HAL_PERMISSION = -42,  /* it is there, but not for this user */
    TUILE_HAL_SIZE = -43,        /* a transfer is larger than the system takes */
    TUILE_HAL_IDENTITY = -44,    /* another panel answered */
} tuile_hal_error_t;

/* One line of English about a tuile_hal_error_t; never NULL. */
const char *tuile_hal_error_text(int error);

typedef enum tuile_pin {
    TUILE_PIN_RESET = 0,     /* level 0: the panel is held in reset; anything else: it runs */
    TUILE_PIN_BACKLIGHT = 1, /* level 0 dark ... 255 full; a line without PWM is on for anything but 0 */
} tuile_pin_t;

#define TUILE_PIN_BIT(pin) (1u << (pin))

typedef struct tuile_bus {
    void *context;

    /* Upper bounds for the clock of command() and of data(), in Hz, told once before the first transfer. A port chooses the
     * nearest real clock that is not faster. NULL: the clocks are fixed by the board. */
    int (*clocks)(void *context, uint32_t command_clock_hz, uint32_t pixel_clock_hz);

    /* Sends bytes[0 ... low_count) with D/C low, then bytes[low_count ... size_bytes) with D/C high, as one transaction.
     * At most 64 bytes. They are the caller's again when the call returns. */
    int (*command)(void *context, const uint8_t *bytes, size_t low_count, size_t size_bytes);

    /* Sends size_bytes with D/C high, at most max_chunk_bytes at a time. May return before the bytes are out (DMA): they then
     * stay readable and unchanged until wait() has returned. After an error the port does not touch them any more. */
    int (*data)(void *context, const uint8_t *bytes, size_t size_bytes);

    /* Returns when nothing is on the wire, with the fault of the last data() if it had one; the port holds no buffer any
     * more, whatever is returned. NULL: data() never returns early. */
    int (*wait)(void *context);

    /* Returns when the port holds the buffer of at most one data(), the last, with the fault of another if it had one; after an
     * error it holds none. A port that has it takes a data() while one is on the wire, and sends its bytes behind those by itself,
     * whatever the caller does meanwhile; never more than that one wait. NULL: data() comes only when nothing is on the wire. */
    int (*wait_one)(void *context);

    /* Sends one command and reads size_bytes of answer, without the dummy clock or byte that some panels put before it. */
    int (*read)(void *context, uint8_t command, uint8_t *bytes, size_t size_bytes);

    /* Returns after at least delay_ms, not much later. */
    int (*delay_ms)(void *context, uint32_t delay_ms);

    /* Sets a line. Only called for the lines that `pins` names. */
    int (*pin)(void *context, tuile_pin_t pin, uint8_t level);

    /* Returns at the beginning of the next vertical blank, as the panel's tearing-effect line tells it, or
     * TUILE_HAL_TIMEOUT after timeout_ms. NULL: the line is not connected. */
    int (*tearing)(void *context, uint32_t timeout_ms);

    uint32_t max_chunk_bytes; /* of one data(); 0 = no limit. At least TUILE_CHUNK_LEAST_BYTES */
    uint32_t pins;            /* the lines that are there: TUILE_PIN_BIT(...) or-ed; others are tied to their active level */
} tuile_bus_t;

/* 0: no bus of the program has wait_one, and what goes with it is left out. */
#ifndef TUILE_BUS_QUEUES
#define TUILE_BUS_QUEUES 1
#endif

/* Chunks are cut at whole pixels and at even bytes, which for 3-byte pixels is every 6. A panel that is written page by page
 * (SH1106) has one more at the end of each page. */
#define TUILE_CHUNK_LEAST_BYTES 6u

#endif
