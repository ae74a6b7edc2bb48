/* Warnock's subdivision (S15): a window that no face meets keeps the background; one that a face fills and hides all others in
 * takes that face; any other is divided, down to single pixels, where the nearest face at the centre is seen. There is no depth
 * buffer.
 *
 * Faces of a window. One array holds the numbers of the tile's faces; two numbers tell those of a window,
 *     order:  | surrounding ... filling | intersecting ... end | of no concern to it: disjoint, or hidden all over it |
 * and for a part of the window the middle is rearranged, and nothing else:
 *     before: | surrounding              | intersecting                                                      |
 *     after:  | surrounding              | surrounding now | intersecting still | disjoint or hidden now     |
 * So whatever happens to the parts of a window, its two numbers enclose the same faces, in whatever order, and nothing has to be
 * undone on the way up. (A surrounding face that another one hides stays where it is: to move it would mix what an outer window
 * keeps apart.)
 *
 * Windows that wait lie on a stack, each with the two numbers of the window that it is a part of. Of the parts the smallest is
 * looked at first and the largest last. Then with w windows waiting below one of area A,  w + 1.5 log2 A  never grows: of four
 * parts the smallest has an area of at most A / 4 and three wait below it (3 = 1.5 log2 4), the next A / 3 and two (2 < 1.5 log2
 * 3), then A / 2 and one, then none; of two parts A / 2 and one. Hence at most 1.5 log2 (1920 * 1920) + 1 = 33 windows, wherever
 * they are cut.
 *
 * Memory: the free room holds sizeof(warnock_face_t) + 2 = 90 bytes for each face whose box meets the tile; the stack is 34 * 14
 * bytes of the processor's. Nothing else, whatever the size of a tile.
 */
#include "../tune.h"

#include "rows.h"
#include "warnock_face.h"

#define STACK_WINDOWS 34

_Static_assert(TUILE_SAMPLES_MAX <= 1920, "STACK_WINDOWS");

typedef struct waiting {
    window_t window;
    uint16_t filling, end; /* of the window that it is a part of */
    uint16_t depth;        /* divisions that led here */
} waiting_t;

typedef struct subdivision {
    tuile_t *t;
    warnock_face_t *faces; /* in the order of their records */
    uint16_t *order;
    uint32_t count;
    unsigned variant; /* tuile_warnock_t */
    unsigned waiting;
    waiting_t stack[STACK_WINDOWS];
} subdivision_t;

TUILE_INLINE void decided(const subdivision_t *s, const window_t *w, tuile_why_t why) {
    const tuile_trace_t *trace = s->t->config.trace;
    if (TUILE_UNLIKELY(trace != NULL) && trace->window) {
        trace->window(trace->context, (unsigned)w->left, (unsigned)w->top, (unsigned)w->right, (unsigned)w->bottom, why);
    }
}

TUILE_INLINE void swap(uint16_t *a, uint16_t *b) {
    const uint16_t held = *a;
    *a = *b;
    *b = held;
}

/* ---- pixels ---- */

/* A face at a pixel: depth above, its number below, turned so that the one that wins a tie is greater. 0: none. */
TUILE_INLINE uint32_t nearness(const subdivision_t *s, uint32_t number, int32_t x, int32_t y, uint32_t turn) {
    return (uint32_t)warnock_face_depth(s->t, &s->faces[number], x, y) << 16 | (number ^ turn);
}

TUILE_INLINE uint32_t tie_turn(const subdivision_t *s) { return s->t->config.tie == TUILE_TIE_LAST ? 0 : 0xffffu; }

/* The pixels of a window, each of which is a window of its own. */
static void pixels_decided(const subdivision_t *s, const window_t *w) {
    s->t->stats.windows_pixels += (uint32_t)window_area(w);
    if (TUILE_LIKELY(s->t->config.trace == NULL)) { return; }
    for (int16_t y = w->top; y < w->bottom; y++) {
        for (int16_t x = w->left; x < w->right; x++) {
            decided(s, &(window_t){x, y, (int16_t)(x + 1), (int16_t)(y + 1)}, TUILE_WHY_PIXEL);
        }
    }
}

/* A window of one pixel: the nearest of the faces that cover it. */
static void decide_pixel(const subdivision_t *s, const waiting_t *p) {
    const int32_t x = p->window.left, y = p->window.top;
    const uint32_t turn = tie_turn(s);
    uint32_t nearest = 0;
    for (uint32_t k = 0; k < p->end; k++) {
        const uint32_t number = s->order[k];
        if (k >= p->filling && warnock_face_relation(s->t, &s->faces[number], &p->window, false) != WINDOW_SURROUNDING) {
            continue;
        }
        const uint32_t key = nearness(s, number, x, y, turn);
        nearest = key > nearest ? key : nearest;
    }
    if (nearest) { warnock_face_pixel(s->t, &s->faces[(nearest ^ turn) & 0xffffu], x, y); }
    pixels_decided(s, &p->window);
}

/* ---- windows ---- */

/* Does face a, by its number, win over b at equal depth? */
TUILE_INLINE bool wins_tie(const subdivision_t *s, uint32_t a, uint32_t b) {
    return s->t->config.tie == TUILE_TIE_LAST ? a > b : a < b;
}

TUILE_INLINE bool hides(const subdivision_t *s, uint32_t a, uint32_t b, const window_t *w) {
    return warnock_face_hides(&s->faces[a], &s->faces[b], w, wins_tie(s, a, b));
}

/* The surrounding face whose least depth over the corner pixels is greatest. */
typedef struct front {
    uint32_t face; /* s->count: none */
    uint32_t least;
    bool alone; /* it hides all others that surround the window, or there is none */
} front_t;

TUILE_INLINE void front_take(const subdivision_t *s, front_t *front, uint32_t number, const window_t *w) {
    const uint32_t least = warnock_face_least(&s->faces[number], w);
    if (front->face == s->count || least > front->least || (least == front->least && wins_tie(s, number, front->face))) {
        *front = (front_t){number, least, true};
    }
}

/* Makes the lists of a part from those of the window that it is a part of. */
static front_t sort_out(const subdivision_t *s, waiting_t *p) {
    const window_t w = p->window;
    const bool brief = s->variant & TUILE_WARNOCK_PIXELS;
    uint16_t *order = s->order;
    uint32_t filling = p->filling, end = filling;
    front_t front = {s->count, 0, true};
    for (uint32_t k = 0; k < filling; k++) {
        front_take(s, &front, order[k], &w);
    }
    for (uint32_t k = p->filling; k < p->end; k++) {
        const uint32_t number = order[k];
        const warnock_face_t *face = &s->faces[number];
        /* A whole step behind the front: no need to know where it lies. */
        if (face->high < (front.least & 0xffff0000u)) { continue; }
        const window_relation_t relation = warnock_face_relation(s->t, face, &w, brief);
        if (relation == WINDOW_DISJOINT) { continue; }
        swap(&order[end], &order[k]);
        if (relation == WINDOW_SURROUNDING) {
            swap(&order[filling++], &order[end]);
            front_take(s, &front, number, &w);
        }
        end++;
    }
    if (front.face != s->count && end > 1) { /* what the front hides */
        for (uint32_t k = 0; k < p->filling; k++) {
            front.alone &= order[k] == front.face || hides(s, front.face, order[k], &w);
        }
        for (uint32_t k = p->filling; k < filling; k++) {
            if (order[k] == front.face) { continue; }
            if (hides(s, front.face, order[k], &w)) {
                swap(&order[--filling], &order[k--]); /* to those that the next loop drops */
            } else {
                front.alone = false;
            }
        }
        for (uint32_t k = filling; k < end; k++) {
            if (hides(s, front.face, order[k], &w)) { swap(&order[--end], &order[k--]); }
        }
    }
    p->filling = (uint16_t)filling;
    p->end = (uint16_t)end;
    return front;
}

/* Colours the window if it can be done at once. */
static bool settle(const subdivision_t *s, const waiting_t *p, front_t front) {
    const unsigned intersecting = (unsigned)(p->end - p->filling);
    if (!front.alone || intersecting > 1) { return false; }
    if (intersecting == 1) {
        const uint32_t number = s->order[p->filling];
        if (!(s->variant & TUILE_WARNOCK_SINGLE) || (p->filling > 0 && !hides(s, number, front.face, &p->window))) { return false; }
        if (p->filling > 0) { warnock_face_fill(s->t, &s->faces[front.face], &p->window); }
        warnock_face_paint(s->t, &s->faces[number], &p->window);
        decided(s, &p->window, TUILE_WHY_SINGLE);
    } else if (p->filling > 0) {
        warnock_face_fill(s->t, &s->faces[front.face], &p->window);
        decided(s, &p->window, TUILE_WHY_SURROUNDED);
    } else {
        decided(s, &p->window, TUILE_WHY_EMPTY);
    }
    return true;
}

#define MASK_FACES 32

/* A window of up to 32 pixels that up to 32 faces meet: each face tells its pixels as the bits of a word. A pixel that one face
 * covers is that face's; only for those that several cover are depths compared. */
static void decide_pixels(const subdivision_t *s, const waiting_t *p, front_t front) {
    const window_t *w = &p->window;
    const uint32_t turn = tie_turn(s);
    uint32_t masks[MASK_FACES], covered = 0, again = 0, count = 0;
    uint16_t numbers[MASK_FACES];
    for (uint32_t k = 0; k < p->end; k++) {
        const uint32_t number = s->order[k];
        uint32_t mask;
        if (k >= p->filling) {
            mask = warnock_face_mask(s->t, &s->faces[number], w);
        } else if (number == front.face || !front.alone) {
            mask = window_mask_full(w);
        } else {
            continue; /* the front hides it */
        }
        again |= covered & mask;
        covered |= mask;
        numbers[count] = (uint16_t)number;
        masks[count++] = mask;
    }
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t alone = masks[k] & ~again;
        if (alone) { warnock_face_bits(s->t, &s->faces[numbers[k]], w, alone); }
    }
    const int32_t width = w->right - w->left;
    int32_t x = w->left, y = w->top;
    for (uint32_t bits = again; bits; bits >>= 1) {
        if (bits & 1) {
            const uint32_t bit = 1u << ((y - w->top) * width + x - w->left);
            uint32_t nearest = 0;
            for (uint32_t k = 0; k < count; k++) {
                if (!(masks[k] & bit)) { continue; }
                const uint32_t key = nearness(s, numbers[k], x, y, turn);
                nearest = key > nearest ? key : nearest;
            }
            warnock_face_pixel(s->t, &s->faces[(nearest ^ turn) & 0xffffu], x, y);
        }
        if (++x == w->right) { x = w->left, y++; }
    }
    s->t->stats.windows += (uint32_t)window_area(w);
    pixels_decided(s, w);
}

/* ---- division ---- */

/* The cut nearer the middle. */
TUILE_INLINE void cut_offer(int32_t *cut, int32_t at, int32_t low, int32_t high, int32_t *distance) {
    const int32_t away = 2 * at > low + high ? 2 * at - low - high : low + high - 2 * at;
    if (at > low && at < high && away < *distance) {
        *cut = at;
        *distance = away;
    }
}

#define BOX_FACES 4 /* measured: with fewer the room costs more, with more the mesh does */

/* Where a window is cut: a column and a row where its right and lower parts begin, or its right and lower end where it is not. A
 * side that is twice the other is halved alone, so that parts become squares. */
static void cut_window(const subdivision_t *s, const waiting_t *p, int32_t *column, int32_t *row) {
    const window_t *w = &p->window;
    const int32_t width = w->right - w->left, height = w->bottom - w->top;
    const bool halve = s->variant & TUILE_WARNOCK_PIXELS && width * height <= 2 * WINDOW_MASK_PX;
    *column = height >= 2 * width || (halve && height > width) ? w->right : w->left + width / 2;
    *row = width >= 2 * height || (halve && width >= height) ? w->bottom : w->top + height / 2;
    if (s->variant & TUILE_WARNOCK_BOX && p->end - p->filling <= BOX_FACES) {
        int32_t across = INT32_MAX, down = INT32_MAX;
        for (uint32_t k = p->filling; k < p->end; k++) {
            const window_t *box = &s->faces[s->order[k]].box;
            cut_offer(column, box->left, w->left, w->right, &across);
            cut_offer(column, box->right, w->left, w->right, &across);
            cut_offer(row, box->top, w->top, w->bottom, &down);
            cut_offer(row, box->bottom, w->top, w->bottom, &down);
        }
    }
}

static void wait(subdivision_t *s, const waiting_t *p, int32_t left, int32_t top, int32_t right, int32_t bottom) {
    if (left >= right || top >= bottom) { return; }
    waiting_t *part = &s->stack[s->waiting++];
    *part = *p;
    part->window = (window_t){(int16_t)left, (int16_t)top, (int16_t)right, (int16_t)bottom};
    part->depth++;
}

/* The parts onto the stack, the largest first. */
static void divide(subdivision_t *s, const waiting_t *p) {
    const window_t *w = &p->window;
    int32_t column, row;
    cut_window(s, p, &column, &row);
    /* Less and more: the narrower columns and the lower rows, and the others. */
    const bool left_less = column - w->left <= w->right - column, top_less = row - w->top <= w->bottom - row;
    const int32_t x0 = left_less ? w->left : column, x1 = left_less ? column : w->right;
    const int32_t x2 = left_less ? column : w->left, x3 = left_less ? w->right : column;
    const int32_t y0 = top_less ? w->top : row, y1 = top_less ? row : w->bottom;
    const int32_t y2 = top_less ? row : w->top, y3 = top_less ? w->bottom : row;
    wait(s, p, x2, y2, x3, y3);
    if ((x1 - x0) * (y3 - y2) >= (x3 - x2) * (y1 - y0)) {
        wait(s, p, x0, y2, x1, y3);
        wait(s, p, x2, y0, x3, y1);
    } else {
        wait(s, p, x2, y0, x3, y1);
        wait(s, p, x0, y2, x1, y3);
    }
    wait(s, p, x0, y0, x1, y1);
}

static void subdivide(subdivision_t *s, const window_t *tile) {
    tuile_stats_t *stats = &s->t->stats;
    s->stack[0] = (waiting_t){*tile, 0, (uint16_t)s->count, 0};
    s->waiting = 1;
    while (s->waiting > 0) {
        waiting_t p = s->stack[--s->waiting];
        const window_t *w = &p.window;
        const int32_t width = w->right - w->left, height = w->bottom - w->top;
        stats->windows++;
        if (p.depth > stats->windows_depth) { stats->windows_depth = p.depth; }
        if (width == 1 && height == 1) {
            decide_pixel(s, &p);
            continue;
        }
        const front_t front = sort_out(s, &p);
        if (settle(s, &p, front)) { continue; }
        if (s->variant & TUILE_WARNOCK_PIXELS && width * height <= WINDOW_MASK_PX && p.end <= MASK_FACES) {
            decide_pixels(s, &p, front);
            continue;
        }
        divide(s, &p);
        if (s->waiting > stats->windows_waiting) { stats->windows_waiting = s->waiting; }
    }
}

/* ---- the tile ---- */

/* The faces of tile row `row` into t->uncarried: those that come from above, and those that start there. */
static void row_enter(tuile_t *t, uint16_t row) {
    while (!t->row_ready || t->row < row) {
        if (t->row_ready) {
            row_advance(t, row_bottom(t, t->row), true);
            t->row++;
        }
        t->uncarried = list_merge(t, list_reverse(t, t->buckets[t->row]), t->uncarried);
        t->buckets[t->row] = RECORD_NONE;
        t->row_ready = true;
    }
}

/* By the nearest vertex, nearest first; of equals the one that wins first (Shell's sort). */
static void sort_by_nearest(const subdivision_t *s) {
    uint32_t gap = 1;
    while (gap < s->count / 3) {
        gap = 3 * gap + 1;
    }
    for (; gap > 0; gap /= 3) {
        for (uint32_t i = gap; i < s->count; i++) {
            const uint16_t number = s->order[i];
            const uint32_t high = s->faces[number].high;
            uint32_t at = i;
            for (; at >= gap && s->faces[s->order[at - gap]].high < high; at -= gap) {
                s->order[at] = s->order[at - gap];
            }
            s->order[at] = number;
        }
    }
}

static size_t faces_bytes(uint32_t count) { return TUILE_ALIGN8((sizeof(warnock_face_t) + sizeof(uint16_t)) * (size_t)count); }

static int warnock_draw_tile(tuile_t *t, uint16_t row) {
    const window_t tile = {(int16_t)t->tile.left, (int16_t)t->tile.top, (int16_t)t->tile.right, (int16_t)t->tile.bottom};
    size_t room;
    subdivision_t s;
    row_enter(t, row);
    s.t = t;
    s.faces = (warnock_face_t *)(void *)frame_room(t, &room);
    s.count = 0;
    s.variant = t->config.warnock;
    for (uint16_t list = t->uncarried; list != RECORD_NONE;) {
        const uint32_t number = list - 1u;
        const record_t *record = frame_record(t, number);
        window_t box;
        list = record->next;
        if (!warnock_face_box(t, record, &tile, &box)) { continue; }
        if (faces_bytes(s.count + 1) > room) { return FRAME_FULL; }
        if (warnock_face_start(t, &s.faces[s.count], number, &box)) {
            s.count++;
        } else {
            pass_measure(t, faces_bytes(s.count + 1));
        }
    }
    pass_measure(t, faces_bytes(s.count));
    s.order = (uint16_t *)(void *)(s.faces + s.count);
    for (uint32_t i = 0; i < s.count; i++) {
        s.order[i] = (uint16_t)i;
    }
    if (s.variant & TUILE_WARNOCK_SORTED) { sort_by_nearest(&s); }
    subdivide(&s, &tile);
    return FRAME_OK;
}

static size_t warnock_room_bytes(const tuile_config_t *config, uint32_t records) {
    (void)config;
    return faces_bytes(records);
}

const visibility_method_t visibility_warnock = {
    .gather = bin_pass,
    .draw_tile = warnock_draw_tile,
    .room_bytes = warnock_room_bytes,
};
