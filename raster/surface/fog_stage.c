#include "../tune.h"

#include "fog_stage.h"

#include "../fill/gradient.h"

/* Depth in Q16.16; vertices have it in Q16.8. */
static uint32_t depth_of(const surface_corner_t *corner) { return corner->at.depth_light & 0xffffff00u; }

void fog_open(surface_t *surface, const surface_face_t *face) {
    const surface_corner_t *a = &face->corner[0], *b = &face->corner[1], *c = &face->corner[2];
    int32_t x1 = b->at.x - a->at.x, y1 = b->at.y - a->at.y, x2 = c->at.x - a->at.x, y2 = c->at.y - a->at.y;
    int32_t z0 = (int32_t)(depth_of(a) >> 8), c1 = (int32_t)(depth_of(b) >> 8) - z0, c2 = (int32_t)(depth_of(c) >> 8) - z0;
    int32_t area = x2 * y1 - x1 * y2;
    depth_plane_t *plane = &surface->depth;
    if (area < 0) {
        const int32_t x = x1, y = y1, v = c1;
        x1 = x2, y1 = y2, c1 = c2;
        x2 = x, y2 = y, c2 = v;
        area = -area;
    }
    const gradient_t g = gradient_exact(c1, c2, x1, y1, x2, y2, area, 12);
    const int32_t to_x = 8 - a->at.x, to_y = 8 - a->at.y;
    plane->dx = g.dx;
    plane->dy = g.dy;
    plane->z = (int64_t)((uint64_t)depth_of(a) + (uint64_t)gradient_part(g, to_x & 15, to_y & 15) +
                         (uint64_t)g.dx * (uint64_t)(int64_t)(to_x >> 4) + (uint64_t)g.dy * (uint64_t)(int64_t)(to_y >> 4));
    const uint32_t za = depth_of(a), zb = depth_of(b), zc = depth_of(c);
    plane->low = za < zb ? (za < zc ? za : zc) : (zb < zc ? zb : zc);
    plane->high = za > zb ? (za > zc ? za : zc) : (zb > zc ? zb : zc);
    if (!face->triangle) { /* the three are not all of its corners */
        plane->low = face->least << 8;
        plane->high = face->most << 8;
    }
    surface->fog = face->fog;
}

void fog_stage(const surface_t *surface, int32_t x, int32_t y, int32_t count, uint32_t *argb) {
    const depth_plane_t *plane = &surface->depth;
    const int64_t low = plane->low, high = plane->high;
    const uint32_t to = fog_goal(surface->fog, surface->blend);
    int64_t z =
        (int64_t)((uint64_t)plane->z + (uint64_t)plane->dx * (uint64_t)(int64_t)x + (uint64_t)plane->dy * (uint64_t)(int64_t)y);
    for (int32_t i = 0; i < count; i++) {
        argb[i] = fog_fade(surface->fog, (uint32_t)(z < low ? low : z > high ? high : z), argb[i], to);
        z = (int64_t)((uint64_t)z + (uint64_t)plane->dx);
    }
}
