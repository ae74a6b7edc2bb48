#include "card.h"

#define BLACK TUILE_COLOUR(0, 0, 0)
#define WHITE TUILE_COLOUR(255, 255, 255)
#define STEPS 16
#define NAME_DOTS 12 /* two characters of the font */
#define LINE_DOTS 10
#define GAP 3

/* Low windows have their parts side by side, others below one another. */
card_layout_t card_layout(const card_t *card, uint16_t width, uint16_t height) {
    const int32_t w = width, h = height;
    card_layout_t l = {.inset_x = GAP, .inset_y = GAP};
    if (card->round) { /* the corners of the square within the circle: (1 - 1 / sqrt 2) / 2 of its side, rounded up */
        l.inset_x = w * 19 / 128 + 1;
        l.inset_y = h * 19 / 128 + 1;
    }
    if (h < 4 * LINE_DOTS + 8 * GAP) {
        const int32_t left = l.inset_x + NAME_DOTS + GAP, right = w - left, top = l.inset_y, bottom = h - l.inset_y;
        const int32_t side = bottom - top, middle = (top + bottom) / 2;
        l.arrow = (tuile_box_t){left, top, left + side / 2, bottom};
        l.bars = (tuile_box_t){left + side / 2 + GAP, top, right, middle - 1};
        l.ramp = (tuile_box_t){left + side / 2 + GAP, middle + 1, right, bottom};
    } else {
        const int32_t left = l.inset_x, right = w - left;
        const int32_t top = l.inset_y + LINE_DOTS + GAP, bottom = h - top, third = (bottom - top) / 3;
        const int32_t between = w / 2 - left - NAME_DOTS - GAP, half = third / 2 < between ? third / 2 : between;
        if (between < LINE_DOTS / 2) { /* no room between the names: below them */
            l.arrow = (tuile_box_t){left, top, right, top + third - GAP};
        } else {
            l.arrow = (tuile_box_t){w / 2 - half, l.inset_y, w / 2 + half, top + third - LINE_DOTS - GAP};
        }
        l.bars = (tuile_box_t){left, top + third, right, top + 2 * third - GAP};
        l.ramp = (tuile_box_t){left, top + 2 * third, right, bottom};
    }
    return l;
}

static void draw_arrow(tuile_canvas_t *canvas, const tuile_box_t *box) {
    const int32_t middle = (box->left + box->right) / 2, width = box->right - box->left, neck = (box->top + box->bottom) / 2;
    const q28_4_t head[3][2] = {{TUILE_PX(middle), TUILE_PX(box->top)},
                                {TUILE_PX(middle + width / 2), TUILE_PX(neck)},
                                {TUILE_PX(middle - width / 2), TUILE_PX(neck)}};
    (void)tuile_draw_polygon(canvas, head, 3, WHITE);
    tuile_draw_rectangle(canvas, middle - width / 8, neck, width / 4, box->bottom - neck, WHITE);
}

static void draw_bars(tuile_canvas_t *canvas, const tuile_box_t *box) {
    static const uint32_t colours[3] = {TUILE_COLOUR(255, 0, 0), TUILE_COLOUR(0, 255, 0), TUILE_COLOUR(0, 0, 255)};
    const int32_t width = (box->right - box->left) / 3;
    for (int32_t i = 0; i < 3; i++) {
        tuile_draw_rectangle(canvas, box->left + i * width, box->top, width, box->bottom - box->top, colours[i]);
    }
}

static void draw_ramp(tuile_canvas_t *canvas, const tuile_box_t *box) {
    const int32_t width = box->right - box->left;
    for (int32_t i = 0; i < STEPS; i++) {
        const int32_t from = box->left + width * i / STEPS, to = box->left + width * (i + 1) / STEPS;
        const uint32_t grey = (uint32_t)i * 17u;
        tuile_draw_rectangle(canvas, from, box->top, to - from, box->bottom - box->top, TUILE_COLOUR(grey, grey, grey));
    }
}

static void draw_names(tuile_canvas_t *canvas, const card_t *card, const card_layout_t *l) {
    const int32_t right = canvas->width - l->inset_x - NAME_DOTS, bottom = canvas->height - l->inset_y - LINE_DOTS;
    tuile_text(canvas, card->font, l->inset_x, l->inset_y, "TL", WHITE);
    tuile_text(canvas, card->font, right, l->inset_y, "TR", WHITE);
    tuile_text(canvas, card->font, l->inset_x, bottom, "BL", WHITE);
    tuile_text(canvas, card->font, right, bottom, "BR", WHITE);
}

void card_draw(void *context, tuile_canvas_t *canvas) {
    const card_t *card = context;
    const card_layout_t l = card_layout(card, canvas->width, canvas->height);
    const int32_t title = l.arrow.bottom + GAP;
    canvas->crisp = true;
    tuile_draw_rectangle(canvas, 0, 0, canvas->width, canvas->height, BLACK);
    tuile_draw_frame(canvas, 0, 0, canvas->width, canvas->height, 1, WHITE);
    if (card->round) {
        const q28_4_t radius = TUILE_PX(canvas->width) / 2;
        tuile_draw_ring(canvas, TUILE_PX(canvas->width) / 2, TUILE_PX(canvas->height) / 2, radius - 16, radius, WHITE);
    }
    draw_names(canvas, card, &l);
    draw_arrow(canvas, &l.arrow);
    draw_bars(canvas, &l.bars);
    draw_ramp(canvas, &l.ramp);
    if (card->title && title + LINE_DOTS <= l.bars.top && tuile_text_width(card->font, card->title) <= l.bars.right - l.bars.left) {
        tuile_text_styled(canvas, card->font, canvas->width / 2, title, card->title,
                          &(tuile_text_style_t){.colour = WHITE, .align = TUILE_ALIGN_CENTRE});
    }
}
