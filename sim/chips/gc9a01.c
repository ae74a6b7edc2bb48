#include "gc9a01.h"

/* Counts of parameters from the lists of commands (6.1); those that no edition describes as modules' programs send them. The inner
 * registers are closed until FEh and EFh. */
static const sim_dcs_command_t commands[] = {
    {0x44, 2, 2, false},  /* set tear scanline */
    {0x51, 1, 1, false},  /* write display brightness */
    {0x53, 1, 1, false},  /* write CTRL display */
    {0xB0, 1, 1, false},  /* RGB interface signal control */
    {0xB5, 3, 3, false},  /* blanking porch */
    {0xB6, 2, 3, false},  /* display function; the third is the count of lines, and drivers leave it out */
    {0xBA, 1, 1, false},  /* tearing effect control */
    {0xEF, 0, 0, false},  /* inner register enable 2 */
    {0xF6, 1, 1, false},  /* interface control */
    {0xFE, 0, 0, false},  /* inner register enable 1 */
    {0xA7, 1, 1, true},   /* Vcore */
    {0xC1, 1, 1, true},   /* power criterion */
    {0xC3, 1, 1, true},   /* VREG1A */
    {0xC4, 1, 1, true},   /* VREG1B */
    {0xC9, 1, 1, true},   /* VREG2A */
    {0xE8, 1, 1, true},   /* frame rate */
    {0xEC, 5, 5, true},   /* charge pump frequencies */
    {0xF0, 6, 6, true},   /* gamma 1 */
    {0xF1, 6, 6, true},   /* 2 */
    {0xF2, 6, 6, true},   /* 3 */
    {0xF3, 6, 6, true},   /* 4 */
    {0x62, 12, 12, true}, /* from here on undocumented */
    {0x63, 12, 12, true}, {0x64, 7, 7, true}, {0x66, 10, 10, true}, {0x67, 10, 10, true}, {0x70, 9, 9, true}, {0x74, 7, 7, true},
    {0x84, 1, 1, true},   {0x85, 1, 1, true}, {0x86, 1, 1, true},   {0x87, 1, 1, true},   {0x88, 1, 1, true}, {0x89, 1, 1, true},
    {0x8A, 1, 1, true},   {0x8B, 1, 1, true}, {0x8C, 1, 1, true},   {0x8D, 1, 1, true},   {0x8E, 1, 1, true}, {0x8F, 1, 1, true},
    {0x90, 4, 4, true},   {0x98, 2, 2, true}, {0xAE, 1, 1, true},   {0xBC, 1, 1, true},   {0xBD, 1, 1, true}, {0xBE, 1, 1, true},
    {0xCD, 1, 1, true},   {0xDF, 3, 3, true}, {0xE1, 2, 2, true},   {0xEB, 1, 1, true},   {0xED, 2, 2, true}, {0xFF, 3, 3, true},
};

static const sim_dcs_rule_t rules[] = {
    {0xB6, 0, 0xFF, 0x00}, /* GS and SS: what becomes of the colours' order with SS is told differently by drivers */
    {0xB6, 1, 0xFF, 0x00},
    {0xF6, 0, 0xFF, 0x00}, /* memory and display by the command interface */
};

static const sim_dcs_key_t keys[] = {{.code = 0xEF, .after = 0xFE, .opens = 1}};

const sim_dcs_part_t sim_gc9a01_part = {
    .name = "GC9A01",
    .width = 240,
    .height = 240,
    .commands = commands,
    .command_count = sizeof commands / sizeof commands[0],
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
    .keys = keys,
    .key_count = sizeof keys / sizeof keys[0],
    .locks = 1,
    .formats = {{3, 12}, {5, 16}, {6, 18}},
    .parallel = 1 << 0 | 1 << 5 | 1 << 6,
    .format_at_reset = 0x66,
    .row_first = true,
    .no_nop = true,
    .id_command = 0x04,
    .id = {0x00, 0x9A, 0x01},
    .rated_clock_hz = 100000000, /* write cycle 10 ns */
    .settle_ms = 5,
    .sleep_ms = 120,
    .reset_pulse_us = 10,
};

sim_chip_t *sim_gc9a01_create(sim_error_t *error) {
    return sim_dcs_create(&sim_gc9a01_part,
                          &(sim_dcs_module_t){.columns_reversed = true, .bgr = true, .normally_black = true, .round = true}, error);
}
