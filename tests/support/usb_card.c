#include "usb_card.h"

#include "check.h"

static unsigned colour_bits(uint8_t wire) {
    switch (wire) {
    case TUILE_WIRE_MONO_ROWS: return 1;
    case TUILE_WIRE_XRGB1111: return 3;
    case TUILE_WIRE_RGB332:
    case TUILE_WIRE_GREY8: return 8;
    case TUILE_WIRE_RGB565:
    case TUILE_WIRE_RGB565_LE: return 16;
    default: return 24;
    }
}

uint32_t usb_card_value(uint8_t wire, const usb_card_way_t *way, uint32_t x, uint32_t y) {
    uint32_t hash = way->seed * 2246822519u + (way->kind == USB_CARD_FLAT ? 0u : (y * 4099u + x + 1u) * 2654435761u);

    hash ^= hash >> 15;
    hash *= 2246822519u;
    hash ^= hash >> 13;
    return hash & ((1u << colour_bits(wire)) - 1u);
}

void usb_card_colour(uint8_t wire, uint32_t value, uint8_t rgb[3]) {
    uint32_t red = value >> 16, green = value >> 8 & 255u, blue = value & 255u;

    switch (wire) {
    case TUILE_WIRE_MONO_ROWS: red = green = blue = value * 255u; break;
    case TUILE_WIRE_GREY8: red = green = blue = value; break;
    case TUILE_WIRE_XRGB1111: red = (value >> 2) * 255u, green = (value >> 1 & 1u) * 255u, blue = (value & 1u) * 255u; break;
    case TUILE_WIRE_RGB332:
        red = value >> 5, green = value >> 2 & 7u, blue = (value & 3u) * 85u;
        red = red << 5 | red << 2 | red >> 1;
        green = green << 5 | green << 2 | green >> 1;
        break;
    case TUILE_WIRE_RGB565:
    case TUILE_WIRE_RGB565_LE:
        red = value >> 11, green = value >> 5 & 63u, blue = value & 31u;
        red = red << 3 | red >> 2;
        green = green << 2 | green >> 4;
        blue = blue << 3 | blue >> 2;
        break;
    default: break;
    }
    rgb[0] = (uint8_t)red;
    rgb[1] = (uint8_t)green;
    rgb[2] = (uint8_t)blue;
}

void usb_card_row(uint8_t wire, const usb_card_way_t *way, uint32_t x, uint32_t y, uint32_t width, uint8_t *to) {
    memset(to, 0, (width * tuile_wire_bits(wire) + 7u) / 8u);
    for (uint32_t i = 0; i < width; i++) {
        const uint32_t value = usb_card_value(wire, way, x + i, y);
        switch (wire) {
        case TUILE_WIRE_MONO_ROWS: to[i / 8u] = (uint8_t)(to[i / 8u] | value << (7u - i % 8u)); break;
        case TUILE_WIRE_XRGB1111: to[i / 2u] = (uint8_t)(to[i / 2u] | value << (i % 2u ? 0 : 4)); break;
        case TUILE_WIRE_RGB332:
        case TUILE_WIRE_GREY8: to[i] = (uint8_t)value; break;
        case TUILE_WIRE_RGB565: to[2u * i] = (uint8_t)(value >> 8), to[2u * i + 1u] = (uint8_t)value; break;
        case TUILE_WIRE_RGB565_LE: to[2u * i] = (uint8_t)value, to[2u * i + 1u] = (uint8_t)(value >> 8); break;
        default: { /* blue, green, red */
            const uint32_t bytes = tuile_wire_bits(wire) / 8u;
            for (uint32_t part = 0; part < 3; part++) {
                to[bytes * i + part] = (uint8_t)(value >> 8u * part);
            }
        }
        }
    }
}

static int write_window(tuile_display_t *display, const usb_card_way_t *way, const uint8_t *bytes, size_t size_bytes) {
    size_t piece = way->piece_pixels ? way->piece_pixels * tuile_wire_bits(display->wire) / 8u : size_bytes;
    int result = 0;

    for (size_t at = 0; at < size_bytes && !result; at += piece) {
        result = tuile_display_write(display, bytes + at, size_bytes - at < piece ? size_bytes - at : piece);
    }
    return result;
}

int usb_card_draw(tuile_display_t *display, const usb_card_way_t *way) {
    const uint32_t tile_width = way->tile_width ? way->tile_width : display->width;
    const uint32_t tile_height = way->tile_height ? way->tile_height : display->height;
    const size_t room = (size_t)tile_width * tile_height * 4u;
    uint8_t *buffers = malloc(2 * room);
    unsigned which = 0;
    int result = 0;

    assert_non_null(buffers);
    for (uint32_t y = 0; y < display->height && !result; y += tile_height) {
        for (uint32_t x = 0; x < display->width && !result; x += tile_width, which ^= 1u) {
            const uint32_t width = display->width - x < tile_width ? display->width - x : tile_width;
            const uint32_t height = display->height - y < tile_height ? display->height - y : tile_height;
            const size_t pitch = width * tuile_wire_bits(display->wire) / 8u;
            uint8_t *bytes = buffers + which * room;
            for (uint32_t row = 0; row < height; row++) {
                usb_card_row(display->wire, way, x, y + row, width, bytes + row * pitch);
            }
            if ((result = tuile_display_window(display, x, y, width, height))) { break; }
            result = write_window(display, way, bytes, pitch * height);
            memset(buffers + (which ^ 1u) * room, 0x5A, room); /* the caller's again */
        }
    }
    if (!result) { result = tuile_display_wait(display); }
    memset(buffers, 0xA5, 2 * room);
    if (!result) { result = tuile_display_present(display); }
    free(buffers);
    return result;
}

void usb_card_check(const sim_usb_t *model, uint8_t wire, const usb_card_way_t *way, unsigned rotation) {
    sim_picture_t glass, upright;

    assert_int_equal(model->picture(model, &glass, NULL), 0);
    assert_int_equal(sim_picture_turn(&glass, -(int)rotation, &upright, NULL), 0);
    for (uint32_t y = 0; y < upright.height; y++) {
        for (uint32_t x = 0; x < upright.width; x++) {
            const uint8_t *seen = sim_picture_at(&upright, x, y);
            uint8_t rgb[3];
            usb_card_colour(wire, usb_card_value(wire, way, x, y), rgb);
            if (memcmp(seen, rgb, 3)) {
                fail_msg("wire %u at (%u, %u): %02X%02X%02X, not %02X%02X%02X", wire, x, y, seen[0], seen[1], seen[2], rgb[0],
                         rgb[1], rgb[2]);
            }
        }
    }
    sim_picture_free(&glass);
    sim_picture_free(&upright);
}

void usb_card_check_dark(const sim_usb_t *model) {
    sim_picture_t glass;

    assert_int_equal(model->picture(model, &glass, NULL), 0);
    for (size_t i = 0; i < 3u * (size_t)glass.width * glass.height; i++) {
        assert_int_equal(glass.rgb[i], 0);
    }
    sim_picture_free(&glass);
}
