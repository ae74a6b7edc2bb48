#include "uno_demo.h"

#include "../../firmware/uno/tell.h"

#include <string.h>

#define LEFT 113u /* of the corner, which reaches to the right edge; 8 rows */
#define COLUMNS 15u
#define ROWS 8u
#define POINT_COLUMN 9u
#define LAST 174u

/* Row by row. */
static const char *const digits[10] = {"####.##.##.####", ".#.##..#..#.###", "###..#####..###", "###..####..####",
                                       "#.##.####..#..#", "####..###..####", "####..####.####", "###..#..#..#..#",
                                       "####.#####.####", "####.####..####"};
static const unsigned places[3] = {1, 5, 11}; /* columns of tens, ones and tenths */

uno_demo_t uno_demo_at(unsigned n) {
    static const struct {
        unsigned from, show;
    } parts[] = {{0, UNO_CUBE_ZBUFFER},  {16, UNO_ROOM_TREE}, {24, UNO_CUBE_TREE},
                 {88, UNO_CUBE_ZBUFFER}, {91, UNO_ROOM_TREE}, {94, UNO_CUBE_TREE}};
    unsigned i = sizeof parts / sizeof parts[0] - 1;

    while (parts[i].from > n) {
        i--;
    }
    return (uno_demo_t){
        .show = parts[i].show,
        .frame = (n - parts[i].from) % UNO_FRAMES,
        .press_ms = n == 89   ? 100
                    : n == 92 ? 2000
                              : 0, /* seen in the frame behind it, the last one of its show */
        .last = n == LAST,
    };
}

static void draw(bool dots[ROWS][COLUMNS], unsigned tenths) {
    memset(dots, 0, ROWS * COLUMNS * sizeof dots[0][0]);
    dots[5][POINT_COLUMN] = true;
    for (unsigned place = 3; place-- > 0; tenths /= 10) {
        for (unsigned i = 0; i < 15; i++) {
            dots[1 + i / 3][places[place] + i % 3] = digits[tenths % 10][i] == '#';
        }
    }
}

static bool shows(const sim_picture_t *seen, bool dots[ROWS][COLUMNS]) {
    for (unsigned y = 0; y < ROWS; y++) {
        for (unsigned x = 0; x < COLUMNS; x++) {
            if ((seen->rgb[3 * (y * seen->width + LEFT + x)] != 0) != dots[y][x]) { return false; }
        }
    }
    return true;
}

int uno_demo_corner(const sim_picture_t *seen, sim_picture_t *wanted, double rate, sim_error_t *error) {
    unsigned tenths;
    bool dots[ROWS][COLUMNS];

    for (tenths = 0; tenths < 1000; tenths++) {
        draw(dots, tenths);
        if (shows(seen, dots)) { break; }
    }
    if (tenths == 1000) { return sim_fail(error, "what is in the corner is no rate"); }
    /* It is cut off below the tenth, and measured to 256 us. */
    if (tenths > rate * 1.01 || tenths < rate * 0.99 - 1) {
        return sim_fail(error, "the corner shows %u tenths of a frame a second; it was %.2f", tenths, rate);
    }
    for (unsigned y = 0; y < ROWS; y++) {
        memcpy(wanted->rgb + 3 * (y * wanted->width + LEFT), seen->rgb + 3 * (y * seen->width + LEFT), 3 * COLUMNS);
    }
    return 0;
}
