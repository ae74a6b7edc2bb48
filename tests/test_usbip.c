/* USB/IP as a host sees it: bytes of its messages, by hand from the protocol's description, against a device that writes down what
 * it gets. */
#include "support/check.h"

#include "linux/usbip.h"

#include <errno.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#define LARGE_BYTES 1000003u /* more than a socket holds */

typedef struct device {
    sim_usb_t usb;
    uint8_t setup[8], endpoint;
    size_t length;
    uint64_t sum;
    int result;
} device_t;

static device_t *device_of(sim_usb_t *usb) { return (device_t *)usb; }

static int take(device_t *device, const uint8_t *data, size_t length) {
    device->length = length;
    device->sum = 0;
    for (size_t i = 0; i < length; i++) {
        device->sum = device->sum * 31 + data[i];
    }
    return device->result;
}

static int device_control(sim_usb_t *usb, const uint8_t setup[8], uint8_t *data, size_t length) {
    memcpy(device_of(usb)->setup, setup, 8);
    if (device_of(usb)->result < 0) { return device_of(usb)->result; }
    if (setup[0] & 0x80u) {
        memcpy(data, "\x11\x22\x33", 3);
        return 3;
    }
    (void)take(device_of(usb), data, length);
    return (int)length;
}

static int device_bulk(sim_usb_t *usb, uint8_t endpoint, uint8_t *data, size_t length) {
    device_of(usb)->endpoint = endpoint;
    if (device_of(usb)->result < 0) { return device_of(usb)->result; }
    if (endpoint & 0x80u) {
        memcpy(data, "\xAA\xBB", 2);
        return 2;
    }
    (void)take(device_of(usb), data, length);
    return (int)length;
}

static const uint8_t descriptors[] = {18, 1, 0, 2, 0, 0, 0, 64,   0x50, 0x1D, 0x4D, 0x61, 0, 1, 0, 0, 0, 1, /* device */
                                      9,  2, 9, 0, 0, 1, 0, 0x80, 50};                                      /* configuration */

/* A server at one end of a pair of sockets, the test at the other. */
typedef struct fixture {
    device_t device;
    usbip_t usbip;
    int host;
    sim_error_t error;
} fixture_t;

static int set_up(void **state) {
    static fixture_t fixture;
    int pair[2];

    if (socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0) { return -1; }
    fixture = (fixture_t){.host = pair[0], .usbip = {.socket = pair[1]}};
    fixture.usbip.usb = &fixture.device.usb;
    fixture.device.usb = (sim_usb_t){
        .control = device_control, .bulk = device_bulk, .descriptors = descriptors, .descriptors_bytes = sizeof descriptors};
    *state = &fixture;
    return 0;
}

static int tear_down(void **state) {
    const fixture_t *fixture = *state;

    (void)close(fixture->host);
    (void)close(fixture->usbip.socket);
    return 0;
}

static void put(const fixture_t *fixture, const void *bytes, size_t size_bytes) {
    assert_int_equal(send(fixture->host, bytes, size_bytes, MSG_NOSIGNAL), size_bytes);
}

static void get(const fixture_t *fixture, void *bytes, size_t size_bytes) {
    assert_int_equal(recv(fixture->host, bytes, size_bytes, MSG_WAITALL), size_bytes);
}

static void assert_silent(const fixture_t *fixture) {
    uint8_t byte;

    assert_int_equal(recv(fixture->host, &byte, 1, MSG_DONTWAIT), -1);
}

/* command, number, device, direction, endpoint; flags, length, start, packets, interval; setup. */
static void put_submit(const fixture_t *fixture, uint8_t number, uint8_t direction, uint8_t endpoint, uint32_t length,
                       const uint8_t setup[8]) {
    uint8_t header[48] = {0, 0, 0, 1, 0, 0, 0x07, number, 0, 1, 0, 2, 0, 0, 0, direction, 0, 0, 0, endpoint, 0, 0, 2, 0};

    header[24] = (uint8_t)(length >> 24);
    header[25] = (uint8_t)(length >> 16);
    header[26] = (uint8_t)(length >> 8);
    header[27] = (uint8_t)length;
    if (setup) { memcpy(header + 40, setup, 8); }
    put(fixture, header, sizeof header);
}

static void put_unlink(const fixture_t *fixture, uint8_t number, uint8_t victim) {
    const uint8_t header[48] = {0, 0, 0, 2, 0, 0, 0x07, number, 0, 1, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x07, victim};

    put(fixture, header, sizeof header);
}

static void assert_answer(fixture_t *fixture, uint8_t command, uint8_t number, int status, uint32_t actual) {
    const uint32_t s = (uint32_t)status;
    uint8_t header[48], expected[48] = {0, 0, 0, command, 0, 0, 0x07, number};

    for (unsigned i = 0; i < 4; i++) {
        expected[20 + i] = (uint8_t)(s >> (24 - 8 * i));
        expected[24 + i] = (uint8_t)(actual >> (24 - 8 * i));
        if (command == 3) { expected[32 + i] = 0xFF; } /* packets: not isochronous */
    }
    get(fixture, header, sizeof header);
    assert_memory_equal(header, expected, sizeof header);
}

static void serve(fixture_t *fixture) {
    if (usbip_serve(&fixture->usbip, &fixture->error) != 1) { fail_msg("%s", fixture->error.text); }
}

static void test_a_descriptor(void **state) {
    static const uint8_t setup[8] = {0x80, 6, 0, 1, 0, 0, 64, 0};
    fixture_t *fixture = *state;
    uint8_t data[18];

    put_submit(fixture, 1, 1, 0, 64, setup);
    serve(fixture);
    assert_answer(fixture, 3, 1, 0, 18);
    get(fixture, data, 18);
    assert_memory_equal(data, descriptors, 18);
    assert_silent(fixture);
}

static void test_requests_of_the_vendor(void **state) {
    static const uint8_t out[8] = {0x41, 0x60, 0, 0, 0, 0, 3, 0}, in[8] = {0xC1, 0x01, 0, 0, 0, 0, 30, 0};
    fixture_t *fixture = *state;
    uint8_t data[3];

    put_submit(fixture, 2, 0, 0, 3, out);
    put(fixture, "\1\2\3", 3);
    serve(fixture);
    assert_answer(fixture, 3, 2, 0, 3);
    assert_memory_equal(fixture->device.setup, out, 8);
    assert_true(fixture->device.sum == (1 * 31 + 2) * 31 + 3);
    put_submit(fixture, 3, 1, 0, 30, in);
    serve(fixture);
    assert_answer(fixture, 3, 3, 0, 3); /* shorter than asked for */
    get(fixture, data, 3);
    assert_memory_equal(data, "\x11\x22\x33", 3);
    assert_silent(fixture);
    assert_int_equal(fixture->usbip.submits, 2);
    assert_int_equal(fixture->usbip.bulks, 0);
}

static void test_bulk_both_ways(void **state) {
    fixture_t *fixture = *state;
    uint8_t data[2];

    put_submit(fixture, 1, 0, 2, 4, NULL);
    put(fixture, "\5\6\7\x08", 4);
    serve(fixture);
    assert_answer(fixture, 3, 1, 0, 4);
    assert_int_equal(fixture->device.endpoint, 0x02);
    assert_int_equal(fixture->device.length, 4);
    put_submit(fixture, 2, 1, 1, 512, NULL);
    serve(fixture);
    assert_answer(fixture, 3, 2, 0, 2);
    assert_int_equal(fixture->device.endpoint, 0x81);
    get(fixture, data, 2);
    assert_memory_equal(data, "\xAA\xBB", 2);
    assert_silent(fixture);
    assert_int_equal(fixture->usbip.bulks, 2);
}

static void test_stalls_carry_no_data(void **state) {
    static const uint8_t in[8] = {0xC1, 0x01, 0, 0, 0, 0, 30, 0};
    fixture_t *fixture = *state;

    fixture->device.result = -EPIPE;
    put_submit(fixture, 1, 1, 0, 30, in);
    put_submit(fixture, 2, 0, 2, 2, NULL);
    put(fixture, "\5\6", 2);
    serve(fixture);
    serve(fixture);
    assert_answer(fixture, 3, 1, -32, 0);
    assert_answer(fixture, 3, 2, -32, 0);
    assert_silent(fixture);
}

static void test_unlinks(void **state) {
    fixture_t *fixture = *state;

    put_submit(fixture, 1, 0, 2, 0, NULL);
    put_unlink(fixture, 2, 1); /* too late */
    serve(fixture);
    serve(fixture);
    assert_answer(fixture, 3, 1, 0, 0);
    assert_answer(fixture, 4, 2, 0, 0);

    fixture->usbip.hold = true;
    put_submit(fixture, 3, 0, 2, 1, NULL);
    put(fixture, "x", 1);
    put_submit(fixture, 4, 1, 1, 64, NULL);
    serve(fixture);
    serve(fixture);
    assert_silent(fixture);
    put_unlink(fixture, 5, 3);
    put_unlink(fixture, 6, 3);
    put_unlink(fixture, 7, 4);
    serve(fixture);
    serve(fixture);
    serve(fixture);
    assert_answer(fixture, 4, 5, -104, 0); /* ECONNRESET: it was still there */
    assert_answer(fixture, 4, 6, 0, 0);
    assert_answer(fixture, 4, 7, -104, 0);
    assert_silent(fixture);
    assert_int_equal(fixture->usbip.unlinks, 4);
    assert_int_equal(fixture->device.length, 0);
}

static uint8_t large[LARGE_BYTES];

static void *send_large(void *argument) {
    const fixture_t *fixture = argument;
    size_t done = 0;

    while (done < LARGE_BYTES) {
        const ssize_t now = send(fixture->host, large + done, LARGE_BYTES - done, MSG_NOSIGNAL);
        if (now <= 0) { break; }
        done += (size_t)now;
    }
    return NULL;
}

static void test_a_transfer_larger_than_the_socket(void **state) {
    fixture_t *fixture = *state;
    pthread_t thread;
    uint64_t sum = 0;

    for (size_t i = 0; i < LARGE_BYTES; i++) {
        large[i] = (uint8_t)(i * 7 + (i >> 8));
        sum = sum * 31 + large[i];
    }
    put_submit(fixture, 1, 0, 1, LARGE_BYTES, NULL);
    assert_int_equal(pthread_create(&thread, NULL, send_large, fixture), 0);
    serve(fixture);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_answer(fixture, 3, 1, 0, LARGE_BYTES);
    assert_int_equal(fixture->device.length, LARGE_BYTES);
    assert_true(fixture->device.sum == sum);
}

static void test_the_end(void **state) {
    fixture_t *fixture = *state;

    assert_int_equal(shutdown(fixture->host, SHUT_WR), 0);
    assert_int_equal(usbip_serve(&fixture->usbip, &fixture->error), 0);
}

static void assert_broken(fixture_t *fixture, const char *word) {
    assert_int_equal(shutdown(fixture->host, SHUT_WR), 0);
    assert_int_equal(usbip_serve(&fixture->usbip, &fixture->error), -1);
    if (!strstr(fixture->error.text, word)) { fail_msg("\"%s\" has no \"%s\"", fixture->error.text, word); }
    assert_silent(fixture);
}

static void test_a_header_that_breaks_off(void **state) {
    put(*state, "\0\0\0\1", 4);
    assert_broken(*state, "in a header");
}

static void test_data_that_break_off(void **state) {
    put_submit(*state, 1, 0, 1, 10, NULL);
    put(*state, "123456789", 9);
    assert_broken(*state, "in the data");
}

static void test_data_that_never_come(void **state) {
    put_submit(*state, 1, 0, 1, 10, NULL);
    assert_broken(*state, "in the data");
}

static void test_an_unknown_message(void **state) {
    static const uint8_t header[48] = {0, 0, 0, 5};

    put(*state, header, sizeof header);
    assert_broken(*state, "no message 5");
}

static void test_a_length_beyond_reason(void **state) {
    put_submit(*state, 1, 1, 1, 0x80000000u, NULL);
    assert_broken(*state, "2147483648 bytes");
}

static void test_a_direction_that_is_none(void **state) {
    put_submit(*state, 1, 2, 1, 0, NULL);
    assert_broken(*state, "direction 2");
}

static void test_an_endpoint_that_is_none(void **state) {
    put_submit(*state, 1, 0, 16, 0, NULL);
    assert_broken(*state, "endpoint 16");
}

static void test_more_transfers_than_can_be_held(void **state) {
    fixture_t *fixture = *state;

    fixture->usbip.hold = true;
    for (unsigned i = 0; i <= USBIP_HELD_MAX; i++) {
        put_submit(fixture, (uint8_t)i, 1, 1, 0, NULL);
    }
    for (unsigned i = 0; i < USBIP_HELD_MAX; i++) {
        serve(fixture);
    }
    assert_broken(fixture, "more than 16");
}

static void test_isochronous_transfers(void **state) {
    static const uint8_t header[48] = {[3] = 1, [19] = 1, [35] = 1};

    put(*state, header, sizeof header);
    assert_broken(*state, "isochronous");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_a_descriptor, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_requests_of_the_vendor, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_bulk_both_ways, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_stalls_carry_no_data, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_unlinks, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_transfer_larger_than_the_socket, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_the_end, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_header_that_breaks_off, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_data_that_break_off, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_data_that_never_come, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_an_unknown_message, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_length_beyond_reason, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_direction_that_is_none, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_an_endpoint_that_is_none, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_more_transfers_than_can_be_held, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_isochronous_transfers, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
