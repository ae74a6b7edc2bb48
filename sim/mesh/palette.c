/* A palette for faces or texels: exact while its size does, else by median cut (Heckbert 1982), splitting always the box whose
 * colours lie furthest from their mean. */
#include "stages.h"

#include <string.h>

typedef struct swatch {
    uint8_t colour[4];
    uint32_t faces;    /* or texels, that have it */
    uint32_t earliest; /* of them */
    uint32_t entry;    /* of the palette */
} swatch_t;

typedef struct box {
    size_t first, count; /* swatches */
    double spread;       /* sum of squared distances from the mean */
    int axis;            /* along which most of that lies */
    double mean[4];
} box_t;

static int by_colour(const void *a, const void *b) {
    const swatch_t *x = a, *y = b;
    int order = memcmp(x->colour, y->colour, 4);
    return order ? order : (x->earliest > y->earliest) - (x->earliest < y->earliest);
}

static int by_use(const void *a, const void *b) {
    const swatch_t *x = a, *y = b;
    return (x->earliest > y->earliest) - (x->earliest < y->earliest);
}

#define BY_AXIS(name, axis)                            \
    static int name(const void *a, const void *b) {    \
        const swatch_t *x = a, *y = b;                 \
        int order = x->colour[axis] - y->colour[axis]; \
        return order ? order : by_colour(a, b);        \
    }
BY_AXIS(by_red, 0)
BY_AXIS(by_green, 1)
BY_AXIS(by_blue, 2)
BY_AXIS(by_alpha, 3)

static void measure(box_t *box, const swatch_t *swatches) {
    double weight = 0, sum[4] = {0}, squares[4] = {0};
    for (size_t i = box->first; i < box->first + box->count; i++) {
        weight += swatches[i].faces;
        for (int k = 0; k < 4; k++) {
            sum[k] += (double)swatches[i].faces * swatches[i].colour[k];
            squares[k] += (double)swatches[i].faces * swatches[i].colour[k] * swatches[i].colour[k];
        }
    }
    box->spread = 0;
    box->axis = 0;
    double widest = -1;
    for (int k = 0; k < 4; k++) {
        box->mean[k] = sum[k] / weight;
        double along = squares[k] - sum[k] * box->mean[k];
        box->spread += along;
        if (along > widest) {
            widest = along;
            box->axis = k;
        }
    }
    if (box->count < 2) { box->spread = 0; }
}

static void split(box_t *box, box_t *other, swatch_t *swatches) {
    static int (*const orders[4])(const void *, const void *) = {by_red, by_green, by_blue, by_alpha};
    qsort(swatches + box->first, box->count, sizeof *swatches, orders[box->axis]);
    size_t keep = 1; /* up to the mean, which needs no second measure of the box to leave two parts */
    while (keep + 1 < box->count && swatches[box->first + keep].colour[box->axis] <= box->mean[box->axis]) {
        keep++;
    }
    *other = (box_t){.first = box->first + keep, .count = box->count - keep};
    box->count = keep;
    measure(box, swatches);
    measure(other, swatches);
}

static size_t cut(swatch_t *swatches, size_t count, size_t most, uint8_t (*palette)[4]) {
    box_t boxes[MESH_MATERIALS_MAX];
    size_t box_count = 1;
    boxes[0] = (box_t){.first = 0, .count = count};
    measure(&boxes[0], swatches);
    while (box_count < most) {
        size_t widest = 0;
        for (size_t b = 1; b < box_count; b++) {
            if (boxes[b].spread > boxes[widest].spread) { widest = b; }
        }
        if (boxes[widest].count < 2) { break; }
        split(&boxes[widest], &boxes[box_count], swatches);
        box_count++;
    }
    for (size_t b = 0; b < box_count; b++) {
        for (int k = 0; k < 4; k++) {
            palette[b][k] = (uint8_t)(boxes[b].mean[k] + 0.5);
        }
        for (size_t i = boxes[b].first; i < boxes[b].first + boxes[b].count; i++) {
            swatches[i].entry = (uint32_t)b;
        }
    }
    return box_count;
}

int mesh_palette_of(const uint8_t (*colours)[4], size_t count, size_t most, uint8_t (*palette)[4], size_t *palette_count,
                    uint32_t *index) {
    swatch_t *swatches = mesh_array(count, sizeof *swatches);
    if (!swatches) { return -1; }
    for (size_t i = 0; i < count; i++) {
        memcpy(swatches[i].colour, colours[i], 4);
        swatches[i].faces = 1;
        swatches[i].earliest = (uint32_t)i;
    }
    qsort(swatches, count, sizeof *swatches, by_colour);
    size_t distinct = 0;
    for (size_t i = 0; i < count; i++) {
        if (distinct && !memcmp(swatches[distinct - 1].colour, swatches[i].colour, 4)) {
            swatches[distinct - 1].faces++;
        } else {
            swatches[distinct++] = swatches[i];
        }
    }
    if (distinct <= most) {
        qsort(swatches, distinct, sizeof *swatches, by_use);
        for (size_t i = 0; i < distinct; i++) {
            memcpy(palette[i], swatches[i].colour, 4);
            swatches[i].entry = (uint32_t)i;
        }
        *palette_count = distinct;
    } else {
        *palette_count = cut(swatches, distinct, most, palette);
    }
    qsort(swatches, distinct, sizeof *swatches, by_colour);
    for (size_t i = 0; i < count; i++) {
        size_t low = 0, high = distinct;
        while (high - low > 1) {
            size_t middle = (low + high) / 2;
            if (memcmp(swatches[middle].colour, colours[i], 4) <= 0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        index[i] = swatches[low].entry;
    }
    free(swatches);
    return 0;
}

int mesh_palette(const uint8_t (*colours)[3], size_t count, uint8_t (*palette)[3], size_t *palette_count, uint32_t *index) {
    uint8_t(*wide)[4] = mesh_array(count, sizeof *wide), entries[MESH_MATERIALS_MAX][4];
    if (!wide) { return -1; }
    for (size_t i = 0; i < count; i++) {
        memcpy(wide[i], colours[i], 3);
    }
    const int status = mesh_palette_of((const uint8_t(*)[4])wide, count, MESH_MATERIALS_MAX, entries, palette_count, index);
    for (size_t i = 0; !status && i < *palette_count; i++) {
        memcpy(palette[i], entries[i], 3);
    }
    free(wide);
    return status;
}
