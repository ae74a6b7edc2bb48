#include "gud_stand.h"

#include "../support/check.h"

void gud_stand_plug(gud_stand_t *stand, const sim_gud_config_t *config) {
    sim_error_t error = {""};

    *stand = (gud_stand_t){0};
    stand->model = sim_gud_create(config, &error);
    assert_string_equal(error.text, "");
    stand->device = mock_usb_plug(1, stand->model);
}

int gud_stand_begin(gud_stand_t *stand, uint8_t wire, uint8_t rotation) {
    return tuile_display_init(
        &stand->display,
        &(tuile_display_config_t){.device = &tuile_gud_device, .device_context = &stand->gud, .wire = wire, .rotation = rotation});
}

void gud_stand_start(gud_stand_t *stand, const sim_gud_config_t *config, uint8_t wire, uint8_t rotation) {
    gud_stand_plug(stand, config);
    assert_int_equal(tuile_gud_open(&stand->gud, NULL), 0);
    assert_int_equal(gud_stand_begin(stand, wire, rotation), 0);
}

void gud_stand_finish(gud_stand_t *stand) {
    tuile_gud_close(&stand->gud);
    assert_string_equal(stand->model->fault.text, "");
    assert_int_equal(mock_usb_state(stand->device)->pending, 0);
    mock_usb_clear();
    stand->model->destroy(stand->model);
}

void gud_stand_draw(gud_stand_t *stand, const usb_card_way_t *way, unsigned rotation) {
    const int result = usb_card_draw(&stand->display, way);
    assert_string_equal(stand->model->fault.text, "");
    assert_string_equal(stand->gud.error_text, "");
    assert_int_equal(result, 0);
    usb_card_check(stand->model, stand->display.wire, way, rotation);
}
