#include "target.h"

#include "render_value.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char target_usage[] =
    "  sim:PANEL[,clock=HZ][,mcu=NAME][,chunk=BYTES]\n"
    "                           a simulated panel; mcu: as --mcu, one of `tuile mcus`\n"
    "  spi:/dev/spidevB.C,panel=PANEL,dc=CHIP:LINE[,rst=...][,bl=...][,te=...][,clock=HZ][,mode=0...3][,worker=0]\n"
    "                           a panel on Linux's spidev, its lines by GPIO chip and number, like gpiochip0:25, or\n"
    "                           gpiochip0:25:low where the line is active low\n"
    "  usb:gud[,serial=S][,mode=WxH][,lz4=0|1]\n"
    "                           a display on USB that speaks GUD\n"
    "  usb:ax206[,serial=S]     a photo frame with an AX206\n"
    "Panels take also bgr=0|1, invert=0|1, offset=X:Y where a module differs from its data, identify=1, command-clock=HZ;\n"
    "displays on USB wait=SECONDS for one to be plugged in, timeout=MS of a transfer; all take brightness=1...255.\n"
    "`tuile panels` lists panels, `tuile displays` what is attached.\n";

/* One "key=value" of the text. */
typedef struct part {
    const char *key, *value;
} part_t;

static int refuse(const target_config_t *config, const part_t *part, const char *wants, sim_error_t *error) {
    return sim_fail(error, "%s: %s=%s: wants %s", config->text, part->key, part->value, wants);
}

static bool read_number(const char *text, unsigned long least, unsigned long most, uint32_t *value) {
    char *end;
    errno = 0;
    const unsigned long number = strtoul(text, &end, 10);
    if (end == text || *end || errno || text[0] == '-' || number < least || number > most) { return false; }
    *value = (uint32_t)number;
    return true;
}

static bool read_clock(const char *text, uint32_t *hz) {
    size_t value;
    if (!render_value_hz(text, &value) || value == 0) { return false; }
    *hz = (uint32_t)value;
    return true;
}

static bool read_flag(const char *text, bool *flag) {
    uint32_t value;
    if (!read_number(text, 0, 1, &value)) { return false; }
    *flag = value != 0;
    return true;
}

#define TEARING_TIMEOUT_MS 100u /* a panel refreshes 30 times a second or more */
#define WANTS_CLOCK "Hz, like 40M, up to 1000M"
#define WANTS_FLAG "0 or 1"

/* What any panel on a bus takes. 1: it was one of them; 0: it is another's; -1. */
static int panel_part(target_config_t *config, const part_t *part, sim_error_t *error) {
    tuile_panel_t *panel = &config->panel;
    uint32_t number;
    bool flag;
    if (strcmp(part->key, "clock") == 0) {
        return read_clock(part->value, &config->clock_hz) ? 1 : refuse(config, part, WANTS_CLOCK, error);
    }
    if (strcmp(part->key, "command-clock") == 0) {
        return read_clock(part->value, &config->command_clock_hz) ? 1 : refuse(config, part, WANTS_CLOCK, error);
    }
    if (strcmp(part->key, "brightness") == 0) {
        if (!read_number(part->value, 1, 255, &number)) { return refuse(config, part, "1 to 255", error); }
        config->brightness = (uint8_t)number;
        return 1;
    }
    if (strcmp(part->key, "identify") == 0) {
        return read_flag(part->value, &config->identify) ? 1 : refuse(config, part, WANTS_FLAG, error);
    }
    if (strcmp(part->key, "bgr") == 0) {
        if (!read_flag(part->value, &flag)) { return refuse(config, part, WANTS_FLAG, error); }
        if (!panel->order_bit) {
            return sim_fail(error, "%s: bgr: %s has no order of colours to choose", config->text, panel->name);
        }
        panel->rotation_base = (uint8_t)(flag ? panel->rotation_base | panel->order_bit : panel->rotation_base & ~panel->order_bit);
        return 1;
    }
    if (strcmp(part->key, "invert") == 0) {
        if (!read_flag(part->value, &flag)) { return refuse(config, part, WANTS_FLAG, error); }
        if (!panel->invert_command[flag]) { return sim_fail(error, "%s: invert: %s does not invert", config->text, panel->name); }
        panel->inverted = flag;
        return 1;
    }
    if (strcmp(part->key, "offset") == 0) {
        unsigned x, y;
        char rest;
        if (sscanf(part->value, "%4u:%4u%c", &x, &y, &rest) != 2 || x + panel->view_width > panel->ram_width ||
            y + panel->view_height > panel->ram_height) {
            char wants[80];
            (void)snprintf(wants, sizeof wants, "X:Y, at most %u:%u, since the chip has memory for %ux%u",
                           (unsigned)panel->ram_width - panel->view_width, (unsigned)panel->ram_height - panel->view_height,
                           panel->ram_width, panel->ram_height);
            return refuse(config, part, wants, error);
        }
        panel->offset_x = (uint16_t)x;
        panel->offset_y = (uint16_t)y;
        return 1;
    }
    return 0;
}

static int sim_part(target_config_t *config, const part_t *part, sim_error_t *error) {
    if (strcmp(part->key, "mcu") == 0) {
        config->mcu = sim_mcu_find(part->value);
        return config->mcu ? 1 : refuse(config, part, "one that `tuile mcus` lists", error);
    }
    if (strcmp(part->key, "chunk") == 0) {
        return read_number(part->value, TUILE_CHUNK_LEAST_BYTES, UINT32_MAX, &config->max_chunk_bytes)
                   ? 1
                   : refuse(config, part, "bytes, at least 6", error);
    }
    return panel_part(config, part, error);
}

static bool read_line(const char *text, target_line_t *line) {
    const char *colon = strchr(text, ':');
    const size_t length = colon ? (size_t)(colon - text) : 0;
    char number[12];
    uint32_t offset;
    if (length == 0 || length >= sizeof line->chip) { return false; }
    const size_t digits = strcspn(colon + 1, ":");
    if (digits >= sizeof number) { return false; }
    (void)snprintf(number, sizeof number, "%.*s", (int)digits, colon + 1);
    const char *rest = colon + 1 + digits;
    if (!read_number(number, 0, 65535, &offset) || (*rest && strcmp(rest, ":low") != 0)) { return false; }
    (void)snprintf(line->chip, sizeof line->chip, "%.*s", (int)length, text);
    line->offset = offset;
    line->active_low = *rest != '\0';
    return true;
}

static int usb_part(target_config_t *config, const part_t *part, sim_error_t *error) {
    unsigned width, height;
    uint32_t number;
    bool flag;
    char rest;
    if (strcmp(part->key, "serial") == 0) {
        if (strlen(part->value) == 0 || strlen(part->value) >= sizeof config->serial) {
            return refuse(config, part, "1 to 63 characters, as `tuile displays` shows them", error);
        }
        (void)snprintf(config->serial, sizeof config->serial, "%s", part->value);
        return 1;
    }
    if (strcmp(part->key, "wait") == 0) {
        if (!read_number(part->value, 1, 1000000, &number)) { return refuse(config, part, "seconds, 1 to 1000000", error); }
        config->wait_ms = 1000 * number;
        return 1;
    }
    if (strcmp(part->key, "timeout") == 0) {
        return read_number(part->value, 1, 1000000, &config->timeout_ms) ? 1 : refuse(config, part, "ms, 1 to 1000000", error);
    }
    if (strcmp(part->key, "brightness") == 0) { return panel_part(config, part, error); }
    if (config->kind == TARGET_AX206) { return 0; }
    if (strcmp(part->key, "lz4") == 0) {
        if (!read_flag(part->value, &flag)) { return refuse(config, part, WANTS_FLAG, error); }
        config->no_compression = !flag;
        return 1;
    }
    if (strcmp(part->key, "mode") == 0) {
        if (sscanf(part->value, "%4ux%4u%c", &width, &height, &rest) != 2 || width == 0 || height == 0) {
            return refuse(config, part, "WIDTHxHEIGHT", error);
        }
        config->mode_width = (uint16_t)width;
        config->mode_height = (uint16_t)height;
        return 1;
    }
    return 0;
}

static int name_panel(target_config_t *config, const char *name, sim_error_t *error) {
    config->module = sim_panel_find(name);
    if (!config->module) { return sim_fail(error, "%s: unknown panel '%s'; `tuile panels` lists them", config->text, name); }
    config->panel = *config->module->panel;
    return 0;
}

static int spi_part(target_config_t *config, const part_t *part, sim_error_t *error) {
    static const char *const names[] = {"dc", "rst", "bl", "te"};
    target_line_t *const lines[] = {&config->dc, &config->reset, &config->backlight, &config->tearing};
    uint32_t number;
    bool flag;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strcmp(part->key, names[i]) != 0) { continue; }
        if (!read_line(part->value, lines[i])) {
            return refuse(config, part, "CHIP:LINE, like gpiochip0:25, or CHIP:LINE:low", error);
        }
        if (lines[i] == &config->tearing) { config->tearing_timeout_ms = TEARING_TIMEOUT_MS; }
        return 1;
    }
    if (strcmp(part->key, "panel") == 0) { return name_panel(config, part->value, error) ? -1 : 1; }
    if (strcmp(part->key, "mode") == 0) {
        if (!read_number(part->value, 0, 3, &number)) { return refuse(config, part, "0 to 3", error); }
        config->mode = (uint8_t)number;
        return 1;
    }
    if (strcmp(part->key, "worker") == 0) {
        if (!read_flag(part->value, &flag)) { return refuse(config, part, WANTS_FLAG, error); }
        config->no_worker = !flag;
        return 1;
    }
    if (!config->module) {
        return sim_fail(error, "%s: %s: name the panel before what is to be changed of it", config->text, part->key);
    }
    return panel_part(config, part, error);
}

typedef int (*part_fn)(target_config_t *config, const part_t *part, sim_error_t *error);

/* The parts behind the first, which stands for itself. `at` is cut up. */
static int read_parts(target_config_t *config, char *at, part_fn take, sim_error_t *error) {
    while (at) {
        char *next = strchr(at, ','), *value;
        if (next) { *next++ = '\0'; }
        value = strchr(at, '=');
        if (!value) { return sim_fail(error, "%s: '%s' wants a value, like %s=...", config->text, at, *at ? at : "clock"); }
        *value++ = '\0';
        const part_t part = {at, value};
        const int taken = take(config, &part, error);
        if (taken < 0) { return -1; }
        if (!taken) { return sim_fail(error, "%s: unknown part '%s'", config->text, at); }
        at = next;
    }
    return 0;
}

static int parse_spi(target_config_t *config, const char *device, char *parts, sim_error_t *error) {
    config->kind = TARGET_SPI;
    if (device[0] != '/' || strlen(device) >= sizeof config->device) {
        return sim_fail(error, "%s: '%s' is no device; wants one like /dev/spidev0.0", config->text, device);
    }
    (void)snprintf(config->device, sizeof config->device, "%s", device);
    if (read_parts(config, parts, spi_part, error)) { return -1; }
    if (!config->module) { return sim_fail(error, "%s: no panel=; `tuile panels` lists them", config->text); }
    if (!config->dc.chip[0]) { return sim_fail(error, "%s: no dc=CHIP:LINE; a panel on SPI cannot do without", config->text); }
    return 0;
}

static int parse_usb(target_config_t *config, const char *kind, char *parts, sim_error_t *error) {
    if (strcmp(kind, "gud") != 0 && strcmp(kind, "ax206") != 0) {
        return sim_fail(error, "%s: unknown kind of USB display '%s'; wants usb:gud or usb:ax206", config->text, kind);
    }
    config->kind = kind[0] == 'g' ? TARGET_GUD : TARGET_AX206;
    return read_parts(config, parts, usb_part, error);
}

int target_parse_panel(target_config_t *config, const char *name, sim_error_t *error) {
    *config = (target_config_t){.kind = TARGET_SIM};
    (void)snprintf(config->text, sizeof config->text, "--panel");
    return name_panel(config, name, error);
}

int target_parse(target_config_t *config, const char *text, sim_error_t *error) {
    char copy[sizeof config->text];
    char *rest;
    *config = (target_config_t){.kind = TARGET_SIM};
    if (snprintf(copy, sizeof copy, "%s", text) >= (int)sizeof copy) {
        return sim_fail(error, "--display %.40s...: longer than %zu characters", text, sizeof copy - 1);
    }
    (void)snprintf(config->text, sizeof config->text, "--display %.*s", (int)(sizeof config->text - 16), text);
    rest = strchr(copy, ':');
    if (rest) {
        char *parts = strchr(rest, ',');
        *rest++ = '\0';
        if (parts) { *parts++ = '\0'; }
        if (strcmp(copy, "sim") == 0) { return name_panel(config, rest, error) ? -1 : read_parts(config, parts, sim_part, error); }
        if (strcmp(copy, "spi") == 0) { return parse_spi(config, rest, parts, error); }
        if (strcmp(copy, "usb") == 0) { return parse_usb(config, rest, parts, error); }
    }
    return sim_fail(error, "%s: unknown kind of display; wants sim:PANEL, spi:/dev/spidevB.C,..., usb:gud or usb:ax206",
                    config->text);
}
