/* A GUD display with its model, plugged in, opened and drawn on. */
#ifndef TESTS_MOCK_GUD_STAND_H
#define TESTS_MOCK_GUD_STAND_H

#include "../../hal/display.h"
#include "../../hal/usb/gud.h"
#include "../../sim/usb/gud_model.h"
#include "../support/usb_card.h"
#include "mock_usb.h"

typedef struct gud_stand {
    sim_usb_t *model;
    mock_usb_t *device;
    tuile_gud_t gud;
    tuile_display_t display;
} gud_stand_t;

/* Makes the model and plugs it into port 1; config may be NULL. */
void gud_stand_plug(gud_stand_t *stand, const sim_gud_config_t *config);

/* Initialises the display on the open device, and returns what tuile_display_init does. */
int gud_stand_begin(gud_stand_t *stand, uint8_t wire, uint8_t rotation);

/* All of it: plugs in, opens, begins. */
void gud_stand_start(gud_stand_t *stand, const sim_gud_config_t *config, uint8_t wire, uint8_t rotation);

/* Draws and looks. */
void gud_stand_draw(gud_stand_t *stand, const usb_card_way_t *way, unsigned rotation);

/* Closes and clears away; fails the test when the model has refused anything or a URB is left. */
void gud_stand_finish(gud_stand_t *stand);

#endif
