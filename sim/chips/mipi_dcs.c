#include "mipi_dcs.h"

#include <stdlib.h>
#include <string.h>

enum {
    NOP = 0x00,
    SWRESET = 0x01,
    SLPIN = 0x10,
    SLPOUT = 0x11,
    NORON = 0x13,
    INVOFF = 0x20,
    INVON = 0x21,
    DISPOFF = 0x28,
    DISPON = 0x29,
    CASET = 0x2A,
    RASET = 0x2B,
    RAMWR = 0x2C,
    VSCRDEF = 0x33,
    TEOFF = 0x34,
    TEON = 0x35,
    MADCTL = 0x36,
    VSCRSADD = 0x37,
    IDMOFF = 0x38,
    COLMOD = 0x3A,
    RAMWRC = 0x3C,
};

enum { MY = 0x80, MX = 0x40, MV = 0x20, BGR = 0x08 };

/* What the engine decodes itself. */
static const sim_dcs_command_t decoded[] = {
    {NOP, 0, 0},     {SWRESET, 0, 0}, {SLPIN, 0, 0},    {SLPOUT, 0, 0}, {NORON, 0, 0},  {INVOFF, 0, 0},  {INVON, 0, 0},
    {DISPOFF, 0, 0}, {DISPON, 0, 0},  {CASET, 4, 4},    {RASET, 4, 4},  {RAMWR, 0, 0},  {VSCRDEF, 6, 6}, {TEOFF, 0, 0},
    {TEON, 1, 1},    {MADCTL, 1, 1},  {VSCRSADD, 2, 2}, {IDMOFF, 0, 0}, {COLMOD, 1, 1}, {RAMWRC, 0, 0},
};

/* In every edition of the standard, but not in this model. */
static const uint8_t not_modelled[] = {0x12, 0x2D, 0x30, 0x39};

typedef struct range {
    uint16_t first, last;
} range_t;

typedef struct sim_dcs {
    sim_chip_t chip;
    const sim_dcs_part_t *part;
    sim_dcs_module_t module;
    uint32_t *memory;

    /* registers */
    range_t columns, rows;
    uint8_t address_mode, pixel_format;
    bool awake, on, inverted, wraps;
    uint8_t scan;   /* GS and SS, as in the second parameter of scan_command */
    uint8_t expand; /* EPF: how 12 and 16 bits become 18 */
    bool low_byte_first;
    uint8_t open; /* locks */

    /* the wire */
    const sim_dcs_command_t *command; /* the one that parameters belong to, or NULL */
    uint8_t code, previous_code;      /* the last command, and the one before it */
    uint8_t parameters[256];
    size_t parameter_count;
    bool writing;      /* data are pixels */
    bool pointer_good; /* there was a RAMWR since the window was set */
    bool full;         /* the window has been written once */
    uint8_t cut[3];    /* bytes of the pixel under way */
    size_t cut_count;
    uint16_t column, row;

    /* time */
    bool held;
    uint64_t held_since_ns, ready_ns, wake_ns, awake_since_ns;
    uint8_t busy_with; /* the command that ready_ns is about */
} sim_dcs_t;

/* A member at the beginning, hence the cast. */
static sim_dcs_t *dcs_of(sim_chip_t *chip) { return (sim_dcs_t *)chip; }

#define REFUSE(dcs, ...) sim_fail(&(dcs)->chip.fault, __VA_ARGS__)

static void default_window(sim_dcs_t *dcs) {
    bool exchanged = (dcs->address_mode & MV) != 0;

    dcs->columns = (range_t){0, (uint16_t)((exchanged ? dcs->part->height : dcs->part->width) - 1)};
    dcs->rows = (range_t){0, (uint16_t)((exchanged ? dcs->part->width : dcs->part->height) - 1)};
}

/* What both kinds of reset do; a software reset leaves address mode, pixel format and memory as they were. */
static void reset_registers(sim_dcs_t *dcs, uint64_t now_ns) {
    default_window(dcs);
    dcs->ready_ns = now_ns + dcs->part->settle_ms * UINT64_C(1000000);
    dcs->wake_ns = dcs->awake ? now_ns + dcs->part->sleep_ms * UINT64_C(1000000) : now_ns;
    dcs->busy_with = SWRESET;
    dcs->awake = dcs->on = dcs->inverted = dcs->pointer_good = dcs->writing = dcs->chip.tearing = false;
    dcs->wraps = true;
    dcs->scan = dcs->open = dcs->code = dcs->previous_code = 0;
    dcs->expand = dcs->part->ram_control_command ? 3 : 0;
    dcs->low_byte_first = false;
    dcs->command = NULL;
    dcs->cut_count = 0;
}

static void dcs_reset(sim_chip_t *chip, bool held, uint64_t now_ns) {
    sim_dcs_t *dcs = dcs_of(chip);

    if (held && !dcs->held) { dcs->held_since_ns = now_ns; }
    if (!held && dcs->held) {
        if (now_ns - dcs->held_since_ns < dcs->part->reset_pulse_us * UINT64_C(1000) && !chip->fault.text[0]) {
            REFUSE(dcs, "%s: reset was held for %llu ns; it takes %u us", chip->name,
                   (unsigned long long)(now_ns - dcs->held_since_ns), dcs->part->reset_pulse_us);
        }
        dcs->address_mode = 0;
        dcs->pixel_format = dcs->part->format_at_reset;
        reset_registers(dcs, now_ns);
    }
    dcs->held = held;
}

/* ---- commands ---------------------------------------------------------------------------------------------- */

static const sim_dcs_command_t *find(const sim_dcs_command_t *commands, size_t count, uint8_t code) {
    for (size_t i = 0; i < count; i++) {
        if (commands[i].code == code) { return &commands[i]; }
    }
    return NULL;
}

/* Bits of a pixel in this format; 0: the serial interface does not take it. */
static unsigned format_bits(const sim_dcs_t *dcs, uint8_t format) {
    for (size_t i = 0; i < sizeof dcs->part->formats / sizeof dcs->part->formats[0]; i++) {
        const sim_dcs_format_t *known = &dcs->part->formats[i];
        if (known->bits && known->code == (format & 7u)) { return known->bits; }
    }
    return 0;
}

static int check_range(sim_dcs_t *dcs, const char *what, range_t range, unsigned size) {
    if (range.first > range.last) {
        return REFUSE(dcs, "%s: %s from %u to %u: the start must not exceed the end", dcs->chip.name, what, range.first,
                      range.last);
    }
    if (range.last >= size) {
        return REFUSE(dcs, "%s: %s from %u to %u: the last is %u with MADCTL %02Xh", dcs->chip.name, what, range.first, range.last,
                      size - 1, dcs->address_mode);
    }
    return 0;
}

static int check_window(sim_dcs_t *dcs) {
    bool exchanged = (dcs->address_mode & MV) != 0;

    return check_range(dcs, "columns", dcs->columns, exchanged ? dcs->part->height : dcs->part->width) ||
                   check_range(dcs, "rows", dcs->rows, exchanged ? dcs->part->width : dcs->part->height)
               ? -1
               : 0;
}

static int start_writing(sim_dcs_t *dcs, bool again) {
    unsigned bits;

    if (!dcs->awake) { return REFUSE(dcs, "%s: memory write while asleep: nothing of it would be seen", dcs->chip.name); }
    if (check_window(dcs)) { return -1; }
    bits = format_bits(dcs, dcs->pixel_format);
    if (dcs->expand != 0 && bits != 18) {
        return REFUSE(dcs, "%s: %u bits a pixel with EPF = %u (%02Xh): only 0, repeating the upper bits, is modelled",
                      dcs->chip.name, bits, dcs->expand, dcs->part->ram_control_command);
    }
    if (dcs->low_byte_first && bits != 16) {
        return REFUSE(dcs, "%s: low byte first (%02Xh) with %u bits a pixel; it is for 16", dcs->chip.name,
                      dcs->part->ram_control_command, bits);
    }
    if (again && !dcs->pointer_good) {
        return REFUSE(dcs, "%s: memory write continued (3Ch) without a memory write (2Ch) in this window", dcs->chip.name);
    }
    if (!again) {
        dcs->column = dcs->columns.first;
        dcs->row = dcs->rows.first;
        dcs->full = false;
    }
    dcs->pointer_good = true;
    dcs->writing = true;
    dcs->cut_count = 0;
    return 0;
}

static int sleep_in(sim_dcs_t *dcs, uint64_t now_ns) {
    uint64_t sleep_ns = dcs->part->sleep_ms * UINT64_C(1000000);

    if (dcs->awake) {
        if (now_ns < dcs->awake_since_ns + sleep_ns) {
            return REFUSE(dcs, "%s: sleep in %llu us after sleep out; it takes %u ms", dcs->chip.name,
                          (unsigned long long)((now_ns - dcs->awake_since_ns) / 1000), dcs->part->sleep_ms);
        }
        dcs->awake = false;
        dcs->wake_ns = now_ns + sleep_ns;
    }
    return 0;
}

static int sleep_out(sim_dcs_t *dcs, uint64_t now_ns) {
    if (!dcs->awake) {
        if (now_ns < dcs->wake_ns) {
            return REFUSE(dcs, "%s: sleep out %llu us too early after a reset or sleep in; it takes %u ms", dcs->chip.name,
                          (unsigned long long)((dcs->wake_ns - now_ns) / 1000), dcs->part->sleep_ms);
        }
        dcs->awake = true;
        dcs->awake_since_ns = now_ns;
    }
    return 0;
}

static int software_reset(sim_dcs_t *dcs, uint64_t now_ns) {
    if (dcs->awake && now_ns < dcs->awake_since_ns + dcs->part->sleep_ms * UINT64_C(1000000)) {
        return REFUSE(dcs, "%s: software reset during the %u ms of sleep out", dcs->chip.name, dcs->part->sleep_ms);
    }
    reset_registers(dcs, now_ns);
    return 0;
}

static int set_pixel_format(sim_dcs_t *dcs, uint8_t format) {
    if (format & 8 || !(dcs->part->parallel >> (format >> 4) & 1u) || format_bits(dcs, format) == 0) {
        return REFUSE(dcs, "%s: pixel format %02Xh is reserved, or not one of the serial interface's", dcs->chip.name, format);
    }
    dcs->pixel_format = format;
    return 0;
}

static int vendor(sim_dcs_t *dcs) {
    const sim_dcs_part_t *part = dcs->part;
    const uint8_t *p = dcs->parameters;
    uint8_t code = dcs->command->code;

    for (size_t i = 0; i < part->rule_count; i++) {
        const sim_dcs_rule_t *rule = &part->rules[i];
        if (rule->code == code && rule->index < dcs->parameter_count && (p[rule->index] & rule->mask) != rule->value) {
            return REFUSE(dcs, "%s: command %02Xh with parameter %u = %02Xh is not modelled", dcs->chip.name, code, rule->index + 1,
                          p[rule->index]);
        }
    }
    for (size_t i = 0; i < part->key_count; i++) {
        const sim_dcs_key_t *key = &part->keys[i];
        if (key->code == code && (dcs->command->most == 0 || key->parameter == p[0]) &&
            (!key->after || key->after == dcs->previous_code)) {
            dcs->open = (uint8_t)((dcs->open | key->opens) & ~key->closes);
        }
    }
    if (code == part->scan_command && dcs->parameter_count >= 2) { dcs->scan = p[1]; }
    if (code == part->wrap_command) { dcs->wraps = (p[0] & 1) != 0; }
    if (code == part->ram_control_command) {
        dcs->expand = p[1] >> 4 & 3u;
        dcs->low_byte_first = (p[1] & 8) != 0;
    }
    return 0;
}

/* Called when the least count of parameters is complete, and again for each that may follow. */
static int execute(sim_dcs_t *dcs, uint64_t now_ns) {
    const uint8_t *p = dcs->parameters;
    unsigned pair[3] = {(unsigned)p[0] << 8 | p[1], (unsigned)p[2] << 8 | p[3], (unsigned)p[4] << 8 | p[5]};

    switch (dcs->command->code) {
    case NOP:
    case NORON:
    case IDMOFF: return 0;
    case SWRESET: return software_reset(dcs, now_ns);
    case SLPIN: return sleep_in(dcs, now_ns);
    case SLPOUT: return sleep_out(dcs, now_ns);
    case INVOFF:
    case INVON: dcs->inverted = dcs->command->code == INVON; return 0;
    case DISPOFF:
    case DISPON: dcs->on = dcs->command->code == DISPON; return 0;
    case CASET:
        dcs->columns = (range_t){(uint16_t)pair[0], (uint16_t)pair[1]};
        dcs->pointer_good = false;
        return check_range(dcs, "columns", dcs->columns, dcs->address_mode & MV ? dcs->part->height : dcs->part->width);
    case RASET:
        dcs->rows = (range_t){(uint16_t)pair[0], (uint16_t)pair[1]};
        dcs->pointer_good = false;
        return check_range(dcs, "rows", dcs->rows, dcs->address_mode & MV ? dcs->part->width : dcs->part->height);
    case RAMWR:
    case RAMWRC: return start_writing(dcs, dcs->command->code == RAMWRC);
    case TEOFF:
    case TEON: dcs->chip.tearing = dcs->command->code == TEON; return 0;
    case MADCTL:
        dcs->address_mode = p[0] & 0xFC;
        dcs->pointer_good = false;
        return 0;
    case COLMOD: return set_pixel_format(dcs, p[0]);
    case VSCRDEF:
        return pair[0] == 0 && pair[1] == dcs->part->height && pair[2] == 0
                   ? 0
                   : REFUSE(dcs, "%s: a scrolling area other than all of it is not modelled", dcs->chip.name);
    case VSCRSADD: return pair[0] == 0 ? 0 : REFUSE(dcs, "%s: scrolling (37h) is not modelled", dcs->chip.name);
    default: return vendor(dcs);
    }
}

static int check_previous(sim_dcs_t *dcs, uint8_t code) {
    unsigned bits;

    if (code == SWRESET) { return 0; /* starting over is how one gets out of a transfer that broke off */ }
    if (dcs->command && dcs->parameter_count < dcs->command->least) {
        return REFUSE(dcs, "%s: command %02Xh takes %u parameters and got %zu", dcs->chip.name, dcs->command->code,
                      dcs->command->least, dcs->parameter_count);
    }
    bits = format_bits(dcs, dcs->pixel_format);
    /* Of 12-bit pixels an odd one is whole after two bytes: the half byte that fills up is nobody's. */
    if (dcs->writing && dcs->cut_count && !(bits == 12 && dcs->cut_count == 2)) {
        return REFUSE(dcs, "%s: command %02Xh cuts a pixel after %zu of its %u bytes", dcs->chip.name, code, dcs->cut_count,
                      bits == 18 ? 3 : 2);
    }
    return 0;
}

static int begin_command(sim_dcs_t *dcs, uint8_t code, uint64_t now_ns) {
    const sim_dcs_command_t *command = find(decoded, sizeof decoded / sizeof decoded[0], code);

    if (check_previous(dcs, code)) { return -1; }
    dcs->writing = false;
    dcs->command = NULL;
    dcs->cut_count = 0;
    if (now_ns < dcs->ready_ns) {
        return REFUSE(dcs, "%s: command %02Xh %llu us too early after %s; it takes %u ms", dcs->chip.name, code,
                      (unsigned long long)((dcs->ready_ns - now_ns + 999) / 1000),
                      dcs->busy_with == SLPIN    ? "sleep in"
                      : dcs->busy_with == SLPOUT ? "sleep out"
                                                 : "a reset",
                      dcs->part->settle_ms);
    }
    if (!command && memchr(not_modelled, code, sizeof not_modelled)) {
        return REFUSE(dcs, "%s: command %02Xh is not modelled", dcs->chip.name, code);
    }
    if (!command) { command = find(dcs->part->commands, dcs->part->command_count, code); }
    if (!command) { return REFUSE(dcs, "%s: unknown command %02Xh", dcs->chip.name, code); }
    if (command->locked && (dcs->open & dcs->part->locks) != dcs->part->locks) {
        return REFUSE(dcs, "%s: command %02Xh before its command set was enabled", dcs->chip.name, code);
    }
    if (code == NOP && dcs->part->no_nop) { return REFUSE(dcs, "%s: NOP disturbs this chip", dcs->chip.name); }
    if (code == CASET && dcs->part->row_first && dcs->address_mode & MV && dcs->code != RASET) {
        return REFUSE(dcs, "%s: columns (2Ah) not right after rows (2Bh), with MADCTL %02Xh", dcs->chip.name, dcs->address_mode);
    }
    dcs->previous_code = dcs->code;
    dcs->code = code;
    if (code == SLPIN || code == SLPOUT) {
        dcs->ready_ns = now_ns + dcs->part->settle_ms * UINT64_C(1000000);
        dcs->busy_with = code;
    }
    dcs->command = command;
    dcs->parameter_count = 0;
    if (command->least == 0) {
        if (execute(dcs, now_ns)) { return -1; }
        if (command->most == 0) { dcs->command = NULL; }
    }
    return 0;
}

/* ---- pixels ------------------------------------------------------------------------------------------------ */

static uint32_t *cell(const sim_dcs_t *dcs, uint32_t column, uint32_t row) {
    return dcs->memory + (size_t)row * dcs->part->width + column;
}

static void store(sim_dcs_t *dcs, uint32_t pixel) {
    uint32_t column = dcs->address_mode & MV ? dcs->row : dcs->column;
    uint32_t row = dcs->address_mode & MV ? dcs->column : dcs->row;

    if (dcs->full && !dcs->wraps) { return; }
    column = dcs->address_mode & MX ? dcs->part->width - 1u - column : column;
    row = dcs->address_mode & MY ? dcs->part->height - 1u - row : row;
    *cell(dcs, column, row) = pixel;
    if (dcs->column++ == dcs->columns.last) {
        dcs->column = dcs->columns.first;
        if (dcs->row++ == dcs->rows.last) {
            dcs->row = dcs->rows.first;
            dcs->full = true;
        }
    }
}

/* From so many bits a component to 18 in all, by repeating the upper bits. */
static uint32_t widen(uint32_t red, unsigned red_bits, uint32_t green, unsigned green_bits, uint32_t blue, unsigned blue_bits) {
    const uint32_t part[3] = {red, green, blue};
    const unsigned bits[3] = {red_bits, green_bits, blue_bits};
    uint32_t pixel = 0;

    for (unsigned i = 0; i < 3; i++) {
        uint32_t six = part[i] << (6 - bits[i]);
        for (unsigned have = bits[i]; have < 6; have *= 2) {
            six |= six >> have;
        }
        pixel = pixel << 6 | six;
    }
    return pixel;
}

static void store_12(sim_dcs_t *dcs, uint32_t rgb) { store(dcs, widen(rgb >> 8, 4, rgb >> 4 & 15u, 4, rgb & 15u, 4)); }

static void store_3(sim_dcs_t *dcs, uint32_t rgb) { store(dcs, widen(rgb >> 2 & 1u, 1, rgb >> 1 & 1u, 1, rgb & 1u, 1)); }

static void pixel_byte(sim_dcs_t *dcs, uint8_t byte) {
    const uint8_t *p = dcs->cut;
    uint32_t word;

    dcs->cut[dcs->cut_count++] = byte;
    switch (format_bits(dcs, dcs->pixel_format)) {
    case 3:
        store_3(dcs, p[0] >> 3);
        store_3(dcs, p[0]);
        dcs->cut_count = 0;
        break;
    case 12:
        if (dcs->cut_count == 2) { store_12(dcs, (uint32_t)p[0] << 4 | p[1] >> 4); }
        if (dcs->cut_count < 3) { return; }
        store_12(dcs, (p[1] & 15u) << 8 | p[2]);
        dcs->cut_count = 0;
        break;
    case 16:
        if (dcs->cut_count < 2) { return; }
        word = dcs->low_byte_first ? (uint32_t)p[1] << 8 | p[0] : (uint32_t)p[0] << 8 | p[1];
        store(dcs, widen(word >> 11, 5, word >> 5 & 63u, 6, word & 31u, 5));
        dcs->cut_count = 0;
        break;
    default:
        if (dcs->cut_count < 3) { return; }
        store(dcs, widen(p[0] >> 2, 6, p[1] >> 2, 6, p[2] >> 2, 6));
        dcs->cut_count = 0;
        break;
    }
}

static int data_byte(sim_dcs_t *dcs, uint8_t byte, uint64_t now_ns) {
    if (dcs->writing) {
        pixel_byte(dcs, byte);
        return 0;
    }
    if (!dcs->command) {
        return REFUSE(dcs, "%s: data %02Xh that belong to no command (pixels need a memory write, 2Ch, before them)",
                      dcs->chip.name, byte);
    }
    if (dcs->parameter_count == dcs->command->most) {
        return REFUSE(dcs, "%s: command %02Xh takes %u parameters and got more", dcs->chip.name, dcs->command->code,
                      dcs->command->most);
    }
    dcs->parameters[dcs->parameter_count++] = byte;
    return dcs->parameter_count >= dcs->command->least ? execute(dcs, now_ns) : 0;
}

static int check_wire(sim_dcs_t *dcs) {
    if (dcs->chip.fault.text[0]) { return -1; }
    return dcs->held ? REFUSE(dcs, "%s: traffic while reset is held", dcs->chip.name) : 0;
}

static int dcs_receive(sim_chip_t *chip, bool data, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz, uint64_t now_ns) {
    sim_dcs_t *dcs = dcs_of(chip);

    if (check_wire(dcs)) { return -1; }
    if (clock_hz > dcs->part->rated_clock_hz) {
        if (chip->warnings++ == 0) {
            sim_fail(&chip->warning, "%s: %s at %u Hz; the data sheet promises %u", chip->name, data ? "data" : "commands",
                     clock_hz, dcs->part->rated_clock_hz);
        }
    }
    for (size_t i = 0; i < size_bytes; i++) {
        if (data ? data_byte(dcs, bytes[i], now_ns) : begin_command(dcs, bytes[i], now_ns)) { return -1; }
    }
    return 0;
}

static int dcs_read(sim_chip_t *chip, uint8_t command, uint8_t *bytes, size_t size_bytes, uint64_t now_ns) {
    sim_dcs_t *dcs = dcs_of(chip);
    uint8_t answer[3];
    size_t length = 1;

    if (check_wire(dcs) || check_previous(dcs, command)) { return -1; }
    if (now_ns < dcs->ready_ns) {
        return REFUSE(dcs, "%s: read %02Xh too early after a reset or a change of sleep", chip->name, command);
    }
    dcs->writing = false;
    dcs->command = NULL;
    switch (command) {
    case 0x0A: /* power mode: booster, awake, normal mode, on */
        answer[0] = (uint8_t)((dcs->awake ? 0x90 : 0) | 0x08 | (dcs->on ? 0x04 : 0));
        break;
    case 0x0B: answer[0] = dcs->address_mode; break;
    case 0x0C: answer[0] = dcs->pixel_format; break;
    default:
        if (command != dcs->part->id_command) { return REFUSE(dcs, "%s: reading %02Xh is not modelled", chip->name, command); }
        memcpy(answer, dcs->part->id, 3);
        length = 3;
        break;
    }
    if (size_bytes > length) {
        return REFUSE(dcs, "%s: %02Xh answers with %zu bytes, not %zu", chip->name, command, length, size_bytes);
    }
    memcpy(bytes, answer, size_bytes);
    return 0;
}

/* ---- glass ------------------------------------------------------------------------------------------------- */

static uint8_t eight_bits(uint32_t six) { return (uint8_t)(six << 2 | six >> 4); }

/* Of a circle that touches the sides of width x height: is the centre of pixel (x, y) inside it or on it? */
static bool in_circle(uint32_t width, uint32_t height, uint32_t x, uint32_t y) {
    int64_t dx = 2 * (int64_t)x + 1 - width, dy = 2 * (int64_t)y + 1 - height;

    return dx * dx + dy * dy <= (int64_t)width * width;
}

static int dcs_glass(const sim_chip_t *chip, sim_picture_t *out, sim_error_t *error) {
    const sim_dcs_t *dcs = (const sim_dcs_t *)chip;
    const sim_dcs_module_t *module = &dcs->module;
    uint32_t width = module->width ? module->width : dcs->part->width;
    uint32_t height = module->height ? module->height : dcs->part->height;
    bool gs = (dcs->scan & 0x40) != 0, ss = (dcs->scan & 0x20) != 0;
    /* SS reverses the three dots of a pixel along with the pixels. */
    bool exchanged = (((dcs->address_mode & BGR) != 0) != module->bgr) != ss;

    if (sim_picture_create(out, width, height, error)) { return -1; }
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            uint32_t column = module->first_column + (module->columns_reversed ? width - 1 - x : x);
            uint32_t row = module->first_row + (module->rows_reversed ? height - 1 - y : y);
            uint32_t pixel = *cell(dcs, ss ? dcs->part->width - 1 - column : column, gs ? dcs->part->height - 1 - row : row);
            uint8_t *to = sim_picture_at(out, x, y);
            if (module->round && !chip->uncut && !in_circle(width, height, x, y)) { continue; }
            /* Without voltage a normally white panel lets the light through, and a normally black one does not. */
            if (!dcs->awake || !dcs->on) { pixel = dcs->inverted ? 0 : 0x3FFFF; }
            pixel = dcs->inverted != module->normally_black ? ~pixel : pixel;
            to[exchanged ? 2 : 0] = eight_bits(pixel >> 12 & 63u);
            to[1] = eight_bits(pixel >> 6 & 63u);
            to[exchanged ? 0 : 2] = eight_bits(pixel & 63u);
        }
    }
    return 0;
}

uint32_t sim_dcs_memory(const sim_chip_t *chip, uint32_t column, uint32_t row) {
    const sim_dcs_t *dcs = (const sim_dcs_t *)chip;

    return *cell(dcs, column, row);
}

static void dcs_destroy(sim_chip_t *chip) {
    free(dcs_of(chip)->memory);
    free(chip);
}

sim_chip_t *sim_dcs_create(const sim_dcs_part_t *part, const sim_dcs_module_t *module, sim_error_t *error) {
    sim_dcs_t *dcs = calloc(1, sizeof *dcs);
    size_t count = (size_t)part->width * part->height;
    uint32_t noise = 0x2545F491;

    if (dcs) { dcs->memory = calloc(count, sizeof *dcs->memory); }
    if (!dcs || !dcs->memory) {
        free(dcs);
        sim_fail(error, "no memory for a model of the %s", part->name);
        return NULL;
    }
    /* Noise and not black: a pixel that nobody wrote must be seen. Always the same, so that pictures can be compared. */
    for (size_t i = 0; i < count; i++) {
        noise = noise * 1664525u + 1013904223u;
        dcs->memory[i] = noise >> 14;
    }
    dcs->chip = (sim_chip_t){
        .reset = dcs_reset,
        .receive = dcs_receive,
        .read = dcs_read,
        .glass = dcs_glass,
        .destroy = dcs_destroy,
        .name = part->name,
    };
    dcs->part = part;
    dcs->module = *module;
    dcs->pixel_format = part->format_at_reset;
    reset_registers(dcs, 0);
    return &dcs->chip;
}
