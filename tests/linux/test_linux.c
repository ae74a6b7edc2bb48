/* What the guest did, after its run: programs built for arm64 under Debian's own kernel. */
#include "../support/check.h"

#include "../../sim/picture.h"
#include "../support/command.h"

static const char *out_path(const char *name, const char *end) {
    static char path[4096];

    (void)snprintf(path, sizeof path, "%s/linux/share/out/%s%s", getenv("BUILD"), name, end);
    return path;
}

/* What a step left, to be released with free. */
static char *text_of(const char *name, const char *end) {
    char *text = command_read(out_path(name, end), NULL);

    if (!text) { fail_msg("the guest left no %s%s", name, end); }
    return text;
}

static void assert_code(const char *step, int code) {
    char *text = text_of(step, ".code"), *err = text_of(step, ".err");

    if (atoi(text) != code) { fail_msg("%s ended with %d, not %d: %s", step, atoi(text), code, err); }
    free(text);
    free(err);
}

/* Pixels of a picture that differ from another. */
static size_t difference(const char *a_path, const char *b_path) {
    sim_picture_t a, b, shown;
    sim_error_t error = {""};
    size_t count = 0;

    if (sim_picture_read(&a, a_path, &error) || sim_picture_read(&b, b_path, &error) ||
        sim_picture_difference(&a, &b, &shown, &count, &error)) {
        fail_msg("%s", error.text);
    }
    sim_picture_free(&a);
    sim_picture_free(&b);
    sim_picture_free(&shown);
    return count;
}

static void assert_same_picture(const char *step) {
    char simulated[4096];

    (void)snprintf(simulated, sizeof simulated, "%s/linux/share/sim.ppm", getenv("BUILD"));
    assert_int_equal(difference(simulated, out_path(step, ".ppm")), 0);
}

static void test_arm64_draws_the_same_bits(void **state) {
    (void)state;
    assert_code("render", 0);
    assert_same_picture("render");
}

static void test_a_frame_on_the_pins_is_the_simulators(void **state) {
    char *err = text_of("panel", ".err");

    (void)state;
    assert_string_equal(err, "");
    assert_code("spi-picture", 0);
    assert_same_picture("lit-1");
    free(err);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arm64_draws_the_same_bits),
        cmocka_unit_test(test_a_frame_on_the_pins_is_the_simulators),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
