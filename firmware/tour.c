#include "tour.h"

#include "caption.h"

static bool draws(const tour_t *tour) { return scenes[tour->scene]->methods >> tour->method & 1u; }

static void step(tour_t *tour) {
    if (tour->method < TUILE_TREE) {
        tour->method++;
        return;
    }
    tour->method = 0;
    tour->scene = (uint8_t)((tour->scene + 1u) % scene_count);
}

static void choose(tour_t *tour, button_event_t event, uint32_t now_us) {
    if (event == BUTTON_LONG) { tour->method = TUILE_TREE; }
    do {
        step(tour);
    } while (!draws(tour));
    tour->rate = 0;
    tour->frames = 0;
    tour->by_hand = event != BUTTON_NOTHING;
    tour->changed_us = tour->counted_us = now_us;
}

void tour_begin(tour_t *tour, uint32_t every_us, uint32_t now_us) {
    *tour = (tour_t){.scene = (uint8_t)(scene_count - 1u), .method = TUILE_TREE, .every_us = every_us};
    choose(tour, BUTTON_NOTHING, now_us);
}

bool tour_frame(tour_t *tour, button_event_t event, uint32_t now_us) {
    const uint32_t counted_us = now_us - tour->counted_us;

    tour->skipped = 0;
    tour->frames++;
    if (counted_us >= TOUR_RATE_US) {
        tour->rate = caption_rate(tour->frames, counted_us);
        tour->frames = 0;
        tour->counted_us = now_us;
    }
    if (event == BUTTON_NOTHING && now_us - tour->changed_us < (tour->by_hand ? TOUR_BY_HAND_US : tour->every_us)) { return false; }
    choose(tour, event, now_us);
    return true;
}

bool tour_skip(tour_t *tour, uint32_t now_us) {
    const bool by_hand = tour->by_hand;

    choose(tour, BUTTON_NOTHING, now_us);
    tour->by_hand = by_hand;
    return ++tour->skipped < (TUILE_TREE + 1u) * scene_count;
}
