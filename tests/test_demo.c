/* Parts of the demo that know no board: its button, its tour of scenes and methods, and its frame rate. */
#include "support/check.h"

#include "../firmware/button.h"
#include "../firmware/caption.h"
#include "../firmware/tour.h"

#define MS 1000u

/* Looks from `from` to `end`, every `step`, at one level; the events that came, as digits of a number. */
static unsigned look(button_t *button, bool pressed, uint32_t from, uint32_t end, uint32_t step) {
    unsigned events = 0;
    for (uint32_t at = 0; at < end - from; at += step) {
        const button_event_t event = button_look(button, pressed, from + at);
        if (event) { events = 10 * events + event; }
    }
    return events;
}

static button_t let_go(void) {
    button_t button = {0};
    assert_int_equal(button_look(&button, false, 12345), BUTTON_NOTHING);
    return button;
}

static void a_short_press_is_told_when_it_ends(void **state) {
    static const uint32_t lengths[] = {20 * MS, 21 * MS, 80 * MS, 599 * MS};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(lengths); i++) {
        button_t button = {0};
        assert_int_equal(look(&button, false, 0, 50 * MS, MS), 0);
        assert_int_equal(look(&button, true, 50 * MS, 50 * MS + lengths[i], MS), 0);
        assert_int_equal(button_look(&button, false, 50 * MS + lengths[i]), BUTTON_SHORT);
        assert_int_equal(look(&button, false, 51 * MS + lengths[i], 3000 * MS, MS), 0);
    }
}

static void a_long_press_is_told_once_while_it_lasts(void **state) {
    button_t button = let_go();
    (void)state;
    assert_int_equal(look(&button, true, 0, 600 * MS, MS), 0);
    assert_int_equal(button_look(&button, true, 600 * MS), BUTTON_LONG);
    assert_int_equal(look(&button, true, 601 * MS, 5000 * MS, MS), 0);
    assert_int_equal(look(&button, false, 5000 * MS, 6000 * MS, MS), 0);
}

/* 2 ms down, 1 ms up, and so on, for 18 ms after each change. */
static void bouncing_is_one_press(void **state) {
    button_t button = let_go();
    unsigned events = 0;
    (void)state;
    for (uint32_t at = 0; at < 400 * MS; at += MS / 2) {
        const bool bounces = at % (200 * MS) < 18 * MS, down = at < 200 * MS;
        const bool level = bounces && at / MS % 3 == 2 ? !down : down;
        const button_event_t event = button_look(&button, level, at);
        if (event) { events = 10 * events + event; }
    }
    assert_int_equal(events, BUTTON_SHORT);
}

/* Some emulators, and wires that are not there, have it low from the beginning. */
static void what_is_down_from_the_beginning_is_no_press(void **state) {
    button_t button = {0};
    (void)state;
    assert_int_equal(look(&button, true, 0, 5000 * MS, MS), 0);
    assert_int_equal(look(&button, false, 5000 * MS, 5100 * MS, MS), 0);
    assert_int_equal(look(&button, true, 5100 * MS, 5200 * MS, MS), 0);
    assert_int_equal(look(&button, false, 5200 * MS, 5300 * MS, MS), BUTTON_SHORT);
}

/* A frame may take longer than a press. */
static void rare_looks_see_a_press(void **state) {
    button_t button = {0};
    (void)state;
    assert_int_equal(button_look(&button, false, 0), 0);
    assert_int_equal(button_look(&button, true, 300 * MS), 0);
    assert_int_equal(button_look(&button, false, 600 * MS), BUTTON_SHORT);
    assert_int_equal(button_look(&button, true, 900 * MS), 0);
    assert_int_equal(button_look(&button, true, 1800 * MS), BUTTON_LONG);
    assert_int_equal(button_look(&button, false, 2000 * MS), 0);
}

/* The clock comes round after 71 minutes. */
static void presses_are_told_apart_while_the_clock_wraps(void **state) {
    static const uint32_t starts[] = {0, UINT32_MAX - 10 * MS, UINT32_MAX - 300 * MS, UINT32_MAX - 599 * MS};
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(starts); i++) {
        button_t button = let_go();
        const uint32_t start = starts[i];
        assert_int_equal(look(&button, true, start, start + 100 * MS, MS), 0);
        assert_int_equal(button_look(&button, false, start + 100 * MS), BUTTON_SHORT);
        assert_int_equal(look(&button, false, start + 101 * MS, start + 300 * MS, MS), 0);
        assert_int_equal(look(&button, true, start + 300 * MS, start + 1000 * MS, MS), BUTTON_LONG);
        assert_int_equal(look(&button, false, start + 1000 * MS, start + 2000 * MS, MS), 0);
        /* Just one round of the clock after the last change: not what bounces. */
        assert_int_equal(button_look(&button, true, start + 1000 * MS + 5), 0);
        assert_true(button.down);
    }
}

static void rates_are_tenths_rounded_to_nearest(void **state) {
    static const struct {
        uint32_t frames, us;
        unsigned rate;
    } cases[] = {
        {1, 1000000, 10},
        {31, 1000000, 310},
        {1, 3000000, 3},
        {2, 3000000, 7},
        {1, 199999, 50},
        {1, 202020, 50},
        {1, 202021, 49},
        {1, 20000001, 1},
        {1, UINT32_MAX, 1},
        {1000, 1000000, 9999},
        {1, 1, 9999},
        {UINT32_MAX, 1, 9999},
        {UINT32_MAX, UINT32_MAX, 9999},
    };
    (void)state;
    for (unsigned i = 0; i < CHECK_COUNT(cases); i++) {
        assert_int_equal(caption_rate(cases[i].frames, cases[i].us), cases[i].rate);
    }
}

/* ---- which scene, by which method ---- */

#define SECOND 1000000u

static bool shows(const tour_t *tour, const char *scene, uint8_t method) {
    return strcmp(scenes[tour->scene]->name, scene) == 0 && tour->method == method;
}

static void time_goes_through_all_pairs_in_order(void **state) {
    tour_t tour;
    uint32_t now = UINT32_MAX - 20 * SECOND;
    (void)state;
    tour_begin(&tour, TOUR_EVERY_US, now);
    for (unsigned round = 0; round < 2; round++) {
        for (unsigned scene = 0; scene < scene_count; scene++) {
            for (uint8_t method = 0; method <= TUILE_TREE; method++) {
                if (!(scenes[scene]->methods >> method & 1u)) { continue; }
                assert_true(shows(&tour, scenes[scene]->name, method));
                assert_false(tour_frame(&tour, BUTTON_NOTHING, now + 4999999));
                assert_true(tour_frame(&tour, BUTTON_NOTHING, now + 5000000));
                now += 5000000;
            }
        }
    }
}

static void a_short_press_is_the_next_method_and_a_long_one_the_next_scene(void **state) {
    static const struct {
        button_event_t event;
        const char *scene;
        uint8_t method;
    } presses[] = {
        {BUTTON_SHORT, "cube", TUILE_SCANLINE},  {BUTTON_SHORT, "cube", TUILE_WARNOCK},    {BUTTON_LONG, "room", TUILE_ZBUFFER},
        {BUTTON_LONG, "spider", TUILE_ZBUFFER},  {BUTTON_SHORT, "spider", TUILE_SCANLINE}, {BUTTON_SHORT, "spider", TUILE_WARNOCK},
        {BUTTON_SHORT, "spider", TUILE_PAINTER}, {BUTTON_SHORT, "bunny", TUILE_ZBUFFER}, /* spiders have no tree */
        {BUTTON_LONG, "model", TUILE_ZBUFFER},   {BUTTON_LONG, "cube", TUILE_ZBUFFER},
    };
    tour_t tour;
    (void)state;
    tour_begin(&tour, TOUR_EVERY_US, 0);
    for (unsigned i = 0; i < CHECK_COUNT(presses); i++) {
        assert_true(tour_frame(&tour, presses[i].event, (i + 1) * SECOND));
        assert_true(shows(&tour, presses[i].scene, presses[i].method));
    }
    /* Who presses is left alone for half a minute. */
    assert_false(tour_frame(&tour, BUTTON_NOTHING, 10 * SECOND + TOUR_BY_HAND_US - 1));
    assert_true(tour_frame(&tour, BUTTON_NOTHING, 10 * SECOND + TOUR_BY_HAND_US));
    assert_false(tour_frame(&tour, BUTTON_NOTHING, 10 * SECOND + TOUR_BY_HAND_US + TOUR_EVERY_US - 1));
    assert_true(tour_frame(&tour, BUTTON_NOTHING, 10 * SECOND + TOUR_BY_HAND_US + TOUR_EVERY_US));
}

static void what_cannot_be_drawn_is_left_out(void **state) {
    unsigned pairs = 0, tries;
    tour_t tour;
    (void)state;
    for (unsigned scene = 0; scene < scene_count; scene++) {
        pairs += (unsigned)__builtin_popcount(scenes[scene]->methods);
    }
    tour_begin(&tour, TOUR_EVERY_US, 0);
    assert_true(tour_skip(&tour, SECOND));
    assert_true(shows(&tour, "cube", TUILE_SCANLINE));
    assert_false(tour_frame(&tour, BUTTON_NOTHING, 2 * SECOND));
    for (unsigned round = 0; round < 2; round++) {
        for (tries = 1; tour_skip(&tour, 3 * SECOND); tries++) {
            assert_true(tries < 100);
        }
        assert_true(tries >= pairs); /* since the last frame each has had its turn */
        assert_false(tour_frame(&tour, BUTTON_NOTHING, 4 * SECOND));
    }
}

static void what_is_left_out_after_a_press_leaves_the_hand_in_charge(void **state) {
    tour_t tour;
    (void)state;
    tour_begin(&tour, TOUR_EVERY_US, 0);
    assert_true(tour_frame(&tour, BUTTON_SHORT, SECOND));
    assert_true(tour_skip(&tour, SECOND));
    assert_true(shows(&tour, "cube", TUILE_WARNOCK));
    assert_false(tour_frame(&tour, BUTTON_NOTHING, SECOND + TOUR_BY_HAND_US - 1));
    assert_true(tour_frame(&tour, BUTTON_NOTHING, SECOND + TOUR_BY_HAND_US));
}

static void a_rate_is_a_mean_over_half_a_second_of_one_scene(void **state) {
    tour_t tour;
    (void)state;
    tour_begin(&tour, TOUR_EVERY_US, 7);
    for (unsigned frame = 1; frame < 25; frame++) {
        (void)tour_frame(&tour, BUTTON_NOTHING, 7 + frame * 20000);
        assert_int_equal(tour.rate, 0);
    }
    (void)tour_frame(&tour, BUTTON_NOTHING, 7 + 500000);
    assert_int_equal(tour.rate, 500); /* 25 frames in half a second */
    (void)tour_frame(&tour, BUTTON_NOTHING, 7 + 500000 + 400000);
    assert_int_equal(tour.rate, 500);
    (void)tour_frame(&tour, BUTTON_NOTHING, 7 + 500000 + 800000);
    assert_int_equal(tour.rate, 25); /* 2 in 0.8 s */
    (void)tour_frame(&tour, BUTTON_SHORT, 7 + 1500000);
    assert_int_equal(tour.rate, 0);
    (void)tour_frame(&tour, BUTTON_NOTHING, 7 + 1500000 + 1000000);
    assert_int_equal(tour.rate, 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_short_press_is_told_when_it_ends),
        cmocka_unit_test(a_long_press_is_told_once_while_it_lasts),
        cmocka_unit_test(bouncing_is_one_press),
        cmocka_unit_test(what_is_down_from_the_beginning_is_no_press),
        cmocka_unit_test(rare_looks_see_a_press),
        cmocka_unit_test(presses_are_told_apart_while_the_clock_wraps),
        cmocka_unit_test(rates_are_tenths_rounded_to_nearest),
        cmocka_unit_test(time_goes_through_all_pairs_in_order),
        cmocka_unit_test(a_short_press_is_the_next_method_and_a_long_one_the_next_scene),
        cmocka_unit_test(what_cannot_be_drawn_is_left_out),
        cmocka_unit_test(what_is_left_out_after_a_press_leaves_the_hand_in_charge),
        cmocka_unit_test(a_rate_is_a_mean_over_half_a_second_of_one_scene),
    };
    return cmocka_run_group_tests_name("demo", tests, NULL, NULL);
}
