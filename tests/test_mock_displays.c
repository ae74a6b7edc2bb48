/* tuile displays, run as a user would run it, where devices are made up; and the udev rules that it names. */
#include "support/check.h"

#include "mock/linux.h"
#include "support/cli.h"
#include "support/command.h"

#include <sys/stat.h>
#include <unistd.h>

static mock_linux_t mock;

static void check_prints(const char *expected) {
    const char *const arguments[] = {cli_program(), "displays", NULL};
    command_result_t result;

    command_run(&result, arguments, NULL, NULL);
    assert_string_equal(result.err, "");
    assert_int_equal(result.code, 0);
    assert_string_equal(result.out, expected);
    command_free(&result);
}

/* The version differs from machine to machine. */
static const char *lines(const char *format) {
    static char text[2048];

    (void)snprintf(text, sizeof text, format, tuile_linux_gpiod_version());
    return text;
}

static void nothing_is_attached(void **state) {
    UMockdevTestbed *bed = umockdev_testbed_new();

    (void)state;
    check_prints(
        lines("SPI, transfers of up to 4096 bytes (bufsiz)\n"
              "  no SPI devices: there is no /dev/spidev*; the device tree has to ask for one (Raspberry Pi: dtparam=spi=on)\n"
              "GPIO, through libgpiod %s\n"
              "  no GPIO chips: there is no /dev/gpiochip*\n"
              "USB\n"
              "  no displays: none of 0 devices is one that speaks GUD, or an AX206\n"));
    g_object_unref(bed);
}

static void a_board(void **state) {
    (void)state;
    mock = (mock_linux_t){.bufsiz = 65536, .mode = 3};
    mock_linux_open(&mock, "ili9341");
    check_prints(lines("SPI, transfers of up to 65536 bytes (bufsiz)\n"
                       "  /dev/spidev0.0: ready\n"
                       "GPIO, through libgpiod %s\n"
                       "  gpiochip0: pinctrl-mock, 54 lines\n"
                       "    line 8 is in use by spi0 CS0\n"
                       "USB\n"
                       "  no displays: none of 0 devices is one that speaks GUD, or an AX206\n"));
    assert_int_equal(mock.mode, 3); /* looking changes nothing */
    assert_int_equal(mock.transfers, 0);
    assert_string_equal(mock.misuse.text, "");
    mock_linux_close(&mock);
}

static void lines_that_a_display_has_are_in_use(void **state) {
    const tuile_linux_config_t config = mock_linux_config();
    tuile_linux_t port;

    (void)state;
    mock = (mock_linux_t){0};
    mock_linux_open(&mock, "ili9341");
    assert_int_equal(tuile_linux_open(&port, &config), 0);
    check_prints(lines("SPI, transfers of up to 4096 bytes (bufsiz)\n"
                       "  /dev/spidev0.0: ready\n"
                       "GPIO, through libgpiod %s\n"
                       "  gpiochip0: pinctrl-mock, 54 lines\n"
                       "    line 8 is in use by spi0 CS0\n"
                       "    line 18 is in use by tuile\n"
                       "    line 25 is in use by tuile\n"
                       "    line 27 is in use by tuile\n"
                       "USB\n"
                       "  no displays: none of 0 devices is one that speaks GUD, or an AX206\n"));
    tuile_linux_close(&port);
    mock_linux_close(&mock);
}

static void devices_that_fail(void **state) {
    (void)state;
    mock = (mock_linux_t){.fail_call = 1};
    mock_linux_open(&mock, "ili9341");
    check_prints(lines("SPI, transfers of up to 4096 bytes (bufsiz)\n"
                       "  /dev/spidev0.0: mode: Input/output error\n"
                       "GPIO, through libgpiod %s\n"
                       "  gpiochip0: pinctrl-mock, 54 lines\n"
                       "    line 8 is in use by spi0 CS0\n"
                       "USB\n"
                       "  no displays: none of 0 devices is one that speaks GUD, or an AX206\n"));
    mock.calls = 0;
    mock.fail_call = 2;
    check_prints(lines("SPI, transfers of up to 4096 bytes (bufsiz)\n"
                       "  /dev/spidev0.0: ready\n"
                       "GPIO, through libgpiod %s\n"
                       "  gpiochip0: Input/output error\n"
                       "USB\n"
                       "  no displays: none of 0 devices is one that speaks GUD, or an AX206\n"));
    mock_linux_close(&mock);
}

static void put_forbidden(const char *root, const char *name) {
    char path[300];
    FILE *file;

    (void)snprintf(path, sizeof path, "%s/dev/%s", root, name);
    file = fopen(path, "w");
    assert_non_null(file);
    (void)fclose(file);
    assert_int_equal(chmod(path, 0), 0);
}

/* Names in the order of their numbers; as a user without rights, since root has them all. */
static void no_permission_names_the_rules(void **state) {
    UMockdevTestbed *bed = umockdev_testbed_new();
    char *root = umockdev_testbed_get_root_dir(bed), line[600];
    command_result_t result;

    (void)state;
    (void)snprintf(line, sizeof line, "mkdir -p %s/dev; chmod -R a+rwX %s", root, root);
    assert_int_equal(system(line), 0);
    put_forbidden(root, "spidev10.0");
    put_forbidden(root, "spidev2.1");
    put_forbidden(root, "gpiochip4");
    if (geteuid() == 0) {
        (void)snprintf(line, sizeof line, "setpriv --reuid=65534 --clear-groups %s displays", cli_program());
    } else {
        (void)snprintf(line, sizeof line, "%s displays", cli_program());
    }
    command_shell(&result, line);
    assert_string_equal(
        result.out, lines("SPI, transfers of up to 4096 bytes (bufsiz)\n"
                          "  /dev/spidev2.1: Permission denied; hal/linux/60-tuile.rules lets users have it (make install-udev)\n"
                          "  /dev/spidev10.0: Permission denied; hal/linux/60-tuile.rules lets users have it (make install-udev)\n"
                          "GPIO, through libgpiod %s\n"
                          "  gpiochip4: Permission denied; hal/linux/60-tuile.rules lets users have it (make install-udev)\n"
                          "USB\n"
                          "  no displays: none of 0 devices is one that speaks GUD, or an AX206\n"));
    assert_int_equal(result.code, 0);
    command_free(&result);
    g_free(root);
    g_object_unref(bed);
}

static void usage_and_help(void **state) {
    char *help = cli_good("displays --help");

    (void)state;
    assert_int_equal(strncmp(help, "Usage: tuile displays\n", 22), 0);
    free(help);
    cli_fails("displays all", "displays", "all");
}

/* The numbers are those of shared documents: GUD's three and the AX206's; nodes by the kernel's names of subsystems. */
static void rules_name_what_is_listed(void **state) {
    static const char *const ids[][2] = {{"1d50", "614d"}, {"16d0", "10a9"}, {"1209", "4fb3"}, {"1908", "0102"}};
    char *rules = command_read("hal/linux/60-tuile.rules", NULL), text[200];
    unsigned usb = 0;

    (void)state;
    assert_non_null(rules);
    for (size_t i = 0; i < CHECK_COUNT(ids); i++) {
        (void)snprintf(text, sizeof text,
                       "\nSUBSYSTEM==\"usb\", ENV{DEVTYPE}==\"usb_device\", ATTR{idVendor}==\"%s\", ATTR{idProduct}==\"%s\", "
                       "GROUP=\"plugdev\", MODE=\"0660\", TAG+=\"uaccess\"\n",
                       ids[i][0], ids[i][1]);
        assert_non_null(strstr(rules, text));
    }
    for (const char *at = rules; (at = strstr(at, "idProduct")) != NULL; at++) {
        usb++;
    }
    assert_int_equal(usb, CHECK_COUNT(ids));
    assert_non_null(strstr(rules, "\nSUBSYSTEM==\"spidev\", GROUP=\"spi\", MODE=\"0660\"\n"));
    assert_non_null(strstr(rules, "\nSUBSYSTEM==\"gpio\", KERNEL==\"gpiochip[0-9]*\", GROUP=\"gpio\", MODE=\"0660\"\n"));
    free(rules);
}

static void rules_are_installed(void **state) {
    char *folder = command_folder(), line[300];
    command_result_t result;

    (void)state;
    (void)snprintf(
        line, sizeof line,
        "env -u LD_PRELOAD make -s install-udev DESTDIR=%s && cmp hal/linux/60-tuile.rules %s/etc/udev/rules.d/60-tuile.rules",
        folder, folder);
    command_shell(&result, line);
    if (result.code) { fail_msg("%s%s", result.out, result.err); }
    command_free(&result);
    (void)snprintf(line, sizeof line, "rm -r %s/etc", folder);
    assert_int_equal(system(line), 0);
    command_remove(folder);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nothing_is_attached, NULL, mock_linux_end),
        cmocka_unit_test_setup_teardown(a_board, NULL, mock_linux_end),
        cmocka_unit_test_setup_teardown(lines_that_a_display_has_are_in_use, NULL, mock_linux_end),
        cmocka_unit_test_setup_teardown(devices_that_fail, NULL, mock_linux_end),
        cmocka_unit_test_setup_teardown(no_permission_names_the_rules, NULL, mock_linux_end),
        cmocka_unit_test_setup_teardown(usage_and_help, cli_set_up, cli_tear_down),
        cmocka_unit_test(rules_name_what_is_listed),
        cmocka_unit_test(rules_are_installed),
    };
    return cmocka_run_group_tests_name("tuile displays", tests, NULL, NULL);
}
