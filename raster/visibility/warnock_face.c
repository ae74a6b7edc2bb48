#include "../tune.h"

#include "warnock_face.h"

#include "paint.h"

/* Of a triangle: 1/4 step by which its gradients may err (fill/triangle.c), and their floors. */
#define PLANE_ERROR 0x4100u

static void triangle_range(warnock_face_t *face, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2) {
    const uint32_t z0 = v0->depth_light >> 8, z1 = v1->depth_light >> 8, z2 = v2->depth_light >> 8;
    const uint32_t low = z1 < z2 ? z1 : z2, high = z1 > z2 ? z1 : z2;
    face->low = ((z0 < low ? z0 : low) << 8) + 0x8000u - PLANE_ERROR;
    face->high = ((z0 > high ? z0 : high) << 8) + 0x8000u + PLANE_ERROR;
}

bool warnock_face_start(tuile_t *t, warnock_face_t *face, uint32_t number, const window_t *box) {
    const record_t *record = frame_record(t, number);
    depth_plane_t plane;
    t->stats.faces_setup++;
    face->record = (uint16_t)number;
    face->box = *box;
    face->is_triangle = frame_record_is_triangle(record);
    if (TUILE_LIKELY(face->is_triangle)) {
        const vertex_t *v0 = &t->vertices[record->v0], *v1 = v0 + record->d1, *v2 = v0 + record->d2;
        const bool gouraud = t->span_kind == SPAN_GOURAUD;
        triangle_planes(v0, v1, v2, &plane, gouraud ? &face->light : NULL);
        triangle_range(face, v0, v1, v2);
        face->sides[0] = window_side(v0->x, v0->y, v1->x, v1->y);
        face->sides[1] = window_side(v1->x, v1->y, v2->x, v2->y);
        face->sides[2] = window_side(v2->x, v2->y, v0->x, v0->y);
        face->value = gouraud ? record->material : frame_value(t, record, number);
    } else {
        const polygon_ring_t ring = frame_record_ring(t, record);
        if (!polygon_plane(&ring, &plane)) { return false; }
        face->low = plane.low;
        face->high = plane.high;
        face->value = frame_value(t, record, number);
    }
    face->z = plane.z;
    face->dx = (int32_t)(uint32_t)plane.dx;
    face->dy = (int32_t)(uint32_t)plane.dy;
    face->is_steep = face->dx != plane.dx || face->dy != plane.dy;
    return true;
}

uint16_t warnock_face_polygon_depth(const tuile_t *t, const warnock_face_t *face, int32_t x, int32_t y) {
    depth_plane_t plane = {face->z, face->dx, face->dy, face->low, face->high};
    if (face->is_steep) {
        const polygon_ring_t ring = frame_record_ring(t, frame_record(t, face->record));
        (void)polygon_plane(&ring, &plane);
    }
    return depth_at(&plane, x, y);
}

/* The plane over the window, without regard to the face's range. */
static void plane_range(const warnock_face_t *face, const window_t *window, int64_t *least, int64_t *most) {
    const int64_t across = (int64_t)face->dx * (window->right - 1 - window->left),
                  down = (int64_t)face->dy * (window->bottom - 1 - window->top);
    const int64_t z = face->z + (int64_t)face->dx * window->left + (int64_t)face->dy * window->top;
    *least = z + (across < 0 ? across : 0) + (down < 0 ? down : 0);
    *most = z + (across > 0 ? across : 0) + (down > 0 ? down : 0);
}

bool warnock_face_hides(const warnock_face_t *a, const warnock_face_t *b, const window_t *window, bool first) {
    int64_t a_least = a->low, a_most = a->high, b_least = b->low, b_most = b->high;
    const int64_t more = first ? 0 : 0x10000; /* a whole step when equal depth is not enough */
    if (a->low >= b->high + more) { return true; }
    if (a->high < b->low) { return false; }
    if (!a->is_steep) { plane_range(a, window, &a_least, &a_most); }
    if (!b->is_steep) { plane_range(b, window, &b_least, &b_most); }
    const int64_t a_worst = a_least < a->low    ? a->low
                            : a_least > a->high ? a->high
                                                : a_least,
                  b_best = b_most > b->high  ? b->high
                           : b_most < b->low ? b->low
                                             : b_most;
    if (a_worst >= b_best + more) { return true; }
    if (a->is_steep || b->is_steep) { return false; }
    /* Corner by corner. Where a polygon's depth is clamped it does not follow its plane: a must not be held down below b, nor b be
     * held up above a. */
    if (!a->is_triangle && a_most > a->high && a->high < b_best + more) { return false; }
    if (!b->is_triangle && b_least < b->low && b->low + more > a_worst) { return false; }
    const int64_t dx = (int64_t)a->dx - b->dx, dy = (int64_t)a->dy - b->dy;
    const int64_t across = dx * (window->right - 1 - window->left), down = dy * (window->bottom - 1 - window->top);
    return a->z - b->z + dx * window->left + dy * window->top + (across < 0 ? across : 0) + (down < 0 ? down : 0) >= more;
}

/* ---- into the tile ---- */

void warnock_face_fill(tuile_t *t, const warnock_face_t *face, const window_t *window) {
    const int32_t count = window->right - window->left;
    size_t at = warnock_pixel_at(t, window->left, window->top);
    if (t->span_kind == SPAN_GOURAUD && face->is_triangle) {
        const light_plane_t *l = &face->light;
        const uint16_t *ramp = frame_ramp(t, face->value);
        uint32_t light = warnock_face_light(face, window->left, window->top);
        for (int32_t y = window->top; y < window->bottom; y++, at += (size_t)t->tile.stride_px, light += l->dy) {
            paint_gouraud((uint16_t *)t->tile.colour + at, count, light, l->dx, ramp);
        }
        return;
    }
    for (int32_t y = window->top; y < window->bottom; y++, at += (size_t)t->tile.stride_px) {
        if (t->span_kind == SPAN_IDS) {
            paint_ids((uint32_t *)t->tile.colour + at, count, face->value);
        } else {
            paint_flat((uint16_t *)t->tile.colour + at, count, (uint16_t)face->value);
        }
    }
}

void warnock_face_bits(tuile_t *t, const warnock_face_t *face, const window_t *window, uint32_t bits) {
    const int32_t width = window->right - window->left, stride = t->tile.stride_px;
    const uint32_t row_bits = 0xffffffffu >> (WINDOW_MASK_PX - width);
    const bool gouraud = t->span_kind == SPAN_GOURAUD && face->is_triangle, ids = t->span_kind == SPAN_IDS;
    const uint16_t *ramp = gouraud ? frame_ramp(t, face->value) : NULL;
    const uint32_t value = face->value;
    uint32_t light = gouraud ? warnock_face_light(face, window->left, window->top) : 0;
    uint8_t *row = (uint8_t *)t->tile.colour + warnock_pixel_at(t, window->left, window->top) * (ids ? 4u : 2u);
    while (bits) {
        uint32_t now = bits & row_bits, shade = light;
        uint16_t *colour = (uint16_t *)(void *)row;
        if (gouraud) {
            for (; now; now >>= 1, colour++, shade += face->light.dx) {
                if (now & 1) { *colour = ramp[shade >> 26]; }
            }
            light += face->light.dy;
        } else if (ids) {
            for (uint32_t *id = (uint32_t *)(void *)row; now; now >>= 1, id++) {
                if (now & 1) { *id = value; }
            }
        } else {
            for (; now; now >>= 1, colour++) {
                if (now & 1) { *colour = (uint16_t)value; }
            }
        }
        if (width == WINDOW_MASK_PX) { return; }
        bits >>= width;
        row += (size_t)stride * (ids ? 4u : 2u);
    }
}

void warnock_face_paint(tuile_t *t, const warnock_face_t *face, const window_t *window) {
    const window_t part = window_cut(&face->box, window);
    if (part.left >= part.right || part.top >= part.bottom) { return; }
    if (window_area(&part) <= WINDOW_MASK_PX) {
        warnock_face_bits(t, face, &part, warnock_face_mask(t, face, &part));
    } else {
        paint_rectangle(t, face->record, part.left, part.top, part.right, part.bottom);
    }
}
