/* The painter's algorithm (S12; Newell, Newell and Sancha): faces from back to front, each painted over those before it, without a
 * depth per pixel.
 *
 * Faces are sorted by their farthest depth. The first one, P, may be painted when it hides nothing of any face Q that is not
 * painted yet; only those Q matter whose depths overlap with P's and whose boxes meet its box, which priority.h looks at. A Q that
 * P hides something of is to be painted before P: Q becomes the next P, and P waits. The faces that wait are a path, each hiding
 * something of the next. When Q itself waits there, the faces between hide one another in a cycle; when P and Q hide something of
 * each other, they cross: then one of them is cut (piece.h), and its pieces take its place.
 *
 * It ends. Faces that cross are cut in two pieces that do not cross that face any more. In a cycle, a face is cut by the plane
 * of the one that it is to be painted after, if it has corners on both sides and was not cut there before, which is so once for
 * each two faces; else the largest of the cycle is cut between two rows or columns of pixels. Pieces of one pixel are compared at
 * that pixel alone, by depth and number: there is no cycle among them.
 *
 * Memory: 2 bytes for each face while it sorts, in the room between vertices and records, and where there is room 21 bytes more for
 * its bounds and the bands that they lie in, which only make it faster. A cut takes a record and 8 slots of 8 bytes or a little
 * more; they stay there while the pass is drawn. */
#include "../tune.h"

#include "paint.h"

#include "../memory.h"
#include "bands.h"
#include "painter.h"
#include "piece.h"
#include "priority.h"

#define PAINTED UINT16_MAX /* in the place of a record's number */
#define WAITING 1   /* `next` of a face that waits: WAITING + 1 + place of the face that waits for it; or WAITING: none does */
#define MOST 65000u /* records: their places and these marks fit in 16 bits */

typedef struct painter {
    tuile_t *t;
    uint16_t *places;      /* numbers of records, farthest first; they end where the records begin */
    uint32_t count;        /* places */
    uint32_t first;        /* place of the first face that is not painted */
    face_bounds_t *bounds; /* of records base ... base + bounded - 1; NULL: no room */
    uint32_t base, bounded;
    const uint8_t *bounds_end;
    bands_t bands;           /* of the places; words NULL: no room */
    uint16_t painted, *last; /* the faces that are painted, linked through `next` */
    /* The path of faces that wait. */
    uint32_t head;   /* place of P */
    uint32_t cursor; /* P hides nothing of the faces in the places before */
} painter_t;

static const face_bounds_t *bounds_of(const painter_t *p, uint32_t number, face_bounds_t *scratch) {
    if (TUILE_LIKELY(p->bounds != NULL && number - p->base < p->bounded)) { return &p->bounds[number - p->base]; }
    priority_bounds(p->t, frame_record(p->t, number), scratch);
    return scratch;
}

static uint8_t *slots_end(const tuile_t *t) { return (uint8_t *)(t->vertices + t->vertex_count); }

/* Bounds and bands give way to what is needed. */
static void bounds_yield(painter_t *p) {
    if (p->bounds != NULL && (slots_end(p->t) > (uint8_t *)p->bounds || (uint8_t *)p->places < p->bounds_end)) {
        p->bounds = NULL;
        p->bands.words = NULL;
    }
    if (p->count >= 32 * p->bands.count) { p->bands.words = NULL; }
}

/* ---- sorting ---- */

/* Two lists through `next`, farthest first; of equally far ones that comes first which loses the tie. */
static uint16_t merge(const painter_t *p, uint16_t a, uint16_t b) {
    uint16_t merged = RECORD_NONE, *end = &merged;
    face_bounds_t scratch;
    uint32_t far_a = a ? bounds_of(p, a - 1u, &scratch)->far : 0, far_b = b ? bounds_of(p, b - 1u, &scratch)->far : 0;
    while (a != RECORD_NONE && b != RECORD_NONE) {
        if (far_a < far_b || (far_a == far_b && priority_wins_tie(p->t, b, a))) {
            *end = a;
            end = &frame_record(p->t, a - 1u)->next;
            a = *end;
            far_a = a ? bounds_of(p, a - 1u, &scratch)->far : 0;
        } else {
            *end = b;
            end = &frame_record(p->t, b - 1u)->next;
            b = *end;
            far_b = b ? bounds_of(p, b - 1u, &scratch)->far : 0;
        }
    }
    *end = a != RECORD_NONE ? a : b;
    return merged;
}

/* Merge sort without recursion: lists[i] is empty or has 2^i records. */
static void sort(painter_t *p, uint32_t first, uint32_t end) {
    uint16_t lists[17] = {RECORD_NONE}, all = RECORD_NONE;
    for (uint32_t number = first; number < end; number++) {
        uint16_t list = (uint16_t)(number + 1);
        unsigned i = 0;
        frame_record(p->t, number)->next = RECORD_NONE;
        for (; lists[i] != RECORD_NONE; i++) {
            list = merge(p, lists[i], list);
            lists[i] = RECORD_NONE;
        }
        lists[i] = list;
    }
    for (unsigned i = 0; i < 17; i++) {
        all = merge(p, lists[i], all);
    }
    for (uint32_t place = 0; place < p->count; place++) {
        record_t *record = frame_record(p->t, all - 1u);
        p->places[place] = (uint16_t)(all - 1u);
        all = record->next;
        record->next = RECORD_NONE;
    }
}

/* ---- the path of those that wait ---- */

static record_t *record_at(const painter_t *p, uint32_t place) { return frame_record(p->t, p->places[place]); }

/* The place of the face that waits for the one in this place; its own when there is none. */
static uint32_t waits_for(const painter_t *p, uint32_t place) {
    const uint32_t next = record_at(p, place)->next;
    return next > WAITING ? next - WAITING - 1 : place;
}

static void begin_at(painter_t *p, uint32_t place) {
    record_at(p, place)->next = WAITING;
    p->head = place;
    p->cursor = p->first;
}

/* The face in this place is to be painted before P. */
static void wait_for(painter_t *p, uint32_t place) {
    record_at(p, place)->next = (uint16_t)(WAITING + 1 + p->head);
    p->head = place;
    p->cursor = p->first;
    p->t->stats.moved++;
}

/* P leaves the path; the one that waited for it goes on from `cursor`. False when there was none. */
static bool leave(painter_t *p, uint32_t cursor) {
    const uint32_t below = waits_for(p, p->head);
    const bool more = below != p->head;
    record_at(p, p->head)->next = RECORD_NONE;
    p->head = below;
    p->cursor = cursor;
    return more;
}

/* ---- cutting ---- */

/* One more record and place behind place `at`. */
static int insert(painter_t *p, uint32_t at) {
    tuile_t *t = p->t;
    const size_t down = t->record_bytes / sizeof(uint16_t) + 1;
    if ((size_t)((uint8_t *)p->places - slots_end(t)) < (down + 1) * sizeof(uint16_t) || t->record_count >= MOST) {
        return FRAME_FULL;
    }
    if (p->bands.words != NULL) { bands_insert(&p->bands, at, p->count); }
    memmove(p->places - down, p->places, (at + 1) * sizeof(uint16_t));
    memmove(p->places - down + at + 2, p->places + at + 1, (p->count - at - 1) * sizeof(uint16_t));
    p->places -= down;
    p->places[at + 1] = (uint16_t)t->record_count++;
    p->count++;
    bounds_yield(p);
    return FRAME_OK;
}

/* Places behind `at` have moved by one: so do the links of the path from `head` down. */
static void move_links(painter_t *p, uint32_t at) {
    p->head += p->head > at;
    for (uint32_t place = p->head;;) {
        record_t *record = record_at(p, place);
        if (record->next <= WAITING) { break; }
        const uint32_t below = record->next - WAITING - 1u;
        record->next = (uint16_t)(record->next + (below > at));
        place = record->next - WAITING - 1u;
    }
}

typedef struct split {
    uint32_t place; /* of the face to be cut */
    int axis;       /* -1: by the plane of `other` */
    int32_t at;
    uint32_t other; /* a place */
} split_t;

/* Cuts a face. If it waits, so do those no more that were to be painted before it. False in *going: nothing waits any more. */
static int split(painter_t *p, const split_t *how, bool *going) {
    tuile_t *t = p->t;
    const uint32_t number = p->places[how->place], other = p->places[how->other];
    const bool waiting = record_at(p, how->place)->next != RECORD_NONE;
    face_bounds_t scratch;
    const face_bounds_t bounds = *bounds_of(p, number, &scratch);
    priority_face_t face, by;
    *going = true;
    for (bool found = !waiting; !found;) {
        found = p->head == how->place;
        *going = leave(p, how->place);
    }
    if (!waiting) { p->cursor = how->place; }
    priority_open(&face, t, number);
    priority_open(&by, t, other);
    const int inserted = insert(p, how->place);
    if (inserted != FRAME_OK) { return inserted; }
    if (*going) { move_links(p, how->place); }
    const uint32_t added = t->record_count - 1;
    const uint8_t *end = (const uint8_t *)p->places;
    const int result = how->axis < 0 ? piece_cut(t, number, added, &bounds, &by.whole, face.number,
                                                 priority_wins_tie(t, face.number, by.number), end)
                                     : piece_cut_at(t, number, added, &bounds, how->axis, how->at, face.number, end);
    frame_record(t, added)->next = frame_record(t, number)->next = RECORD_NONE;
    bounds_yield(p);
    if (p->bounds != NULL && number - p->base < p->bounded && result == FRAME_OK) {
        priority_bounds(t, frame_record(t, number), &p->bounds[number - p->base]);
    }
    t->stats.splits++;
    return result;
}

static int32_t pixels_in(const face_bounds_t *b) { return (b->right - b->left) * (b->bottom - b->top); }

/* A line through the face in `place` that frees a part of it from the one in `other`, or halves it. */
static void choose_line(const painter_t *p, split_t *how) {
    face_bounds_t scratch, own = *bounds_of(p, p->places[how->place], &scratch);
    const face_bounds_t *other = bounds_of(p, p->places[how->other], &scratch);
    const int32_t columns[2] = {other->left, other->right}, rows[2] = {other->top, other->bottom};
    how->axis = own.right - own.left < own.bottom - own.top;
    how->at = how->axis ? (own.top + own.bottom) / 2 : (own.left + own.right) / 2;
    for (unsigned i = 0; i < 2; i++) {
        if (columns[i] > own.left && columns[i] < own.right) {
            how->axis = 0;
            how->at = columns[i];
        } else if (rows[i] > own.top && rows[i] < own.bottom) {
            how->axis = 1;
            how->at = rows[i];
        }
    }
}

/* P and the face in `place`, which waits, are ends of a cycle. */
static int cut_cycle(painter_t *p, uint32_t place, priority_face_t *head, priority_face_t *face, bool *going) {
    split_t how = {.axis = -1};
    if (priority_straddles(p->t, head, face)) {
        how.place = p->head;
        how.other = place;
        return split(p, &how, going);
    }
    if (priority_straddles(p->t, face, head)) {
        how.place = place;
        how.other = p->head;
        return split(p, &how, going);
    }
    int32_t most = 1;
    uint32_t before = place; /* what a face of the cycle is to be painted after */
    for (uint32_t at = p->head;; at = waits_for(p, at)) {
        face_bounds_t scratch;
        const int32_t pixels = pixels_in(bounds_of(p, p->places[at], &scratch));
        if (pixels > most) {
            most = pixels;
            how.place = at;
            how.other = before;
        }
        before = at;
        if (at == place) { break; }
    }
    if (most == 1) { return TUILE_ERROR_RANGE; } /* never: see above */
    choose_line(p, &how);
    return split(p, &how, going);
}

/* P and the face in `place` cross: the smaller one is cut, since each piece is drawn with the pixels of the whole. */
static int cut_crossed(painter_t *p, uint32_t place, bool *going) {
    face_bounds_t scratch;
    const int32_t own = pixels_in(bounds_of(p, p->places[p->head], &scratch)),
                  other = pixels_in(bounds_of(p, p->places[place], &scratch));
    const split_t how = {.axis = -1, .place = own <= other ? p->head : place, .other = own <= other ? place : p->head};
    return split(p, &how, going);
}

/* ---- the order ---- */

/* Is no face from this place on, where a word of the bands begins, farther than `nearest`? */
static bool all_nearer(const painter_t *p, uint32_t place, uint32_t nearest) {
    face_bounds_t scratch;
    while (place < p->count && p->places[place] == PAINTED) {
        place++;
    }
    return place >= p->count || bounds_of(p, p->places[place], &scratch)->far > nearest;
}

/* Moves the cursor on to the next place whose face may meet the box. bits: of those from the cursor on in its word, the ones that
 * may. False when there is none that is not nearer than `nearest`. */
TUILE_INLINE bool next_place(painter_t *p, uint32_t *bits, const face_bounds_t *box, uint32_t nearest) {
    if (TUILE_UNLIKELY(p->bands.words == NULL)) { return p->cursor < p->count; }
    while (*bits == 0) { /* the cursor is still in the word that they were of */
        p->cursor = (p->cursor | 31) + 1;
        if (all_nearer(p, p->cursor, nearest)) { return false; }
        *bits = bands_near(&p->bands, p->cursor / 32, box);
    }
    p->cursor = (p->cursor & ~31u) + 31 - fixed_clz32(*bits & (0 - *bits));
    return true;
}

/* Looks for a face that P hides something of, from the cursor on; leaves the cursor there. FREE: there is none. */
static priority_t find_hidden(painter_t *p, priority_face_t *head, priority_face_t *face) {
    const tuile_t *t = p->t;
    const uint32_t number = p->places[p->head];
    face_bounds_t scratch, own = *bounds_of(p, number, &scratch);
    const uint32_t nearest = own.near + PRIORITY_MARGIN;
    uint32_t bits = 0;
    bool open = false;
    if (own.left >= own.right || p->cursor >= p->count) { return PRIORITY_FREE; } /* a piece without pixels; the last face */
    if (p->bands.words != NULL) { bits = bands_near(&p->bands, p->cursor / 32, &own) & (UINT32_MAX << (p->cursor % 32)); }
    for (; next_place(p, &bits, &own, nearest); bits &= bits - 1, p->cursor += p->bands.words == NULL) {
        const uint32_t other = p->places[p->cursor];
        if (other == PAINTED || p->cursor == p->head) { continue; }
        const face_bounds_t *bounds = bounds_of(p, other, &scratch);
        if (bounds->far > nearest) { break; }
        if (!priority_boxes_meet(&own, bounds)) { continue; }
        if (!open) { priority_open(head, t, number); }
        open = true;
        priority_open(face, t, other);
        p->t->stats.compared++;
        const priority_t result = priority_compare(t, head, &own, face, bounds);
        if (result != PRIORITY_FREE) { return result; }
    }
    return PRIORITY_FREE;
}

static void paint(painter_t *p) {
    const uint32_t number = p->places[p->head], place = p->head;
    (void)leave(p, place + 1); /* the one that waited goes on behind it */
    *p->last = (uint16_t)(number + 1);
    p->last = &frame_record(p->t, number)->next;
    if (p->bands.words != NULL) {
        face_bounds_t scratch;
        bands_set(&p->bands, place, bounds_of(p, number, &scratch), false);
    }
    p->places[place] = PAINTED;
}

/* Paints the face in a place, and before it all that must be. */
static int paint_from(painter_t *p, uint32_t place) {
    priority_face_t head, face;
    bool going = true;
    begin_at(p, place);
    while (going) {
        const priority_t priority = find_hidden(p, &head, &face);
        int result = FRAME_OK;
        if (priority == PRIORITY_FREE) {
            going = waits_for(p, p->head) != p->head;
            paint(p);
        } else if (priority == PRIORITY_CROSSED) {
            result = cut_crossed(p, p->cursor, &going);
        } else if (record_at(p, p->cursor)->next != RECORD_NONE) {
            result = cut_cycle(p, p->cursor, &head, &face, &going);
        } else {
            wait_for(p, p->cursor);
        }
        if (result != FRAME_OK) { return result; }
    }
    return FRAME_OK;
}

/* Records `first` and on into the order in which they were painted: `next` becomes the number that each shall have, then they are
 * swapped along the cycles. Those behind `end` make room for the pieces. */
static void permute(const painter_t *p, uint32_t first, uint32_t end, uint32_t pieces) {
    tuile_t *t = p->t;
    uint32_t to = first;
    for (uint16_t list = p->painted; list != RECORD_NONE; to++) {
        record_t *record = frame_record(t, list - 1u);
        list = record->next;
        record->next = (uint16_t)to;
    }
    for (uint32_t i = end; i < t->record_count - pieces; i++) {
        frame_record(t, i)->next = (uint16_t)(i + pieces);
    }
    for (uint32_t i = first; i < t->record_count; i++) {
        record_t *here = frame_record(t, i);
        while (here->next != i) {
            record_id_t other;
            record_t *there = frame_record(t, here->next);
            memcpy(&other, there, t->record_bytes);
            memcpy(there, here, t->record_bytes);
            memcpy(here, &other, t->record_bytes);
        }
    }
}

size_t painter_room_bytes(uint32_t records) { return sizeof(uint16_t) * ((size_t)records + 1); }

/* Bounds and bands, where there is room: they leave a quarter of the rest to records and the other three to slots. */
static void bounds_keep(painter_t *p, uint8_t *room) {
    tuile_t *t = p->t;
    const uint32_t places = p->count + p->count / 4 + 32;
    const size_t free_bytes = (size_t)((uint8_t *)p->places - room);
    const size_t bounds_bytes = p->bounded * sizeof *p->bounds, wanted = bounds_bytes + bands_bytes(places);
    if (free_bytes < wanted + 8) { return; }
    p->bounds = (face_bounds_t *)(void *)(room + (free_bytes - wanted) / 4 * 3 / 8 * 8);
    p->bounds_end = (uint8_t *)p->bounds + wanted;
    face_bounds_t all = {INT16_MAX, INT16_MAX, INT16_MIN, INT16_MIN, 0, 0};
    for (uint32_t i = 0; i < p->bounded; i++) {
        face_bounds_t *box = &p->bounds[i];
        priority_bounds(t, frame_record(t, p->base + i), box);
        all.left = box->left < all.left ? box->left : all.left;
        all.top = box->top < all.top ? box->top : all.top;
        all.right = box->right > all.right ? box->right : all.right;
        all.bottom = box->bottom > all.bottom ? box->bottom : all.bottom;
    }
    bands_open(&p->bands, p->bounds + p->bounded, places, &all);
}

int painter_order(tuile_t *t, uint32_t first, uint32_t end) {
    size_t room_bytes;
    uint8_t *room = frame_room(t, &room_bytes);
    painter_t p = {.t = t, .count = end - first, .base = first, .bounded = end - first};
    const uint32_t before = t->record_count;
    if (p.count == 0) { return FRAME_OK; }
    if (room_bytes < painter_room_bytes(p.count) || before >= MOST) { return FRAME_FULL; }
    p.places = (uint16_t *)(void *)frame_record(t, before - 1) - p.count;
    p.last = &p.painted;
    bounds_keep(&p, room);
    sort(&p, first, end);
    for (uint32_t place = 0; place < p.count && p.bands.words != NULL; place++) {
        bands_set(&p.bands, place, &p.bounds[p.places[place] - first], true);
    }
    while (p.first < p.count) {
        if (p.places[p.first] == PAINTED) {
            p.first++;
            continue;
        }
        const int result = paint_from(&p, p.first);
        if (result != FRAME_OK) { return result; }
    }
    *p.last = RECORD_NONE;
    pass_measure(t, painter_room_bytes(p.count));
    permute(&p, first, end, t->record_count - before);
    return FRAME_OK;
}

/* ---- the method ---- */

static int painter_gather(tuile_t *t) {
    int result = bin_pass(t);
    if (result == FRAME_OK) { result = painter_order(t, 0, t->record_count); }
    if (result == FRAME_OK) { bin_again(t, t->pass_first); }
    return result;
}

static size_t painter_method_room(const tuile_config_t *config, uint32_t records) {
    (void)config;
    return painter_room_bytes(records);
}

const visibility_method_t visibility_painter = {
    .gather = painter_gather,
    .draw_tile = paint_draw_tile,
    .room_bytes = painter_method_room,
    .piece_mask = piece_mask,
};
