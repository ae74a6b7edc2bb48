/* Separating planes between the boxes of instances.
 *
 * Two boxes in any pose are apart if and only if they are apart along one of 15 directions: the three axes of each and the nine
 * products of these. A plane across such a direction parts the objects, and what lies beyond it, seen from the observer, comes
 * first (proposition 3 of the document). Pairs without such a plane go in one group, and so do those whose order runs in a circle;
 * a group is drawn by another method. Nothing is guessed.
 *
 * Boxes that touch may come out overlapping by what the quantisation of their models rounded: they count as apart up to 2^-15 of
 * their size along the direction, less than two steps of their grids.
 */
#include "arrange.h"

#include "../geometry/wide.h"

typedef struct box {
    wide_t centre[3];  /* in world directions, from the observer or, with an orthographic camera, from the world's origin */
    wide_t half[3][3]; /* half edges */
} box_t;

enum { EITHER, FIRST_BEHIND, SECOND_BEHIND, UNKNOWN };

static void box_make(const tuile_scene_t *scene, unsigned number, box_t *box) {
    const tuile_instance_t *instance = &scene->instances[number];
    const tuile_model_t *model = instance->model;
    const tuile_pose_t *pose = &instance->pose;
    const wide_t half_step = wide_multiply(wide_multiply(wide_scale(model->step), wide_scale(pose->scale)), wide_make(1, -1));
    for (int i = 0; i < 3; i++) {
        const int64_t origin = scene->camera.projection == TUILE_PERSPECTIVE ? scene->camera.eye[i] : 0;
        box->centre[i] = wide_make((int64_t)pose->translation[i] - origin, -16);
        for (int j = 0; j < 3; j++) {
            const wide_t direction = wide_multiply(wide_make(pose->rotation[i][j], -30), half_step);
            const int64_t middle = 2 * (int64_t)model->offset[j] + model->low[j] + model->high[j];
            box->half[j][i] = wide_multiply(direction, wide_make(model->high[j] - model->low[j], 0));
            box->centre[i] = wide_add(box->centre[i], wide_multiply(direction, wide_make(middle, 0)));
        }
    }
}

static wide_t reach(const box_t *box, const wide_t axis[3]) {
    wide_t sum = {0, 0};
    for (int i = 0; i < 3; i++) {
        sum = wide_add(sum, wide_abs(wide_dot(box->half[i], axis)));
    }
    return sum;
}

static bool less(wide_t a, wide_t b) { return wide_sign(wide_add(b, wide_negate(a))) > 0; }

/* a lies below b along the axis, or above it, with a plane between them; else UNKNOWN. `to`: where an orthographic camera looks
 * from. */
static int relation_along(const box_t *a, const box_t *b, const wide_t axis[3], const wide_t *to) {
    wide_t ca = wide_dot(a->centre, axis), cb = wide_dot(b->centre, axis);
    const wide_t ra = reach(a, axis), rb = reach(b, axis), slack = wide_multiply(wide_add(ra, rb), wide_make(1, -15));
    const bool above = less(cb, ca);
    if (above) {
        ca = wide_negate(ca);
        cb = wide_negate(cb);
    }
    const wide_t a_top = wide_add(ca, ra), b_bottom = wide_add(cb, wide_negate(rb));
    if (wide_sign(wide_add(ra, rb)) == 0 || less(wide_add(b_bottom, slack), a_top)) { return UNKNOWN; }
    if (to) {
        const int side = above ? -wide_sign(wide_dot(to, axis)) : wide_sign(wide_dot(to, axis)); /* > 0: the observer is beyond b */
        return side > 0 ? FIRST_BEHIND : side < 0 ? SECOND_BEHIND : EITHER;
    }
    const wide_t middle = wide_add(a_top, b_bottom); /* of the gap, twice: the observer is at 0 */
    const int side = wide_sign(middle);
    return side < 0 ? FIRST_BEHIND : SECOND_BEHIND;
}

/* Two planes that ask for different orders show that the boxes hide nothing of one another: neither need come first. */
static int relation(const box_t *a, const box_t *b, const wide_t *to) {
    bool found[UNKNOWN + 1] = {false};
    for (int i = 0; i < 15 && !found[EITHER] && !(found[FIRST_BEHIND] && found[SECOND_BEHIND]); i++) {
        wide_t axis[3];
        if (i < 6) {
            found[relation_along(a, b, i < 3 ? a->half[i] : b->half[i - 3], to)] = true;
        } else {
            wide_cross(a->half[(i - 6) / 3], b->half[(i - 6) % 3], axis);
            found[relation_along(a, b, axis, to)] = true;
        }
    }
    if (found[EITHER] || (found[FIRST_BEHIND] && found[SECOND_BEHIND])) { return EITHER; }
    return found[FIRST_BEHIND] ? FIRST_BEHIND : found[SECOND_BEHIND] ? SECOND_BEHIND : UNKNOWN;
}

typedef struct arrangement {
    unsigned count;
    uint8_t *relations; /* count * count: is the row's instance behind the column's? */
    uint16_t *groups;   /* of each instance: the least number in its group */
    uint16_t *visited;  /* of each group: when a search came by it */
    uint16_t *order;
    unsigned placed;
} arrangement_t;

static void join(arrangement_t *a, unsigned g, unsigned h) {
    const unsigned least = g < h ? g : h, other = g < h ? h : g;
    for (unsigned i = 0; i < a->count; i++) {
        if (a->groups[i] == other) { a->groups[i] = (uint16_t)least; }
    }
}

static bool is_placed(const arrangement_t *a, unsigned group) { return a->visited[group] == UINT16_MAX; }

/* A group that must come before this one and has not; count when there is none. */
static unsigned group_behind(const arrangement_t *a, unsigned group) {
    for (unsigned i = 0; i < a->count; i++) {
        if (a->groups[i] == group || is_placed(a, a->groups[i])) { continue; }
        for (unsigned j = 0; j < a->count; j++) {
            if (a->groups[j] == group && a->relations[i * a->count + j]) { return a->groups[i]; }
        }
    }
    return a->count;
}

static int place(arrangement_t *a, unsigned group) {
    const unsigned before = a->placed;
    for (unsigned i = group; i < a->count; i++) {
        if (a->groups[i] == group) { a->order[a->placed++] = (uint16_t)i; }
    }
    a->order[before] |= ARRANGE_FIRST;
    a->visited[group] = UINT16_MAX;
    return a->placed - before > 1 ? (int)(a->placed - before) : 0;
}

/* Follows what must come before `group`: a group with nothing before it is placed, a circle is joined. */
static int place_next(arrangement_t *a, unsigned group) {
    unsigned step = 0;
    for (unsigned i = 0; i < a->count; i++) {
        if (!is_placed(a, i)) { a->visited[i] = 0; }
    }
    for (;;) {
        const unsigned behind = group_behind(a, group);
        if (behind == a->count) { return place(a, group); }
        a->visited[group] = (uint16_t)++step;
        if (a->visited[behind] != 0) { break; }
        group = behind;
    }
    const unsigned behind = group_behind(a, group), from = a->visited[behind];
    unsigned joined = behind;
    for (unsigned i = 0; i < a->count; i++) {
        if (!is_placed(a, i) && a->visited[i] > from && a->groups[i] == i) {
            join(a, joined, i);
            joined = joined < i ? joined : i;
        }
    }
    return 0;
}

int arrange_instances(tuile_t *t, uint8_t *scratch, size_t size_bytes) {
    const tuile_scene_t *scene = t->scene;
    const unsigned n = scene->instance_count;
    const size_t wanted = (size_t)n * n + 4 * (size_t)n + 2;
    arrangement_t a = {.count = n, .order = t->instance_order};
    int grouped = 0;
    if (n <= 1) {
        if (n == 1) { t->instance_order[0] = ARRANGE_FIRST; }
        return 0;
    }
    if (n >= ARRANGE_FIRST) { return TUILE_ERROR_ARGUMENT; }
    if (wanted > size_bytes) {
        t->wanted_bytes = (size_t)t->stats.size_bytes + wanted - size_bytes;
        return TUILE_ERROR_MEMORY;
    }
    a.groups = (uint16_t *)(void *)scratch;
    a.visited = a.groups + n;
    a.relations = (uint8_t *)(a.visited + n);
    wide_t to[3];
    for (int i = 0; i < 3; i++) {
        to[i] = wide_make(scene->camera.rotation[2][i], -30);
    }
    for (unsigned i = 0; i < n; i++) {
        a.groups[i] = (uint16_t)i;
        a.visited[i] = 0;
        a.relations[i * n + i] = 0;
    }
    for (unsigned i = 0; i < n; i++) {
        box_t first, second;
        box_make(scene, i, &first);
        for (unsigned j = i + 1; j < n; j++) {
            box_make(scene, j, &second);
            const int found = relation(&first, &second, scene->camera.projection == TUILE_ORTHOGRAPHIC ? to : NULL);
            a.relations[i * n + j] = found == FIRST_BEHIND;
            a.relations[j * n + i] = found == SECOND_BEHIND;
            if (found == UNKNOWN && a.groups[i] != a.groups[j]) { join(&a, a.groups[i], a.groups[j]); }
        }
    }
    while (a.placed < n) {
        unsigned group = 0;
        while (a.groups[group] != group || is_placed(&a, group)) {
            group++;
        }
        grouped += place_next(&a, group);
    }
    return grouped;
}
