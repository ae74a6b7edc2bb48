#define _XOPEN_SOURCE 700

#include "picture.h"

#include "output.h"

#include <errno.h>
#include <png.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int sim_picture_create(sim_picture_t *out, uint32_t width, uint32_t height, sim_error_t *error) {
    *out = (sim_picture_t){0};
    if (width == 0 || height == 0 || width > SIM_PICTURE_MAX_PX || height > SIM_PICTURE_MAX_PX) {
        return sim_fail(error, "a picture of %u x %u pixels: each side must be 1 to %u", width, height, SIM_PICTURE_MAX_PX);
    }
    out->rgb = calloc((size_t)width * height, 3);
    if (!out->rgb) { return sim_fail(error, "no memory for a picture of %u x %u pixels", width, height); }
    out->width = width;
    out->height = height;
    return 0;
}

void sim_picture_free(sim_picture_t *picture) {
    free(picture->rgb);
    *picture = (sim_picture_t){0};
}

/* ---- writing ----------------------------------------------------------------------------------------------- */

static bool ends_with(const char *path, const char *end) {
    size_t length = strlen(path), end_length = strlen(end);

    return length > end_length && strcmp(path + length - end_length, end) == 0;
}

static int write_ppm(const sim_picture_t *picture, FILE *file) {
    size_t size = (size_t)picture->width * picture->height * 3u;

    if (fprintf(file, "P6\n%u %u\n255\n", picture->width, picture->height) < 0) { return -1; }
    return fwrite(picture->rgb, 1, size, file) == size ? 0 : -1;
}

static int write_png(const sim_picture_t *picture, FILE *file, char *why, size_t why_size) {
    png_image image = {.version = PNG_IMAGE_VERSION, .width = picture->width, .height = picture->height, .format = PNG_FORMAT_RGB};
    int good = png_image_write_to_stdio(&image, file, 0, picture->rgb, (png_int_32)(3u * picture->width), NULL);

    if (!good) { snprintf(why, why_size, "%s", image.message); }
    png_image_free(&image);
    return good ? 0 : -1;
}

int sim_picture_write(const sim_picture_t *picture, const char *path, sim_error_t *error) {
    char why[80] = "";
    output_t output;

    if (!ends_with(path, ".ppm") && !ends_with(path, ".png")) {
        return sim_fail(error, "%s: cannot tell the kind of picture: end the name in .png or .ppm", path);
    }
    if (!picture->rgb) { return sim_fail(error, "%s: the picture to write is empty", path); }
    if (output_open(&output, path, error)) { return -1; }
    errno = 0;
    if (ends_with(path, ".ppm") ? write_ppm(picture, output.file) : write_png(picture, output.file, why, sizeof why)) {
        const int reason = errno;
        output_discard(&output);
        /* The system's reason is the better one; the library knows only that a write failed. */
        if (reason == 0 && why[0]) { return sim_fail(error, "%s: cannot write: %s", path, why); }
        return sim_fail(error, "%s: cannot write: %s", path, strerror(reason ? reason : EIO));
    }
    return output_close(&output, error);
}

/* ---- reading ----------------------------------------------------------------------------------------------- */

static int read_number(FILE *file, uint32_t *number) {
    int c = getc(file);

    while (c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '#') {
        if (c == '#') {
            while (c != '\n' && c != EOF) {
                c = getc(file);
            }
        }
        c = getc(file);
    }
    if (c < '0' || c > '9') { return -1; }
    for (*number = 0; c >= '0' && c <= '9'; c = getc(file)) {
        *number = *number * 10u + (uint32_t)(c - '0');
        if (*number > SIM_PICTURE_MAX_PX) { return -1; }
    }
    return 0; /* the one space after the number has been taken */
}

static int read_ppm(sim_picture_t *out, FILE *file, const char *path, sim_error_t *error) {
    uint32_t width, height, depth;
    size_t size;

    if (read_number(file, &width) || read_number(file, &height) || read_number(file, &depth) || depth != 255) {
        return sim_fail(error, "%s: not a binary PPM of 8 bits and at most %u pixels a side", path, SIM_PICTURE_MAX_PX);
    }
    if (sim_picture_create(out, width, height, error)) { return -1; }
    size = (size_t)width * height * 3u;
    if (fread(out->rgb, 1, size, file) != size) {
        sim_picture_free(out);
        return sim_fail(error, "%s: the picture ends too early", path);
    }
    return 0;
}

static int read_png(sim_picture_t *out, FILE *file, const char *path, sim_error_t *error) {
    png_image image = {.version = PNG_IMAGE_VERSION};
    static const png_color black = {0, 0, 0};
    int good = png_image_begin_read_from_stdio(&image, file);

    image.format = PNG_FORMAT_RGB;
    if (good && sim_picture_create(out, image.width, image.height, error)) {
        png_image_free(&image);
        return -1;
    }
    good = good && png_image_finish_read(&image, &black, out->rgb, 0, NULL);
    if (!good) {
        sim_fail(error, "%s: not a readable PNG: %s", path, image.message);
        sim_picture_free(out);
    }
    png_image_free(&image);
    return good ? 0 : -1;
}

int sim_picture_read(sim_picture_t *out, const char *path, sim_error_t *error) {
    uint8_t magic[2];
    FILE *file = fopen(path, "rb");
    int result;

    *out = (sim_picture_t){0};
    if (!file) { return sim_fail(error, "%s: cannot open: %s", path, strerror(errno)); }
    if (fread(magic, 1, 2, file) != 2) {
        result = sim_fail(error, "%s: too short for a picture", path);
    } else if (magic[0] == 'P' && magic[1] == '6') {
        result = read_ppm(out, file, path, error);
    } else {
        rewind(file);
        result = read_png(out, file, path, error);
    }
    fclose(file);
    return result;
}

/* ---- arithmetic -------------------------------------------------------------------------------------------- */

int sim_picture_turn(const sim_picture_t *picture, int quarter_turns, sim_picture_t *out, sim_error_t *error) {
    unsigned turn = (unsigned)quarter_turns & 3u; /* two's complement: -1 is 3 */
    uint32_t width = picture->width, height = picture->height;

    if (sim_picture_create(out, turn & 1u ? height : width, turn & 1u ? width : height, error)) { return -1; }
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            uint32_t to_x = turn == 0 ? x : turn == 1 ? height - 1 - y : turn == 2 ? width - 1 - x : y;
            uint32_t to_y = turn == 0 ? y : turn == 1 ? x : turn == 2 ? height - 1 - y : width - 1 - x;
            memcpy(sim_picture_at(out, to_x, to_y), sim_picture_at(picture, x, y), 3);
        }
    }
    return 0;
}

int sim_picture_magnify(const sim_picture_t *picture, uint32_t factor, sim_picture_t *out, sim_error_t *error) {
    if (factor == 0 || factor > SIM_PICTURE_MAX_PX) {
        *out = (sim_picture_t){0};
        return sim_fail(error, "cannot magnify a picture %u times", factor);
    }
    if (sim_picture_create(out, picture->width * factor, picture->height * factor, error)) { return -1; }
    for (uint32_t y = 0; y < out->height; y++) {
        for (uint32_t x = 0; x < out->width; x++) {
            memcpy(sim_picture_at(out, x, y), sim_picture_at(picture, x / factor, y / factor), 3);
        }
    }
    return 0;
}

int sim_picture_halve(const sim_picture_t *picture, sim_picture_t *out, sim_error_t *error) {
    if (sim_picture_create(out, (picture->width + 1) / 2, (picture->height + 1) / 2, error)) { return -1; }
    for (uint32_t y = 0; y < out->height; y++) {
        for (uint32_t x = 0; x < out->width; x++) {
            unsigned sum[3] = {0}, count = 0;
            for (uint32_t from_y = 2 * y; from_y < 2 * y + 2 && from_y < picture->height; from_y++) {
                for (uint32_t from_x = 2 * x; from_x < 2 * x + 2 && from_x < picture->width; from_x++) {
                    for (unsigned i = 0; i < 3; i++) {
                        sum[i] += sim_picture_at(picture, from_x, from_y)[i];
                    }
                    count++;
                }
            }
            for (unsigned i = 0; i < 3; i++) {
                sim_picture_at(out, x, y)[i] = (uint8_t)((sum[i] + count / 2) / (count ? count : 1));
            }
        }
    }
    return 0;
}

int sim_picture_difference(const sim_picture_t *a, const sim_picture_t *b, sim_picture_t *out, size_t *count, sim_error_t *error) {
    size_t differ = 0;

    if (a->width != b->width || a->height != b->height) {
        *out = (sim_picture_t){0};
        return sim_fail(error, "pictures of unlike size: %u x %u and %u x %u", a->width, a->height, b->width, b->height);
    }
    if (sim_picture_create(out, a->width, a->height, error)) { return -1; }
    for (size_t i = 0; i < (size_t)a->width * a->height; i++) {
        const uint8_t *p = a->rgb + 3 * i, *q = b->rgb + 3 * i;
        uint8_t *to = out->rgb + 3 * i;
        int largest = 0;
        for (unsigned k = 0; k < 3; k++) {
            int distance = abs(p[k] - q[k]);
            largest = distance > largest ? distance : largest;
        }
        if (largest) {
            to[0] = (uint8_t)(64 + largest * 191 / 255);
            differ++;
        } else {
            to[0] = to[1] = to[2] = (uint8_t)((p[0] + 2 * p[1] + p[2]) / 16);
        }
    }
    if (count) { *count = differ; }
    return 0;
}

sim_picture_t *sim_pictures_create(size_t count) { return calloc(count, sizeof(sim_picture_t)); }

void sim_pictures_free(sim_picture_t *pictures, size_t count) {
    for (size_t i = 0; pictures && i < count; i++) {
        sim_picture_free(&pictures[i]);
    }
    free(pictures);
}
