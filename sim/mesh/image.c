/* PNG by libpng, JPEG by libjpeg. Both libraries leave by longjmp where something is wrong, so what they work on is in a struct. */
#include "image.h"

#include <png.h>
#include <setjmp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jerror.h>
#include <jpeglib.h>

void image_free(image_t *image) {
    free(image->pixels);
    *image = (image_t){0};
}

/* False with a text in trouble. */
static bool make_room(image_t *image, uint32_t width, uint32_t height, char trouble[200]) {
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MAX || height > IMAGE_SIDE_MAX) {
        (void)snprintf(trouble, 200, "is %ux%u pixels; 1x1 to %ux%u fit", width, height, IMAGE_SIDE_MAX, IMAGE_SIDE_MAX);
        return false;
    }
    *image = (image_t){width, height, malloc((size_t)width * height * sizeof *image->pixels)};
    if (!image->pixels) { (void)snprintf(trouble, 200, "of %ux%u pixels needs more memory than there is", width, height); }
    return image->pixels != NULL;
}

/* ---- PNG ------------------------------------------------------------------------------------------------------- */

typedef struct png_work {
    image_t image;
    const uint8_t *at, *end;
    png_structp png;
    png_infop info;
    png_bytep *rows;
    char trouble[200];
} png_work_t;

static void png_take(png_structp png, png_bytep to, png_size_t count) {
    png_work_t *w = png_get_io_ptr(png);
    if ((size_t)(w->end - w->at) < count) { png_error(png, "the file is cut short"); }
    memcpy(to, w->at, count);
    w->at += count;
}

static void png_fail(png_structp png, png_const_charp text) {
    png_work_t *w = png_get_error_ptr(png);
    if (!w->trouble[0]) { (void)snprintf(w->trouble, sizeof w->trouble, "is a broken PNG file: %.120s", text); }
    png_longjmp(png, 1);
}

static void png_ignore(png_structp png, png_const_charp text) {
    (void)png;
    (void)text;
}

/* Whatever it is, to 8 bits of red, green, blue and alpha. */
static bool png_decode_rows(png_work_t *w) {
    png_read_info(w->png, w->info);
    const uint32_t width = png_get_image_width(w->png, w->info), height = png_get_image_height(w->png, w->info);
    if (!make_room(&w->image, width, height, w->trouble)) { return false; }
    png_set_expand(w->png);
    png_set_scale_16(w->png);
    png_set_gray_to_rgb(w->png);
    png_set_add_alpha(w->png, 255, PNG_FILLER_AFTER);
    (void)png_set_interlace_handling(w->png);
    png_read_update_info(w->png, w->info);
    w->rows = calloc(height, sizeof *w->rows);
    if (!w->rows) { png_error(w->png, "out of memory"); }
    for (uint32_t y = 0; y < height; y++) {
        w->rows[y] = (png_bytep)w->image.pixels[(size_t)y * width];
    }
    png_read_image(w->png, w->rows);
    png_read_end(w->png, NULL);
    return true;
}

static bool png_decode(png_work_t *w) {
    w->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, w, png_fail, png_ignore);
    w->info = w->png ? png_create_info_struct(w->png) : NULL;
    if (!w->info) {
        (void)snprintf(w->trouble, sizeof w->trouble, "needs more memory than there is");
        return false;
    }
    png_set_user_limits(w->png, 0x7fffffff, 0x7fffffff); /* sizes are judged here */
    if (setjmp(png_jmpbuf(w->png))) { return false; }
    png_set_read_fn(w->png, w, png_take);
    return png_decode_rows(w);
}

/* ---- JPEG ------------------------------------------------------------------------------------------------------- */

typedef struct jpeg_work {
    struct jpeg_error_mgr errors; /* first: libjpeg knows this struct by its address */
    image_t image;
    const uint8_t *bytes;
    size_t size_bytes;
    struct jpeg_decompress_struct jpeg;
    uint8_t *row;
    jmp_buf leave;
    char trouble[200];
} jpeg_work_t;

static void jpeg_fail(j_common_ptr jpeg) {
    jpeg_work_t *w = (jpeg_work_t *)(void *)jpeg->err;
    char text[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, text);
    if (!w->trouble[0]) { (void)snprintf(w->trouble, sizeof w->trouble, "is a broken JPEG file: %.120s", text); }
    longjmp(w->leave, 1);
}

/* libjpeg goes on with grey where data end or a marker stands in them. */
static void jpeg_hear(j_common_ptr jpeg, int level) {
    if (level < 0 && (jpeg->err->msg_code == JWRN_JPEG_EOF || jpeg->err->msg_code == JWRN_HIT_MARKER)) { jpeg_fail(jpeg); }
}

static bool jpeg_decode_rows(jpeg_work_t *w) {
    jpeg_mem_src(&w->jpeg, w->bytes, (unsigned long)w->size_bytes);
    (void)jpeg_read_header(&w->jpeg, TRUE);
    if (w->jpeg.jpeg_color_space == JCS_CMYK || w->jpeg.jpeg_color_space == JCS_YCCK) {
        (void)snprintf(w->trouble, sizeof w->trouble, "has the four colours of print (CMYK); convert it to RGB");
        return false;
    }
    w->jpeg.out_color_space = JCS_RGB;
    if (!make_room(&w->image, w->jpeg.image_width, w->jpeg.image_height, w->trouble)) { return false; }
    (void)jpeg_start_decompress(&w->jpeg);
    w->row = malloc((size_t)w->image.width * 3);
    if (!w->row) {
        (void)snprintf(w->trouble, sizeof w->trouble, "needs more memory than there is");
        return false;
    }
    while (w->jpeg.output_scanline < w->image.height) {
        uint8_t(*to)[4] = w->image.pixels + (size_t)w->jpeg.output_scanline * w->image.width;
        (void)jpeg_read_scanlines(&w->jpeg, &w->row, 1);
        for (uint32_t x = 0; x < w->image.width; x++) {
            memcpy(to[x], w->row + 3 * (size_t)x, 3);
            to[x][3] = 255;
        }
    }
    (void)jpeg_finish_decompress(&w->jpeg);
    return true;
}

static bool jpeg_decode(jpeg_work_t *w) {
    w->jpeg.err = jpeg_std_error(&w->errors);
    w->errors.error_exit = jpeg_fail;
    w->errors.emit_message = jpeg_hear;
    if (setjmp(w->leave)) { return false; }
    jpeg_create_decompress(&w->jpeg);
    return jpeg_decode_rows(w);
}

/* ---- either ------------------------------------------------------------------------------------------------------ */

static int decode_png(image_t *image, const uint8_t *bytes, size_t size_bytes, const char *name, sim_error_t *error) {
    png_work_t w = {.at = bytes, .end = bytes + size_bytes};
    const bool good = png_decode(&w);
    png_destroy_read_struct(&w.png, &w.info, NULL);
    free(w.rows);
    if (!good) {
        image_free(&w.image);
        return sim_fail(error, "%s: %s", name, w.trouble);
    }
    *image = w.image;
    return 0;
}

static int decode_jpeg(image_t *image, const uint8_t *bytes, size_t size_bytes, const char *name, sim_error_t *error) {
    jpeg_work_t w = {.bytes = bytes, .size_bytes = size_bytes};
    const bool good = jpeg_decode(&w);
    jpeg_destroy_decompress(&w.jpeg);
    free(w.row);
    if (!good) {
        image_free(&w.image);
        return sim_fail(error, "%s: %s", name, w.trouble);
    }
    *image = w.image;
    return 0;
}

int image_decode(image_t *image, const uint8_t *bytes, size_t size_bytes, const char *name, sim_error_t *error) {
    *image = (image_t){0};
    if (size_bytes >= 8 && !memcmp(bytes, "\x89PNG\r\n\x1a\n", 8)) { return decode_png(image, bytes, size_bytes, name, error); }
    if (size_bytes >= 3 && !memcmp(bytes, "\xff\xd8\xff", 3)) { return decode_jpeg(image, bytes, size_bytes, name, error); }
    return sim_fail(error, "%s: is neither a PNG nor a JPEG file; convert it, or leave images out (--no-textures)", name);
}
