/* From changes of pins to a chip: bits by the modes of SPI, D/C, resets and light, and what no wire shows. */
#include "support/check.h"

#include "linux/pins.h"

/* A chip that writes down what reaches it. */
typedef struct listener {
    sim_chip_t chip;
    char log[400];
    uint32_t clock_hz;
    uint64_t now_ns;
    unsigned seen;
} listener_t;

static listener_t *listener_of(sim_chip_t *chip) { return (listener_t *)chip; }

static void note(sim_chip_t *chip, const char *text) {
    char *log = listener_of(chip)->log;

    assert_true(strlen(log) + strlen(text) < sizeof listener_of(chip)->log);
    (void)strcat(log, text);
}

static void listener_reset(sim_chip_t *chip, bool held, uint64_t now_ns) {
    listener_of(chip)->now_ns = now_ns;
    note(chip, held ? "held " : "free ");
}

static int listener_receive(sim_chip_t *chip, bool data, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz,
                            uint64_t now_ns) {
    char text[16];

    assert_int_equal(size_bytes, 1);
    (void)snprintf(text, sizeof text, "%c%02X ", data ? 'd' : 'c', bytes[0]);
    note(chip, text);
    listener_of(chip)->clock_hz = clock_hz;
    listener_of(chip)->now_ns = now_ns;
    if (bytes[0] == 0xEE) { return sim_fail(&chip->fault, "the chip refuses EE"); }
    return 0;
}

static int listener_seen(void *context, const sim_chip_t *chip, sim_error_t *error) {
    listener_t *listener = context;

    assert_ptr_equal(chip, &listener->chip);
    note(&listener->chip, "seen ");
    return listener->seen++ == 9 ? sim_fail(error, "seen too often") : 0;
}

static void open_pins(pins_t *pins, listener_t *listener, uint8_t mode) {
    *listener = (listener_t){.chip = {.reset = listener_reset, .receive = listener_receive}};
    *pins = (pins_t){.chip = &listener->chip, .spi_mode = mode, .seen = listener_seen, .context = listener};
}

/* Changes as text, 10 us apart: K clock, M MOSI, S select, D D/C, R reset, B backlight,
 * E end; capital = high, small = low. */
static int play(pins_t *pins, const char *changes, sim_error_t *error) {
    static const char names[] = "kmsxdrbe";
    static uint64_t time_us = 1000000;
    int result = 0;

    for (; *changes && result == 0; changes++) {
        const char *name = strchr(names, *changes | 0x20);
        if (*changes == ' ') { continue; }
        assert_non_null(name);
        result = pins_change(pins, (unsigned)(name - names), (*changes & 0x20) == 0, time_us += 10, error);
    }
    return result;
}

static void assert_play(uint8_t mode, const char *changes, const char *log) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    open_pins(&pins, &listener, mode);
    if (play(&pins, changes, &error)) { fail_msg("%s: %s", changes, error.text); }
    assert_int_equal(pins_end(&pins, &error), 0);
    assert_string_equal(listener.log, log);
}

static void assert_fault(uint8_t mode, const char *changes, const char *word) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    open_pins(&pins, &listener, mode);
    if (play(&pins, changes, &error) == 0) { assert_int_equal(pins_end(&pins, &error), -1); }
    if (!strstr(error.text, word)) { fail_msg("%s: \"%s\" has no \"%s\"", changes, error.text, word); }
}

/* A5 = 10100101, highest bit first. */
static void test_modes(void **state) {
    (void)state;
    assert_play(0, "S s MKk mKk MKk mKk mKk MKk mKk MKk S", "cA5 ");
    assert_play(1, "S s KMk Kmk KMk Kmk Kmk KMk Kmk KMk S", "cA5 ");
    assert_play(2, "SK s MkK mkK MkK mkK mkK MkK mkK MkK S", "cA5 ");
    assert_play(3, "SK s kMK kmK kMK kmK kmK kMK kmK kMK S", "cA5 ");
}

static void test_dc_tells_data_from_commands(void **state) {
    (void)state;
    assert_play(0, "S s KkKkKkKkKkKkKkKk D M KkKkKkKkKkKkKkKk d KkKkKkKkKkKkKkKk S", "c00 dFF cFF ");
}

static void test_counts(void **state) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    (void)state;
    open_pins(&pins, &listener, 0);
    assert_int_equal(play(&pins, "S s KkKkKkKkKkKkKkKk D KkKkKkKkKkKkKkKk KkKkKkKkKkKkKkKk S", &error), 0);
    assert_int_equal(pins.commands, 1);
    assert_int_equal(pins.data_bytes, 2);
}

static void test_clock_means_nothing_to_a_chip_that_is_not_selected(void **state) {
    (void)state;
    assert_play(0, "kK S KkKkKk MKkKkKkKkKkKkKkKkKkKk s KkKkKkKkKkKkKkKk S KkKk", "cFF ");
}

static void test_reset_and_light(void **state) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    (void)state;
    open_pins(&pins, &listener, 0);
    assert_int_equal(play(&pins, "S b r R rR B b B", &error), 0);
    assert_string_equal(listener.log, "free held free seen "); /* low at power-up is no pulse */
    assert_int_equal(pins.resets, 1);
    assert_int_equal(pins.lights, 2);
    assert_int_equal(pins_end(&pins, &error), -1);
    assert_string_equal(error.text, "pins: the light is left on");
    assert_int_equal(play(&pins, "b", &error), 0);
    assert_int_equal(pins_end(&pins, &error), 0);
    assert_string_equal(listener.log, "free held free seen seen ");
}

static int listener_begin(void *context, pins_t *pins, sim_error_t *error) {
    note(context, "begin ");
    pins->spi_mode = 3;
    return pins->resets == 3 ? sim_fail(error, "three resets") : 0;
}

static void test_a_reset_may_be_another_panel(void **state) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    (void)state;
    open_pins(&pins, &listener, 0);
    pins.begin = listener_begin;
    assert_int_equal(play(&pins, "S R rR K s kM K kK kK kK kK kK kK kK S rR", &error), 0);
    assert_string_equal(listener.log, "free begin held free cFF begin held free ");
    assert_int_equal(play(&pins, "r", &error), -1);
    assert_string_equal(error.text, "three resets");
}

static void test_the_end_of_a_program(void **state) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    (void)state;
    open_pins(&pins, &listener, 0);
    assert_int_equal(play(&pins, "S E B b e", &error), 0);
    assert_int_equal(play(&pins, "B E", &error), -1);
    assert_string_equal(error.text, "pins: the light is left on");
    assert_int_equal(play(&pins, "b s Kk e", &error), -1);
    assert_string_equal(error.text, "pins: it ends after 1 bits of a byte");
}

static void test_clock_rate_and_time(void **state) {
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    (void)state;
    open_pins(&pins, &listener, 0);
    assert_int_equal(play(&pins, "S s KkKkKkKkKkKkKkKk", &error), 0);
    /* From the first rising edge to the eighth 14 changes of 10 us: 7 periods. The first change is time 0, the last rise the 17th.
     */
    assert_int_equal(listener.clock_hz, 50000);
    assert_int_equal(listener.now_ns, 16 * 10000);
    assert_int_equal(pins.commands, 1);
    assert_int_equal(pins.data_bytes, 0);
}

static void test_what_no_wire_shows_is_refused(void **state) {
    (void)state;
    assert_fault(0, "S s KkKkKk S", "the chip select moved after 3 bits");
    assert_fault(0, "S s KkKkKk", "it ends after 3 bits");
    assert_fault(0, "S s KkKkKk D Kk", "D/C changed at bit 3");
    assert_fault(0, "SK s", "the clock rests high; in mode 0 it rests low");
    assert_fault(3, "S s", "the clock rests low; in mode 3 it rests high");
    assert_fault(0, "S s KkKkKkKkKkKkKkK S", "the clock rests high");
    assert_fault(0, "S s M KkKkKk m Kk M KkKkKk m Kk", "the chip refuses EE");
}

static void test_lines_of_a_trace(void **state) {
    static const char good[] = "11797@1795813051.000007:pl061_set_output /machine/unattached/device[6] setting output 6 to 1\n";
    static const char *const bad[] = {
        "",
        "pl061_set_output x setting output 6 to 1\n",
        "11797@1795813051.259395:pl061_read x setting output 6 to 1\n",
        "11797@1795813051:pl061_set_output x setting output 6 to 1\n",
        "11797@1795813051.25939:pl061_set_output x setting output 6 to 1\n",
        "11797@1795813051.259395:pl061_set_output x setting output 6\n",
        "11797@1795813051.259395:pl061_set_output x setting output 6 to 2\n",
        "11797@1795813051.259395:pl061_set_output x setting output 6 to 1x\n",
        "11797@1795813051.259395:pl061_set_output x setting output 8 to 1\n",
    };
    pins_t pins;
    listener_t listener;
    sim_error_t error = {""};

    (void)state;
    open_pins(&pins, &listener, 0);
    assert_int_equal(pins_trace(&pins, good, &error), 0);
    assert_int_equal(pins.lights, 1);
    assert_true(pins.start_us == UINT64_C(1795813051000007));
    for (size_t i = 0; i < CHECK_COUNT(bad); i++) {
        if (pins_trace(&pins, bad[i], &error) == 0) { fail_msg("taken: %s", bad[i]); }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_modes),
        cmocka_unit_test(test_dc_tells_data_from_commands),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_clock_means_nothing_to_a_chip_that_is_not_selected),
        cmocka_unit_test(test_reset_and_light),
        cmocka_unit_test(test_a_reset_may_be_another_panel),
        cmocka_unit_test(test_the_end_of_a_program),
        cmocka_unit_test(test_clock_rate_and_time),
        cmocka_unit_test(test_what_no_wire_shows_is_refused),
        cmocka_unit_test(test_lines_of_a_trace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
