/* The faces of a solid as pieces, and what they have in common: planes, points, edges. */
#include "tree_space.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- tables ------------------------------------------------------------------------------------------------- */

typedef bool space_equal_t(const space_t *space, uint32_t item, const void *key);

static bool table_grow(space_table_t *table) {
    space_table_t grown = {.capacity = table->capacity ? 2 * table->capacity : 256, .count = table->count};
    grown.slots = mesh_array(grown.capacity, sizeof *grown.slots);
    if (!grown.slots) { return false; }
    for (size_t i = 0; i < grown.capacity; i++) {
        grown.slots[i].item = SPACE_NONE;
    }
    for (size_t i = 0; i < table->capacity; i++) {
        if (table->slots[i].item == SPACE_NONE) { continue; }
        size_t at = table->slots[i].hash & (grown.capacity - 1);
        while (grown.slots[at].item != SPACE_NONE) {
            at = (at + 1) & (grown.capacity - 1);
        }
        grown.slots[at] = table->slots[i];
    }
    free(table->slots);
    *table = grown;
    return true;
}

/* The item equal to key, or `fresh`, which is then entered. SPACE_NONE without memory. */
static uint32_t table_find(space_t *space, space_table_t *table, uint64_t hash, space_equal_t *equal, const void *key,
                           uint32_t fresh) {
    if (2 * table->count >= table->capacity && !table_grow(table)) { return SPACE_NONE; }
    const uint32_t folded = (uint32_t)(hash ^ hash >> 32);
    size_t at = folded & (table->capacity - 1);
    for (; table->slots[at].item != SPACE_NONE; at = (at + 1) & (table->capacity - 1)) {
        if (table->slots[at].hash == folded && equal(space, table->slots[at].item, key)) { return table->slots[at].item; }
    }
    table->slots[at].item = fresh;
    table->slots[at].hash = folded;
    table->count++;
    return fresh;
}

static uint64_t mix(uint64_t hash, uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 31;
}

/* ---- planes, points, edges ---------------------------------------------------------------------------------- */

static bool plane_equal(const space_t *space, uint32_t item, const void *key) {
    const exact_plane_t *a = &space->planes[item], *b = key;
    return a->n[0] == b->n[0] && a->n[1] == b->n[1] && a->n[2] == b->n[2] && a->d == b->d;
}

static uint32_t enter_plane(space_t *space, const exact_plane_t *plane) {
    if (space->plane_count >= SPACE_NONE - 1 ||
        !mesh_reserve(&space->planes, &space->plane_capacity, space->plane_count + 1, sizeof *space->planes) ||
        !mesh_reserve(&space->slacks, &space->slack_capacity, space->plane_count + 1, sizeof *space->slacks)) {
        return SPACE_NONE;
    }
    space->planes[space->plane_count] = *plane;
    space->slacks[space->plane_count] = (space_slack_t){.tilt = DBL_MAX};
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        hash = mix(hash, (uint64_t)plane->n[k]);
    }
    hash = mix(hash, (uint64_t)plane->d);
    uint32_t found = table_find(space, &space->plane_table, hash, plane_equal, plane, (uint32_t)space->plane_count);
    space->plane_count += found == space->plane_count;
    return found;
}

static bool point_equal(const space_t *space, uint32_t item, const void *key) { return exact_same(&space->points[item], key); }

static uint32_t enter_point(space_t *space, const exact_point_t *point) {
    if (space->point_count >= SPACE_NONE - 1 ||
        !mesh_reserve(&space->points, &space->point_capacity, space->point_count + 1, sizeof *space->points)) {
        return SPACE_NONE;
    }
    space->points[space->point_count] = *point;
    uint32_t found = table_find(space, &space->point_table, exact_hash(point), point_equal, point, (uint32_t)space->point_count);
    space->point_count += found == space->point_count;
    return found;
}

static uint32_t new_line(space_t *space, bool edge, uint32_t a, uint32_t b) {
    if (space->line_count >= SPACE_NONE - 1 ||
        !mesh_reserve(&space->lines, &space->line_capacity, space->line_count + 1, sizeof *space->lines)) {
        return SPACE_NONE;
    }
    space->lines[space->line_count] = (space_line_t){.edge = edge, .of = {a, b}, .marks = SPACE_NONE};
    return (uint32_t)space->line_count++;
}

static bool edge_equal(const space_t *space, uint32_t item, const void *key) {
    return memcmp(space->lines[item].of, key, sizeof space->lines[item].of) == 0;
}

static uint32_t enter_edge(space_t *space, uint32_t a, uint32_t b) {
    const uint32_t ends[2] = {a < b ? a : b, a < b ? b : a};
    uint32_t line = new_line(space, true, ends[0], ends[1]);
    if (line == SPACE_NONE) { return SPACE_NONE; }
    uint32_t found = table_find(space, &space->edge_table, mix(mix(0, ends[0]), ends[1]), edge_equal, ends, line);
    space->line_count -= found != line;
    return found;
}

/* A point may be noted twice; sorting drops what is too much. */
static bool mark(space_t *space, uint32_t line, uint32_t point) {
    if (space->mark_count >= SPACE_NONE - 1 ||
        !mesh_reserve(&space->marks, &space->mark_capacity, space->mark_count + 1, sizeof *space->marks)) {
        return false;
    }
    space->marks[space->mark_count] = (space_mark_t){point, space->lines[line].marks};
    space->lines[line].marks = (uint32_t)space->mark_count++;
    return true;
}

/* ---- faces to pieces ---------------------------------------------------------------------------------------- */

static const int16_t *place(const space_t *space, uint32_t point) { return space->solid->vertices[space->places[point]].position; }

static uint32_t new_piece(space_t *space, const space_corner_t *corners, size_t count, uint32_t face) {
    if (space->piece_count >= SPACE_NONE - 1 || space->corner_count + count >= SPACE_NONE ||
        !mesh_reserve(&space->pieces, &space->piece_capacity, space->piece_count + 1, sizeof *space->pieces) ||
        !mesh_reserve(&space->corners, &space->corner_capacity, space->corner_count + count, sizeof *space->corners)) {
        return SPACE_NONE;
    }
    memcpy(space->corners + space->corner_count, corners, count * sizeof *corners);
    space->pieces[space->piece_count] = (space_piece_t){(uint32_t)space->corner_count, (uint32_t)count, face};
    space->corner_count += count;
    return (uint32_t)space->piece_count++;
}

static void note_slack(space_t *space, uint32_t plane, const uint32_t *corners, size_t count, const int64_t normal[3]) {
    const solid_vertex_t *vertices = space->solid->vertices;
    space_slack_t slack = {.tilt = 0};
    for (size_t i = 0; i < count; i++) {
        const int16_t *p = vertices[corners[i]].position, *q = vertices[corners[(i + 1) % count]].position;
        slack.tilt += hypot(hypot(q[0] - p[0], q[1] - p[1]), q[2] - p[2]);
        for (int k = 0; k < 3; k++) {
            slack.centre[k] += (double)p[k] / (double)count;
        }
    }
    slack.tilt /= hypot(hypot((double)normal[0], (double)normal[1]), (double)normal[2]);
    if (slack.tilt < space->slacks[plane].tilt) { space->slacks[plane] = slack; }
}

double space_slack(const space_t *space, uint32_t plane, const exact_point_t *point) {
    const space_slack_t *slack = &space->slacks[plane];
    if (space->rounding <= 0) { return 0; }
    const double r =
        hypot(hypot(point->at[0] - slack->centre[0], point->at[1] - slack->centre[1]), point->at[2] - slack->centre[2]);
    return fmin(space->rounding * (2 + r * slack->tilt), SPACE_SLACK_MAX);
}

static void spread(const solid_vertex_t *vertex, float varying[SPACE_VARYING]) {
    for (int k = 0; k < 3; k++) {
        varying[SPACE_NORMAL + k] = vertex->normal[k];
    }
    for (int k = 0; k < 2; k++) {
        varying[SPACE_TEXCOORD + k] = vertex->texcoord[k];
    }
    for (int k = 0; k < 4; k++) {
        varying[SPACE_COLOUR + k] = vertex->colour[k];
    }
}

/* corners: vertices of the solid. */
static bool add_face(space_t *space, const solid_face_t *from, const uint32_t *corners, size_t count, const int64_t normal[3]) {
    const solid_vertex_t *vertices = space->solid->vertices;
    exact_plane_t plane;
    space_corner_t buffer[MESH_CORNERS_MAX];
    space_face_t face = {.material = from->material, .source = from->source, .even = true};
    face.turned = exact_plane_make(&plane, normal, vertices[corners[0]].position);
    face.plane = enter_plane(space, &plane);
    if (face.plane != SPACE_NONE) { note_slack(space, face.plane, corners, count, normal); }
    if (face.plane == SPACE_NONE || count > MESH_CORNERS_MAX ||
        !mesh_reserve(&space->faces, &space->face_capacity, space->face_count + 1, sizeof *space->faces)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t v = corners[i], next = corners[(i + 1) % count];
        buffer[i] = (space_corner_t){.point = space->solid->places[v],
                                     .line = enter_edge(space, space->solid->places[v], space->solid->places[next])};
        if (buffer[i].line == SPACE_NONE) { return false; }
        spread(&vertices[v], buffer[i].varying);
        for (int k = 0; k < SPACE_VARYING; k++) {
            face.even = face.even && !(buffer[i].varying[k] < buffer[0].varying[k] || buffer[i].varying[k] > buffer[0].varying[k]);
        }
    }
    space->faces[space->face_count] = face;
    return new_piece(space, buffer, count, (uint32_t)space->face_count++) != SPACE_NONE;
}

/* n . (q - p) < 3 * 2^41 * 2^16: Newell's normal of 255 corners fits. */
static bool flat(const solid_t *solid, const solid_face_t *face) {
    const int16_t *p = solid->vertices[solid->corners[face->first]].position;
    for (uint32_t i = 1; i < face->count; i++) {
        const int16_t *q = solid->vertices[solid->corners[face->first + i]].position;
        int64_t off = 0;
        for (int k = 0; k < 3; k++) {
            off += face->normal[k] * (q[k] - p[k]);
        }
        if (off) { return false; }
    }
    return true;
}

static bool add_triangles(space_t *space, const solid_face_t *face) {
    const uint32_t *corners = space->solid->corners + face->first;
    int32_t points[MESH_CORNERS_MAX][3];
    uint32_t triangles[MESH_CORNERS_MAX][3];
    for (uint32_t i = 0; i < face->count; i++) {
        for (int k = 0; k < 3; k++) {
            points[i][k] = space->solid->vertices[corners[i]].position[k];
        }
    }
    long count = mesh_triangulate((const int32_t(*)[3])points, face->count, triangles);
    for (long t = 0; t < count; t++) {
        const uint32_t *at = triangles[t], three[3] = {corners[at[0]], corners[at[1]], corners[at[2]]};
        int64_t normal[3];
        const int32_t triangle[3][3] = {{points[at[0]][0], points[at[0]][1], points[at[0]][2]},
                                        {points[at[1]][0], points[at[1]][1], points[at[1]][2]},
                                        {points[at[2]][0], points[at[2]][1], points[at[2]][2]}};
        solid_newell(triangle, 3, normal);
        if (!add_face(space, face, three, 3, normal)) { return false; }
    }
    space->non_planar++;
    return count >= 0;
}

bool space_open(space_t *space, const solid_t *solid) {
    *space = (space_t){.solid = solid, .rounding = solid->error > 0 ? solid->error / solid->step_value : 0};
    space->places = mesh_array(solid->place_count, sizeof *space->places);
    if (!space->places || !mesh_reserve(&space->points, &space->point_capacity, solid->place_count, sizeof *space->points)) {
        return false;
    }
    memset(space->points, 0, solid->place_count * sizeof *space->points);
    space->point_count = solid->place_count;
    for (size_t v = 0; v < solid->vertex_count; v++) {
        exact_point_t *point = &space->points[solid->places[v]];
        space->places[solid->places[v]] = (uint32_t)v;
        exact_point_whole(point, solid->vertices[v].position);
        if (table_find(space, &space->point_table, exact_hash(point), point_equal, point, solid->places[v]) == SPACE_NONE) {
            return false;
        }
    }
    for (size_t f = 0; f < solid->face_count; f++) {
        const solid_face_t *face = &solid->faces[f];
        if (!(face->count == 3 || flat(solid, face) ? add_face(space, face, solid->corners + face->first, face->count, face->normal)
                                                    : add_triangles(space, face))) {
            return false;
        }
    }
    return true;
}

void space_close(space_t *space) {
    void *owned[] = {space->planes,
                     space->slacks,
                     space->points,
                     space->lines,
                     space->marks,
                     space->corners,
                     space->faces,
                     space->pieces,
                     space->places,
                     space->signs,
                     space->plane_table.slots,
                     space->point_table.slots,
                     space->edge_table.slots,
                     space->sorted,
                     space->halves[0],
                     space->halves[1]};
    for (size_t i = 0; i < sizeof owned / sizeof owned[0]; i++) {
        free(owned[i]);
    }
    *space = (space_t){0};
}

/* ---- cutting ------------------------------------------------------------------------------------------------ */

static bool emit(space_t *space, int half, size_t *count, const space_corner_t *corner, uint32_t line) {
    if (!mesh_reserve(&space->halves[half], &space->half_capacity[half], *count + 1, sizeof **space->halves)) { return false; }
    space->halves[half][*count] = *corner;
    space->halves[half][(*count)++].line = line;
    return true;
}

/* The point in which a side crosses the plane, with what varies as it is there. SPACE_NONE as point without memory. */
static space_corner_t crossing(space_t *space, const space_corner_t *from, const space_corner_t *to, uint32_t plane) {
    const space_line_t *line = &space->lines[from->line];
    const exact_plane_t *cut = &space->planes[plane];
    exact_point_t point;
    if (line->edge) {
        exact_point_on_edge(&point, place(space, line->of[0]), place(space, line->of[1]), cut);
    } else {
        exact_point_of_planes(&point, &space->planes[line->of[0]], &space->planes[line->of[1]], cut);
    }
    double off[2];
    for (int i = 0; i < 2; i++) {
        const double *at = space->points[i ? to->point : from->point].at;
        off[i] = cut->f[0] * at[0] + cut->f[1] * at[1] + cut->f[2] * at[2] + cut->e;
    }
    double part = off[0] / (off[0] - off[1]);
    part = part >= 0 && part <= 1 ? part : 0.5; /* both may be 0 as doubles */
    space_corner_t corner = {.point = enter_point(space, &point)};
    for (int k = 0; k < SPACE_VARYING; k++) {
        corner.varying[k] = (float)(from->varying[k] + (to->varying[k] - from->varying[k]) * part);
    }
    return corner;
}

/* A side within the plane: does the face lie on the plus side of it? Left of a direction u in a face of normal n is n x u; with
 * u = l (n x p), p the plane's normal, its product with p is l ((n . p)^2 - n^2 p^2): the opposite sign of l. */
static bool inside_is_plus(const space_t *space, const space_face_t *face, uint32_t from, uint32_t to, const exact_plane_t *cut) {
    mesh_int128_t along[3];
    exact_cross(space->planes[face->plane].n, cut->n, along);
    for (int k = 0; k < 3; k++) {
        if (along[k]) {
            int order = exact_order(&space->points[to], &space->points[from], k);
            return (order > 0) == (along[k] > 0) ? face->turned : !face->turned;
        }
    }
    return true;
}

/* Two sides in a row on one line are one side, or a part of it: their common corner is noted on the line, and comes back in the end
 * where it is needed. This takes away what bridges leave. */
static size_t without_detours(space_corner_t *corners, size_t count) {
    for (size_t i = 0; i < count && count > 2;) {
        const size_t before = i ? i - 1 : count - 1, after = i + 1 < count ? i + 1 : 0;
        if (corners[i].point == corners[after].point || corners[before].line == corners[i].line) {
            memmove(corners + i, corners + i + 1, (count - i - 1) * sizeof *corners);
            count--;
            i = 0;
        } else {
            i++;
        }
    }
    return count;
}

/* Sutherland and Hodgman's, for both sides at once. Where the polygon is not convex, sides along the cut lie upon one another; they
 * cancel under the even-odd rule, and as they all get the points of the cut's line they do so after rounding too. A
 * side that lies in the plane belongs to the part that it bounds; the other part, where it bridges, has it as part of the cut. */
static bool cut_corners(space_t *space, const space_piece_t *piece, uint32_t plane, uint32_t line, size_t counts[2]) {
    const space_face_t *face = &space->faces[piece->face];
    for (uint32_t i = 0; i < piece->count; i++) {
        const uint32_t after = i + 1 < piece->count ? i + 1 : 0, before = i ? i - 1 : piece->count - 1;
        const space_corner_t at = space->corners[piece->first + i], to = space->corners[piece->first + after];
        const int s = space->signs[i], t = space->signs[after], r = space->signs[before];
        bool good = true;
        if (s == 0 && t == 0) {
            bool plus = inside_is_plus(space, face, at.point, to.point, &space->planes[plane]);
            good = mark(space, line, at.point) && emit(space, 0, &counts[0], &at, plus ? at.line : line) &&
                   emit(space, 1, &counts[1], &at, plus ? line : at.line);
        } else if (s == 0 && r == t) { /* touches, no more */
            good = emit(space, t > 0 ? 0 : 1, &counts[t > 0 ? 0 : 1], &at, at.line);
        } else if (s == 0) {
            good = mark(space, line, at.point) && emit(space, 0, &counts[0], &at, t > 0 ? at.line : line) &&
                   emit(space, 1, &counts[1], &at, t > 0 ? line : at.line);
        } else {
            const int own = s > 0 ? 0 : 1;
            good = emit(space, own, &counts[own], &at, at.line);
            if (good && s == -t) {
                const space_corner_t made = crossing(space, &at, &to, plane);
                good = made.point != SPACE_NONE && mark(space, at.line, made.point) && mark(space, line, made.point) &&
                       emit(space, own, &counts[own], &made, line) && emit(space, 1 - own, &counts[1 - own], &made, at.line);
            }
        }
        if (!good) { return false; }
    }
    return true;
}

bool space_cut(space_t *space, uint32_t piece, uint32_t plane, uint32_t parts[2]) {
    const space_piece_t from = space->pieces[piece];
    const uint32_t line = new_line(space, false, space->faces[from.face].plane, plane);
    size_t counts[2] = {0};
    if (line == SPACE_NONE || !mesh_reserve(&space->signs, &space->sign_capacity, from.count, 1)) { return false; }
    for (uint32_t i = 0; i < from.count; i++) {
        space->signs[i] = (int8_t)exact_side(&space->planes[plane], &space->points[space->corners[from.first + i].point]);
    }
    if (!cut_corners(space, &from, plane, line, counts)) { return false; }
    for (int half = 0; half < 2; half++) {
        counts[half] = without_detours(space->halves[half], counts[half]);
        parts[half] = new_piece(space, space->halves[half], counts[half], from.face);
        if (parts[half] == SPACE_NONE) { return false; }
    }
    space->splits++;
    return true;
}

/* ---- points along lines ------------------------------------------------------------------------------------- */

/* An axis along which the line does not stand still. */
static int axis_of(const space_t *space, const space_line_t *line) {
    mesh_int128_t along[3];
    if (line->edge) {
        for (int k = 0; k < 3; k++) {
            along[k] = place(space, line->of[1])[k] - place(space, line->of[0])[k];
        }
    } else {
        exact_cross(space->planes[line->of[0]].n, space->planes[line->of[1]].n, along);
    }
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        along[k] = along[k] < 0 ? -along[k] : along[k];
        axis = along[k] > along[axis] ? k : axis;
    }
    return axis;
}

typedef struct sorter {
    const space_t *space;
    int axis;
} sorter_t;

static int by_place(const void *x, const void *y, void *context) {
    const sorter_t *sorter = context;
    uint32_t a, b;
    memcpy(&a, x, sizeof a);
    memcpy(&b, y, sizeof b);
    return exact_order(&sorter->space->points[a], &sorter->space->points[b], sorter->axis);
}

bool space_sort_lines(space_t *space) {
    for (size_t l = 0; l < space->line_count; l++) {
        space_line_t *line = &space->lines[l];
        line->sorted = (uint32_t)space->sorted_count;
        for (uint32_t m = line->marks; m != SPACE_NONE; m = space->marks[m].next) {
            if (!mesh_reserve(&space->sorted, &space->sorted_capacity, space->sorted_count + 1, sizeof *space->sorted)) {
                return false;
            }
            space->sorted[space->sorted_count++] = space->marks[m].point;
        }
        size_t count = space->sorted_count - line->sorted, kept = 0;
        if (!count) { continue; }
        sorter_t sorter = {space, axis_of(space, line)};
        uint32_t *points = space->sorted + line->sorted;
        qsort_r(points, count, sizeof *points, by_place, &sorter);
        for (size_t i = 0; i < count; i++) {
            if (!kept || points[kept - 1] != points[i]) { points[kept++] = points[i]; }
        }
        line->sorted_count = (uint32_t)kept;
        space->sorted_count = line->sorted + kept;
    }
    return true;
}

/* How many points of a line come before `point`, and with `too`, the point itself counted. */
static size_t rank(const space_t *space, const uint32_t *points, size_t count, uint32_t point, int axis, bool too) {
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = exact_order(&space->points[points[middle]], &space->points[point], axis);
        if (order < 0 || (too && order == 0)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

space_run_t space_between(const space_t *space, uint32_t line_index, uint32_t from, uint32_t to) {
    const space_line_t *line = &space->lines[line_index];
    if (!line->sorted_count) { return (space_run_t){.step = 1}; }
    const uint32_t *points = space->sorted + line->sorted;
    int axis = axis_of(space, line);
    bool up = exact_order(&space->points[from], &space->points[to], axis) < 0;
    size_t first = rank(space, points, line->sorted_count, up ? from : to, axis, true);
    size_t end = rank(space, points, line->sorted_count, up ? to : from, axis, false);
    space_run_t run = {.count = end > first ? end - first : 0, .step = up ? 1 : -1, .axis = axis};
    if (run.count) { run.at = up ? points + first : points + end - 1; }
    return run;
}
