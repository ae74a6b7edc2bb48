#include "oled.h"

#include <stdlib.h>
#include <string.h>

/* A member at the beginning, hence the cast. */
static sim_oled_t *oled_of(sim_chip_t *chip) { return (sim_oled_t *)chip; }

/* ---- reset ------------------------------------------------------------------------------------------------- */

/* What a reset leaves alone is the memory, and what belongs to the wire outside. */
static void reset_registers(sim_oled_t *oled, uint64_t now_ns) {
    sim_oled_t fresh = {.chip = oled->chip, .part = oled->part, .module = oled->module, .memory = oled->memory};

    fresh.columns.last = (uint16_t)(oled->part->width / oled->part->column_pixels - 1u);
    fresh.rows.last = (uint16_t)(oled->part->height / oled->part->row_pixels - 1u);
    fresh.multiplex = oled->part->height;
    fresh.master = 15;
    fresh.ready_ns = now_ns + oled->part->settle_us * UINT64_C(1000);
    *oled = fresh;
    oled->part->defaults(oled);
}

static void oled_reset(sim_chip_t *chip, bool held, uint64_t now_ns) {
    sim_oled_t *oled = oled_of(chip);

    if (held && !oled->held) { oled->held_since_ns = now_ns; }
    if (!held && oled->held) {
        const uint64_t pulse_ns = now_ns - oled->held_since_ns;

        if (pulse_ns < oled->part->reset_pulse_us * UINT64_C(1000) && !chip->fault.text[0]) {
            SIM_OLED_REFUSE(oled, "%s: reset was held for %llu ns; it takes %u us", chip->name, (unsigned long long)pulse_ns,
                            oled->part->reset_pulse_us);
        }
        reset_registers(oled, now_ns);
    }
    oled->held = held;
}

/* ---- what commands do -------------------------------------------------------------------------------------- */

static int check_range(sim_oled_t *oled, const char *what, sim_oled_range_t range, unsigned count) {
    if (range.first > range.last) {
        return SIM_OLED_REFUSE(oled, "%s: %s from %u to %u: the start must not exceed the end", oled->chip.name, what, range.first,
                               range.last);
    }
    if (range.last >= count) {
        return SIM_OLED_REFUSE(oled, "%s: %s from %u to %u: the last is %u", oled->chip.name, what, range.first, range.last,
                               count - 1);
    }
    return 0;
}

int sim_oled_columns(sim_oled_t *oled, uint8_t first, uint8_t last) {
    oled->columns = (sim_oled_range_t){first, last};
    oled->column = first;
    oled->placed |= SIM_OLED_COLUMNS;
    return check_range(oled, "columns", oled->columns, oled->part->width / oled->part->column_pixels);
}

int sim_oled_rows(sim_oled_t *oled, uint8_t first, uint8_t last) {
    oled->rows = (sim_oled_range_t){first, last};
    oled->row = first;
    oled->placed |= SIM_OLED_ROWS;
    return check_range(oled, oled->part->row_pixels == 8 ? "pages" : "rows", oled->rows,
                       oled->part->height / oled->part->row_pixels);
}

int sim_oled_page_column(sim_oled_t *oled, unsigned column) {
    oled->columns = (sim_oled_range_t){(uint16_t)column, (uint16_t)(oled->part->width - 1u)};
    oled->column = (uint16_t)column;
    oled->placed |= SIM_OLED_COLUMNS;
    return 0;
}

int sim_oled_check(sim_oled_t *oled, const char *what, unsigned value, unsigned least, unsigned most) {
    if (value >= least && value <= most) { return 0; }
    return SIM_OLED_REFUSE(oled, "%s: %s (%02Xh) is %u; it goes from %u to %u", oled->chip.name, what, oled->code, value, least,
                           most);
}

int sim_oled_lock(sim_oled_t *oled, uint8_t parameter, bool guards) {
    switch (parameter) {
    case 0x12:
    case 0x16: oled->locked = parameter == 0x16; return 0;
    case 0xB0:
    case 0xB1:
        if (guards) {
            oled->guarded = parameter == 0xB0;
            return 0;
        }
        break;
    default: break;
    }
    return SIM_OLED_REFUSE(oled, "%s: command lock (FDh) knows no %02Xh", oled->chip.name, parameter);
}

/* ---- the wire ---------------------------------------------------------------------------------------------- */

static const sim_oled_command_t *find(const sim_oled_part_t *part, uint8_t code) {
    for (size_t i = 0; i < part->command_count; i++) {
        if (code >= part->commands[i].first && code <= part->commands[i].last) { return &part->commands[i]; }
    }
    return NULL;
}

static int execute(sim_oled_t *oled) {
    oled->command = NULL;
    return oled->part->execute(oled, oled->code, oled->parameters);
}

static int begin_command(sim_oled_t *oled, uint8_t code) {
    const sim_oled_command_t *command = find(oled->part, code);

    if (oled->command) {
        return SIM_OLED_REFUSE(oled, "%s: command %02Xh takes %u parameters and got %zu", oled->chip.name, oled->code,
                               oled->command->parameters, oled->parameter_count);
    }
    if (oled->cut_count) {
        return SIM_OLED_REFUSE(oled, "%s: command %02Xh cuts data after %zu of %u bytes", oled->chip.name, code, oled->cut_count,
                               oled->part->unit_bytes);
    }
    if (!command) { return SIM_OLED_REFUSE(oled, "%s: unknown command %02Xh", oled->chip.name, code); }
    if (oled->locked && code != 0xFD) {
        return SIM_OLED_REFUSE(oled, "%s: command %02Xh while commands are locked (FDh 16h)", oled->chip.name, code);
    }
    if (oled->guarded && command->flags & SIM_OLED_GUARDED) {
        return SIM_OLED_REFUSE(oled, "%s: command %02Xh is locked until FDh B1h", oled->chip.name, code);
    }
    if (command->flags & SIM_OLED_NOT_MODELLED) {
        return SIM_OLED_REFUSE(oled, "%s: command %02Xh is not modelled", oled->chip.name, code);
    }
    oled->writing = false;
    oled->code = code;
    oled->command = command;
    oled->parameter_count = 0;
    return command->parameters == 0 ? execute(oled) : 0;
}

static int parameter(sim_oled_t *oled, uint8_t byte) {
    oled->parameters[oled->parameter_count++] = byte;
    return oled->parameter_count == oled->command->parameters ? execute(oled) : 0;
}

static void advance(sim_oled_t *oled) {
    if (oled->vertical) {
        if (oled->row++ < oled->rows.last) { return; }
        oled->row = oled->rows.first;
        oled->column = oled->column == oled->columns.last ? oled->columns.first : (uint16_t)(oled->column + 1);
        return;
    }
    if (oled->column++ < oled->columns.last) { return; }
    oled->column = oled->columns.first;
    if (oled->column_ends) { oled->placed &= (uint8_t)~SIM_OLED_COLUMNS; }
    oled->row = oled->row == oled->rows.last ? oled->rows.first : (uint16_t)(oled->row + 1);
}

static int data_byte(sim_oled_t *oled, uint8_t byte) {
    const sim_oled_part_t *part = oled->part;

    if (oled->locked) { return SIM_OLED_REFUSE(oled, "%s: data while commands are locked (FDh 16h)", oled->chip.name); }
    if (part->write_command && !oled->writing) {
        return SIM_OLED_REFUSE(oled, "%s: data %02Xh that belong to no command (pixels need a memory write before them)",
                               oled->chip.name, byte);
    }
    if (oled->placed != (SIM_OLED_COLUMNS | SIM_OLED_ROWS)) {
        return SIM_OLED_REFUSE(oled, "%s: data %02Xh before columns and rows were told", oled->chip.name, byte);
    }
    if (check_range(oled, "columns", oled->columns, part->width / part->column_pixels)) { return -1; }
    oled->cut[oled->cut_count++] = byte;
    if (oled->cut_count < part->unit_bytes) { return 0; }
    oled->cut_count = 0;
    part->store(oled, oled->cut);
    advance(oled);
    return 0;
}

static int byte_of(sim_oled_t *oled, bool data, uint8_t byte) {
    const bool low = oled->part->parameters_low;

    if (oled->command && data && low) {
        return SIM_OLED_REFUSE(oled, "%s: D/C is high at parameter %zu of command %02Xh", oled->chip.name,
                               oled->parameter_count + 1, oled->code);
    }
    if (oled->command && data != low) { return parameter(oled, byte); }
    return data ? data_byte(oled, byte) : begin_command(oled, byte);
}

static int check_wire(sim_oled_t *oled, uint64_t now_ns) {
    if (oled->chip.fault.text[0]) { return -1; }
    if (oled->held) { return SIM_OLED_REFUSE(oled, "%s: traffic while reset is held", oled->chip.name); }
    if (now_ns < oled->ready_ns) {
        return SIM_OLED_REFUSE(oled, "%s: traffic %llu ns too early after a reset; it takes %u us", oled->chip.name,
                               (unsigned long long)(oled->ready_ns - now_ns), oled->part->settle_us);
    }
    return 0;
}

static int oled_receive(sim_chip_t *chip, bool data, const uint8_t *bytes, size_t size_bytes, uint32_t clock_hz, uint64_t now_ns) {
    sim_oled_t *oled = oled_of(chip);

    if (check_wire(oled, now_ns)) { return -1; }
    if (clock_hz > oled->part->rated_clock_hz && chip->warnings++ == 0) {
        sim_fail(&chip->warning, "%s: %s at %u Hz; the data sheet promises %u", chip->name, data ? "data" : "commands", clock_hz,
                 oled->part->rated_clock_hz);
    }
    for (size_t i = 0; i < size_bytes; i++) {
        if (byte_of(oled, data, bytes[i])) { return -1; }
    }
    return 0;
}

static int oled_read(sim_chip_t *chip, uint8_t command, uint8_t *bytes, size_t size_bytes, uint64_t now_ns) {
    sim_oled_t *oled = oled_of(chip);

    (void)bytes;
    (void)size_bytes;
    if (check_wire(oled, now_ns)) { return -1; }
    return SIM_OLED_REFUSE(oled, "%s: reading %02Xh: the serial interface can only be written", chip->name, command);
}

/* ---- glass ------------------------------------------------------------------------------------------------- */

uint32_t *sim_oled_at(const sim_oled_t *oled, unsigned segment, unsigned row) {
    return oled->memory + (size_t)row * oled->part->width + segment;
}

void sim_oled_grey(const sim_oled_t *oled, uint32_t value, uint8_t *rgb) {
    (void)oled;
    memset(rgb, (int)(17u * value), 3);
}

/* Split: odd commons come out of the pins of the upper half. A module that is wired for the other arrangement shows its lines out
 * of order; of those that are wired in sequence none has more lines than one half. */
static unsigned common_of_line(const sim_oled_t *oled, unsigned line) {
    const unsigned wired = oled->module.commons_reversed ? oled->module.height - 1u - line : line;

    if (oled->module.commons_split == oled->commons_split) { return wired; }
    return oled->module.commons_split ? wired / 2u + wired % 2u * (oled->part->height / 2u) : 2u * wired;
}

/* The row of the memory that a common shows, or -1 when it is not scanned. */
static int row_of_common(const sim_oled_t *oled, unsigned common) {
    const unsigned height = oled->part->height;
    const unsigned scanned = oled->part->reverses_all ? height : oled->multiplex;
    const unsigned place = oled->commons_remapped ? (height + scanned - 1u - common) : common;
    const unsigned row = (place + oled->offset) % height;

    return row < oled->multiplex ? (int)((row + oled->start_line) % height) : -1;
}

/* The current is in proportion to contrast and master current; the module's usual contrast is as bright as it gets. */
static uint8_t lit(const sim_oled_t *oled, unsigned channel, uint8_t level) {
    const unsigned full = 16u * oled->module.full[channel], given = oled->contrast[channel] * (oled->master + 1u);

    return (uint8_t)(level * (given < full ? given : full) / full);
}

static void seen(const sim_oled_t *oled, uint32_t value, uint8_t *rgb) {
    const uint32_t white = oled->part->white;

    value = oled->inverse ? white - value : value;
    value = oled->all_on ? white : oled->all_off ? 0 : value;
    oled->part->colour(oled, value, rgb);
    for (unsigned i = 0; i < 3; i++) {
        rgb[i] = lit(oled, i, rgb[i]);
    }
}

static int oled_glass(const sim_chip_t *chip, sim_picture_t *out, sim_error_t *error) {
    const sim_oled_t *oled = (const sim_oled_t *)chip;
    const sim_oled_module_t *module = &oled->module;

    if (sim_picture_create(out, module->width, module->height, error)) { return -1; }
    for (unsigned y = 0; oled->on && !oled->unpowered && y < module->height; y++) {
        const int row = row_of_common(oled, common_of_line(oled, y));

        for (unsigned x = 0; row >= 0 && x < module->width; x++) {
            const unsigned segment = module->first_segment + (module->segments_reversed ? module->width - 1u - x : x);

            seen(oled, *sim_oled_at(oled, segment, (unsigned)row), sim_picture_at(out, x, y));
        }
    }
    return 0;
}

uint32_t sim_oled_memory(const sim_chip_t *chip, unsigned segment, unsigned row) {
    return *sim_oled_at((const sim_oled_t *)chip, segment, row);
}

/* ---- life -------------------------------------------------------------------------------------------------- */

static void oled_destroy(sim_chip_t *chip) {
    free(oled_of(chip)->memory);
    free(chip);
}

sim_chip_t *sim_oled_create(const sim_oled_part_t *part, const sim_oled_module_t *module, sim_error_t *error) {
    sim_oled_t *oled = calloc(1, sizeof *oled);
    const size_t count = (size_t)part->width * part->height;
    uint32_t noise = 0x2545F491;

    if (oled) { oled->memory = calloc(count, sizeof *oled->memory); }
    if (!oled || !oled->memory) {
        free(oled);
        sim_fail(error, "no memory for a model of the %s", part->name);
        return NULL;
    }
    /* Noise, the same each time: a pixel that nobody wrote must be seen. */
    for (size_t i = 0; i < count; i++) {
        noise = noise * 1664525u + 1013904223u;
        oled->memory[i] = (noise >> 14) & part->white;
    }
    oled->chip = (sim_chip_t){
        .reset = oled_reset,
        .receive = oled_receive,
        .read = oled_read,
        .glass = oled_glass,
        .destroy = oled_destroy,
        .name = part->name,
    };
    oled->part = part;
    oled->module = *module;
    reset_registers(oled, 0);
    return &oled->chip;
}
