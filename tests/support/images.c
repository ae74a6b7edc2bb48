#include "images.h"

#include "check.h"
#include "folder.h"

#include <png.h>

#include <jpeglib.h>

static void append(png_structp png, png_bytep bytes, png_size_t count) {
    image_bytes_t *to = png_get_io_ptr(png);
    to->at = realloc(to->at, to->size + count);
    assert_non_null(to->at);
    memcpy(to->at + to->size, bytes, count);
    to->size += count;
}

static void flush(png_structp png) { (void)png; }

image_bytes_t images_png(const images_png_t *from) {
    image_bytes_t bytes = {0};
    png_color palette[256];
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    assert_non_null(info);
    png_set_write_fn(png, &bytes, append, flush);
    png_set_IHDR(png, info, from->width, from->height, from->depth, from->colour_type,
                 from->interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    for (int i = 0; i < from->entries; i++) {
        palette[i] = (png_color){from->palette[i][0], from->palette[i][1], from->palette[i][2]};
    }
    if (from->entries) { png_set_PLTE(png, info, palette, from->entries); }
    if (from->alphas) { png_set_tRNS(png, info, from->alphas, from->entries, NULL); }
    if (from->gamma > 0) { png_set_gAMA(png, info, from->gamma); }
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; pass++) {
        for (uint32_t y = 0; y < from->height; y++) {
            png_write_row(png, from->rows + y * from->row_bytes);
        }
    }
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

image_bytes_t images_png_rgb(uint32_t width, uint32_t height, const uint8_t *pixels, bool alpha) {
    return images_png(&(images_png_t){.width = width,
                                      .height = height,
                                      .colour_type = alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                                      .depth = 8,
                                      .rows = pixels,
                                      .row_bytes = (size_t)width * (alpha ? 4 : 3)});
}

image_bytes_t images_jpeg(uint32_t width, uint32_t height, const uint8_t *pixels, int components) {
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned char *made = NULL;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &made, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = components;
    jpeg.in_color_space = components == 1 ? JCS_GRAYSCALE : components == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 1; /* colours as fine as light */
    jpeg_start_compress(&jpeg, TRUE);
    for (uint32_t y = 0; y < height; y++) {
        uint8_t row[1024];
        uint8_t *rows = row;
        assert_true((size_t)width * (size_t)components <= sizeof row);
        memcpy(row, pixels + (size_t)y * width * (size_t)components, (size_t)width * (size_t)components);
        (void)jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return (image_bytes_t){made, size};
}

const char *images_put(const char *name, image_bytes_t bytes) {
    const char *path = folder_put_bytes(name, bytes.at, bytes.size);
    free(bytes.at);
    return path;
}

void images_put_stripes(const char *name) {
    static const uint8_t row[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
    uint8_t pixels[24];
    memcpy(pixels, row, 12);
    memcpy(pixels + 12, row, 12);
    (void)images_put(name, images_png_rgb(4, 2, pixels, false));
}
