/* A Linux board that umockdev makes up: /dev/spidev0.0 and /dev/gpiochip0, and behind them the model of a panel's chip.
 *
 * What stands in for the kernel obeys the interface's own documents (linux/spi/spidev.h, linux/gpio.h, both versions of the GPIO
 * interface): the level of the D/C line, as the line's requests set it, tells the chip what the bytes are. Only one board at a
 * time, and only under the preloaded library. */
#ifndef TESTS_MOCK_LINUX_H
#define TESTS_MOCK_LINUX_H

#include <semaphore.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <umockdev.h>

#include "../../hal/linux/bus.h"
#include "../../sim/panels.h"

enum { MOCK_BACKLIGHT = 18, MOCK_TEARING = 24, MOCK_DC = 25, MOCK_RESET = 27, MOCK_TAKEN = 8, MOCK_LINES = 54 };

/* One transfer of a message, as spidev got it. */
typedef struct mock_transfer {
    bool dc; /* the line's level */
    uint32_t size_bytes, clock_hz;
    uint8_t bits, first; /* first: its first byte; 0 for a read */
    uint8_t count;       /* transfers of the message that it belongs to */
} mock_transfer_t;

typedef struct mock_request {
    bool edges, active_low, first_level;
    int fd, fill;  /* fill: where the test writes edges to */
    uint64_t file; /* that fd stands for, as its number may come again */
    char consumer[32];
} mock_request_t;

typedef struct mock_linux {
    /* Zero = default. Set before mock_linux_open. */
    uint32_t bufsiz;         /* 0: the parameter cannot be read, and it is 4096 */
    const char *bufsiz_text; /* in the place of the number; NULL: none */
    uint32_t real_bufsiz;    /* what messages are held against; 0: bufsiz */
    const uint8_t *reply;    /* bytes that a read gets, as they are on the wire; NULL: the chip's answer */
    uint32_t mode;           /* SPI mode and flags; in the end as the port has set them */
    bool wire_time;          /* a message takes as long as its bits do */
    bool real_time;          /* the board's clock is the real one, for ports whose pauses are real */
    uint32_t late_us;        /* and this much more */

    UMockdevTestbed *bed;
    sim_chip_t *chip;
    uint64_t now_ns; /* goes by the wire and by mock_linux_delay */
    bool level[MOCK_LINES];
    mock_request_t requests[MOCK_LINES];

    /* A fault: ioctl number fail_call (1 = the first; counted from when the caller zeroes calls) answers fail_errno, or, where
     * cut, half of a message's bytes. ESHUTDOWN and ENODEV last. */
    unsigned calls, fail_call;
    int fail_errno;
    bool cut, gone;
    bool hold; /* messages wait for `go` */
    sem_t go;
    unsigned own_descriptors; /* of the testbed, which stands on pseudo-terminals */

    mock_transfer_t log[4096];
    unsigned transfers;
    sim_error_t misuse; /* the first thing that the kernel would have refused in another way than the caller can see */
} mock_linux_t;

/* panel: as in sim_panels. The mock must stay where it is. Nodes are made once and serve one mock after the other, since making
 * them takes much longer than a frame. */
void mock_linux_open(mock_linux_t *mock, const char *panel);
void mock_linux_close(mock_linux_t *mock);

/* Removes the nodes. After a group of tests, and where a test has changed them. state may be NULL. */
int mock_linux_end(void **state);

/* dc, reset and backlight on the lines above. */
tuile_linux_config_t mock_linux_config(void);

/* The same port, but its pauses pass in the mock's time only. */
int mock_linux_port(mock_linux_t *mock, tuile_linux_t *port, const tuile_linux_config_t *config);

/* Descriptors of the board's nodes that this process has open: devices, chips and lines. */
unsigned mock_linux_descriptors(const mock_linux_t *mock);

/* Lines whose request is still open. */
unsigned mock_linux_held(const mock_linux_t *mock);

/* The tearing line rises. */
void mock_linux_edge(mock_linux_t *mock);

/* What is seen by someone who holds the device so that a display of this rotation reads upright. To be released. */
sim_picture_t mock_linux_picture(const mock_linux_t *mock, unsigned rotation);

#endif
