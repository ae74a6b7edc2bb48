#include "guest.h"

#include "../support/check.h"

#include "../../sim/picture.h"
#include "../support/command.h"

const char *guest_path(const char *name, const char *end) {
    static char path[512];

    (void)snprintf(path, sizeof path, "%s/linux/share/out/%s%s", getenv("BUILD"), name, end);
    return path;
}

char *guest_text(const char *name, const char *end) {
    char *text = command_read(guest_path(name, end), NULL);

    if (!text) { fail_msg("the guest left no %s%s", name, end); }
    return text;
}

void guest_assert_text(const char *name, const char *end, const char *expected) {
    char *text = guest_text(name, end);

    assert_string_equal(text, expected);
    free(text);
}

void guest_assert_code(const char *name, int code) {
    char *text = guest_text(name, ".code"), *err = guest_text(name, ".err");

    if (atoi(text) != code) { fail_msg("%s ended with %d, not %d: %s", name, atoi(text), code, err); }
    free(text);
    free(err);
}

unsigned long guest_number(const char *name, const char *end, const char *word) {
    char *text = guest_text(name, end);
    const char *at = strstr(text, word);
    unsigned long number;

    if (!at) { fail_msg("%s%s has no \"%s\": %s", name, end, word, text); }
    number = strtoul(at + strlen(word), NULL, 10);
    free(text);
    return number;
}

void guest_assert_same_picture(const char *path, const char *other_path, uint32_t kept) {
    sim_picture_t picture, other;
    sim_error_t error = {""};
    size_t count = 0;

    if (sim_picture_read(&picture, path, &error) || sim_picture_read(&other, other_path, &error)) { fail_msg("%s", error.text); }
    assert_int_equal(picture.width, other.width);
    assert_int_equal(picture.height, other.height);
    for (size_t i = 0; i < (size_t)picture.width * picture.height * 3; i++) {
        count += ((picture.rgb[i] ^ other.rgb[i]) & (kept >> (16 - 8 * (i % 3)) & 255u)) != 0;
    }
    sim_picture_free(&picture);
    sim_picture_free(&other);
    if (count > 0) { fail_msg("%zu components of %s are not those of %s", count, path, other_path); }
}
