/* The models of USB displays against bytes typed from the protocols: USB's own requests, GUD, and the bulk-only transport of AX206
 * frames. */
#include "support/check.h"

#include <errno.h>

#include "../sim/usb/ax206_model.h"
#include "../sim/usb/gud_model.h"

/* ---- transfers, written as they go over the wire ------------------------------------------------------------------- */

static size_t bytes_of(const char *hex, uint8_t *bytes) {
    size_t count = 0;
    int used;
    unsigned value;

    while (sscanf(hex, " %2x%n", &value, &used) == 1) {
        bytes[count++] = (uint8_t)value;
        hex += used;
    }
    return count;
}

/* Sends with a setup packet whose length is that of the data. */
static int set(sim_usb_t *usb, uint8_t request, const char *hex) {
    uint8_t data[512];
    const size_t count = bytes_of(hex, data);
    const uint8_t setup[8] = {0x41, request, 0, 0, 0, 0, (uint8_t)count, (uint8_t)(count >> 8)};

    return sim_usb_control(usb, setup, data, count);
}

/* Asks, and compares the answer. */
static void check_answer(sim_usb_t *usb, const char *setup_hex, const char *hex) {
    uint8_t setup[8], expected[512], data[512];
    const size_t count = bytes_of(hex, expected);

    assert_int_equal(bytes_of(setup_hex, setup), 8);
    assert_int_equal(sim_usb_control(usb, setup, data, setup[6] | (size_t)setup[7] << 8), (int)count);
    assert_memory_equal(data, expected, count);
}

static int bulk(sim_usb_t *usb, uint8_t endpoint, const char *hex) {
    uint8_t data[512];
    const size_t count = bytes_of(hex, data);

    return sim_usb_bulk(usb, endpoint, data, count);
}

static unsigned status(sim_usb_t *usb) {
    static const uint8_t setup[8] = {0xC1, 0, 0, 0, 0, 0, 1, 0};
    uint8_t data[1] = {99};

    assert_int_equal(sim_usb_control(usb, setup, data, 1), 1);
    return data[0];
}

/* It was refused, for a reason that is told, with this status. */
static void check_refused(sim_usb_t *usb, int result, unsigned code) {
    assert_int_equal(result, -EPIPE);
    assert_string_not_equal(usb->fault.text, "");
    usb->fault.text[0] = 0;
    assert_int_equal(status(usb), code);
}

static sim_usb_t *gud(const sim_gud_config_t *config) {
    sim_error_t error = {""};
    sim_usb_t *usb = sim_gud_create(config, &error);

    assert_string_equal(error.text, "");
    return usb;
}

/* ---- GUD: what it tells -------------------------------------------------------------------------------------------- */

static void test_descriptors_and_strings(void **state) {
    sim_usb_t *usb = gud(&(sim_gud_config_t){.serial = "A1", .interface = 1, .endpoint = 3, .packet_bytes = 64});

    (void)state;
    check_answer(usb, "80 06 00 01 00 00 12 00", "12 01 00 02 00 00 00 40 50 1D 4D 61 00 01 01 02 03 01");
    check_answer(usb, "80 06 00 02 00 00 FF 00",
                 "09 02 29 00 02 01 00 80 FA 09 04 00 00 01 08 00 00 00 07 05 0F 02 40 00 00 "
                 "09 04 01 00 01 FF 00 00 00 07 05 03 02 40 00 00");
    check_answer(usb, "80 06 00 02 00 00 09 00", "09 02 29 00 02 01 00 80 FA");
    check_answer(usb, "80 06 00 03 00 00 FF 00", "04 03 09 04");
    check_answer(usb, "80 06 03 03 09 04 FF 00", "06 03 41 00 31 00");
    check_answer(usb, "80 00 00 00 00 00 02 00", "00 00");
    check_answer(usb, "80 08 00 00 00 00 01 00", "01");
    assert_int_equal(usb->descriptors_bytes, 18 + 41);
    assert_string_equal(usb->fault.text, "");
    usb->destroy(usb);
}

/* A display of 128 x 64 and 32 x 16 pixels, status on set, LZ4, a buffer of 4096 bytes: magic, version, flags, compression, buffer,
 * least and most width and height. Modes: (128 + 24) x (64 + 6) x 60 Hz = 638.4 kHz, (32 + 24) x (16 + 6) x 60 = 73.92. */
static void test_gud_answers(void **state) {
    sim_usb_t *usb = gud(&(sim_gud_config_t){.modes = {{128, 64}, {32, 16}},
                                             .preferred = 2,
                                             .formats = {SIM_GUD_RGB565, SIM_GUD_R1},
                                             .max_buffer_bytes = 4096,
                                             .lz4 = true,
                                             .status_on_set = true,
                                             .backlight = true,
                                             .rotations = 5,
                                             .connectors = 2,
                                             .status = {0, SIM_GUD_UNKNOWN + 1}});

    (void)state;
    check_answer(usb, "C1 01 00 00 00 00 1E 00",
                 "4D 61 50 1D 01 01 00 00 00 01 00 10 00 00 20 00 00 00 80 00 00 00 10 00 00 00 40 00 00 00");
    check_answer(usb, "C1 40 00 00 00 00 20 00", "40 01");
    check_answer(usb, "C1 41 00 00 00 00 40 01", "32 00 05 00 00 00 00 00 00 00");
    check_answer(usb, "C1 50 00 00 00 00 A0 00", "00 00 00 00 00 00 00 00 00 00");
    check_answer(usb, "C1 51 01 00 00 00 40 01", "0C 00 32 00 00 00 00 00 00 00");
    check_answer(usb, "C1 54 00 00 00 00 01 00", "01");
    check_answer(usb, "C1 54 01 00 00 00 01 00", "02");
    check_answer(usb, "C1 56 00 00 00 00 00 08", "");
    check_answer(usb, "C1 55 00 00 00 00 00 0C",
                 "7E 02 00 00 80 00 88 00 90 00 98 00 40 00 42 00 44 00 46 00 00 00 00 00 "
                 "49 00 00 00 20 00 28 00 30 00 38 00 10 00 12 00 14 00 16 00 00 04 00 00");
    check_answer(usb, "C1 00 00 00 00 00 01 00", "00");
    assert_string_equal(usb->fault.text, "");
    usb->destroy(usb);
}

static void test_gud_without_properties_answers_nothing(void **state) {
    sim_usb_t *usb = gud(NULL);

    (void)state;
    check_answer(usb, "C1 41 00 00 00 00 40 01", "");
    check_answer(usb, "C1 51 00 00 00 00 40 01", "");
    check_answer(usb, "C1 40 00 00 00 00 20 00", "01 08 20 30 40 50 80");
    usb->destroy(usb);
}

static void test_gud_refuses_requests_it_does_not_know(void **state) {
    static const struct {
        const char *setup;
        unsigned code;
    } cases[] = {
        {"C1 42 00 00 00 00 01 00", SIM_GUD_NOT_SUPPORTED},     {"C1 01 01 00 00 00 1E 00", SIM_GUD_INVALID_PARAMETER},
        {"C1 54 01 00 00 00 01 00", SIM_GUD_INVALID_PARAMETER}, {"C1 00 00 00 00 00 02 00", SIM_GUD_PROTOCOL_ERROR},
        {"C0 01 00 00 00 00 1E 00", SIM_GUD_PROTOCOL_ERROR},    {"C1 01 00 00 01 00 1E 00", SIM_GUD_PROTOCOL_ERROR},
        {"41 65 00 00 00 00 00 00", SIM_GUD_NOT_SUPPORTED},     {"41 62 01 00 00 00 00 00", SIM_GUD_INVALID_PARAMETER},
        {"41 53 01 00 00 00 00 00", SIM_GUD_INVALID_PARAMETER},
    };
    sim_usb_t *usb = gud(NULL);

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        uint8_t setup[8], data[64];
        bytes_of(cases[i].setup, setup);
        check_refused(usb, sim_usb_control(usb, setup, data, setup[6]), cases[i].code);
    }
    assert_int_equal(usb->faults, CHECK_COUNT(cases));
    assert_int_equal(set(usb, 0x53, ""), 0);
    assert_int_equal(status(usb), SIM_GUD_OK);
    usb->destroy(usb);
}

/* ---- GUD: state ---------------------------------------------------------------------------------------------------- */

/* 16 x 2 pixels, totals of 40 and 8, 19 kHz. */
#define MODE "13 00 00 00 10 00 18 00 20 00 28 00 02 00 04 00 06 00 08 00 00 00 00 00 "
#define BACKLIGHT "0C 00 1E 00 00 00 00 00 00 00 "
#define ROTATION "32 00 04 00 00 00 00 00 00 00 "

static void test_gud_state_in_order(void **state) {
    sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .backlight = true, .rotations = 5});

    (void)state;
    check_refused(usb, set(usb, 0x62, ""), SIM_GUD_PROTOCOL_ERROR); /* nothing was checked */
    check_refused(usb, set(usb, 0x64, "01"), SIM_GUD_PROTOCOL_ERROR);
    assert_int_equal(set(usb, 0x61, MODE "40 00 " BACKLIGHT ROTATION), 46);
    check_refused(usb, set(usb, 0x62, ""), SIM_GUD_PROTOCOL_ERROR); /* the controller is off */
    assert_int_equal(set(usb, 0x63, "01"), 1);
    check_refused(usb, set(usb, 0x64, "01"), SIM_GUD_PROTOCOL_ERROR); /* no state */
    assert_int_equal(set(usb, 0x62, ""), 0);
    check_refused(usb, set(usb, 0x62, ""), SIM_GUD_PROTOCOL_ERROR); /* once only */
    assert_int_equal(set(usb, 0x64, "01"), 1);
    assert_int_equal(sim_gud_state(usb).width, 16);
    assert_int_equal(sim_gud_state(usb).height, 2);
    assert_int_equal(sim_gud_state(usb).format, SIM_GUD_RGB565);
    assert_int_equal(sim_gud_state(usb).rotation, 2);
    assert_int_equal(sim_gud_state(usb).backlight, 30);
    assert_true(sim_gud_state(usb).display);
    assert_int_equal(set(usb, 0x63, "00"), 1);
    assert_false(sim_gud_state(usb).display);
    usb->destroy(usb);
}

static void test_gud_refuses_states(void **state) {
    static const struct {
        const char *hex;
        unsigned code;
    } cases[] = {
        {MODE "40 00 " BACKLIGHT, SIM_GUD_INVALID_PARAMETER},           /* a property is missing */
        {MODE "40 00 " BACKLIGHT BACKLIGHT, SIM_GUD_INVALID_PARAMETER}, /* one comes twice */
        {MODE "40 00 " BACKLIGHT ROTATION "06 00 01 00 00 00 00 00 00 00", SIM_GUD_INVALID_PARAMETER},
        {MODE "40 00 0C 00 65 00 00 00 00 00 00 00 " ROTATION, SIM_GUD_INVALID_PARAMETER},    /* 101 per cent */
        {MODE "40 00 " BACKLIGHT "32 00 02 00 00 00 00 00 00 00", SIM_GUD_INVALID_PARAMETER}, /* a quarter turn, which it has not */
        {MODE "40 00 " BACKLIGHT "32 00 05 00 00 00 00 00 00 00", SIM_GUD_INVALID_PARAMETER}, /* the mask itself */
        {MODE "40 00 " BACKLIGHT "32 00 04 00 00 00 01 00 00 00", SIM_GUD_INVALID_PARAMETER}, /* more than 32 bits */
        {MODE "40 01 " BACKLIGHT ROTATION, SIM_GUD_INVALID_PARAMETER},                        /* connector 1 */
        {MODE "50 00 " BACKLIGHT ROTATION, SIM_GUD_INVALID_PARAMETER},                        /* RGB888 */
        {MODE "40 00 " BACKLIGHT "32 00 04 00 00 00 00 00 00", SIM_GUD_PROTOCOL_ERROR},       /* a byte is missing */
        {MODE "40", SIM_GUD_PROTOCOL_ERROR},
        /* 18 pixels wide; 3 high; no clock; a total of 15; of 1 line */
        {"13 00 00 00 12 00 18 00 20 00 28 00 02 00 04 00 06 00 08 00 00 00 00 00 40 00 " BACKLIGHT ROTATION,
         SIM_GUD_INVALID_PARAMETER},
        {"13 00 00 00 10 00 18 00 20 00 28 00 03 00 04 00 06 00 08 00 00 00 00 00 40 00 " BACKLIGHT ROTATION,
         SIM_GUD_INVALID_PARAMETER},
        {"00 00 00 00 10 00 18 00 20 00 28 00 02 00 04 00 06 00 08 00 00 00 00 00 40 00 " BACKLIGHT ROTATION,
         SIM_GUD_INVALID_PARAMETER},
        {"13 00 00 00 10 00 18 00 20 00 0F 00 02 00 04 00 06 00 08 00 00 00 00 00 40 00 " BACKLIGHT ROTATION,
         SIM_GUD_INVALID_PARAMETER},
        {"13 00 00 00 10 00 18 00 20 00 28 00 02 00 04 00 06 00 01 00 00 00 00 00 40 00 " BACKLIGHT ROTATION,
         SIM_GUD_INVALID_PARAMETER},
    };
    sim_usb_t *usb =
        gud(&(sim_gud_config_t){.width = 16, .height = 2, .formats = {SIM_GUD_RGB565}, .backlight = true, .rotations = 5});

    (void)state;
    assert_int_equal(set(usb, 0x63, "01"), 1);
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        check_refused(usb, set(usb, 0x61, cases[i].hex), cases[i].code);
        check_refused(usb, set(usb, 0x62, ""), SIM_GUD_PROTOCOL_ERROR); /* and nothing remains of what was checked before */
        assert_int_equal(set(usb, 0x61, MODE "40 00 " BACKLIGHT ROTATION), 46);
    }
    check_refused(usb, set(usb, 0x63, "02"), SIM_GUD_INVALID_PARAMETER);
    check_refused(usb, set(usb, 0x64, ""), SIM_GUD_PROTOCOL_ERROR);
    check_refused(usb, set(usb, 0x60, "00"), SIM_GUD_PROTOCOL_ERROR);
    usb->destroy(usb);
}

/* ---- GUD: pixels --------------------------------------------------------------------------------------------------- */

static void show(sim_usb_t *usb, const char *state_hex) {
    assert_true(set(usb, 0x61, state_hex) > 0);
    assert_int_equal(set(usb, 0x63, "01"), 1);
    assert_int_equal(set(usb, 0x62, ""), 0);
    assert_int_equal(set(usb, 0x64, "01"), 1);
}

static void check_row(sim_usb_t *usb, uint32_t x, uint32_t y, const char *hex) {
    uint8_t expected[64];
    const size_t count = bytes_of(hex, expected);
    sim_picture_t glass;

    assert_int_equal(usb->picture(usb, &glass, NULL), 0);
    assert_memory_equal(sim_picture_at(&glass, x, y), expected, count);
    sim_picture_free(&glass);
}

#define AT(x, y, width, height) x " 00 00 00 " y " 00 00 00 " width " 00 00 00 " height " 00 00 00 "
#define PLAIN(length) length " 00 00 00 00 00 00 00 00"

/* Row 1 from x = 8 on: the bytes, and the colours they are. */
static void test_gud_formats(void **state) {
    static const struct {
        const char *format, *width, *length, *pixels, *colours;
    } cases[] = {
        {"01", "08", "01", "A1", "FFFFFF 000000 FFFFFF 000000 000000 000000 000000 FFFFFF"},
        {"01", "03", "01", "60", "000000 FFFFFF FFFFFF"},
        {"08", "02", "02", "12 FE", "121212 FEFEFE"},
        {"20", "04", "02", "41 7E", "FF0000 0000FF FFFFFF FFFF00"},
        {"20", "03", "02", "24 90", "00FF00 FF0000 0000FF"}, /* the fourth bit means nothing */
        {"30", "04", "04", "E0 1C 03 92", "FF0000 00FF00 0000FF 9292AA"},
        {"40", "03", "06", "00 F8 E0 07 1F 00", "FF0000 00FF00 0000FF"},
        {"40", "01", "02", "10 84", "848284"},
        {"50", "02", "06", "01 02 03 FF 80 00", "030201 0080FF"},
        {"80", "02", "08", "01 02 03 77 FF 80 00 88", "030201 0080FF"},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2});
        char hex[256];
        (void)snprintf(hex, sizeof hex, MODE "%s 00", cases[i].format);
        show(usb, hex);
        (void)snprintf(hex, sizeof hex, AT("08", "01", "%s", "01") PLAIN("%s"), cases[i].width, cases[i].length);
        assert_int_equal(set(usb, 0x60, hex), 25);
        assert_true(bulk(usb, 1, cases[i].pixels) > 0);
        check_row(usb, 8, 1, cases[i].colours);
        assert_string_equal(usb->fault.text, "");
        usb->destroy(usb);
    }
}

static void test_gud_refuses_buffers(void **state) {
    static const char *const cases[] = {
        AT("00", "00", "11", "01") PLAIN("22"), /* 17 wide */
        AT("0F", "00", "02", "01") PLAIN("04"), /* beyond the right side */
        AT("10", "00", "01", "01") PLAIN("02"), /* outside */
        AT("00", "02", "01", "01") PLAIN("02"),
        AT("00", "01", "01", "02") PLAIN("04"),
        AT("00", "00", "00", "01") PLAIN("00"),
        AT("00", "00", "01", "00") PLAIN("00"),
        AT("00", "00", "02", "01") PLAIN("03"),                  /* another length than the pixels have */
        AT("00", "00", "10", "02") PLAIN("40"),                  /* 64 bytes, more than its buffer */
        AT("00", "00", "02", "01") "04 00 00 00 01 04 00 00 00", /* LZ4, which it has not */
        AT("00", "00", "02", "01") "04 00 00 00 00 04 00 00 00", /* a compressed length without compression */
        AT("00", "00", "02", "01") "04 00 00 00 02 00 00 00 00", /* compression that nobody knows */
    };
    sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .max_buffer_bytes = 63});

    (void)state;
    check_refused(usb, set(usb, 0x60, AT("00", "00", "02", "01") PLAIN("04")), SIM_GUD_PROTOCOL_ERROR); /* no mode yet */
    show(usb, MODE "40 00");
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        check_refused(usb, set(usb, 0x60, cases[i]), SIM_GUD_INVALID_PARAMETER);
    }
    assert_int_equal(set(usb, 0x60, AT("01", "01", "02", "01") PLAIN("04")), 25);
    usb->destroy(usb);
    usb = gud(&(sim_gud_config_t){.width = 16, .height = 2});
    show(usb, MODE "01 00");
    check_refused(usb, set(usb, 0x60, AT("04", "00", "08", "01") PLAIN("01")), SIM_GUD_INVALID_PARAMETER); /* within a byte */
    usb->destroy(usb);
}

static void test_gud_counts_the_bytes_of_a_transfer(void **state) {
    sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .packet_bytes = 8});

    (void)state;
    show(usb, MODE "08 00");
    check_refused(usb, bulk(usb, 1, "01"), SIM_GUD_PROTOCOL_ERROR); /* without SET_BUFFER */
    assert_int_equal(set(usb, 0x60, AT("00", "00", "02", "01") PLAIN("02")), 25);
    assert_int_equal(bulk(usb, 1, "01 02"), -EPIPE); /* still halted */
    assert_string_equal(usb->fault.text, "");
    usb->clear_halt(usb, 1);
    assert_int_equal(bulk(usb, 1, "01 02"), 2);
    check_row(usb, 0, 0, "010101 020202");
    check_refused(usb, bulk(usb, 2, "01"), SIM_GUD_PROTOCOL_ERROR);
    /* 10 bytes in a packet and a rest; then too many, none, and a transfer that ends early. */
    assert_int_equal(set(usb, 0x60, AT("00", "00", "0A", "01") PLAIN("0A")), 25);
    assert_int_equal(bulk(usb, 1, "11 12 13 14 15 16 17 18"), 8);
    assert_int_equal(bulk(usb, 1, "19 1A"), 2);
    check_row(usb, 7, 0, "181818 191919 1A1A1A");
    assert_int_equal(set(usb, 0x60, AT("00", "00", "02", "01") PLAIN("02")), 25);
    check_refused(usb, bulk(usb, 1, "01 02 03"), SIM_GUD_PROTOCOL_ERROR);
    usb->clear_halt(usb, 1);
    assert_int_equal(set(usb, 0x60, AT("00", "00", "02", "01") PLAIN("02")), 25);
    check_refused(usb, bulk(usb, 1, ""), SIM_GUD_PROTOCOL_ERROR);
    usb->clear_halt(usb, 1);
    assert_int_equal(set(usb, 0x60, AT("00", "00", "0A", "01") PLAIN("0A")), 25);
    check_refused(usb, bulk(usb, 1, "01 02 03"), SIM_GUD_PROTOCOL_ERROR);
    assert_int_equal(sim_gud_counts(usb)->updates, 2);
    assert_int_equal(sim_gud_counts(usb)->payload_bytes, 12);
    usb->destroy(usb);
}

/* 32 bytes of FFh as a raw block: one literal, a match of 26 at distance 1 (15 + 7 + 4), five literals. */
static void test_gud_lz4(void **state) {
    sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .lz4 = true});

    (void)state;
    show(usb, MODE "40 00");
    assert_int_equal(set(usb, 0x60, AT("00", "01", "10", "01") "20 00 00 00 01 0B 00 00 00"), 25);
    assert_int_equal(bulk(usb, 1, "1F FF 01 00 07 50 FF FF FF FF FF"), 11);
    check_row(usb, 0, 1, "FFFFFF FFFFFF");
    check_row(usb, 14, 1, "FFFFFF FFFFFF");
    assert_int_equal(sim_gud_counts(usb)->compressed, 1);
    assert_int_equal(sim_gud_counts(usb)->payload_bytes, 11);
    assert_int_equal(sim_gud_counts(usb)->pixel_bytes, 32);
    /* The match is a byte shorter: 31 bytes. */
    assert_int_equal(set(usb, 0x60, AT("00", "01", "10", "01") "20 00 00 00 01 0B 00 00 00"), 25);
    check_refused(usb, bulk(usb, 1, "1F FF 01 00 06 50 FF FF FF FF FF"), SIM_GUD_ERROR);
    check_refused(usb, set(usb, 0x60, AT("00", "01", "10", "01") "20 00 00 00 01 21 00 00 00"), SIM_GUD_INVALID_PARAMETER);
    check_refused(usb, set(usb, 0x60, AT("00", "01", "10", "01") "20 00 00 00 01 00 00 00 00"), SIM_GUD_INVALID_PARAMETER);
    usb->destroy(usb);
}

/* A frame of 16 x 2 bytes, in one transfer or in two; SET_BUFFER lets it begin anew. */
static void test_gud_whole_frames(void **state) {
    static const char row[] = "01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F 10 ";
    static const char other[] = "21 22 23 24 25 26 27 28 29 2A 2B 2C 2D 2E 2F 30 ";
    char frame[128];
    sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .full_update = true});

    (void)state;
    show(usb, MODE "08 00");
    (void)snprintf(frame, sizeof frame, "%s%s", row, other);
    assert_int_equal(bulk(usb, 1, frame), 32);
    check_row(usb, 0, 1, "212121 222222");
    assert_int_equal(bulk(usb, 1, other), 16);
    assert_int_equal(bulk(usb, 1, row), 16);
    check_row(usb, 0, 0, "212121");
    check_row(usb, 15, 1, "101010");
    assert_int_equal(sim_gud_counts(usb)->updates, 2);
    assert_int_equal(bulk(usb, 1, row), 16);
    assert_int_equal(set(usb, 0x60, AT("00", "00", "10", "01") PLAIN("10")), 25);
    assert_int_equal(bulk(usb, 1, frame), 32);
    check_row(usb, 15, 1, "303030");
    check_refused(usb, set(usb, 0x60, AT("00", "01", "10", "01") PLAIN("10")), SIM_GUD_INVALID_PARAMETER);
    check_refused(usb, set(usb, 0x60, AT("00", "00", "08", "01") PLAIN("08")), SIM_GUD_INVALID_PARAMETER);
    assert_int_equal(bulk(usb, 1, row), 16);
    check_refused(usb, bulk(usb, 1, "01 02 03"), SIM_GUD_PROTOCOL_ERROR); /* within a row */
    usb->destroy(usb);
}

/* The protocol counts against the clock: at bit 1 the framebuffer of 2 x 16 pixels stands on its left side. */
static void test_gud_rotation(void **state) {
    static const struct {
        const char *value;
        uint32_t x, y; /* where the pixel at the beginning of the framebuffer is seen, of 16 x 2 */
    } cases[] = {{"01", 0, 0}, {"02", 0, 1}, {"04", 15, 1}, {"08", 15, 0}};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .rotations = 15});
        char hex[256];
        (void)snprintf(hex, sizeof hex, MODE "08 00 32 00 %s 00 00 00 00 00 00 00", cases[i].value);
        show(usb, hex);
        assert_int_equal(set(usb, 0x60, AT("00", "00", "02", "01") PLAIN("02")), 25);
        assert_int_equal(bulk(usb, 1, "AB CD"), 2);
        check_row(usb, cases[i].x, cases[i].y, "ABABAB");
        usb->destroy(usb);
    }
}

static void test_gud_status_on_set(void **state) {
    sim_usb_t *usb = gud(&(sim_gud_config_t){.width = 16, .height = 2, .status_on_set = true});

    (void)state;
    assert_int_equal(set(usb, 0x62, ""), 0); /* not stalled: the status tells */
    assert_int_equal(status(usb), SIM_GUD_PROTOCOL_ERROR);
    usb->fault.text[0] = 0;
    assert_int_equal(set(usb, 0x61, MODE "08 00"), 26);
    assert_int_equal(set(usb, 0x63, "01"), 1);
    assert_string_equal(usb->fault.text, "request 63 comes before the status of the set was read");
    assert_int_equal(status(usb), SIM_GUD_OK);
    usb->fault.text[0] = 0;
    sim_gud_break(usb, SIM_GUD_BUSY);
    assert_int_equal(set(usb, 0x62, ""), 0);
    assert_int_equal(status(usb), SIM_GUD_BUSY);
    sim_gud_break(usb, 0);
    assert_int_equal(set(usb, 0x62, ""), 0);
    assert_int_equal(status(usb), SIM_GUD_OK);
    assert_int_equal(set(usb, 0x60, AT("00", "00", "02", "01") PLAIN("02")), 25);
    assert_int_equal(bulk(usb, 1, "01 02"), 2);
    assert_string_equal(usb->fault.text, "pixels come before the status of the set was read");
    usb->destroy(usb);
}

static void test_gud_that_contradicts_itself(void **state) {
    static const sim_gud_config_t configs[] = {
        {.formats = {0x02}},        {.connectors = 3},          {.rotations = 2},
        {.rotations = 17},          {.edid_bytes = 100},        {.full_update = true, .lz4 = true},
        {.width = 16, .height = 0}, {.width = 0, .height = 16}, {.width = 16385, .height = 1},
    };

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(configs); i++) {
        sim_error_t error = {""};
        assert_null(sim_gud_create(&configs[i], &error));
        assert_string_not_equal(error.text, "");
    }
}

/* ---- AX206 ----------------------------------------------------------------------------------------------------------- */

#define COMMAND "55 53 42 43 DE AD BE EF "
#define SIZE COMMAND "05 00 00 00 80 00 10 CD 00 00 00 00 02 00 00 00 00 00 00 00 00 00 00"
#define BLIT(length, places) COMMAND length " 00 00 00 00 00 10 CD 00 00 00 00 06 12 " places " 00"
#define PROPERTY(id, value) COMMAND "00 00 00 00 00 00 10 CD 00 00 00 00 06 01 " id " 00 " value " 00 00 00 00 00 00"

static void check_read(sim_usb_t *usb, const char *hex) {
    uint8_t expected[64], data[64];
    const size_t count = bytes_of(hex, expected);

    assert_int_equal(sim_usb_bulk(usb, 0x81, data, sizeof data), (int)count);
    assert_memory_equal(data, expected, count);
}

static void check_status(sim_usb_t *usb, const char *residue, const char *code) {
    char hex[64];

    (void)snprintf(hex, sizeof hex, "55 53 42 53 DE AD BE EF %s 00 00 00 %s", residue, code);
    check_read(usb, hex);
}

static void test_ax206_commands(void **state) {
    sim_usb_t *usb = sim_ax206_create(&(sim_ax206_config_t){.width = 480, .height = 272}, NULL);

    (void)state;
    assert_int_equal(bulk(usb, 1, SIZE), 31);
    check_read(usb, "E0 01 10 01 00");
    check_status(usb, "00", "00");
    assert_int_equal(bulk(usb, 1, PROPERTY("01", "03")), 31);
    check_status(usb, "00", "00");
    assert_int_equal(sim_ax206_brightness(usb), 3);
    /* (257, 2) to (258, 3): red, green; blue, white */
    assert_int_equal(bulk(usb, 1, BLIT("08", "01 01 02 00 02 01 03 00")), 31);
    assert_int_equal(bulk(usb, 1, "F8 00 07 E0 00 1F FF FF"), 8);
    check_status(usb, "00", "00");
    check_row(usb, 257, 2, "FF0000 00FF00");
    check_row(usb, 257, 3, "0000FF FFFFFF");
    assert_int_equal(sim_ax206_counts(usb)->blits, 1);
    assert_int_equal(sim_ax206_counts(usb)->pixel_bytes, 8);
    assert_string_equal(usb->fault.text, "");
    /* Fewer bytes than were announced end the data: what is left of them, and a command that failed. */
    assert_int_equal(bulk(usb, 1, BLIT("08", "01 01 02 00 02 01 03 00")), 31);
    assert_int_equal(bulk(usb, 1, "F8 00"), 2);
    check_status(usb, "06", "01");
    assert_int_equal(bulk(usb, 1, PROPERTY("01", "00")), 31);
    check_status(usb, "00", "00");
    check_row(usb, 257, 3, "000000 000000");
    usb->destroy(usb);
}

static void test_ax206_refuses(void **state) {
    static const char *const cases[] = {
        BLIT("08", "02 00 00 00 01 00 03 00"), /* ends before it begins */
        BLIT("02", "08 00 00 00 08 00 00 00"), /* column 8 of 8 */
        BLIT("02", "00 00 04 00 00 00 04 00"), /* row 4 of 4 */
        BLIT("06", "00 00 00 00 01 00 01 00"), /* 6 bytes for 4 pixels */
        PROPERTY("01", "08"),
        PROPERTY("02", "01"),
        COMMAND "05 00 00 00 00 00 10 CD 00 00 00 00 02 00 00 00 00 00 00 00 00 00 00",                 /* the size, going out */
        COMMAND "00 00 00 00 00 00 10 12 00 00 00 00 06 00 00 00 00 00 00 00 00 00 00",                 /* INQUIRY */
        "55 53 42 44 DE AD BE EF 05 00 00 00 80 00 10 CD 00 00 00 00 02 00 00 00 00 00 00 00 00 00 00", /* no signature */
        "55 53 42 43",
    };
    uint8_t data[16];
    sim_usb_t *usb = sim_ax206_create(&(sim_ax206_config_t){.width = 8, .height = 4}, NULL);

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(cases); i++) {
        static const uint8_t setup[8] = {0x21, 0xFF};
        assert_int_equal(bulk(usb, 1, cases[i]), -EPIPE);
        assert_string_not_equal(usb->fault.text, "");
        usb->fault.text[0] = 0;
        assert_int_equal(bulk(usb, 1, SIZE), -EPIPE); /* until the transport is reset */
        assert_string_equal(usb->fault.text, "");
        assert_int_equal(sim_usb_control(usb, setup, NULL, 0), 0);
    }
    assert_int_equal(sim_usb_bulk(usb, 0x81, data, 13), -EPIPE); /* nothing to say */
    usb->reset(usb);
    assert_int_equal(bulk(usb, 1, SIZE), 31);
    assert_int_equal(bulk(usb, 1, SIZE), -EPIPE); /* the answer was not read */
    usb->destroy(usb);
}

static void test_ax206_that_fails(void **state) {
    sim_usb_t *usb = sim_ax206_create(&(sim_ax206_config_t){.width = 8, .height = 4}, NULL);

    (void)state;
    sim_ax206_break(usb, 1);
    assert_int_equal(bulk(usb, 1, PROPERTY("01", "02")), 31);
    check_status(usb, "00", "01");
    assert_int_equal(sim_ax206_brightness(usb), 7);
    usb->destroy(usb);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_descriptors_and_strings),
        cmocka_unit_test(test_gud_answers),
        cmocka_unit_test(test_gud_without_properties_answers_nothing),
        cmocka_unit_test(test_gud_refuses_requests_it_does_not_know),
        cmocka_unit_test(test_gud_state_in_order),
        cmocka_unit_test(test_gud_refuses_states),
        cmocka_unit_test(test_gud_formats),
        cmocka_unit_test(test_gud_refuses_buffers),
        cmocka_unit_test(test_gud_counts_the_bytes_of_a_transfer),
        cmocka_unit_test(test_gud_lz4),
        cmocka_unit_test(test_gud_whole_frames),
        cmocka_unit_test(test_gud_rotation),
        cmocka_unit_test(test_gud_status_on_set),
        cmocka_unit_test(test_gud_that_contradicts_itself),
        cmocka_unit_test(test_ax206_commands),
        cmocka_unit_test(test_ax206_refuses),
        cmocka_unit_test(test_ax206_that_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
