/* A convex solid for `make bench-methods`: a sphere of 8 * 16 * 16 = 2048 triangles as OBJ text.
 *
 * Each side of an octahedron is cut into triangles by whole coordinates |x| + |y| + |z| = 16, and their corners are moved out to
 * distance 1. No angle of a triangle exceeds a right one, so the circle round none of them holds another corner: the triangles are
 * those of the corners' convex hull.
 */
#include <math.h>
#include <stdio.h>

#define PARTS 16

static int numbers[2 * PARTS + 1][2 * PARTS + 1][2 * PARTS + 1]; /* of the corners, from 1 */
static int corner_count;

static void corner(const int p[3]) {
    int *number = &numbers[p[0] + PARTS][p[1] + PARTS][p[2] + PARTS];
    if (*number) { return; }
    const double length = sqrt((double)(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
    *number = ++corner_count;
    (void)printf("v %.9f %.9f %.9f\n", p[0] / length, p[1] / length, p[2] / length);
}

/* The corner at x, y and its neighbours `step` further along x and along y, in the octant of the signs. */
static void triangle(const int sign[3], int x, int y, int step) {
    const int corners[3][2] = {{x, y}, {x + step, y}, {x, y + step}};
    const int odd = sign[0] * sign[1] * sign[2] < 0;
    int at[3];
    for (int i = 0; i < 3; i++) {
        const int *c = corners[odd ? 2 - i : i];
        const int p[3] = {sign[0] * c[0], sign[1] * c[1], sign[2] * (PARTS - c[0] - c[1])};
        corner(p);
        at[i] = numbers[p[0] + PARTS][p[1] + PARTS][p[2] + PARTS];
    }
    (void)printf("f %d %d %d\n", at[0], at[1], at[2]);
}

int main(void) {
    for (int octant = 0; octant < 8; octant++) {
        const int sign[3] = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
        for (int y = 0; y < PARTS; y++) {
            for (int x = 0; x + y <= PARTS; x++) {
                if (x + y < PARTS) { triangle(sign, x, y, 1); }
                if (x > 0 && y > 0) { triangle(sign, x, y, -1); }
            }
        }
    }
    return 0;
}
