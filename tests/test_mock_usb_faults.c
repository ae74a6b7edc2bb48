/* The fault sweep of displays on USB: each URB of opening, starting, two frames and closing fails once, in each way there is. The
 * error is told by the call that waits for it, in one line; it sticks; nothing is sent after it; resume or opening anew brings the
 * picture back; no URB and no file descriptor is left, and LeakSanitizer counts the memory. */
#include "support/check.h"

#include "../hal/display.h"
#include "../hal/usb/ax206.h"
#include "../hal/usb/gud.h"
#include "../sim/usb/ax206_model.h"
#include "../sim/usb/gud_model.h"
#include "mock/mock_usb.h"
#include "support/usb_card.h"

/* A URB that is held is waited for as long as this. Where the machine is so slow that another one takes longer, the run does not
 * count. */
#define HELD_MS 20u
#define LONG_MS 20000u

typedef struct scenario {
    const char *name;
    bool ax206;
    sim_gud_config_t gud;
    usb_card_way_t way;
    mock_usb_kernel_t kernel;
} scenario_t;

typedef struct rig {
    const scenario_t *scenario;
    sim_usb_t *model;
    mock_usb_t *device;
    tuile_gud_t gud;
    tuile_ax206_t ax206;
    tuile_display_t display;
    unsigned descriptors; /* file descriptors before anything was opened; each bed of umockdev's keeps a few */
} rig_t;

static void plug(rig_t *rig, const scenario_t *scenario) {
    *rig = (rig_t){.scenario = scenario};
    rig->model = scenario->ax206 ? sim_ax206_create(&(sim_ax206_config_t){.width = 16, .height = 12}, NULL)
                                 : sim_gud_create(&scenario->gud, NULL);
    assert_non_null(rig->model);
    rig->device = mock_usb_plug(1, rig->model);
    mock_usb_state(rig->device)->kernel = scenario->kernel;
    rig->descriptors = mock_usb_descriptors(0);
}

static void unplug(rig_t *rig) {
    mock_usb_clear();
    rig->model->destroy(rig->model);
}

static int open_device(rig_t *rig, uint32_t timeout_ms) {
    return rig->scenario->ax206 ? tuile_ax206_open(&rig->ax206, &(tuile_ax206_config_t){.timeout_ms = timeout_ms})
                                : tuile_gud_open(&rig->gud, &(tuile_gud_config_t){.timeout_ms = timeout_ms});
}

static int begin(rig_t *rig) {
    return tuile_display_init(
        &rig->display, &(tuile_display_config_t){.device = rig->scenario->ax206 ? &tuile_ax206_device : &tuile_gud_device,
                                                 .device_context = rig->scenario->ax206 ? (void *)&rig->ax206 : (void *)&rig->gud});
}

static void close_device(rig_t *rig) {
    tuile_ax206_close(&rig->ax206);
    tuile_gud_close(&rig->gud);
}

static const char *text(const rig_t *rig) { return rig->scenario->ax206 ? rig->ax206.error_text : rig->gud.error_text; }

static int draw(rig_t *rig, uint32_t seed) {
    usb_card_way_t way = rig->scenario->way;

    way.seed = seed;
    return usb_card_draw(&rig->display, &way);
}

static void check(const rig_t *rig, uint32_t seed) {
    usb_card_way_t way = rig->scenario->way;

    way.seed = seed;
    usb_card_check(rig->model, rig->display.wire, &way, 0);
}

/* What a fault may be called. One that cuts an answer may go unnoticed where answers have no fixed size. */
static bool may_be(mock_usb_fault_t fault, bool out, int error) {
    switch (fault) {
    case MOCK_USB_STALL: return error == TUILE_HAL_PROTOCOL;
    case MOCK_USB_PROTO: return error == TUILE_HAL_IO;
    case MOCK_USB_HOLD: return error == TUILE_HAL_TIMEOUT;
    case MOCK_USB_GONE: return error == TUILE_HAL_GONE;
    case MOCK_USB_NO_MEMORY: return error == TUILE_HAL_SIZE || error == TUILE_HAL_IO;
    case MOCK_USB_SHORT:
        if (out) { return error == TUILE_HAL_IO; }
        return error == TUILE_HAL_OK || error == TUILE_HAL_PROTOCOL || error == TUILE_HAL_UNSUPPORTED;
    default: return error == TUILE_HAL_OK;
    }
}

static void check_error(rig_t *rig, int error, unsigned k, mock_usb_fault_t fault) {
    const mock_usb_state_t *state = mock_usb_state(rig->device);

    if (!may_be(state->struck ? fault : MOCK_USB_FINE, state->out, error)) {
        fail_msg("%s: URB %u, fault %u: error %d, \"%s\"; model: %s", rig->scenario->name, k, fault, error, text(rig),
                 rig->model->fault.text);
    }
    if (error) {
        assert_true(strlen(text(rig)) > 10 && !strchr(text(rig), '\n'));
        if (fault == MOCK_USB_GONE) { assert_non_null(strstr(text(rig), "the device is gone")); }
        if (fault == MOCK_USB_HOLD) { assert_non_null(strstr(text(rig), "timed out")); }
        if (fault == MOCK_USB_STALL && !rig->scenario->ax206) { assert_non_null(strstr(text(rig), "status: ")); }
    }
}

/* Nothing is sent, and every call says the same. */
static void check_that_it_sticks(rig_t *rig, int error) {
    const unsigned before = mock_usb_state(rig->device)->submitted;
    const uint8_t pixels[4] = {0};

    assert_int_equal(rig->display.error, error);
    assert_int_equal(tuile_display_window(&rig->display, 0, 0, 8, 1), error);
    assert_int_equal(tuile_display_write(&rig->display, pixels, 2), error);
    assert_int_equal(tuile_display_wait(&rig->display), error);
    assert_int_equal(tuile_display_present(&rig->display), error);
    assert_int_equal(tuile_display_brightness(&rig->display, 9), error);
    assert_int_equal(mock_usb_state(rig->device)->submitted, before);
}

/* Opens, starts and draws; the first error ends it. */
static int run(rig_t *rig, uint32_t timeout_ms, bool *opened, bool *begun) {
    int result = open_device(rig, timeout_ms);

    *opened = !result;
    *begun = false;
    if (!result) {
        result = begin(rig);
        *begun = rig->display.device != NULL;
    }
    for (uint32_t seed = 1; seed <= 2 && !result; seed++) {
        if (!(result = draw(rig, seed))) { check(rig, seed); }
    }
    return result;
}

static void check_that_it_comes_back(rig_t *rig, bool opened, bool begun, int error) {
    int result;

    if (error == TUILE_HAL_GONE) {
        if (begun) { assert_int_equal(tuile_display_resume(&rig->display), TUILE_HAL_GONE); }
        if (begun) { (void)tuile_display_close(&rig->display); }
        close_device(rig);
        unplug(rig);
        plug(rig, rig->scenario);
        opened = begun = false;
    }
    if (!opened || !begun) {
        close_device(rig);
        result = open_device(rig, LONG_MS);
        if (!result) { result = begin(rig); }
    } else {
        result = tuile_display_resume(&rig->display);
        assert_true(rig->display.refresh);
    }
    if (!result) {
        usb_card_check_dark(rig->model);
        result = draw(rig, 3);
    }
    if (result || text(rig)[0]) {
        fail_msg("%s: after error %d: %s; model: %s", rig->scenario->name, error, text(rig), rig->model->fault.text);
    }
    check(rig, 3);
}

typedef enum outcome { UNTOUCHED, STRUCK, TOO_SLOW } outcome_t;

static outcome_t sweep_once(const scenario_t *scenario, unsigned k, mock_usb_fault_t fault) {
    const uint32_t timeout_ms = fault == MOCK_USB_HOLD ? HELD_MS : LONG_MS;
    const mock_usb_state_t *state;
    bool opened, begun, too_slow;
    int result;
    rig_t rig;

    plug(&rig, scenario);
    mock_usb_state(rig.device)->fault = fault;
    mock_usb_state(rig.device)->fault_at = k;
    state = mock_usb_state(rig.device);
    result = run(&rig, timeout_ms, &opened, &begun);
    too_slow = result == TUILE_HAL_TIMEOUT && !state->struck;
    if (!too_slow) { check_error(&rig, result, k, fault); }
    if (result && !too_slow) {
        rig.gud.usb.timeout_ms = rig.ax206.usb.timeout_ms = LONG_MS;
        if (begun) { check_that_it_sticks(&rig, result); }
        if (fault == MOCK_USB_SHORT) { rig.model->fault.text[0] = 0; } /* it has seen the host fall short */
        assert_string_equal(rig.model->fault.text, "");
        check_that_it_comes_back(&rig, opened, begun, result);
        state = mock_usb_state(rig.device);
        result = tuile_display_close(&rig.display);
        assert_int_equal(result, 0);
    } else if (!too_slow) {
        result = tuile_display_close(&rig.display);
        too_slow = result == TUILE_HAL_TIMEOUT && !state->struck;
        if (!too_slow) { check_error(&rig, result, k, fault); }
        if (fault == MOCK_USB_SHORT) { rig.model->fault.text[0] = 0; }
    }
    close_device(&rig);
    if (!too_slow) {
        /* A host that was kept from reading a status goes on without it. */
        if (strstr(rig.model->fault.text, "before the status of the set was read")) { rig.model->fault.text[0] = 0; }
        assert_string_equal(rig.model->fault.text, "");
        if (!state->gone && !result) { usb_card_check_dark(rig.model); }
    }
    assert_int_equal(state->pending, 0);
    assert_int_equal(state->submitted - (state->struck && fault == MOCK_USB_NO_MEMORY), state->reaped);
    assert_int_equal(mock_usb_descriptors(rig.descriptors), rig.descriptors);
    result = state->struck || (fault == MOCK_USB_GONE && !state->gone);
    unplug(&rig);
    if (too_slow) { return TOO_SLOW; }
    return result ? STRUCK : UNTOUCHED;
}

static unsigned count_urbs(const scenario_t *scenario) {
    bool opened, begun;
    unsigned count;
    rig_t rig;

    plug(&rig, scenario);
    assert_int_equal(run(&rig, LONG_MS, &opened, &begun), 0);
    assert_int_equal(tuile_display_close(&rig.display), 0);
    close_device(&rig);
    count = mock_usb_state(rig.device)->submitted;
    unplug(&rig);
    return count;
}

static void sweep(const scenario_t *scenario) {
    const unsigned urbs = count_urbs(scenario);
    unsigned struck = 0;

    for (unsigned fault = MOCK_USB_STALL; fault < MOCK_USB_FAULTS; fault++) {
        for (unsigned k = 1; k <= urbs; k++) {
            outcome_t outcome = TOO_SLOW;
            for (unsigned tries = 0; tries < 20 && outcome == TOO_SLOW; tries++) {
                outcome = sweep_once(scenario, k, (mock_usb_fault_t)fault);
            }
            assert_int_not_equal(outcome, TOO_SLOW);
            /* Only what has no bytes cannot be cut. */
            if (outcome == UNTOUCHED) { assert_int_equal(fault, MOCK_USB_SHORT); }
            struck += outcome == STRUCK;
        }
    }
    print_message("%s: %u URBs, %u faults\n", scenario->name, urbs, struck);
}

static void test_gud(void **state) {
    (void)state;
    sweep(&(scenario_t){.name = "gud", .gud = {.width = 16, .height = 12}, .way = {.tile_height = 7}});
}

static void test_gud_with_all_it_may_have(void **state) {
    (void)state;
    sweep(&(scenario_t){.name = "gud, status, LZ4, properties, small buffer",
                        .gud = {.width = 16,
                                .height = 12,
                                .status_on_set = true,
                                .lz4 = true,
                                .backlight = true,
                                .rotations = 15,
                                .max_buffer_bytes = 160},
                        .way = {.kind = USB_CARD_FLAT, .tile_height = 7}});
}

static void test_gud_of_whole_frames(void **state) {
    (void)state;
    sweep(&(scenario_t){.name = "gud, whole frames in pieces",
                        .gud = {.width = 16, .height = 12, .full_update = true, .max_buffer_bytes = 160},
                        .way = {.tile_width = 8, .tile_height = 7}});
}

static void test_gud_where_transfers_are_cut(void **state) {
    (void)state;
    sweep(&(scenario_t){.name = "gud, several URBs a transfer",
                        .gud = {.width = 160, .height = 128, .formats = {SIM_GUD_RGB565}},
                        .way = {.tile_height = 100},
                        .kernel = MOCK_USB_CUT});
}

static void test_ax206(void **state) {
    (void)state;
    sweep(&(scenario_t){.name = "ax206", .ax206 = true, .way = {.tile_height = 7}});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_gud, mock_usb_set_up),
        cmocka_unit_test_setup(test_gud_with_all_it_may_have, mock_usb_set_up),
        cmocka_unit_test_setup(test_gud_of_whole_frames, mock_usb_set_up),
        cmocka_unit_test_setup(test_gud_where_transfers_are_cut, mock_usb_set_up),
        cmocka_unit_test_setup(test_ax206, mock_usb_set_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
