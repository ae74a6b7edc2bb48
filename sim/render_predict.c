#include "render_predict.h"

#include <string.h>

const char render_predict_usage[] =
    "  --buffers 1|2            tiles in flight, 2 by default: with one a tile is not drawn while another is sent\n";

bool render_predict_option(render_predict_t *part, options_t *options, const char *argument) {
    if (strcmp(argument, "--buffers") != 0) { return false; }
    (void)options_integer(options, &part->buffers, 1, 2);
    return true;
}

void render_predict_apply(render_predict_t *part, const target_t *target, tuile_config_t *config) {
    config->buffers = (uint8_t)part->buffers;
    if (!target || !target_is_simulated(target) || !target->config.mcu) { return; }
    predict_open(&part->predict, target->config.mcu);
    config->trace = &part->predict.meter.trace;
}

void render_predict_start(render_predict_t *part, const tuile_t *renderer, const bool *summing, target_t *target) {
    if (part->predict.mcu) { predict_start(&part->predict, renderer, summing, &target->bus); }
}

void render_predict_frame_begin(render_predict_t *part, const target_t *target) {
    if (part->predict.mcu) { predict_frame_begin(&part->predict, &target->bus); }
}

void render_predict_frame_end(render_predict_t *part, const target_t *target) {
    if (part->predict.mcu) { predict_frame_end(&part->predict, &target->bus); }
}

void render_predict_report(const render_predict_t *part, const tuile_config_t *config, FILE *file) {
    const predict_t *p = &part->predict;
    char left_out[128];
    if (!p->costs) { return; }
    (void)predict_leaves_out(p->costs, config, left_out, sizeof left_out);
    (void)fprintf(file,
                  ",\n     \"mcu\": \"%s\", \"instructions\": %llu, \"render_ns\": %llu, \"frame_ns\": %llu, \"lead_ns\": %llu, "
                  "\"fps\": %.2f, "
                  "\"bound\": \"%s\", \"bound_by\": %.2f, \"not_counted\": \"%s\"",
                  p->mcu->name, (unsigned long long)predict_instructions(p->costs, &p->events), (unsigned long long)p->render_ns,
                  (unsigned long long)p->frame_ns, (unsigned long long)p->lead_ns, p->frame_ns ? 1e9 / (double)p->frame_ns : 0.0,
                  predict_bound(p->render_ns, p->wire_ns) == PREDICT_BUS_BOUND ? "bus" : "render",
                  predict_ratio(p->render_ns, p->wire_ns), left_out);
}

void render_predict_tell(const render_predict_t *part, const tuile_config_t *config) {
    const predict_t *p = &part->predict;
    char text[160], left_out[128];
    if (!p->mcu) { return; }
    if (!p->costs) {
        (void)printf("%s: no prediction: nobody has counted what this method and shading take there\n", p->mcu->name);
        return;
    }
    predict_text(p, text, sizeof text);
    const bool leaves_out = predict_leaves_out(p->costs, config, left_out, sizeof left_out);
    (void)printf("%s%s%s\n", text, leaves_out ? "; not counted: " : "", left_out);
}
