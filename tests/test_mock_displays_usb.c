/* tuile displays, where displays on USB are made up: what it says of each, and whom it does not mention. */
#include "support/check.h"

#include "../sim/usb/ax206_model.h"
#include "../sim/usb/gud_model.h"
#include "mock/mock_usb.h"
#include "support/cli.h"
#include "support/command.h"

#include <unistd.h>

static sim_usb_t *models[2];

static mock_usb_state_t *plug_gud(unsigned port, const sim_gud_config_t *config) {
    sim_error_t error = {""};

    models[port - 1] = sim_gud_create(config, &error);
    if (!models[port - 1]) { fail_msg("%s", error.text); }
    return mock_usb_state(mock_usb_plug(port, models[port - 1]));
}

static void check_usb(const char *expected) {
    const char *const arguments[] = {cli_program(), "displays", NULL};
    command_result_t result;
    const char *usb;

    command_run(&result, arguments, NULL, NULL);
    assert_string_equal(result.err, "");
    assert_int_equal(result.code, 0);
    usb = strstr(result.out, "\nUSB\n");
    assert_non_null(usb);
    assert_string_equal(usb + 5, expected);
    command_free(&result);
}

static void unplug_all(void) {
    mock_usb_clear();
    for (size_t i = 0; i < CHECK_COUNT(models); i++) {
        if (models[i]) {
            assert_string_equal(models[i]->fault.text, "");
            models[i]->destroy(models[i]);
        }
        models[i] = NULL;
    }
}

static void each_number_of_gud(void **state) {
    static const uint16_t ids[][2] = {{0x1D50, 0x614D}, {0x16D0, 0x10A9}, {0x1209, 0x4FB3}};

    (void)state;
    for (size_t i = 0; i < CHECK_COUNT(ids); i++) {
        char expected[100];
        const sim_gud_config_t config = {
            .vendor = ids[i][0], .product = ids[i][1], .width = 320, .height = 172, .interface = (uint8_t)i};
        const mock_usb_state_t *device = plug_gud(1, &config);

        (void)snprintf(expected, sizeof expected, "  001-002: %04x:%04x GUD: ready, up to 320x172 pixels\n", ids[i][0], ids[i][1]);
        check_usb(expected);
        assert_int_equal(device->claims, device->releases);
        assert_int_equal(device->pending, 0);
        unplug_all();
    }
}

static void an_unknown_number_that_says_it_is_gud(void **state) {
    const sim_gud_config_t config = {.vendor = 0x1234, .product = 0xABCD};

    (void)state;
    (void)plug_gud(1, &config);
    check_usb("  001-002: 1234:abcd GUD: ready, up to 320x240 pixels\n");
    unplug_all();
}

static void an_unknown_number_that_does_not(void **state) {
    const sim_gud_config_t config = {.vendor = 0x1234, .product = 0xABCD, .magic = 0x12345678};

    (void)state;
    (void)plug_gud(1, &config);
    check_usb("  no displays: none of 1 devices is one that speaks GUD, or an AX206\n");
    unplug_all();
}

/* Nobody asks a stranger anything while a driver has it. */
static void an_unknown_number_with_a_driver_is_left_alone(void **state) {
    const sim_gud_config_t config = {.vendor = 0x1234, .product = 0xABCD};
    mock_usb_state_t *device;

    (void)state;
    device = plug_gud(1, &config);
    device->driver = true;
    check_usb("  no displays: none of 1 devices is one that speaks GUD, or an AX206\n");
    assert_int_equal(device->claims, 0);
    assert_int_equal(device->submitted, 0);
    unplug_all();
}

static void the_kernels_driver_has_it(void **state) {
    mock_usb_state_t *device;

    (void)state;
    device = plug_gud(1, NULL);
    device->driver = true;
    check_usb("  001-002: 1d50:614d GUD: ready; the kernel's driver has it, and loses it to whoever opens it\n");
    assert_true(device->driver);
    assert_int_equal(device->submitted, 0);
    unplug_all();
}

static void another_program_has_it(void **state) {
    (void)state;
    plug_gud(1, NULL)->busy = true;
    check_usb("  001-002: 1d50:614d GUD: in use by another program\n");
    unplug_all();
}

static void it_does_not_answer(void **state) {
    mock_usb_state_t *device;
    const sim_gud_config_t config = {.magic = 0x12345678};

    (void)state;
    device = plug_gud(1, NULL);
    device->fault = MOCK_USB_STALL;
    device->fault_at = 1;
    check_usb("  001-002: 1d50:614d GUD: Pipe error\n");
    unplug_all();
    device = plug_gud(1, NULL);
    device->fault = MOCK_USB_GONE;
    device->fault_at = 1;
    check_usb("  001-002: 1d50:614d GUD: it is gone\n");
    unplug_all();
    (void)plug_gud(1, &config);
    check_usb("  001-002: 1d50:614d GUD: it does not answer as a GUD display\n");
    unplug_all();
}

static void photo_frame_and_gud_together(void **state) {
    sim_error_t error = {""};
    mock_usb_state_t *device;

    (void)state;
    models[1] = sim_ax206_create(NULL, &error);
    assert_non_null(models[1]);
    (void)plug_gud(1, NULL);
    device = mock_usb_state(mock_usb_plug(2, models[1]));
    check_usb("  001-002: 1d50:614d GUD: ready, up to 320x240 pixels\n"
              "  001-003: 1908:0102 AX206: ready\n");
    assert_int_equal(device->submitted, 0);
    device->busy = true;
    check_usb("  001-002: 1d50:614d GUD: ready, up to 320x240 pixels\n"
              "  001-003: 1908:0102 AX206: in use by another program\n");
    unplug_all();
}

/* root may open everything. */
static void no_permission_names_the_rules(void **state) {
    char line[300];
    command_result_t result;
    mock_usb_t *device;
    sim_error_t error = {""};

    (void)state;
    models[0] = sim_gud_create(NULL, &error);
    assert_non_null(models[0]);
    device = mock_usb_plug(1, models[0]);
    mock_usb_forbid(device);
    (void)snprintf(line, sizeof line, "%s%s displays", geteuid() == 0 ? "setpriv --reuid=65534 --clear-groups " : "",
                   cli_program());
    command_shell(&result, line);
    assert_non_null(strstr(result.out,
                           "\nUSB\n  001-002: 1d50:614d GUD: no permission; hal/linux/60-tuile.rules lets users have it "
                           "(make install-udev)\n"));
    command_free(&result);
    unplug_all();
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_number_of_gud, mock_usb_set_up),
        cmocka_unit_test_setup(an_unknown_number_that_says_it_is_gud, mock_usb_set_up),
        cmocka_unit_test_setup(an_unknown_number_that_does_not, mock_usb_set_up),
        cmocka_unit_test_setup(an_unknown_number_with_a_driver_is_left_alone, mock_usb_set_up),
        cmocka_unit_test_setup(the_kernels_driver_has_it, mock_usb_set_up),
        cmocka_unit_test_setup(another_program_has_it, mock_usb_set_up),
        cmocka_unit_test_setup(it_does_not_answer, mock_usb_set_up),
        cmocka_unit_test_setup(photo_frame_and_gud_together, mock_usb_set_up),
        cmocka_unit_test_setup(no_permission_names_the_rules, mock_usb_set_up),
    };
    return cmocka_run_group_tests_name("tuile displays on USB", tests, NULL, NULL);
}
