#include "player.h"

/* The most rows that a tile of this block has and that the display's windows can begin at; 0 when it is less than one such row. */
static unsigned aligned_rows(const tuile_t *renderer, unsigned align) {
    const unsigned rows = tuile_config(renderer)->tile_height;

    return rows == tuile_config(renderer)->height ? rows : rows / align * align;
}

static int lay_out(player_t *player, tuile_config_t *layout, const player_config_t *config) {
    const unsigned align = player->display->align_y;
    unsigned rows;
    int error = tuile_init(&player->renderer, layout, config->block, config->block_bytes, &player->wanted_bytes);

    if (error || layout->tile_height ||
        (rows = aligned_rows(player->renderer, align)) == tuile_config(player->renderer)->tile_height) {
        return error;
    }
    layout->tile_height = (uint16_t)(rows ? rows : align);
    return tuile_init(&player->renderer, layout, config->block, config->block_bytes, &player->wanted_bytes);
}

int player_open(player_t *player, const scene_script_t *script, const player_config_t *config) {
    tuile_config_t layout = {
        .width = config->display->width,
        .height = config->display->height,
        .tile_width = config->tile_width,
        .tile_height = config->tile_height,
        .format = tuile_stream_format(config->display),
        .method = config->method,
        .buffers = config->buffers,
        .overlay = config->overlay,
        .overlay_context = config->overlay_context,
    };
    int error;

    player->display = config->display;
    player->update = config->update;
    player->stats = (tuile_stats_t){0};
    player->wanted_bytes = 0;
    if (config->update) { tuile_update_forget(config->update); }
    if (config->update && config->update->changes) { tuile_changes_forget(config->update->changes); }
    if (config->method > TUILE_TREE || !(script->methods >> config->method & 1u)) { return TUILE_ERROR_ARGUMENT; }
    if ((error = scene_open(&player->stage, script, config->model, config->model_bytes, layout.width, layout.height))) {
        return error;
    }
    if (config->method == TUILE_TREE && !player->stage.model.tree) { return TUILE_ERROR_TREE; }
    scene_configure(&player->stage, &layout);
    return lay_out(player, &layout, config);
}

int player_frame(player_t *player, uint32_t frame) {
    const int error = scene_frame(&player->stage, frame);

    return error ? error : player_show(player);
}

int player_show(player_t *player) {
    const int error =
        player->update ? tuile_update_frame(player->update, player->renderer, &player->stage.scene, player->display, &player->stats)
                       : tuile_stream_frame(player->renderer, &player->stage.scene, player->display, &player->stats);
    if (error == TUILE_ERROR_MEMORY) { player->wanted_bytes = tuile_wanted(player->renderer); }
    return error;
}
