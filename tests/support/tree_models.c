#include "tree_models.h"

#include "check.h"
#include "models.h"

#include <math.h>

void tree_model_scale(mesh_t *mesh, double factor) {
    for (size_t p = 0; p < mesh->position_count; p++) {
        for (int k = 0; k < 3; k++) {
            mesh->positions[p][k] = round(mesh->positions[p][k] * factor);
        }
    }
}

void tree_model_turn_inside_out(mesh_t *mesh) {
    for (size_t f = 0; f < mesh->face_count; f++) {
        uint32_t *corners = mesh->corners + mesh->faces[f].first;
        for (uint32_t i = 0, j = mesh->faces[f].count - 1; i < j; i++, j--) {
            const uint32_t swap = corners[i];
            corners[i] = corners[j];
            corners[j] = swap;
        }
    }
}

void tree_model_triangle(mesh_t *mesh, const int32_t corners[3][3]) {
    uint32_t at[3];
    for (int i = 0; i < 3; i++) {
        at[i] = model_position(mesh, corners[i][0], corners[i][1], corners[i][2]);
    }
    model_face(mesh, at, 3, model_material(mesh, 200, 200, 200));
}

void tree_model_quad(mesh_t *mesh, const int32_t corners[4][3]) {
    uint32_t at[4];
    for (int i = 0; i < 4; i++) {
        at[i] = model_position(mesh, corners[i][0], corners[i][1], corners[i][2]);
    }
    model_face(mesh, at, 4, model_material(mesh, 200, 200, 200));
}

void tree_model_box(mesh_t *mesh, int32_t x0, int32_t y0, int32_t z0, int32_t x1, int32_t y1, int32_t z1) {
    const double low[3] = {x0, y0, z0}, high[3] = {x1, y1, z1};
    model_box(mesh, low, high, model_material(mesh, 200, 200, 200));
}

/* The position that is there already, or a new one. */
static uint32_t joined_position(mesh_t *mesh, const double at[3]) {
    for (uint32_t p = 0; p < mesh->position_count; p++) {
        if (memcmp(mesh->positions[p], at, sizeof mesh->positions[p]) == 0) { return p; }
    }
    return model_position(mesh, at[0], at[1], at[2]);
}

void tree_model_icosphere(mesh_t *mesh, unsigned divisions, double radius) {
    static const uint8_t faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    const double t = (1 + sqrt(5)) / 2;
    const double corners[12][3] = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    model_start(mesh);
    for (unsigned f = 0; f < 20; f++) {
        for (unsigned a = 0; a < divisions; a++) {
            for (unsigned b = 0; a + b < divisions; b++) {
                for (unsigned half = 0; half < (a + b + 1 < divisions ? 2u : 1u); half++) {
                    const unsigned parts[2][3][2] = {{{a, b}, {a + 1, b}, {a, b + 1}}, {{a + 1, b}, {a + 1, b + 1}, {a, b + 1}}};
                    uint32_t at[3];
                    for (int i = 0; i < 3; i++) {
                        double p[3], squares = 0;
                        for (int k = 0; k < 3; k++) {
                            const unsigned u = parts[half][i][0], v = parts[half][i][1];
                            p[k] = corners[faces[f][0]][k] * (divisions - u - v) + corners[faces[f][1]][k] * u +
                                   corners[faces[f][2]][k] * v;
                            squares += p[k] * p[k];
                        }
                        for (int k = 0; k < 3; k++) {
                            p[k] = round(p[k] / sqrt(squares) * radius) + 0.0;
                        }
                        at[i] = joined_position(mesh, p);
                    }
                    model_face(mesh, at, 3, model_material(mesh, 200, 200, 200));
                }
            }
        }
    }
}

int64_t tree_model_volume(const int32_t a[3], const int32_t b[3], const int32_t c[3], const int32_t d[3]) {
    int64_t sum = 0;
    for (int k = 0; k < 3; k++) {
        const int y = (k + 1) % 3, z = (k + 2) % 3;
        sum += ((int64_t)(b[y] - a[y]) * (c[z] - a[z]) - (int64_t)(b[z] - a[z]) * (c[y] - a[y])) * (d[k] - a[k]);
    }
    return sum;
}

void tree_model_hull(mesh_t *mesh, random_source_t *random) {
    enum { POINTS = 16 };
    int32_t at[POINTS][3];
    uint32_t place[POINTS];
    model_start(mesh);
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < 3; k++) {
            at[i][k] = random_between(random, -30000, 30000);
        }
        place[i] = model_position(mesh, at[i][0], at[i][1], at[i][2]);
    }
    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < POINTS; j++) {
            for (int k = 0; k < POINTS; k++) {
                if (i == j || j == k || i == k || i > j || i > k) { continue; } /* the least number first */
                bool outside = true;
                for (int o = 0; o < POINTS && outside; o++) {
                    outside = o == i || o == j || o == k || tree_model_volume(at[i], at[j], at[k], at[o]) < 0;
                }
                const uint32_t corners[3] = {place[i], place[j], place[k]};
                if (outside) { model_face(mesh, corners, 3, model_material(mesh, 200, 200, 200)); }
            }
        }
    }
}

void tree_model_star_bar(mesh_t *mesh, int points, const int32_t axes[3][3], const int32_t middle[3]) {
    uint32_t ring[2][32];
    for (int e = 0; e < 2; e++) {
        for (int i = 0; i < 2 * points; i++) {
            const double radius = i % 2 ? 60 : 150, turn = 3.14159265358979 * i / points;
            const double along[3] = {round(radius * cos(turn)), round(radius * sin(turn)), e ? 130 : -130};
            double p[3];
            for (int k = 0; k < 3; k++) {
                p[k] = middle[k] + along[0] * axes[0][k] + along[1] * axes[1][k] + along[2] * axes[2][k];
            }
            ring[e][i] = model_position(mesh, p[0], p[1], p[2]);
        }
    }
    uint32_t corners[32];
    const uint32_t count = 2 * (uint32_t)points, material = model_material(mesh, 200, 200, 200);
    model_face(mesh, ring[1], count, material);
    for (uint32_t i = 0; i < count; i++) {
        corners[i] = ring[0][count - 1 - i];
    }
    model_face(mesh, corners, count, material);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t next = (i + 1) % count, side[4] = {ring[0][i], ring[0][next], ring[1][next], ring[1][i]};
        model_face(mesh, side, 4, material);
    }
}
