/* Images: textures texel by texel, equal neighbours at once. */
#include "../surface/texture.h"
#include "canvas.h"

static bool is_texture(const tuile_texture_t *image) {
    const bool indexed = image != NULL && (image->format == TUILE_TEXEL_PALETTE8 || image->format == TUILE_TEXEL_PALETTE4);
    return image != NULL && image->texels != NULL && image->width > 0 && image->height > 0 && image->width <= TUILE_TEXTURE_MAX &&
           image->height <= TUILE_TEXTURE_MAX && image->format <= TUILE_TEXEL_ARGB4444 && (!indexed || image->palette != NULL);
}

static uint32_t faded(uint32_t argb, uint32_t alpha) {
    return (argb & 0xffffffu) | pixel_div255((argb >> 24) * alpha + 127u) << 24;
}

int tuile_draw_image(tuile_canvas_t *canvas, const tuile_texture_t *image, int32_t x, int32_t y, unsigned scale, uint8_t alpha) {
    tuile_box_t box;
    const int64_t size = scale > 65535 ? 65535 : scale ? scale : 1;
    if (!is_texture(image)) { return TUILE_ERROR_ARGUMENT; }
    if (!overlay_cut(canvas, x, y, x + image->width * size, y + image->height * size, &box)) { return TUILE_OK; }
    const texture_level_t level = texture_level(image, 0);
    for (int32_t row = box.top; row < box.bottom; row++) {
        const uint32_t t = (uint32_t)(((int64_t)row - y) / size);
        for (int32_t column = box.left; column < box.right;) {
            const uint32_t s = (uint32_t)(((int64_t)column - x) / size), argb = texture_level_texel(image, &level, s, t);
            uint32_t next = s + 1;
            while (next < image->width && x + next * size < box.right && texture_level_texel(image, &level, next, t) == argb) {
                next++;
            }
            const int64_t end = x + next * size;
            const tuile_box_t run = {column, row, end < box.right ? (int32_t)end : box.right, row + 1};
            const overlay_paint_t paint = overlay_paint(canvas, faded(argb, alpha));
            overlay_fill(canvas, &paint, &run);
            column = run.right;
        }
    }
    return TUILE_OK;
}
