/* Which scene the demo shows, and by which method: a button's, or time's. And how many frames a second come. */
#ifndef TUILE_FIRMWARE_TOUR_H
#define TUILE_FIRMWARE_TOUR_H

#include "button.h"
#include "scenes.h"

#define TOUR_EVERY_US 5000000u    /* from one change to the next, if nobody presses the button */
#define TOUR_BY_HAND_US 30000000u /* and after somebody has */
#define TOUR_RATE_US 500000u      /* a rate is a mean over so long at least */

/* Times wrap; calls come more often than that. */
typedef struct tour {
    uint8_t scene;  /* index in scenes[] */
    uint8_t method; /* tuile_method_t, of the scene's */
    uint16_t rate;  /* as caption_t has it; 0 until the scene has been shown for some time */
    bool by_hand;
    uint32_t every_us, changed_us, counted_us;
    uint32_t frames;  /* since counted_us */
    uint32_t skipped; /* pairs of scene and method that could not be drawn, since the last that could */
} tour_t;

/* The first scene by its first method. */
void tour_begin(tour_t *tour, uint32_t every_us, uint32_t now_us);

/* A frame has been shown, and what the button did meanwhile. True when another scene or method is to be opened: after a short press
 * and by time the next method, and behind the last one the next scene; after a long press the next scene. */
bool tour_frame(tour_t *tour, button_event_t event, uint32_t now_us);

/* This one cannot be drawn: the next. False when none of all could. */
bool tour_skip(tour_t *tour, uint32_t now_us);

#endif
