#include "mock_usb.h"

#include <dirent.h>
#include <errno.h>
#include <linux/usbdevice_fs.h>
#include <pthread.h>
#include <stddef.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <umockdev.h>

#include "../support/check.h"

#define PORTS 4
#define URBS_MAX 64

typedef struct urb {
    UMockdevIoctlData *data, *buffer; /* buffer: NULL without bytes */
    bool held, discarded;
    mock_usb_fault_t fault;
} urb_t;

struct mock_usb {
    mock_usb_state_t state;
    sim_usb_t *model;
    UMockdevIoctlBase *handler;
    char *sys_path;
    char node[32];
    urb_t urbs[URBS_MAX]; /* in the order of submission */
    unsigned urb_count;
    uint32_t halted; /* bit n: OUT endpoint n, bit 16 + n: IN */
};

static UMockdevTestbed *bed;
static mock_usb_t *devices[PORTS + 1];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* the handler runs in the bed's thread */

/* ---- URBs ------------------------------------------------------------------------------------------------------- */

static struct usbdevfs_urb *urb_of(const urb_t *urb) { return (struct usbdevfs_urb *)(void *)urb->data->data; }

static uint32_t endpoint_bit(unsigned endpoint) { return 1u << ((endpoint & 15u) + (endpoint & 0x80u ? 16u : 0u)); }

static int submit(mock_usb_t *device, UMockdevIoctlData *data) {
    mock_usb_state_t *state = &device->state;
    struct usbdevfs_urb *fields = (struct usbdevfs_urb *)(void *)data->data;
    urb_t *urb;

    state->submitted++;
    if (state->submitted == state->fault_at && state->fault == MOCK_USB_NO_MEMORY) {
        state->struck = true;
        state->out = fields->type != USBDEVFS_URB_TYPE_CONTROL && !(fields->endpoint & 0x80u);
        return ENOMEM;
    }
    assert_in_range(device->urb_count, 0, URBS_MAX - 1);
    urb = &device->urbs[device->urb_count++];
    *urb = (urb_t){.data = g_object_ref(data)};
    if (state->submitted == state->fault_at) { urb->fault = state->fault; }
    urb->held = urb->fault == MOCK_USB_HOLD;
    if (fields->buffer_length > 0) {
        urb->buffer = umockdev_ioctl_data_resolve(data, offsetof(struct usbdevfs_urb, buffer), (gsize)fields->buffer_length, NULL);
    }
    if ((unsigned)fields->buffer_length > state->largest_bytes) { state->largest_bytes = (unsigned)fields->buffer_length; }
    if (urb->held) { state->struck = true; }
    state->pending++;
    return 0;
}

/* What the device makes of a URB. Returns the status; moved: as the kernel counts them, without the setup packet. */
static int transfer(mock_usb_t *device, const urb_t *urb, int *moved) {
    const struct usbdevfs_urb *fields = urb_of(urb);
    uint8_t *bytes = urb->buffer ? urb->buffer->data : NULL;
    const bool control = fields->type == USBDEVFS_URB_TYPE_CONTROL,
               in = control ? (bytes[0] & 0x80u) != 0 : fields->endpoint & 0x80u;
    size_t length = (size_t)fields->buffer_length - (control ? 8u : 0u);
    int result;

    *moved = 0;
    if (urb->fault != MOCK_USB_FINE) {
        const bool matters = urb->fault != MOCK_USB_SHORT || length > 0;
        device->state.struck = device->state.struck || matters;
        if (matters) { device->state.out = !in; }
    }
    if (urb->fault == MOCK_USB_PROTO) { return -EPROTO; }
    if (urb->fault == MOCK_USB_STALL && !control) { device->halted |= endpoint_bit(fields->endpoint); }
    if (urb->fault == MOCK_USB_STALL || (!control && device->halted & endpoint_bit(fields->endpoint))) { return -EPIPE; }
    if (urb->fault == MOCK_USB_SHORT && !in && length) {
        length /= 2;
        if (!control) { (void)sim_usb_bulk(device->model, fields->endpoint, bytes, length); }
        *moved = (int)length;
        return 0;
    }
    result = control ? sim_usb_control(device->model, bytes, bytes + 8, length)
                     : sim_usb_bulk(device->model, fields->endpoint, bytes, length);
    if (result < 0) {
        if (!control && result == -EPIPE) { device->halted |= endpoint_bit(fields->endpoint); }
        return result;
    }
    *moved = urb->fault == MOCK_USB_SHORT ? result / 2 : result;
    return 0;
}

/* The first URB that is done; -1 when there is none. */
static int next_done(const mock_usb_t *device) {
    for (unsigned i = 0; i < device->urb_count; i++) {
        const urb_t *urb = &device->urbs[i];
        if (urb->discarded || device->state.gone) { return (int)i; }
        if (!urb->held) { return i == 0 || !device->urbs[0].held ? (int)i : -1; } /* in order, behind one that is stuck */
    }
    return -1;
}

static int reap(mock_usb_t *device, UMockdevIoctlData *to) {
    const int which = next_done(device);
    int32_t status = -ENOENT, moved = 0;
    urb_t urb;

    if (which < 0) { return device->state.gone ? ENODEV : EAGAIN; }
    urb = device->urbs[which];
    if (urb.fault == MOCK_USB_GONE) { device->state.gone = device->state.struck = true; }
    device->urb_count--;
    memmove(&device->urbs[which], &device->urbs[which + 1], (device->urb_count - (unsigned)which) * sizeof urb);
    if (device->state.gone) {
        status = -ESHUTDOWN; /* what a disconnect ends URBs with; they can still be reaped */
    } else if (!urb.discarded) {
        if (urb.buffer) { (void)umockdev_ioctl_data_reload(urb.buffer, NULL); }
        status = transfer(device, &urb, &moved);
        if (urb.fault != MOCK_USB_FINE && device->state.then_gone) { device->state.gone = true; }
        if (urb.buffer) { umockdev_ioctl_data_update(urb.buffer, 0, urb.buffer->data, urb.buffer->data_len); }
    }
    umockdev_ioctl_data_update(urb.data, offsetof(struct usbdevfs_urb, status), (guint8 *)&status, sizeof status);
    umockdev_ioctl_data_update(urb.data, offsetof(struct usbdevfs_urb, actual_length), (guint8 *)&moved, sizeof moved);
    umockdev_ioctl_data_set_ptr(to, 0, urb.data);
    g_object_unref(urb.data);
    if (urb.buffer) { g_object_unref(urb.buffer); }
    device->state.reaped++;
    device->state.pending--;
    return 0;
}

static int discard(mock_usb_t *device, gulong address) {
    for (unsigned i = 0; i < device->urb_count; i++) {
        if (device->urbs[i].data->client_addr != address) { continue; }
        device->urbs[i].discarded = true;
        device->state.discarded++;
        return 0;
    }
    return EINVAL;
}

/* ---- interfaces and drivers ------------------------------------------------------------------------------------- */

static int claim(mock_usb_t *device, bool detach) {
    if (device->state.busy) { return EBUSY; }
    if (device->state.driver && !detach) { return EBUSY; }
    device->state.driver = false;
    device->state.claims++;
    return 0;
}

/* The ioctl for a driver: connect is the only one that is asked for. */
static int driver_ioctl(mock_usb_t *device, const UMockdevIoctlData *data, long *result) {
    const struct usbdevfs_ioctl *fields = (const struct usbdevfs_ioctl *)(const void *)data->data;

    if ((unsigned)fields->ioctl_code != USBDEVFS_CONNECT) { return ENOTTY; }
    device->state.driver = true;
    *result = 1;
    return 0;
}

static int clear_halt(mock_usb_t *device, unsigned endpoint) {
    const uint8_t setup[8] = {0x02, 1, 0, 0, (uint8_t)endpoint}; /* CLEAR_FEATURE(ENDPOINT_HALT), which the kernel sends */

    device->halted &= ~endpoint_bit(endpoint);
    device->state.halts_cleared++;
    (void)sim_usb_control(device->model, setup, NULL, 0);
    return 0;
}

/* ---- ioctls ----------------------------------------------------------------------------------------------------- */

static int answer(mock_usb_t *device, unsigned long request, UMockdevIoctlClient *client, long *result) {
    UMockdevIoctlData *arg = umockdev_ioctl_client_get_arg(client), *data = NULL;
    guint32 capabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
    int error = 0;

    if (device->state.gone && request != USBDEVFS_REAPURB && request != USBDEVFS_REAPURBNDELAY) { return ENODEV; }
    if (request == USBDEVFS_DISCARDURB) {
        gulong address;
        memcpy(&address, arg->data, sizeof address);
        return discard(device, address);
    }
    if (_IOC_SIZE(request)) { data = umockdev_ioctl_data_resolve(arg, 0, _IOC_SIZE(request), NULL); }
    switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
        if (device->state.kernel == MOCK_USB_WHOLE) {
            capabilities |= USBDEVFS_CAP_BULK_SCATTER_GATHER | USBDEVFS_CAP_NO_PACKET_SIZE_LIM;
        }
        umockdev_ioctl_data_update(data, 0, (guint8 *)&capabilities, sizeof capabilities);
        break;
    case USBDEVFS_CLAIMINTERFACE: error = claim(device, false); break;
    case USBDEVFS_DISCONNECT_CLAIM: error = claim(device, true); break;
    case USBDEVFS_RELEASEINTERFACE: device->state.releases++; break;
    case USBDEVFS_GETDRIVER: error = device->state.driver ? 0 : ENODATA; break;
    case USBDEVFS_IOCTL: error = driver_ioctl(device, data, result); break;
    case USBDEVFS_CLEAR_HALT: error = clear_halt(device, data->data[0]); break;
    case USBDEVFS_SUBMITURB: error = submit(device, data); break;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY: error = reap(device, data); break;
    default: error = ENOTTY;
    }
    if (data) { g_object_unref(data); }
    return error;
}

static gboolean handle(UMockdevIoctlBase *base, UMockdevIoctlClient *client, gpointer context) {
    long result = 0;
    int error;

    (void)base;
    pthread_mutex_lock(&lock);
    error = answer(context, umockdev_ioctl_client_get_request(client), client, &result);
    pthread_mutex_unlock(&lock);
    umockdev_ioctl_client_complete(client, error ? -1 : result, error);
    return TRUE;
}

/* ---- the bed ---------------------------------------------------------------------------------------------------- */

void mock_usb_bed(void) {
    if (!bed) { bed = umockdev_testbed_new(); }
}

mock_usb_t *mock_usb_plug(unsigned port, sim_usb_t *model) {
    mock_usb_t *device = calloc(1, sizeof *device);
    char text[4096];
    int count;

    assert_in_range(port, 1, PORTS);
    assert_null(devices[port]);
    mock_usb_bed();
    devices[port] = device;
    device->model = model;
    device->handler = umockdev_ioctl_base_new();
    g_signal_connect(device->handler, "handle-ioctl", G_CALLBACK(handle), device);
    (void)snprintf(device->node, sizeof device->node, "/dev/bus/usb/001/%03u", port + 1);
    count = snprintf(
        text, sizeof text,
        "P: /devices/usb1/1-%u\nN: bus/usb/001/%03u\n"
        "E: DEVNAME=%s\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=%03u\nE: MAJOR=189\nE: MINOR=%u\n"
        "A: busnum=1\\n\nA: devnum=%u\\n\nA: speed=480\\n\nA: bConfigurationValue=1\\n\n"
        "A: idVendor=%04x\\n\nA: idProduct=%04x\\n\nH: descriptors=",
        port, port + 1, device->node, port + 1, port, port + 1, sim_usb_u16(model->descriptors + 8),
        sim_usb_u16(model->descriptors + 10));
    for (size_t i = 0; i < model->descriptors_bytes; i++) {
        count += snprintf(text + count, sizeof text - (size_t)count, "%02X", model->descriptors[i]);
    }
    (void)snprintf(text + count, sizeof text - (size_t)count, "\n");
    model->reset(model);
    (void)asprintf(&device->sys_path, "/sys/devices/usb1/1-%u", port);
    /* In one go with its handler: whoever is waiting for it opens it at once. */
    pthread_mutex_lock(&lock);
    assert_true(umockdev_testbed_add_from_string(bed, text, NULL));
    assert_true(umockdev_testbed_attach_ioctl(bed, device->node, device->handler, NULL));
    pthread_mutex_unlock(&lock);
    umockdev_testbed_uevent(bed, device->sys_path, "add");
    return device;
}

mock_usb_state_t *mock_usb_state(mock_usb_t *device) { return &device->state; }

void mock_usb_unplug(mock_usb_t *device) {
    pthread_mutex_lock(&lock);
    device->state.gone = true;
    pthread_mutex_unlock(&lock);
    umockdev_testbed_uevent(bed, device->sys_path, "remove");
    umockdev_testbed_remove_device(bed, device->sys_path);
}

void mock_usb_forbid(mock_usb_t *device) {
    gchar *root = umockdev_testbed_get_root_dir(bed);
    char path[256];

    assert_int_equal(chmod(root, 0777), 0); /* libusb's sockets for hot plug are made in there */
    (void)snprintf(path, sizeof path, "%s%s", root, device->node);
    assert_int_equal(chmod(path, 0), 0);
    /* The wrapper of open() connects to the handler even where open() fails. */
    (void)snprintf(path, sizeof path, "%s/ioctl%s", root, device->node);
    assert_int_equal(chmod(path, 0777), 0);
    g_free(root);
}

void mock_usb_clear(void) {
    for (unsigned port = 1; port <= PORTS; port++) {
        mock_usb_t *device = devices[port];
        if (!device) { continue; }
        devices[port] = NULL;
        (void)umockdev_testbed_detach_ioctl(bed, device->node, NULL);
        for (unsigned i = 0; i < device->urb_count; i++) {
            g_object_unref(device->urbs[i].data);
            if (device->urbs[i].buffer) { g_object_unref(device->urbs[i].buffer); }
        }
        g_object_unref(device->handler);
        free(device->sys_path);
        free(device);
    }
    if (bed) { g_object_unref(bed); }
    bed = NULL;
}

int mock_usb_set_up(void **state) {
    (void)state;
    mock_usb_clear();
    return 0;
}

unsigned mock_usb_descriptors(unsigned expected) {
    unsigned count = 0;

    for (unsigned tries = 0; tries < 200; tries++) {
        DIR *folder = opendir("/proc/self/fd");
        const struct dirent *entry;
        count = 0;
        assert_non_null(folder);
        while ((entry = readdir(folder))) {
            count += entry->d_name[0] != '.';
        }
        closedir(folder);
        if (!expected || count == expected) { break; }
        usleep(5000);
    }
    return count;
}
