/* Parts of the display tree's compiler by themselves: how a polygon is cut, and what is said about a list, against the definition.
 */
#include "support/check.h"
#include "support/random.h"

#include "../sim/mesh/tree.h"

typedef struct figure {
    solid_t solid;
    size_t vertex_capacity, place_capacity, corner_capacity, face_capacity;
} figure_t;

/* A face in the plane z = 0 or of three corners; no corner is shared. */
static void add(figure_t *figure, const int16_t (*at)[3], uint32_t count) {
    solid_t *solid = &figure->solid;
    int32_t points[16][3];
    solid_face_t face = {.first = (uint32_t)solid->corner_count, .count = count, .source = (uint32_t)solid->face_count};
    const size_t corners = solid->corner_count + count;
    assert_true(mesh_reserve(&solid->vertices, &figure->vertex_capacity, corners, sizeof *solid->vertices));
    assert_true(mesh_reserve(&solid->places, &figure->place_capacity, corners, sizeof *solid->places));
    assert_true(mesh_reserve(&solid->corners, &figure->corner_capacity, corners, sizeof *solid->corners));
    assert_true(mesh_reserve(&solid->faces, &figure->face_capacity, solid->face_count + 1, sizeof *solid->faces));
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t v = (uint32_t)solid->corner_count++;
        solid->corners[v] = solid->places[v] = v;
        solid->vertices[v] = (solid_vertex_t){.position = {at[i][0], at[i][1], at[i][2]}, .normal = {0, 0, 127}};
        for (int k = 0; k < 3; k++) {
            points[i][k] = at[i][k];
        }
    }
    solid_newell((const int32_t(*)[3])points, count, face.normal);
    solid->vertex_count = solid->place_count = solid->corner_count;
    solid->faces[solid->face_count++] = face;
}

/* ---- cutting ---------------------------------------------------------------------------------------------------- */

/* A corner of a piece, and whether the side that begins there is an edge of the face. */
typedef struct corner {
    int16_t at[3];
    bool edge;
} corner_t;

/* The piece has these corners in this order, from whichever on. */
static void check_piece(const space_t *space, uint32_t piece, const corner_t *corners, uint32_t count) {
    const space_piece_t *at = &space->pieces[piece];
    assert_int_equal(at->count, count);
    for (uint32_t first = 0; first < count; first++) {
        bool same = true;
        for (uint32_t i = 0; i < count; i++) {
            const space_corner_t *corner = &space->corners[at->first + (first + i) % count];
            int32_t place[3];
            exact_round(&space->points[corner->point], place);
            for (int k = 0; k < 3; k++) {
                same = same && place[k] == 256 * corners[i].at[k];
            }
            same = same && space->lines[corner->line].edge == corners[i].edge;
        }
        if (same) { return; }
    }
    fail_msg("piece %u is not what it should be", piece);
}

/* An L, cut along y = 100, where one of its edges lies: the edge bounds the lower part. In both directions round. */
static void an_edge_in_the_plane_goes_to_the_part_that_it_bounds(void **state) {
    static const int16_t outline[6][3] = {{0, 0, 0}, {200, 0, 0}, {200, 100, 0}, {100, 100, 0}, {100, 200, 0}, {0, 200, 0}};
    static const corner_t upper[4] = {{{100, 100, 0}, true}, {{100, 200, 0}, true}, {{0, 200, 0}, true}, {{0, 100, 0}, false}};
    static const corner_t lower[5] = {
        {{0, 0, 0}, true}, {{200, 0, 0}, true}, {{200, 100, 0}, true}, {{100, 100, 0}, false}, {{0, 100, 0}, true}};
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        figure_t figure = {.vertex_capacity = 0};
        int16_t at[6][3];
        for (int i = 0; i < 6; i++) {
            memcpy(at[i], outline[turned ? 5 - i : i], sizeof at[i]);
        }
        static const int16_t wall[3][3] = {{0, 100, 0}, {0, 100, 50}, {50, 100, 0}}; /* its plane is y = 100 */
        add(&figure, (const int16_t(*)[3])at, 6);
        add(&figure, wall, 3);
        space_t space;
        uint32_t parts[2];
        assert_true(space_open(&space, &figure.solid));
        assert_true(space_cut(&space, 0, space.faces[1].plane, parts));
        corner_t expected[2][5];
        for (uint32_t i = 0; i < 5; i++) { /* the other way round, a side begins where it ended */
            expected[0][i % 4] = upper[turned ? 3 - i % 4 : i % 4];
            expected[1][i] = lower[turned ? 4 - i : i];
        }
        for (uint32_t i = 0; i < 5 && turned; i++) {
            expected[0][i % 4].edge = upper[(6 - i % 4) % 4].edge;
            expected[1][i].edge = lower[(8 - i) % 5].edge;
        }
        check_piece(&space, parts[0], expected[0], 4);
        check_piece(&space, parts[1], expected[1], 5);
        space_close(&space);
        solid_free(&figure.solid);
    }
}

/* A U cut through its arms: the upper part is two rectangles in one outline, joined along the cut, and of even winding elsewhere.
 */
static void what_is_cut_keeps_its_area(void **state) {
    static const int16_t outline[8][3] = {{0, 0, 0},    {300, 0, 0},  {300, 200, 0}, {200, 200, 0},
                                          {200, 50, 0}, {100, 50, 0}, {100, 200, 0}, {0, 200, 0}};
    static const int16_t wall[3][3] = {{0, 120, 0}, {0, 120, 50}, {50, 120, 0}};
    (void)state;
    figure_t figure = {.vertex_capacity = 0};
    add(&figure, outline, 8);
    add(&figure, wall, 3);
    space_t space;
    uint32_t parts[2];
    assert_true(space_open(&space, &figure.solid));
    assert_true(space_cut(&space, 0, space.faces[1].plane, parts));
    double areas[2] = {0};
    for (int p = 0; p < 2; p++) {
        const space_piece_t *piece = &space.pieces[parts[p]];
        for (uint32_t i = 0; i < piece->count; i++) {
            const double *a = space.points[space.corners[piece->first + i].point].at;
            const double *b = space.points[space.corners[piece->first + (i + 1) % piece->count].point].at;
            areas[p] += (a[0] * b[1] - a[1] * b[0]) / 2;
            assert_true(p ? a[1] <= 120 : a[1] >= 120);
        }
    }
    assert_true(areas[0] > 15999 && areas[0] < 16001 && areas[1] > 28999 && areas[1] < 29001);
    space_close(&space);
    solid_free(&figure.solid);
}

/* Even-odd, of points that are on no side. */
static bool covers(const space_t *space, uint32_t piece_index, double x, double y) {
    const space_piece_t *piece = &space->pieces[piece_index];
    bool inside = false;
    for (uint32_t i = 0; i < piece->count; i++) {
        const double *a = space->points[space->corners[piece->first + i].point].at;
        const double *b = space->points[space->corners[piece->first + (i + 1) % piece->count].point].at;
        if ((a[1] > y) != (b[1] > y) && a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > x) { inside = !inside; }
    }
    return inside;
}

/* Outlines that cross themselves anyhow, on a coarse grid so that planes go through corners and along sides, cut three times: each
 * point is in one of the parts, or in none, as it was in the whole. */
static void any_outline_is_cut_without_loss(void **state) {
    (void)state;
    random_source_t random = random_seed(30);
    size_t cuts = 0;
    for (int round = 0; round < CHECK_ROUNDS(2000); round++) {
        figure_t figure = {.vertex_capacity = 0};
        const uint32_t corners = (uint32_t)random_between(&random, 3, 9), walls = 3;
        int16_t at[9][3] = {{0}};
        for (uint32_t i = 0; i < corners; i++) {
            do {
                at[i][0] = (int16_t)(10 * random_between(&random, -4, 4));
                at[i][1] = (int16_t)(10 * random_between(&random, -4, 4));
            } while ((i > 0 && memcmp(at[i], at[i - 1], sizeof at[i]) == 0) || (i > 0 && memcmp(at[i], at[0], sizeof at[i]) == 0));
        }
        add(&figure, (const int16_t(*)[3])at, corners);
        const int64_t *normal = figure.solid.faces[0].normal;
        for (uint32_t w = 0; w < walls; w++) {
            int16_t wall[3][3] = {{0}};
            do {
                for (int i = 0; i < 4; i++) {
                    wall[i / 2][i % 2] = (int16_t)(10 * random_between(&random, -3, 3));
                }
            } while (memcmp(wall[0], wall[1], sizeof wall[0]) == 0);
            memcpy(wall[2], wall[0], sizeof wall[2]);
            wall[2][2] = 50;
            add(&figure, (const int16_t(*)[3])wall, 3);
        }
        space_t space;
        uint32_t parts[8] = {0};
        size_t count = 1;
        const bool good = normal[2] != 0;
        assert_true(!good || space_open(&space, &figure.solid));
        for (uint32_t w = 1; good && w <= walls; w++) {
            for (size_t i = count; i-- > 0;) {
                uint32_t halves[2];
                if (tree_sides(&space, parts[i], space.faces[w].plane) != 3) { continue; }
                assert_true(space_cut(&space, parts[i], space.faces[w].plane, halves));
                parts[i] = halves[0];
                parts[count++] = halves[1];
                cuts++;
                for (int h = 0; h < 2; h++) {
                    assert_int_equal(tree_sides(&space, halves[h], space.faces[w].plane) & (h ? 1 : 2), 0);
                }
            }
        }
        for (int sample = 0; good && sample < 100; sample++) {
            const double x = random_real(&random, -42, 42), y = random_real(&random, -42, 42);
            unsigned covered = 0;
            for (size_t i = 0; i < count; i++) {
                covered += covers(&space, parts[i], x, y);
            }
            assert_int_equal(covered, covers(&space, 0, x, y));
        }
        if (good) { space_close(&space); }
        solid_free(&figure.solid);
    }
    assert_true(cuts > (size_t)CHECK_ROUNDS(2000) * 2);
}

/* ---- lists ------------------------------------------------------------------------------------------------------ */

/* By their definitions, exactly and without memory. */
static int hull_of(const space_t *space, const uint32_t *pieces, size_t count, uint32_t plane) {
    unsigned sides = 0;
    for (size_t i = 0; i < count; i++) {
        sides |= tree_sides(space, pieces[i], plane);
    }
    return sides == 3 ? HULL_INSIDE : sides == 1 ? HULL_PLUS : sides == 2 ? HULL_MINUS : HULL_FLAT;
}

static size_t cost_of(const space_t *space, const uint32_t *pieces, size_t count, uint32_t plane) {
    long balance = 0, cuts = 0;
    for (size_t i = 0; i < count; i++) {
        const unsigned sides = tree_sides(space, pieces[i], plane);
        cuts += sides == 3;
        balance += sides == 3 ? 0 : sides == 2 ? -1 : 1;
    }
    return (size_t)(8 * cuts + labs(balance));
}

/* A list that loses pieces, and gets parts of others for them, is asked again and again: what planes remember must not show. */
static void lists_are_described_as_defined(void **state) {
    (void)state;
    random_source_t random = random_seed(31);
    for (int round = 0; round < CHECK_ROUNDS(16); round++) {
        figure_t figure = {.vertex_capacity = 0};
        space_t space;
        tree_list_t list = {.count = 0};
        uint32_t pieces[4096];
        size_t count = 60, chosen = 0;
        for (size_t f = 0; f < count; f++) {
            int16_t at[3][3], middle[3];
            for (int i = 0; i < 12; i++) { /* small, so that planes that cut few differ */
                *(i < 3 ? &middle[i] : &at[i / 3 - 1][i % 3]) =
                    (int16_t)random_between(&random, i < 3 ? -600 : -250, i < 3 ? 600 : 250);
            }
            for (int i = 0; i < 9; i++) {
                at[i / 3][i % 3] = (int16_t)(at[i / 3][i % 3] + middle[i % 3]);
            }
            add(&figure, (const int16_t(*)[3])at, 3);
            pieces[f] = (uint32_t)f;
        }
        assert_true(space_open(&space, &figure.solid));
        while (count > 2) {
            assert_true(tree_list_look(&list, &space, pieces, count));
            bool any = tree_list_hull(&list);
            uint32_t by = list.planes[(size_t)random_between(&random, 0, (int32_t)list.plane_count - 1)];
            for (size_t p = 0; p < list.plane_count; p++) {
                assert_int_equal(list.hull[list.planes[p]], hull_of(&space, pieces, count, list.planes[p]));
            }
            if (!any) {
                by = tree_list_choose(&list);
                const size_t cost = cost_of(&space, pieces, count, by);
                for (size_t p = 0; p < list.plane_count; p++) {
                    assert_true(cost <= cost_of(&space, pieces, count, list.planes[p]));
                }
                chosen++;
            }
            size_t kept = 0, all = count; /* the hull falls away, or one side of the plane */
            for (size_t i = 0; i < all; i++) {
                const uint32_t plane = space.faces[space.pieces[pieces[i]].face].plane;
                uint32_t parts[2] = {pieces[i], pieces[i]};
                if (any ? list.hull[plane] != HULL_INSIDE : plane == by) { continue; }
                const unsigned sides = tree_sides(&space, pieces[i], by);
                if (!any && sides == 3) { assert_true(space_cut(&space, pieces[i], by, parts)); }
                pieces[kept++] = parts[0];
                if (parts[1] != parts[0]) { pieces[count++] = parts[1]; }
                assert_true(count < CHECK_COUNT(pieces));
            }
            memmove(pieces + kept, pieces + all, (count - all) * sizeof *pieces);
            count = kept + count - all;
        }
        assert_true(chosen > 5);
        tree_list_close(&list);
        space_close(&space);
        solid_free(&figure.solid);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_edge_in_the_plane_goes_to_the_part_that_it_bounds),
        cmocka_unit_test(what_is_cut_keeps_its_area),
        cmocka_unit_test(any_outline_is_cut_without_loss),
        cmocka_unit_test(lists_are_described_as_defined),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
