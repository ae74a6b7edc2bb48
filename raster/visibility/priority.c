#include "../tune.h"

#include "priority.h"

enum { BEFORE = 1, BEHIND = 2, CLOSE = 4 };

#define SLACK_MAX ((int64_t)1 << 24) /* no two depths are farther apart */
#define FEW_PIXELS 16

/* ---- bounds and planes ---- */

static void bounds_of_corners(const polygon_ring_t *ring, face_bounds_t *bounds) {
    int32_t left = INT32_MAX, right = INT32_MIN, top = INT32_MAX, bottom = INT32_MIN;
    uint32_t far = UINT32_MAX, near = 0;
    for (uint32_t i = 0; i < ring->count; i++) {
        const vertex_t *v = polygon_ring_vertex(ring, i);
        const uint32_t depth = v->depth_light >> 8;
        left = v->x < left ? v->x : left;
        right = v->x > right ? v->x : right;
        top = v->y < top ? v->y : top;
        bottom = v->y > bottom ? v->y : bottom;
        far = depth < far ? depth : far;
        near = depth > near ? depth : near;
    }
    *bounds = (face_bounds_t){
        (int16_t)edge_row(left), (int16_t)edge_row(top), (int16_t)edge_row(right), (int16_t)edge_row(bottom), far, near};
}

void priority_bounds(const tuile_t *t, const record_t *record, face_bounds_t *bounds) {
    if (frame_record_is_piece(record)) {
        *bounds = frame_record_piece(t, record)->bounds;
        return;
    }
    uint8_t list[3];
    const polygon_ring_t ring = piece_ring(t, record, list);
    bounds_of_corners(&ring, bounds);
    bounds->left = (int16_t)(bounds->left < t->region.left ? t->region.left : bounds->left);
    bounds->top = (int16_t)(bounds->top < t->region.top ? t->region.top : bounds->top);
    bounds->right = (int16_t)(bounds->right > t->region.right ? t->region.right : bounds->right);
    bounds->bottom = (int16_t)(bounds->bottom > t->region.bottom ? t->region.bottom : bounds->bottom);
}

static int64_t absolute(int64_t a) { return a < 0 ? -a : a; }

static int32_t depth_of(const vertex_t *v) { return (int32_t)(v->depth_light >> 8); }

static void plane_through(priority_face_t *face, const vertex_t *v0, const vertex_t *v1, const vertex_t *v2) {
    const int32_t x1 = v1->x - v0->x, y1 = v1->y - v0->y, x2 = v2->x - v0->x, y2 = v2->y - v0->y;
    const int32_t z1 = depth_of(v1) - depth_of(v0), z2 = depth_of(v2) - depth_of(v0);
    const int64_t area = (int64_t)x2 * y1 - (int64_t)x1 * y2, sign = area < 0 ? -1 : 1;
    face->x0 = v0->x;
    face->y0 = v0->y;
    face->z0 = depth_of(v0);
    face->area = sign * area;
    face->nx = sign * ((int64_t)z2 * y1 - (int64_t)z1 * y2); /* < 2^40 */
    face->ny = sign * ((int64_t)z1 * x2 - (int64_t)z2 * x1);
}

/* How far a corner is before the plane, times its area: < 2^58. */
TUILE_INLINE int64_t before_plane(const priority_face_t *plane, const vertex_t *v) {
    return (depth_of(v) - plane->z0) * plane->area - plane->nx * (v->x - plane->x0) - plane->ny * (v->y - plane->y0);
}

/* The plane that polygon_plane takes. */
static void polygon_open(priority_face_t *face, const polygon_ring_t *ring) {
    const vertex_t *v0 = polygon_ring_vertex(ring, 0), *best1 = v0, *best2 = v0;
    int64_t best = 0, off = 0;
    for (uint32_t i = 1; i + 1 < ring->count; i++) {
        const vertex_t *v1 = polygon_ring_vertex(ring, i), *v2 = polygon_ring_vertex(ring, i + 1);
        const int64_t area = absolute((int64_t)(v2->x - v0->x) * (v1->y - v0->y) - (int64_t)(v1->x - v0->x) * (v2->y - v0->y));
        if (area > best) {
            best = area;
            best1 = v1;
            best2 = v2;
        }
    }
    face->empty = best == 0;
    if (face->empty) { return; }
    plane_through(face, v0, best1, best2);
    for (uint32_t i = 0; i < ring->count; i++) {
        const int64_t distance = absolute(before_plane(face, polygon_ring_vertex(ring, i)));
        off = distance > off ? distance : off;
    }
    face->slack = off / face->area + 1;
}

void priority_open(priority_face_t *face, const tuile_t *t, uint32_t number) {
    const record_t *record = frame_record(t, number);
    face->record = record;
    face->number = (uint16_t)number;
    face->slack = face->area = 0;
    face->empty = false;
    face->is_piece = frame_record_is_piece(record);
    face->whole = frame_record_face(t, record);
    face->ring = piece_ring(t, &face->whole, face->list);
    if (face->is_piece) {
        const piece_slot_t *piece = frame_record_piece(t, record);
        face->number = piece->number;
        face->ring = (polygon_ring_t){(const vertex_t *)(piece + 1), NULL, NULL, piece->count};
        face->empty = piece->count == 0;
    }
}

/* Planes are made when they are first wanted. */
static void plane_open(priority_face_t *face, const tuile_t *t) {
    if (face->area != 0 || face->empty) { return; }
    if (TUILE_LIKELY(frame_record_is_triangle(face->record))) {
        const vertex_t *v0 = &t->vertices[face->record->v0];
        plane_through(face, v0, v0 + face->record->d1, v0 + face->record->d2);
        return;
    }
    uint8_t list[3];
    const polygon_ring_t ring = piece_ring(t, &face->whole, list);
    polygon_open(face, &ring); /* of a triangle, too, this is its plane */
    if (face->empty) { return; }
    /* Corners of a piece were rounded by half a unit, and pixels may be one beyond. */
    if (face->is_piece) { face->slack += 2 * ((absolute(face->nx) + absolute(face->ny)) / face->area + 1); }
    face->slack = face->slack > SLACK_MAX ? SLACK_MAX : face->slack;
}

/* On which sides of the plane the corners of the face lie, where all of its pixels are surely there, too. */
static unsigned sides_of_plane(const priority_face_t *face, const priority_face_t *plane) {
    const int64_t margin = plane->area * (PRIORITY_MARGIN + face->slack + plane->slack) +
                           (face->is_piece ? absolute(plane->nx) + absolute(plane->ny) : 0);
    unsigned sides = 0;
    for (uint32_t i = 0; i < face->ring.count; i++) {
        const int64_t distance = before_plane(plane, polygon_ring_vertex(&face->ring, i));
        sides |= distance > margin ? BEFORE : distance < -margin ? BEHIND : CLOSE;
    }
    return sides;
}

/* ---- do the projections overlap? ---- */

/* A side of face a with all of a on one side of it and all of b on the other one. Corners on the line do no harm: of two faces that
 * touch there a pixel's centre on the line belongs to one only. Of convex faces it tells all. */
static bool parted_by_side(const priority_face_t *a, const priority_face_t *b) {
    const bool convex = a->ring.count == 3 && !a->is_piece;
    const int32_t pieces = (int32_t)a->is_piece + (int32_t)b->is_piece;
    const vertex_t *from = polygon_ring_vertex(&a->ring, a->ring.count - 1);
    for (uint32_t i = 0; i < a->ring.count; i++) {
        const vertex_t *to = polygon_ring_vertex(&a->ring, i);
        const int32_t dx = to->x - from->x, dy = to->y - from->y, x = from->x, y = from->y;
        const int32_t slack = pieces * (int32_t)(absolute(dx) + absolute(dy));
        bool left = true, right = !convex; /* b may be left of the side and a right of it, as seen from above; or the other way */
        from = to;
        if (dx == 0 && dy == 0) { continue; }
        for (uint32_t k = 0; k < b->ring.count && (left || right); k++) {
            const vertex_t *v = polygon_ring_vertex(&b->ring, k);
            const int32_t s = (v->x - x) * dy - (v->y - y) * dx; /* < 2^31; above 0 inside a triangle */
            left &= s <= -slack;
            right &= s >= slack;
        }
        for (uint32_t k = 0; k < a->ring.count && !convex && (left || right); k++) {
            const vertex_t *v = polygon_ring_vertex(&a->ring, k);
            const int32_t s = (v->x - x) * dy - (v->y - y) * dx;
            left &= s >= 0;
            right &= s <= 0;
        }
        if (left || right) { return true; }
    }
    return false;
}

/* ---- pixels that both cover ---- */

typedef struct contest {
    const tuile_t *t;
    const priority_face_t *p, *q;
    duel_t duel;
    unsigned sides;
} contest_t;

/* Pixels from ... to - 1 of a row, which both whole faces cover. */
static void contest_span(contest_t *contest, int32_t y, int32_t from, int32_t to) {
    const duel_t *duel = &contest->duel;
    uint32_t p_mask[PIECE_MASK_WORDS], q_mask[PIECE_MASK_WORDS];
    const bool p_piece = contest->p->is_piece, q_piece = contest->q->is_piece;
    if (!p_piece && !q_piece) {
        const int64_t first = duel->z + duel->dx * from + duel->dy * y, last = first + duel->dx * (to - 1 - from);
        if ((first >= duel->band && last >= duel->band) || (first <= -duel->band && last <= -duel->band)) {
            contest->sides |= first > 0 ? BEFORE : BEHIND;
            return;
        }
    }
    if (p_piece) { piece_mask(contest->t, contest->p->record, y, from, to, p_mask); }
    if (q_piece) { piece_mask(contest->t, contest->q->record, y, from, to, q_mask); }
    for (int32_t i = 0; i < to - from && contest->sides != (BEFORE | BEHIND); i++) {
        if ((p_piece && !piece_mask_bit(p_mask, i)) || (q_piece && !piece_mask_bit(q_mask, i))) { continue; }
        contest->sides |= duel_front(duel, from + i, y) ? BEFORE : BEHIND;
    }
}

/* Spans of one ring on a row, one after the other, cut to the box. */
static bool span_next(const polygon_ring_t *ring, polygon_cursor_t *cursor, int32_t row, int32_t *from, int32_t *to) {
    if (!polygon_crossing(ring, row, cursor)) { return false; }
    *from = cursor->x;
    if (!polygon_crossing(ring, row, cursor)) { return false; }
    *to = cursor->x;
    return true;
}

/* A row of the box that can tell nothing new: p is surely on one side of q all along, and that side is known. */
static bool row_is_known(const contest_t *contest, int32_t y, const face_bounds_t *box) {
    const duel_t *duel = &contest->duel;
    const int64_t first = duel->z + duel->dx * box->left + duel->dy * y, last = first + duel->dx * (box->right - 1 - box->left);
    return (contest->sides == BEFORE && first >= duel->band && last >= duel->band) ||
           (contest->sides == BEHIND && first <= -duel->band && last <= -duel->band);
}

/* On which sides of q's pixels p's pixels are, among those in the box. */
static unsigned sides_of_pixels(const tuile_t *t, const priority_face_t *p, const priority_face_t *q, const face_bounds_t *box) {
    contest_t contest = {.t = t, .p = p, .q = q, .sides = 0};
    uint8_t p_list[3], q_list[3];
    const polygon_ring_t p_ring = piece_ring(t, &p->whole, p_list), q_ring = piece_ring(t, &q->whole, q_list);
    if (!duel_open(&contest.duel, t, &p->whole, &q->whole, priority_wins_tie(t, p->number, q->number))) { return 0; }
    for (int32_t y = box->top; y < box->bottom && contest.sides != (BEFORE | BEHIND); y++) {
        polygon_cursor_t p_cursor = {0, 0, false};
        int32_t p_from, p_to, q_from, q_to;
        if (row_is_known(&contest, y, box)) { continue; }
        while (span_next(&p_ring, &p_cursor, y, &p_from, &p_to)) {
            polygon_cursor_t q_cursor = {0, 0, false};
            p_from = p_from > box->left ? p_from : box->left;
            p_to = p_to < box->right ? p_to : box->right;
            while (p_from < p_to && span_next(&q_ring, &q_cursor, y, &q_from, &q_to)) {
                const int32_t from = p_from > q_from ? p_from : q_from, to = p_to < q_to ? p_to : q_to;
                if (from < to) { contest_span(&contest, y, from, to); }
            }
        }
    }
    return contest.sides;
}

/* ---- the tests in their order ---- */

static bool same_face(const record_t *face, const cut_slot_t *cut) {
    return face->v0 == cut->v0 && face->d1 == cut->d1 && face->d2 == cut->d2;
}

/* The side of `other` where the cuts of a piece have put it; 0: none has. */
static unsigned side_by_cut(const tuile_t *t, const priority_face_t *face, const priority_face_t *other) {
    if (!face->is_piece) { return 0; }
    const bool wins_tie = priority_wins_tie(t, face->number, other->number);
    for (uint16_t at = frame_record_piece(t, face->record)->cuts; at;) {
        const cut_slot_t *cut = (const cut_slot_t *)(const void *)&t->vertices[at];
        if (same_face(&other->whole, cut) && cut->wins_tie == wins_tie) { return cut->front ? BEFORE : BEHIND; }
        at = cut->next;
    }
    return 0;
}

static priority_t priority_of(unsigned sides) {
    return sides == (BEFORE | BEHIND) ? PRIORITY_CROSSED : sides == BEFORE ? PRIORITY_AFTER : PRIORITY_FREE;
}

priority_t priority_compare(const tuile_t *t, priority_face_t *p, const face_bounds_t *p_bounds, priority_face_t *q,
                            const face_bounds_t *q_bounds) {
    if (p->empty || q->empty || p->number == q->number) { return PRIORITY_FREE; } /* pieces of one face share no pixel */
    const unsigned by_p = side_by_cut(t, p, q), by_q = side_by_cut(t, q, p);
    if (by_p == BEHIND || by_q == BEFORE) { return PRIORITY_FREE; }
    /* Of the faces whose boxes meet most are neighbours in a mesh, which no plane parts but a side does: so that comes first. */
    if (parted_by_side(p, q) || parted_by_side(q, p)) { return PRIORITY_FREE; }
    bool surely_before = by_p || by_q || p_bounds->far > q_bounds->near + PRIORITY_MARGIN;
    if (!surely_before) {
        plane_open(p, t);
        plane_open(q, t);
        if (p->empty || q->empty) { return PRIORITY_FREE; }
        const unsigned p_sides = sides_of_plane(p, q);
        if (p_sides == BEHIND) { return PRIORITY_FREE; }
        const unsigned q_sides = sides_of_plane(q, p);
        if (q_sides == BEFORE) { return PRIORITY_FREE; }
        surely_before = p_sides == BEFORE || q_sides == BEHIND;
    }
    const face_bounds_t box = {p_bounds->left > q_bounds->left ? p_bounds->left : q_bounds->left,
                               p_bounds->top > q_bounds->top ? p_bounds->top : q_bounds->top,
                               p_bounds->right < q_bounds->right ? p_bounds->right : q_bounds->right,
                               p_bounds->bottom < q_bounds->bottom ? p_bounds->bottom : q_bounds->bottom,
                               0,
                               0};
    /* In a few pixels nothing but these counts: orders within a pixel are then those of one row of numbers and have no cycle. */
    if (surely_before && (box.right - box.left) * (box.bottom - box.top) > FEW_PIXELS) { return PRIORITY_AFTER; }
    return priority_of(sides_of_pixels(t, p, q, &box));
}

bool priority_straddles(const tuile_t *t, priority_face_t *face, priority_face_t *plane) {
    const unsigned both = BEFORE | BEHIND;
    plane_open(face, t);
    plane_open(plane, t);
    return !face->empty && !plane->empty && !side_by_cut(t, face, plane) && (sides_of_plane(face, plane) & both) == both;
}
