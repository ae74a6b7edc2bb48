/* The Uno in simavr, with the model of an SSD1306 at its pins: runs the flashed image and holds each frame against the simulator's.
 *
 * Usage: uno test IMAGE.bin MODELS          every frame of a round, compared; and the stack
 *        uno demo IMAGE.bin MODELS          the demo: a round, then its button; the rate in the corner by this clock
 *        uno show IMAGE.bin MODELS FOLDER   saves the frames as PNG, tells the cycles of each
 *
 * MODELS: the folder of the compiled models (`make firmware-models`). An error is a line on stderr and ends it with 1.
 *
 * simavr 1.6 has every byte of the SPI take 100 us and does not mind how it is used. Here a byte takes 8 clocks of the divider that
 * is set (data sheet, 19.5), and what a chip would not do is a fault: SPI off or in slave mode, pins that are inputs, a byte
 * written while another is on its way, D/C or chip select moved meanwhile. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/avr_ioport.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>

#include "uno_demo.h"

#include "../../firmware/player.h"
#include "../../firmware/uno/tell.h"
#include "../../sim/mesh/mesh.h"
#include "../../sim/target.h"

#define CLOCK_HZ 16000000u
#define LIMIT_CYCLES (60u * (uint64_t)CLOCK_HZ) /* of one frame */
#define STACK_MARGIN 256u                       /* bytes that must be left */
#define RAM_END 0x8ffu
#define PAINT 0xa5u /* start.S */

/* Data space (data sheet, section 36). */
enum {
    DDRB = 0x24,
    PORTB = 0x25,
    GPIOR0 = 0x3e,
    GPIOR1 = 0x4a,
    GPIOR2 = 0x4b,
    SPCR = 0x4c,
    SPSR = 0x4d,
    SPDR = 0x4e,
    SPL = 0x5d,
    PRR = 0x64
};
enum { PIN_RESET = 0x01, PIN_DC = 0x02, PIN_SELECT = 0x04, PIN_DATA = 0x08, PIN_CLOCK = 0x20 };
enum { PORTD = 0x2b, DDRD = 0x2a, PIN_BUTTON = 2 }; /* the pin's number */
enum { SPE = 0x40, DORD = 0x20, MSTR = 0x10, CPOL_CPHA = 0x0c, SPIF = 0x80, PRSPI = 0x04 };

typedef struct uno {
    avr_t *avr;
    sim_chip_t *chip;
    const char *models, *folder; /* folder: NULL: frames are compared */
    sim_error_t error;           /* the first fault */
    uint8_t sent, sent_port;     /* the byte on the wire, and the pins when it set out */
    uint32_t sent_clock_hz;
    bool sending, ended, reset, demo;
    uint64_t begun, last_told; /* cycles */
    uint64_t took;             /* likewise, the last frame */
    unsigned shown, bytes, stack_unused, stack_low;
    struct {
        target_t target;
        player_t player;
        uint8_t *model, *block;
    } expected[UNO_SHOWS];
} uno_t;

static const struct {
    const char *scene, *method_name;
    uint8_t method;
} shows[UNO_SHOWS] = {
    [UNO_CUBE_ZBUFFER] = {"cube", "zbuffer", TUILE_ZBUFFER},
    [UNO_ROOM_TREE] = {"room", "tree", TUILE_TREE},
    [UNO_CUBE_TREE] = {"cube", "tree", TUILE_TREE},
};

static uint64_t now_ns(const uno_t *uno) { return uno->avr->cycle * 1000u / (CLOCK_HZ / 1000000u); }

static void fault(uno_t *uno, const char *text) {
    if (!uno->error.text[0]) { (void)sim_fail(&uno->error, "cycle %" PRIu64 ": %s", uno->avr->cycle, text); }
}

/* ---- the wire ---- */

static avr_cycle_count_t byte_out(avr_t *avr, avr_cycle_count_t when, void *param) {
    uno_t *uno = param;
    const uint8_t port = avr->data[PORTB];

    (void)when;
    uno->sending = false;
    avr->data[SPSR] |= SPIF;
    if ((port ^ uno->sent_port) & (PIN_DC | PIN_SELECT)) { fault(uno, "D/C or chip select moved while a byte was on the wire"); }
    if (!uno->reset) { fault(uno, "a byte, but the panel was never reset"); }
    if (port & PIN_SELECT) {
        fault(uno, "a byte while the panel is not selected");
    } else if (uno->chip->receive(uno->chip, (port & PIN_DC) != 0, &uno->sent, 1, uno->sent_clock_hz, now_ns(uno))) {
        fault(uno, uno->chip->fault.text);
    }
    uno->bytes++;
    return 0;
}

static void byte_written(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    static const uint8_t divider_bits[4] = {2, 4, 6, 7}; /* SPR1, SPR0; table 19-5 */
    uno_t *uno = param;
    const unsigned shift = divider_bits[avr->data[SPCR] & 3u] - (avr->data[SPSR] & 1u);

    if (!(avr->data[SPCR] & SPE) || !(avr->data[SPCR] & MSTR)) { fault(uno, "SPDR written, but the SPI is off or a slave"); }
    if (avr->data[SPCR] & (DORD | CPOL_CPHA)) { fault(uno, "SPI: not mode 0, most significant bit first"); }
    if (avr->data[PRR] & PRSPI) { fault(uno, "SPI: its clock is off (PRR)"); }
    if ((avr->data[DDRB] & (PIN_DATA | PIN_CLOCK | PIN_SELECT | PIN_DC)) != (PIN_DATA | PIN_CLOCK | PIN_SELECT | PIN_DC)) {
        fault(uno, "SPI: a pin is an input");
    }
    if (uno->sending) {
        fault(uno, "SPDR written while a byte was on the wire");
        return;
    }
    avr->data[address] = value;
    avr->data[SPSR] &= (uint8_t)~SPIF;
    uno->sending = true;
    uno->sent = value;
    uno->sent_port = avr->data[PORTB];
    uno->sent_clock_hz = CLOCK_HZ >> shift;
    avr_cycle_timer_register(avr, (avr_cycle_count_t)8 << shift, byte_out, uno);
}

static void reset_moved(struct avr_irq_t *irq, uint32_t value, void *param) {
    uno_t *uno = param;

    (void)irq;
    uno->reset |= value == 0;
    uno->chip->reset(uno->chip, value == 0, now_ns(uno));
    if (uno->chip->fault.text[0]) { fault(uno, uno->chip->fault.text); }
}

/* ---- frames ---- */

static int expected_open(uno_t *uno, unsigned show) {
    const scene_script_t *script = scene_find(shows[show].scene);
    const mesh_options_t options = {.tree = true};
    const size_t block_bytes = 65536;
    player_config_t config = {.block_bytes = block_bytes, .method = shows[show].method};
    target_config_t panel;
    char path[4096];
    mesh_report_t report;
    int error;

    (void)snprintf(path, sizeof path, "%s/%s.tuile", uno->models, script->model);
    if (target_parse_panel(&panel, "ssd1306-128x64", &uno->error) ||
        mesh_load(path, 0, &options, &uno->expected[show].model, &config.model_bytes, &report, &uno->error) ||
        target_open(&uno->expected[show].target, &panel, 0, TUILE_WIRE_DEFAULT, &uno->error)) {
        return -1;
    }
    config.display = &uno->expected[show].target.display;
    config.model = uno->expected[show].model;
    config.block = uno->expected[show].block = aligned_alloc(64, block_bytes);
    if (!config.block) { return sim_fail(&uno->error, "out of memory"); }
    if ((error = player_open(&uno->expected[show].player, script, &config))) {
        return sim_fail(&uno->error, "%s: %s", script->name, tuile_stream_error_text(error));
    }
    return 0;
}

static int compare(uno_t *uno, unsigned show, unsigned frame, sim_picture_t *seen) {
    sim_picture_t wanted = {0}, difference = {0};
    size_t count = 0, lit = 0;
    const int error = player_frame(&uno->expected[show].player, frame);
    int result;

    if (error) { return sim_fail(&uno->error, "the simulator: %s", tuile_stream_error_text(error)); }
    result = target_picture(&uno->expected[show].target, &wanted, NULL, &uno->error) ||
             (uno->demo && uno_demo_corner(seen, &wanted, uno->took ? 10.0 * CLOCK_HZ / (double)uno->took : 0, &uno->error)) ||
             sim_picture_difference(seen, &wanted, &difference, &count, &uno->error);
    for (size_t i = 0; result == 0 && i < (size_t)wanted.width * wanted.height; i++) {
        lit += wanted.rgb[3 * i] != 0;
    }
    if (result == 0 && (count || lit < 300)) {
        result = sim_fail(&uno->error, "%s %s %u: %zu dots differ from the simulator's, which has %zu lit", shows[show].scene,
                          shows[show].method_name, frame, count, lit);
    }
    sim_picture_free(&wanted);
    sim_picture_free(&difference);
    return result ? -1 : 0;
}

static int save(uno_t *uno, unsigned show, unsigned frame, const sim_picture_t *seen) {
    sim_picture_t large = {0};
    char path[4096];
    int result;

    (void)snprintf(path, sizeof path, "%s/%s-%s-%02u.png", uno->folder, shows[show].scene, shows[show].method_name, frame);
    result = sim_picture_magnify(seen, 4, &large, &uno->error) || sim_picture_write(&large, path, &uno->error);
    sim_picture_free(&large);
    (void)printf("%s %s %u: %" PRIu64 " cycles, %" PRIu64 " ms, %u bytes, %s\n", shows[show].scene, shows[show].method_name, frame,
                 uno->avr->cycle - uno->begun, (uno->avr->cycle - uno->begun) / (CLOCK_HZ / 1000u), uno->bytes, path);
    return result ? -1 : 0;
}

static avr_cycle_count_t button_up(avr_t *avr, avr_cycle_count_t when, void *param) {
    (void)when;
    (void)param;
    avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('D'), PIN_BUTTON), 1);
    return 0;
}

static void press(uno_t *uno, unsigned held_ms) {
    if (!(uno->avr->data[PORTD] >> PIN_BUTTON & 1) || (uno->avr->data[DDRD] >> PIN_BUTTON & 1)) {
        fault(uno, "the button's pin is not an input that is pulled up");
    }
    avr_raise_irq(avr_io_getirq(uno->avr, AVR_IOCTL_IOPORT_GETIRQ('D'), PIN_BUTTON), 0);
    avr_cycle_timer_register(uno->avr, (avr_cycle_count_t)held_ms * (CLOCK_HZ / 1000u), button_up, uno);
}

static void shown_by_demo(uno_t *uno, unsigned show, unsigned frame) {
    const uno_demo_t wanted = uno_demo_at(uno->shown++);
    sim_picture_t seen = {0};

    if (show != wanted.show || frame != wanted.frame * UNO_STEP) {
        fault(uno, "another frame or show than time and button ask for");
    } else if (uno->chip->glass(uno->chip, &seen, &uno->error) == 0) {
        (void)compare(uno, show, frame, &seen);
    }
    sim_picture_free(&seen);
    uno->took = uno->avr->cycle - uno->begun;
    if (wanted.press_ms) { press(uno, wanted.press_ms); }
    uno->ended = wanted.last;
}

static void shown(uno_t *uno, unsigned show, unsigned frame) {
    sim_picture_t seen = {0};

    if (uno->demo) {
        shown_by_demo(uno, show, frame);
        return;
    }
    if (show >= UNO_SHOWS || frame != uno->shown % UNO_FRAMES * UNO_STEP || show != uno->shown / UNO_FRAMES) {
        fault(uno, "a frame out of turn");
        return;
    }
    if (uno->chip->glass(uno->chip, &seen, &uno->error) == 0) {
        (void)(uno->folder ? save(uno, show, frame, &seen) : compare(uno, show, frame, &seen));
    }
    sim_picture_free(&seen);
    uno->shown++;
}

static void told(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param) {
    uno_t *uno = param;
    const uint8_t a = avr->data[GPIOR1], b = avr->data[GPIOR2];

    avr->data[address] = value;
    uno->last_told = avr->cycle;
    switch (value) {
    case UNO_BEGINS:
        uno->begun = avr->cycle;
        uno->bytes = 0;
        break;
    case UNO_SHOWN: shown(uno, a, b); break;
    case UNO_STACK: uno->stack_unused = a | (unsigned)b << 8; break;
    case UNO_ROUND: uno->ended = true; break;
    case UNO_PARKED:
        if (!uno->error.text[0]) { (void)sim_fail(&uno->error, "the program has parked with code %u", a); }
        break;
    default: fault(uno, "an event that is none");
    }
}

/* ---- the board ---- */

static int load(uno_t *uno, const char *path) {
    static uint8_t code[32769];
    FILE *file = fopen(path, "rb");
    size_t size_bytes;

    if (!file) { return sim_fail(&uno->error, "%s cannot be read", path); }
    size_bytes = fread(code, 1, sizeof code, file);
    (void)fclose(file);
    if (size_bytes == 0 || size_bytes > 32768) { return sim_fail(&uno->error, "%s: 1 to 32768 bytes are a program", path); }
    if (!(uno->avr = avr_make_mcu_by_name("atmega328p"))) { return sim_fail(&uno->error, "simavr does not know the ATmega328P"); }
    avr_init(uno->avr);
    uno->avr->frequency = CLOCK_HZ;
    uno->avr->log = LOG_ERROR;
    avr_loadcode(uno->avr, code, (uint32_t)size_bytes, 0);
    uno->avr->codeend = (uint32_t)size_bytes;
    return 0;
}

/* In the place of what simavr has there. */
static void take_register(uno_t *uno, avr_io_addr_t address, avr_io_write_t write) {
    const avr_io_addr_t io = AVR_DATA_TO_IO(address);

    uno->avr->io[io].w.c = write;
    uno->avr->io[io].w.param = uno;
}

static int run(uno_t *uno) {
    uno->stack_low = RAM_END;
    while (!uno->ended && !uno->error.text[0]) {
        const int state = avr_run(uno->avr);
        const unsigned stack = uno->avr->data[SPL] | (unsigned)uno->avr->data[SPL + 1] << 8;

        if (stack > 0x100 && stack < uno->stack_low) { uno->stack_low = stack; }
        if (state == cpu_Done || state == cpu_Crashed) { fault(uno, "the processor has stopped"); }
        if (uno->avr->cycle - uno->last_told > LIMIT_CYCLES) { fault(uno, "nothing has been told for a minute of its time"); }
    }
    return uno->error.text[0] ? -1 : 0;
}

/* Bytes below the stack that are painted as they were. */
static unsigned painted(const uno_t *uno) {
    unsigned count = 0;

    while (uno->avr->data[uno->stack_low - count] == PAINT) {
        count++;
    }
    return count;
}

static int check_end(uno_t *uno) {
    if (uno->demo) {
        uno->stack_unused = painted(uno);
    } else if (uno->shown != UNO_SHOWS * UNO_FRAMES) {
        return sim_fail(&uno->error, "only %u frames were shown", uno->shown);
    }
    if (uno->chip->warnings) { return sim_fail(&uno->error, "SSD1306: %s", uno->chip->warning.text); }
    if (uno->stack_unused < STACK_MARGIN) {
        return sim_fail(&uno->error, "%u bytes of stack were never used; %u are to be left", uno->stack_unused, STACK_MARGIN);
    }
    return 0;
}

static void close_all(uno_t *uno) {
    for (unsigned i = 0; i < UNO_SHOWS; i++) {
        target_close(&uno->expected[i].target);
        free(uno->expected[i].model);
        free(uno->expected[i].block);
    }
    if (uno->chip) { uno->chip->destroy(uno->chip); }
    if (uno->avr) { avr_terminate(uno->avr); }
}

static int work(uno_t *uno, const char *image) {
    const sim_panel_t *panel = sim_panel_find("ssd1306-128x64");

    for (unsigned i = 0; i < UNO_SHOWS && !uno->folder; i++) {
        if (expected_open(uno, i)) { return -1; }
    }
    if (!(uno->chip = panel->create(&uno->error)) || load(uno, image)) { return -1; }
    take_register(uno, SPDR, byte_written);
    take_register(uno, GPIOR0, told);
    (void)button_up(uno->avr, 0, uno);
    avr_irq_register_notify(avr_io_getirq(uno->avr, AVR_IOCTL_IOPORT_GETIRQ('B'), 0), reset_moved, uno);
    return run(uno) || check_end(uno) ? -1 : 0;
}

int main(int count, char **arguments) {
    static uno_t uno;
    const bool demo = count == 4 && strcmp(arguments[1], "demo") == 0,
               test = demo || (count == 4 && strcmp(arguments[1], "test") == 0);
    int result;

    if (!test && (count != 5 || strcmp(arguments[1], "show") != 0)) {
        (void)fputs("Usage: uno test|demo IMAGE.bin MODELS, or uno show IMAGE.bin MODELS FOLDER\n", stderr);
        return 2;
    }
    uno.models = arguments[3];
    uno.demo = demo;
    uno.folder = test ? NULL : arguments[4];
    result = work(&uno, arguments[2]);
    if (result) {
        (void)fprintf(stderr, "uno: %s\n", uno.error.text);
    } else {
        (void)printf("uno%s: %u frames%s; %" PRIu64 " cycles; stack down to %#x, %u bytes never used\n", demo ? " demo" : "",
                     uno.shown, test ? " are the simulator's, dot by dot" : "", uno.avr->cycle, uno.stack_low, uno.stack_unused);
    }
    close_all(&uno);
    return result ? 1 : 0;
}
