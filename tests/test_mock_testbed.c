/* What the tests of ports stand on: devices that umockdev makes up are seen by plain calls, and only there. */
#include "support/check.h"

#include <umockdev.h>
#include <unistd.h>

/* Without the preloaded library every later test would look at the devices of the machine that it runs on. */
static void made_up_devices_are_seen(void **state) {
    UMockdevTestbed *bed;

    (void)state;
    assert_int_not_equal(access("/dev/tuile-mock", F_OK), 0);
    bed = umockdev_testbed_new();
    assert_true(umockdev_in_mock_environment());
    assert_true(umockdev_testbed_add_from_string(bed, "P: /devices/tuile\nN: tuile-mock\nE: SUBSYSTEM=mem\n", NULL));
    assert_int_equal(access("/dev/tuile-mock", F_OK), 0);
    g_object_unref(bed);
    assert_int_not_equal(access("/dev/tuile-mock", F_OK), 0);
}

int main(void) {
    static const struct CMUnitTest tests[] = {cmocka_unit_test(made_up_devices_are_seen)};
    return cmocka_run_group_tests_name("made-up devices", tests, NULL, NULL);
}
