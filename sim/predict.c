#include "predict.h"

#include <stdio.h>
#include <string.h>

#define COMPACT "compact"

static const predict_costs_t *find(const predict_costs_t *costs, unsigned count, const char *core, const tuile_config_t *config) {
    for (unsigned i = 0; i < count; i++) {
        if (strcmp(costs[i].core, core) == 0 && costs[i].method == config->method && costs[i].shade == config->shade &&
            costs[i].textured == (config->effects != 0)) {
            return &costs[i];
        }
    }
    return NULL;
}

const predict_costs_t *predict_costs_find(const sim_mcu_t *mcu, const tuile_config_t *config) {
    const predict_costs_t *costs = find(predict_costs, predict_costs_count, mcu->core, config);
    return costs ? costs : find(predict_costs_uno, predict_costs_uno_count, mcu->core, config);
}

uint64_t predict_instructions(const predict_costs_t *costs, const predict_events_t *events) {
    uint64_t milli = 0; /* 22 events of 2^31 times 2^28 at most */
    for (unsigned i = 0; i < PREDICT_EVENT_COUNT; i++) {
        milli += events->count[i] * costs->milli[i];
    }
    return (milli + 500u) / 1000u;
}

/* 2^33 instructions of 2^14 thousandths of a cycle: below 2^47; whole seconds apart, so that nothing overflows. */
uint64_t predict_ns(const sim_mcu_t *mcu, uint64_t instructions) {
    const uint64_t milli_hz = (uint64_t)mcu->core_hz * 1000u, milli_cycles = instructions * mcu->cycles_milli;
    const uint64_t seconds = milli_cycles / milli_hz, rest = milli_cycles % milli_hz;
    return seconds * UINT64_C(1000000000) + (rest * 1000000u + milli_hz / 1000u - 1u) / (milli_hz / 1000u);
}

bool predict_leaves_out(const predict_costs_t *costs, const tuile_config_t *config, char *text, size_t size_bytes) {
    const bool compact = strcmp(costs->core, COMPACT) == 0;
    const bool plain_format = compact ? config->format == TUILE_MONO_PAGES : config->format <= TUILE_RGB565_LE;
    const struct {
        bool there;
        const char *name;
    } parts[] = {
        {config->overlay != NULL, "overlay"},
        {!plain_format, compact ? "pixels that are not black and white" : "pixels that are not RGB565"},
        {config->dither && !compact, "dithering"}, /* black and white is always dithered */
        {config->aa != TUILE_AA_NONE, "anti-aliasing"},
        {(config->effects & TUILE_LAYERS) != 0, "layers"},
    };
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (!parts[i].there || used >= size_bytes) { continue; }
        used += (size_t)snprintf(text + used, size_bytes - used, "%s%s", used ? ", " : "", parts[i].name);
    }
    return used > 0;
}

/* ---- a frame on the clock of a bus ------------------------------------------------------------------------------ */

void predict_open(predict_t *predict, const sim_mcu_t *mcu) {
    *predict = (predict_t){.mcu = mcu};
    predict_meter_open(&predict->meter);
}

static uint64_t work(void *context) {
    predict_t *predict = context;
    predict_events_t events = predict_meter_take(&predict->meter);
    if (predict->summing && *predict->summing) { events.count[PREDICT_BYTE_SUMMED] = 2u * events.count[PREDICT_TILE_SAMPLE]; }
    for (unsigned i = 0; i < PREDICT_EVENT_COUNT; i++) {
        predict->events.count[i] += events.count[i];
    }
    const uint64_t ns = predict_ns(predict->mcu, predict_instructions(predict->costs, &events));
    if (predict->lead_ns == 0) { predict->lead_ns = ns; }
    return ns;
}

void predict_start(predict_t *predict, const tuile_t *renderer, const bool *summing, sim_bus_t *bus) {
    predict->meter.renderer = renderer;
    predict->summing = summing;
    predict->costs = predict_costs_find(predict->mcu, tuile_config(renderer));
    if (predict->costs) { sim_bus_listen(bus, work, predict); }
}

void predict_frame_begin(predict_t *predict, const sim_bus_t *bus) {
    predict_meter_begin(&predict->meter);
    predict->events = (predict_events_t){{0}};
    predict->started_ns = bus->now_ns;
    predict->lead_ns = 0;
}

void predict_frame_end(predict_t *predict, const sim_bus_t *bus) {
    predict->render_ns = bus->counts.work_ns;
    predict->wire_ns = bus->counts.wire_ns + bus->counts.gap_ns;
    predict->frame_ns = bus->now_ns - predict->started_ns;
    predict->render_sum_ns += predict->render_ns;
    predict->wire_sum_ns += predict->wire_ns;
    predict->frame_sum_ns += predict->frame_ns;
    predict->frames++;
}

predict_bound_t predict_bound(uint64_t render_ns, uint64_t wire_ns) {
    return render_ns < wire_ns ? PREDICT_BUS_BOUND : PREDICT_RENDER_BOUND;
}

double predict_ratio(uint64_t render_ns, uint64_t wire_ns) {
    const uint64_t less = render_ns < wire_ns ? render_ns : wire_ns, more = render_ns < wire_ns ? wire_ns : render_ns;
    return less ? (double)more / (double)less : 0.0;
}

void predict_text(const predict_t *predict, char *text, size_t size_bytes) {
    const bool bus = predict_bound(predict->render_sum_ns, predict->wire_sum_ns) == PREDICT_BUS_BOUND;
    const double rate = predict->frame_sum_ns ? 1e9 * predict->frames / (double)predict->frame_sum_ns : 0.0;
    (void)snprintf(text, size_bytes, "%s: %.1f frames a second (%.2f ms), %s-bound: %s takes %.1f times as long as %s",
                   predict->mcu->name, rate, rate > 0.0 ? 1000.0 / rate : 0.0, bus ? "bus" : "render", bus ? "the wire" : "drawing",
                   predict_ratio(predict->render_sum_ns, predict->wire_sum_ns), bus ? "drawing" : "the wire");
}
