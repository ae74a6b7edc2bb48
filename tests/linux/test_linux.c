/* What the guest did, after its run: programs built for arm64 under Debian's own kernel. */
#include "../support/check.h"

#include "guest.h"

static void assert_simulated(const char *name) {
    char simulated[4096];

    (void)snprintf(simulated, sizeof simulated, "%s/linux/share/sim.ppm", getenv("BUILD"));
    guest_assert_same_picture(guest_path(name, ".ppm"), simulated);
}

static void test_arm64_draws_the_same_bits(void **state) {
    (void)state;
    guest_assert_code("render", 0);
    assert_simulated("render");
}

static void test_a_frame_on_the_pins_is_the_simulators(void **state) {
    (void)state;
    guest_assert_text("panel", ".err", "");
    guest_assert_code("spi-picture", 0);
    assert_simulated("lit-1");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arm64_draws_the_same_bits),
        cmocka_unit_test(test_a_frame_on_the_pins_is_the_simulators),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
