#include "usbip.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

enum { CMD_SUBMIT = 1, CMD_UNLINK = 2, RET_SUBMIT = 3, RET_UNLINK = 4 };
enum { TO_HOST = 1 };                                                                  /* directions: 0 is from the host */
enum { COMMAND = 0, NUMBER = 4, DIRECTION = 12, ENDPOINT = 16 };                       /* places of all headers */
enum { LENGTH = 24, PACKETS = 32, SETUP = 40, VICTIM = 20, STATUS = 20, ACTUAL = 24 }; /* of a submit; an unlink; an answer */

#define LENGTH_MAX_BYTES (64u << 20)
#define NOT_ISOCHRONOUS UINT32_MAX

static uint32_t get_u32(const uint8_t *bytes) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void put_u32(uint8_t *bytes, uint32_t value) {
    bytes[0] = (uint8_t)(value >> 24);
    bytes[1] = (uint8_t)(value >> 16);
    bytes[2] = (uint8_t)(value >> 8);
    bytes[3] = (uint8_t)value;
}

/* 1: all of them; 0: the other end closed before the first; -1: within. */
static int receive_all(int socket, uint8_t *bytes, size_t size_bytes) {
    size_t done = 0;

    while (done < size_bytes) {
        const ssize_t now = recv(socket, bytes + done, size_bytes - done, 0);
        if (now < 0 && errno == EINTR) { continue; }
        if (now <= 0) { return done == 0 ? 0 : -1; }
        done += (size_t)now;
    }
    return 1;
}

/* Whether the other end still takes it is found out by the next receive. */
static void send_all(int socket, const uint8_t *bytes, size_t size_bytes) {
    while (size_bytes > 0) {
        const ssize_t now = send(socket, bytes, size_bytes, MSG_NOSIGNAL);
        if (now < 0 && errno == EINTR) { continue; }
        if (now <= 0) { return; }
        bytes += now;
        size_bytes -= (size_t)now;
    }
}

static void answer(const usbip_t *usbip, uint32_t command, uint32_t number, int status, const uint8_t *data, size_t moved_bytes,
                   size_t data_bytes) {
    uint8_t header[USBIP_HEADER_BYTES] = {0};

    put_u32(header + COMMAND, command);
    put_u32(header + NUMBER, number);
    put_u32(header + STATUS, (uint32_t)status);
    if (command == RET_SUBMIT) {
        put_u32(header + ACTUAL, (uint32_t)moved_bytes);
        put_u32(header + PACKETS, NOT_ISOCHRONOUS);
    }
    send_all(usbip->socket, header, sizeof header);
    send_all(usbip->socket, data, data_bytes);
}

static int transfer(usbip_t *usbip, const uint8_t *header, uint8_t *data, size_t length) {
    const uint32_t endpoint = get_u32(header + ENDPOINT);

    if (endpoint == 0) { return sim_usb_control(usbip->usb, header + SETUP, data, length); }
    return sim_usb_bulk(usbip->usb, (uint8_t)(endpoint | (get_u32(header + DIRECTION) == TO_HOST ? 0x80u : 0)), data, length);
}

static int submit(usbip_t *usbip, const uint8_t *header, sim_error_t *error) {
    const uint32_t number = get_u32(header + NUMBER), length = get_u32(header + LENGTH), packets = get_u32(header + PACKETS);
    const bool to_host = get_u32(header + DIRECTION) == TO_HOST, bulk = get_u32(header + ENDPOINT) != 0;
    uint8_t *data;
    int result;

    if (length > LENGTH_MAX_BYTES || get_u32(header + DIRECTION) > 1 || get_u32(header + ENDPOINT) > 15) {
        return sim_fail(error, "usbip: a transfer of %u bytes, direction %u, at endpoint %u", length, get_u32(header + DIRECTION),
                        get_u32(header + ENDPOINT));
    }
    if (packets != 0 && packets != NOT_ISOCHRONOUS) { return sim_fail(error, "usbip: an isochronous transfer"); }
    data = calloc(length + 1u, 1);
    if (!data) { return sim_fail(error, "usbip: no memory for %u bytes", length); }
    if (!to_host && length > 0 && receive_all(usbip->socket, data, length) != 1) {
        free(data);
        return sim_fail(error, "usbip: the host broke off in the data of a transfer");
    }
    usbip->submits++;
    usbip->bulks += bulk;
    if (bulk && usbip->hold) {
        free(data);
        if (usbip->held_count == USBIP_HELD_MAX) { return sim_fail(error, "usbip: more than %u transfers held", USBIP_HELD_MAX); }
        usbip->held[usbip->held_count++] = number;
        return 1;
    }
    result = transfer(usbip, header, data, length);
    answer(usbip, RET_SUBMIT, number, result < 0 ? result : 0, data, result < 0 ? 0 : (size_t)result,
           result < 0 || !to_host ? 0 : (size_t)result);
    free(data);
    return 1;
}

/* -ECONNRESET when the transfer was still held; 0 when it has been answered. */
static int take_back(usbip_t *usbip, uint32_t number) {
    for (uint32_t i = 0; i < usbip->held_count; i++) {
        if (usbip->held[i] == number) {
            usbip->held[i] = usbip->held[--usbip->held_count];
            return -ECONNRESET;
        }
    }
    return 0;
}

int usbip_serve(usbip_t *usbip, sim_error_t *error) {
    uint8_t header[USBIP_HEADER_BYTES];
    const int result = receive_all(usbip->socket, header, sizeof header);

    if (result < 0) { return sim_fail(error, "usbip: the host broke off in a header"); }
    if (result == 0) { return 0; }
    switch (get_u32(header + COMMAND)) {
    case CMD_SUBMIT: return submit(usbip, header, error);
    case CMD_UNLINK:
        usbip->unlinks++;
        answer(usbip, RET_UNLINK, get_u32(header + NUMBER), take_back(usbip, get_u32(header + VICTIM)), NULL, 0, 0);
        return 1;
    default: return sim_fail(error, "usbip: there is no message %u", get_u32(header + COMMAND));
    }
}
