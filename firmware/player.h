/* Plays a scene of the list on a display, in a block of memory: what boards and the simulator run. */
#ifndef TUILE_FIRMWARE_PLAYER_H
#define TUILE_FIRMWARE_PLAYER_H

#include "scenes.h"
#include "update.h"

/* Zero = default, throughout. */
typedef struct player_config {
    const void *model; /* the compiled bytes of the script's model, 4-byte aligned; they outlive the player */
    size_t model_bytes;
    tuile_display_t *display; /* initialised; outlives the player */
    void *block;              /* the renderer's, 8-byte aligned; outlives the player */
    size_t block_bytes;
    uint8_t method;                   /* tuile_method_t, of those of the script */
    uint8_t buffers;                  /* tiles in flight: 1 or 2; 0 = 2 */
    uint16_t tile_width, tile_height; /* 0 = the whole width; as high as suits the block and the display */
    tuile_overlay_fn overlay;         /* drawn over each tile; NULL = none */
    void *overlay_context;
    /* NULL = every frame is sent whole; else as tuile_update_frame wants it, and it outlives the player. player_open forgets the
     * frame before; the sums may come afterwards, when tuile_config(player->renderer) tells the tiles. */
    tuile_update_t *update;
} player_config_t;

/* Must not be moved while it is open. */
typedef struct player {
    scene_stage_t stage;
    tuile_display_t *display;
    tuile_update_t *update; /* may be NULL */
    tuile_t *renderer;
    tuile_stats_t stats; /* of the last frame */
    size_t wanted_bytes; /* after TUILE_ERROR_MEMORY: a block that would have been enough there */
} player_t;

/* Lays the renderer out for the script and the display. 0 or an error of either kind (tuile_stream_error_text);
 * TUILE_ERROR_ARGUMENT also for a method that the script does not name, TUILE_ERROR_TREE when its model has no tree for it. */
int player_open(player_t *player, const scene_script_t *script, const player_config_t *config);

/* Draws one frame and shows it, or what has changed of it. 0 or an error of either kind. */
int player_frame(player_t *player, uint32_t frame);

/* The same of the stage as it is set, by scene_phase. */
int player_show(player_t *player);

#endif
