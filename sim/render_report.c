#include "render_report.h"

#include "render_format.h"

void render_report_frame(const render_report_t *r, FILE *f) {
    const tuile_stats_t *s = r->stats;
    const tuile_config_t *c = r->config;
    char format[64];
    render_format_text(c, format, sizeof format);
    (void)fprintf(
        f,
        "%s\n    {\"frame\": %u, \"hash\": \"%s\", \"width\": %u, \"height\": %u, \"tile_width\": %u, \"tile_height\": %u,\n"
        "     \"format\": \"%s\",\n",
        r->frame ? "," : "", r->frame, r->hash, c->width, c->height, c->tile_width, c->tile_height, format);
    (void)fprintf(f,
                  "     \"instances\": %u, \"instances_outside\": %u, \"faces\": %u, \"clusters\": %u, \"clusters_outside\": %u, "
                  "\"clusters_facing_away\": %u, \"vertices\": %u,\n",
                  s->instances, s->instances_outside, s->faces, s->clusters, s->clusters_outside, s->clusters_facing_away,
                  s->vertices);
    (void)fprintf(
        f,
        "     \"faces_tested\": %u, \"faces_back\": %u, \"faces_degenerate\": %u, \"faces_outside\": %u, \"faces_clipped\": %u,\n"
        "     \"faces_clipped_away\": %u, \"faces_binned\": %u, \"faces_setup\": %u, \"faces_resumed\": %u,\n",
        s->faces_tested, s->faces_back, s->faces_degenerate, s->faces_outside, s->faces_clipped, s->faces_clipped_away,
        s->faces_binned, s->faces_setup, s->faces_resumed);
    switch (c->method) {
    case TUILE_SCANLINE: (void)fprintf(f, "     \"active_max\": %u,\n", s->active_max); break;
    case TUILE_WARNOCK:
        (void)fprintf(f, "     \"windows\": %u, \"windows_depth\": %u, \"windows_pixels\": %u, \"windows_waiting\": %u,\n",
                      s->windows, s->windows_depth, s->windows_pixels, s->windows_waiting);
        break;
    case TUILE_PAINTER:
        (void)fprintf(f, "     \"compared\": %u, \"moved\": %u, \"splits\": %u,\n", s->compared, s->moved, s->splits);
        break;
    case TUILE_TREE: (void)fprintf(f, "     \"nodes\": %u, \"instances_sorted\": %u,\n", s->nodes, s->instances_sorted); break;
    default: break;
    }
    (void)fprintf(f,
                  "     \"passes\": %u, \"tiles\": %u, \"tiles_narrow\": %u, \"size_bytes\": %u, \"least_bytes\": %u, "
                  "\"peak_bytes\": %u,\n"
                  "     \"wire_bytes\": %llu, \"wire_ns\": %llu, \"fps_bus\": %.2f",
                  s->passes, s->tiles, s->tiles_narrow, s->size_bytes, s->least_bytes, s->peak_bytes,
                  (unsigned long long)r->wire_bytes, (unsigned long long)r->wire_ns, r->wire_ns ? 1e9 / (double)r->wire_ns : 0.0);
    render_predict_report(r->predict, c, f);
    (void)fprintf(f, "}");
}
