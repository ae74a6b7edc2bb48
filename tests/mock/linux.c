#include "linux.h"

#include "../support/check.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <linux/spi/spidev.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static mock_linux_t *board; /* the one that is open */
static UMockdevTestbed *bed;
static UMockdevIoctlBase *kernel;

static void misuse(mock_linux_t *mock, const char *what) {
    if (!mock->misuse.text[0]) { (void)sim_fail(&mock->misuse, "%s", what); }
}

static void *resolve(UMockdevIoctlData *data, size_t offset, size_t size_bytes, UMockdevIoctlData **child) {
    *child = umockdev_ioctl_data_resolve(data, offset, size_bytes, NULL);
    return *child ? (*child)->data : NULL;
}

static void update(UMockdevIoctlData *data, size_t offset, const void *bytes, size_t size_bytes) {
    uint8_t copy[1024];

    assert_true(size_bytes <= sizeof copy);
    memcpy(copy, bytes, size_bytes);
    umockdev_ioctl_data_update(data, offset, copy, (int)size_bytes);
}

/* ---- SPI -------------------------------------------------------------------------------------------------------- */

static uint32_t bufsiz_of(const mock_linux_t *mock) {
    const uint32_t told = mock->bufsiz ? mock->bufsiz : 4096;

    return mock->real_bufsiz ? mock->real_bufsiz : told;
}

static void pass_wire(mock_linux_t *mock, uint32_t size_bytes, uint32_t clock_hz) {
    const uint64_t ns = (uint64_t)size_bytes * 8u * UINT64_C(1000000000) / (clock_hz ? clock_hz : 500000);

    mock->now_ns += ns;
    if (mock->wire_time) {
        const uint64_t real_ns = ns + mock->late_us * UINT64_C(1000);
        const struct timespec time = {(time_t)(real_ns / 1000000000u), (long)(real_ns % 1000000000u)};
        (void)nanosleep(&time, NULL);
    }
}

/* Before the answer stand the clocks that nobody wants: one for 04h and 09h, eight for D3h (ILI9341, 8.2.3, 8.3.23). */
static void answer(mock_linux_t *mock, uint8_t command, uint8_t *bytes, size_t size_bytes) {
    uint8_t plain[32] = {0};
    const unsigned dummy = command == 0xD3 ? 8 : command == 0x04 || command == 0x09 ? 1 : 0;

    assert_true(size_bytes < sizeof plain);
    if (mock->reply) {
        memcpy(bytes, mock->reply, size_bytes);
        return;
    }
    if (mock->chip->read(mock->chip, command, plain, size_bytes - (dummy > 0), mock->now_ns)) {
        misuse(mock, mock->chip->fault.text);
    }
    memset(bytes, 0, size_bytes);
    for (size_t bit = 0; bit < 8 * (size_bytes - (dummy > 0)); bit++) {
        const unsigned value = (unsigned)plain[bit / 8] >> (7 - bit % 8) & 1u;
        bytes[(bit + dummy) / 8] |= (uint8_t)(value << (7 - (bit + dummy) % 8));
    }
}

/* What a transfer takes of bufsiz: spidev (drivers/spi/spidev.c) rounds it up to ARCH_KMALLOC_MINALIGN, at most 128 bytes, on
 * arm64. Smaller buffers are taken as of a machine that rounds to nothing. */
static uint32_t rounded(const mock_linux_t *mock, uint32_t size_bytes) {
    return bufsiz_of(mock) < 128 ? size_bytes : (size_bytes + 127u) / 128u * 128u;
}

static long message(mock_linux_t *mock, UMockdevIoctlData *arg, size_t count, bool cut, int *error) {
    UMockdevIoctlData *list, *buffer;
    const struct spi_ioc_transfer *transfers = resolve(arg, 0, count * sizeof *transfers, &list);
    uint32_t out = 0, in = 0, total = 0;
    uint8_t command = 0;

    if (mock->hold) { (void)sem_wait(&mock->go); }
    for (size_t i = 0; i < count; i++) {
        out += transfers[i].tx_buf ? rounded(mock, transfers[i].len) : 0;
        in += transfers[i].rx_buf ? rounded(mock, transfers[i].len) : 0;
        total += transfers[i].len;
    }
    if (out > bufsiz_of(mock) || in > bufsiz_of(mock)) {
        *error = EMSGSIZE;
        umockdev_ioctl_data_unref(list);
        return -1;
    }
    for (size_t i = 0; i < count; i++) {
        const struct spi_ioc_transfer *one = &transfers[i];
        const bool dc = mock->level[MOCK_DC];
        uint8_t *bytes;

        if (one->tx_buf) {
            bytes = resolve(list, i * sizeof *one + offsetof(struct spi_ioc_transfer, tx_buf), one->len, &buffer);
            command = bytes[0];
            if (mock->transfers < CHECK_COUNT(mock->log)) {
                mock->log[mock->transfers++] =
                    (mock_transfer_t){dc, one->len, one->speed_hz, one->bits_per_word, bytes[0], (uint8_t)count};
            }
            if (count == 1 &&
                mock->chip->receive(mock->chip, dc, bytes, cut ? one->len / 2 : one->len, one->speed_hz, mock->now_ns)) {
                misuse(mock, mock->chip->fault.text);
            }
        } else {
            uint8_t got[32];

            bytes = resolve(list, i * sizeof *one + offsetof(struct spi_ioc_transfer, rx_buf), one->len, &buffer);
            if (!bytes || i != 1 || dc || one->len > sizeof got) {
                misuse(mock, "a read without a command before it");
            } else {
                if (mock->transfers < CHECK_COUNT(mock->log)) {
                    mock->log[mock->transfers++] =
                        (mock_transfer_t){dc, one->len, one->speed_hz, one->bits_per_word, 0, (uint8_t)count};
                }
                answer(mock, command, got, one->len);
                update(buffer, 0, got, one->len);
            }
        }
        pass_wire(mock, one->len, one->speed_hz);
        umockdev_ioctl_data_unref(buffer);
    }
    umockdev_ioctl_data_unref(list);
    return (long)(cut ? total / 2 : total);
}

static long spi(mock_linux_t *mock, unsigned long request, UMockdevIoctlData *arg, bool cut, int *error) {
    UMockdevIoctlData *data;
    const uint32_t *word;

    if (_IOC_TYPE(request) != SPI_IOC_MAGIC) {
        *error = ENOTTY;
        return -1;
    }
    if (_IOC_NR(request) == _IOC_NR(SPI_IOC_MESSAGE(1)) && _IOC_DIR(request) == _IOC_WRITE) {
        return message(mock, arg, _IOC_SIZE(request) / sizeof(struct spi_ioc_transfer), cut, error);
    }
    if (!(word = resolve(arg, 0, 4, &data))) { misuse(mock, "an ioctl of spidev without its word"); }
    if (request == SPI_IOC_RD_MODE32) {
        update(data, 0, &mock->mode, 4);
    } else if (request == SPI_IOC_WR_MODE32) {
        mock->mode = *word;
    } else {
        misuse(mock, "an ioctl of spidev that is not known here");
    }
    umockdev_ioctl_data_unref(data);
    return 0;
}

/* ---- GPIO ------------------------------------------------------------------------------------------------------- */

static void drive(mock_linux_t *mock, unsigned offset, bool value) {
    const bool level = value != mock->requests[offset].active_low;

    if (offset == MOCK_RESET && level != mock->level[offset]) { mock->chip->reset(mock->chip, !level, mock->now_ns); }
    mock->level[offset] = level;
}

/* The file behind a descriptor; 0: none. */
static uint64_t file_of(int fd) {
    struct stat status;

    return fstat(fd, &status) ? 0 : (uint64_t)status.st_dev << 40 ^ status.st_ino;
}

static bool is_held(const mock_linux_t *mock, uint32_t offset) {
    return offset < MOCK_LINES && mock->requests[offset].file && file_of(mock->requests[offset].fd) == mock->requests[offset].file;
}

/* 0 or an errno. */
static int take(mock_linux_t *mock, uint32_t offset, uint32_t count, bool edges, bool active_low, bool value, const char *consumer,
                int *fd) {
    char path[64];
    int ends[2];
    mock_request_t *request;

    if (count != 1 || offset >= MOCK_LINES) { return EINVAL; }
    request = &mock->requests[offset];
    if (offset == MOCK_TAKEN || is_held(mock, offset)) { return EBUSY; }
    *request = (mock_request_t){.edges = edges, .active_low = active_low, .first_level = value, .fill = -1};
    (void)snprintf(request->consumer, sizeof request->consumer, "%s", consumer);
    if (edges) {
        assert_int_equal(pipe(ends), 0);
        request->fd = ends[0];
        request->fill = ends[1];
    } else {
        (void)snprintf(path, sizeof path, "/dev/gpioline%u", offset);
        request->fd = open(path, O_RDWR | O_CLOEXEC);
        assert_true(request->fd >= 0);
        drive(mock, offset, value);
    }
    *fd = request->fd;
    request->file = file_of(request->fd);
    return 0;
}

static int chip_v1(mock_linux_t *mock, unsigned long request, UMockdevIoctlData *arg) {
    UMockdevIoctlData *data;
    void *bytes = resolve(arg, 0, _IOC_SIZE(request), &data);
    int result = ENOTTY, fd = -1;

    if (request == GPIO_GET_LINEINFO_IOCTL) {
        struct gpioline_info info = *(struct gpioline_info *)bytes;
        if (info.line_offset == MOCK_TAKEN) {
            info.flags = GPIOLINE_FLAG_KERNEL;
            (void)snprintf(info.consumer, sizeof info.consumer, "spi0 CS0");
        } else if (is_held(mock, info.line_offset)) {
            info.flags = GPIOLINE_FLAG_KERNEL | GPIOLINE_FLAG_IS_OUT;
            (void)snprintf(info.consumer, sizeof info.consumer, "%s", mock->requests[info.line_offset].consumer);
        }
        update(data, 0, &info, sizeof info);
        result = info.line_offset < MOCK_LINES ? 0 : EINVAL;
    } else if (request == GPIO_GET_LINEHANDLE_IOCTL) {
        const struct gpiohandle_request *asked = bytes;
        if (!(asked->flags & GPIOHANDLE_REQUEST_OUTPUT)) { misuse(mock, "a line that is not an output"); }
        result = take(mock, asked->lineoffsets[0], asked->lines, false, asked->flags & GPIOHANDLE_REQUEST_ACTIVE_LOW,
                      asked->default_values[0], asked->consumer_label, &fd);
        update(data, offsetof(struct gpiohandle_request, fd), &fd, sizeof fd);
    } else if (request == GPIO_GET_LINEEVENT_IOCTL) {
        const struct gpioevent_request *asked = bytes;
        if (asked->eventflags != GPIOEVENT_REQUEST_RISING_EDGE) { misuse(mock, "edges that are not rising"); }
        result = take(mock, asked->lineoffset, 1, true, asked->handleflags & GPIOHANDLE_REQUEST_ACTIVE_LOW, false,
                      asked->consumer_label, &fd);
        update(data, offsetof(struct gpioevent_request, fd), &fd, sizeof fd);
    }
    umockdev_ioctl_data_unref(data);
    return result;
}

static int chip_v2(mock_linux_t *mock, unsigned long request, UMockdevIoctlData *arg) {
    UMockdevIoctlData *data;
    void *bytes = resolve(arg, 0, _IOC_SIZE(request), &data);
    int result = ENOTTY, fd = -1;

    if (request == GPIO_V2_GET_LINEINFO_IOCTL) {
        struct gpio_v2_line_info info = *(struct gpio_v2_line_info *)bytes;
        if (info.offset == MOCK_TAKEN) {
            info.flags = GPIO_V2_LINE_FLAG_USED;
            (void)snprintf(info.consumer, sizeof info.consumer, "spi0 CS0");
        } else if (is_held(mock, info.offset)) {
            info.flags = GPIO_V2_LINE_FLAG_USED;
            (void)snprintf(info.consumer, sizeof info.consumer, "%s", mock->requests[info.offset].consumer);
        }
        info.flags |= GPIO_V2_LINE_FLAG_INPUT;
        update(data, 0, &info, sizeof info);
        result = info.offset < MOCK_LINES ? 0 : EINVAL;
    } else if (request == GPIO_V2_GET_LINE_IOCTL) {
        const struct gpio_v2_line_request *asked = bytes;
        const struct gpio_v2_line_config *config = &asked->config;
        const bool edges = (config->flags & GPIO_V2_LINE_FLAG_EDGE_RISING) != 0;
        bool value = false;
        for (unsigned i = 0; i < config->num_attrs; i++) {
            if (config->attrs[i].attr.id == GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES) {
                value = config->attrs[i].attr.values & config->attrs[i].mask & 1;
            }
        }
        if (edges ? !(config->flags & GPIO_V2_LINE_FLAG_INPUT) : !(config->flags & GPIO_V2_LINE_FLAG_OUTPUT)) {
            misuse(mock, "a line of the wrong direction");
        }
        result = take(mock, asked->offsets[0], asked->num_lines, edges, config->flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW, value,
                      asked->consumer, &fd);
        update(data, offsetof(struct gpio_v2_line_request, fd), &fd, sizeof fd);
    }
    umockdev_ioctl_data_unref(data);
    return result;
}

static int chip(mock_linux_t *mock, unsigned long request, UMockdevIoctlData *arg) {
    static const struct gpiochip_info told = {.name = "gpiochip0", .label = "pinctrl-mock", .lines = MOCK_LINES};
    UMockdevIoctlData *data;

    if (request == GPIO_GET_CHIPINFO_IOCTL) {
        if (!resolve(arg, 0, sizeof told, &data)) { return EFAULT; }
        update(data, 0, &told, sizeof told);
        umockdev_ioctl_data_unref(data);
        return 0;
    }
    return request == GPIO_V2_GET_LINEINFO_IOCTL || request == GPIO_V2_GET_LINE_IOCTL ? chip_v2(mock, request, arg)
                                                                                      : chip_v1(mock, request, arg);
}

static int line(mock_linux_t *mock, unsigned offset, unsigned long request, UMockdevIoctlData *arg) {
    UMockdevIoctlData *data;
    const void *bytes = resolve(arg, 0, _IOC_SIZE(request), &data);
    int result = 0;

    if (request == GPIOHANDLE_SET_LINE_VALUES_IOCTL) {
        drive(mock, offset, ((const struct gpiohandle_data *)bytes)->values[0]);
    } else if (request == GPIO_V2_LINE_SET_VALUES_IOCTL) {
        const struct gpio_v2_line_values *values = bytes;
        if (values->mask != 1) { misuse(mock, "values of lines that were not asked for"); }
        drive(mock, offset, values->bits & 1);
    } else {
        result = ENOTTY;
    }
    umockdev_ioctl_data_unref(data);
    return result;
}

/* ---- the kernel ------------------------------------------------------------------------------------------------- */

static void pass_time(mock_linux_t *mock) {
    struct timespec now;
    uint64_t real_ns;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    real_ns = (uint64_t)now.tv_sec * UINT64_C(1000000000) + (uint64_t)now.tv_nsec;
    if (mock->real_time && real_ns > mock->now_ns) { mock->now_ns = real_ns; }
}

static gboolean handle(UMockdevIoctlBase *base, UMockdevIoctlClient *client, gpointer context) {
    mock_linux_t *mock = board;
    const char *node = umockdev_ioctl_client_get_devnode(client);
    const unsigned long request = umockdev_ioctl_client_get_request(client);
    UMockdevIoctlData *arg = umockdev_ioctl_client_get_arg(client);
    const bool is_spi = strstr(node, "spidev") != NULL;
    unsigned offset = 0;
    bool cut = false;
    int error = 0;
    long result = 0;

    (void)base, (void)context;
    pass_time(mock);
    if (++mock->calls == mock->fail_call) {
        cut = mock->cut && is_spi && _IOC_NR(request) == 0;
        error = cut ? 0 : mock->fail_errno ? mock->fail_errno : EIO;
        mock->gone = error == ESHUTDOWN;
    }
    if (mock->gone && !error) { error = is_spi ? ESHUTDOWN : ENODEV; }
    if (!error) {
        if (is_spi) {
            result = spi(mock, request, arg, cut, &error);
        } else if (sscanf(node, "/dev/gpioline%u", &offset) == 1) {
            error = line(mock, offset, request, arg);
        } else {
            error = chip(mock, request, arg);
        }
    }
    umockdev_ioctl_client_complete(client, error ? -1 : result, error);
    return TRUE;
}

static void add(const char *name, const char *subsystem, unsigned major, unsigned minor) {
    char text[256], node[64];

    (void)snprintf(text, sizeof text,
                   "P: /devices/platform/board/%s\nN: %s\nE: DEVNAME=/dev/%s\nE: SUBSYSTEM=%s\nA: dev=%u:%u\\n\n", name, name, name,
                   subsystem, major, minor);
    assert_true(umockdev_testbed_add_from_string(bed, text, NULL));
    (void)snprintf(node, sizeof node, "/dev/%s", name);
    assert_true(umockdev_testbed_attach_ioctl(bed, node, kernel, NULL));
}

static void make_nodes(void) {
    static const unsigned lines[] = {MOCK_DC, MOCK_RESET, MOCK_BACKLIGHT};

    bed = umockdev_testbed_new();
    assert_true(umockdev_in_mock_environment());
    kernel = umockdev_ioctl_base_new();
    (void)g_signal_connect(kernel, "handle-ioctl", G_CALLBACK(handle), NULL);
    add("spidev0.0", "spidev", 153, 0);
    add("gpiochip0", "gpio", 254, 0);
    for (size_t i = 0; i < CHECK_COUNT(lines); i++) {
        char name[32];
        (void)snprintf(name, sizeof name, "gpioline%u", lines[i]);
        add(name, "mem", 253, lines[i]);
    }
}

int mock_linux_end(void **state) {
    (void)state;
    g_clear_object(&bed);
    g_clear_object(&kernel);
    return 0;
}

static void put_bufsiz(uint32_t bufsiz, const char *other) {
    char *sys = umockdev_testbed_get_sys_dir(bed), *folder = g_strconcat(sys, "/module/spidev/parameters", NULL);
    char *path = g_strconcat(folder, "/bufsiz", NULL), text[16];

    (void)snprintf(text, sizeof text, "%u\n", bufsiz);
    (void)unlink(path);
    assert_int_equal(g_mkdir_with_parents(folder, 0755), 0);
    if (bufsiz || other) { assert_true(g_file_set_contents(path, other ? other : text, -1, NULL)); }
    g_free(path);
    g_free(folder);
    g_free(sys);
}

/* A node of the testbed is a pseudo-terminal. */
static unsigned count_terminals(void) {
    DIR *folder = opendir("/proc/self/fd");
    unsigned count = 0;

    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        char path[300], target[16] = "";
        (void)snprintf(path, sizeof path, "/proc/self/fd/%s", entry->d_name);
        count += readlink(path, target, sizeof target - 1) > 0 && strncmp(target, "/dev/pts/", 9) == 0;
    }
    (void)closedir(folder);
    return count;
}

void mock_linux_open(mock_linux_t *mock, const char *panel) {
    sim_error_t error = {""};

    board = mock;
    assert_int_equal(sem_init(&mock->go, 0, 0), 0);
    mock->chip = sim_panel_find(panel)->create(&error);
    assert_non_null(mock->chip);
    if (!bed) { make_nodes(); }
    mock->bed = bed;
    put_bufsiz(mock->bufsiz, mock->bufsiz_text);
    mock->level[MOCK_RESET] = true; /* pulled up on the module */
    mock->own_descriptors = count_terminals();
}

void mock_linux_close(mock_linux_t *mock) {
    for (unsigned i = 0; i < MOCK_LINES; i++) {
        if (mock->requests[i].edges) { (void)close(mock->requests[i].fill); }
    }
    mock->chip->destroy(mock->chip);
    (void)sem_destroy(&mock->go);
    board = NULL;
}

tuile_linux_config_t mock_linux_config(void) {
    return (tuile_linux_config_t){
        .spi = "/dev/spidev0.0",
        .dc = {.chip = "gpiochip0", .offset = MOCK_DC},
        .reset = {.chip = "gpiochip0", .offset = MOCK_RESET},
        .backlight = {.chip = "/dev/gpiochip0", .offset = MOCK_BACKLIGHT},
    };
}

static int delay(void *context, uint32_t delay_ms) {
    (void)context;
    board->now_ns += delay_ms * UINT64_C(1000000);
    return 0;
}

int mock_linux_port(mock_linux_t *mock, tuile_linux_t *port, const tuile_linux_config_t *config) {
    const int result = tuile_linux_open(port, config);

    assert_ptr_equal(mock, board);
    if (result == 0) { port->bus.delay_ms = delay; }
    return result;
}

unsigned mock_linux_descriptors(const mock_linux_t *mock) { return count_terminals() - mock->own_descriptors; }

unsigned mock_linux_held(const mock_linux_t *mock) {
    unsigned count = 0;

    for (unsigned i = 0; i < MOCK_LINES; i++) {
        count += is_held(mock, i);
    }
    return count;
}

void mock_linux_edge(mock_linux_t *mock) {
    const int fill = mock->requests[MOCK_TEARING].fill;

    if (tuile_linux_gpiod_version()[0] == '1') {
        const struct gpioevent_data event = {.timestamp = mock->now_ns, .id = GPIOEVENT_EVENT_RISING_EDGE};
        assert_int_equal(write(fill, &event, sizeof event), sizeof event);
    } else {
        const struct gpio_v2_line_event event = {
            .timestamp_ns = mock->now_ns, .id = GPIO_V2_LINE_EVENT_RISING_EDGE, .offset = MOCK_TEARING};
        assert_int_equal(write(fill, &event, sizeof event), sizeof event);
    }
}

sim_picture_t mock_linux_picture(const mock_linux_t *mock, unsigned rotation) {
    sim_picture_t glass = {0}, seen;
    sim_error_t error = {""};

    if (mock->chip->glass(mock->chip, &glass, &error)) { fail_msg("%s", error.text); }
    if (!mock->level[MOCK_BACKLIGHT]) { memset(glass.rgb, 0, (size_t)glass.width * glass.height * 3u); }
    assert_int_equal(sim_picture_turn(&glass, -(int)(rotation & 3u), &seen, &error), 0);
    sim_picture_free(&glass);
    return seen;
}
