#include "cores.h"

/* Both cores see these: what was written before a counter was set is seen by whoever has seen the counter. */
static uint32_t look(const uint32_t *counter) { return __atomic_load_n(counter, __ATOMIC_ACQUIRE); }

static void show(uint32_t *counter, uint32_t value) { __atomic_store_n(counter, value, __ATOMIC_RELEASE); }

static uint32_t now(const cores_t *cores) { return cores->port->now ? cores->port->now(cores->port->context) : 0; }

static void pause(const cores_t *cores) {
    if (cores->port->pause) { cores->port->pause(cores->port->context); }
}

static void notify(const cores_t *cores) {
    if (cores->port->notify) { cores->port->notify(cores->port->context); }
}

static uint32_t tile_rows(const cores_t *cores) {
    return (cores->config.height + (uint32_t)cores->config.tile_height - 1u) / cores->config.tile_height;
}

/* Rows cost the same all over a band, as far as can be known: that many of the longer one's make up half of the difference. That is
 * half of them at most, so neither band is ever left without any. */
uint32_t cores_border(uint32_t border, uint32_t rows, uint32_t busy_first, uint32_t busy_second) {
    if (busy_first > busy_second) {
        border -= (uint32_t)((uint64_t)(busy_first - busy_second) * border / (2u * (uint64_t)busy_first));
    } else if (busy_second > busy_first) {
        border += (uint32_t)((uint64_t)(busy_second - busy_first) * (rows - border) / (2u * (uint64_t)busy_second));
    }
    return border;
}

/* A renderer draws the tiles that begin in its rows; to move them it is laid out anew, which takes no longer than to clear its
 * state. */
static int lay_out(cores_t *cores, unsigned core) {
    tuile_config_t config = cores->config;
    cores_half_t *half = &cores->halves[core];
    const uint16_t row = (uint16_t)(cores->border * config.tile_height); /* the height, where one row is all there is */

    config.row_first = core ? row : 0;
    config.row_end = core ? config.height : row;
    return tuile_init(&half->renderer, &config, half->block, half->block_bytes, NULL);
}

int cores_open(cores_t *cores, const cores_config_t *config) {
    int error;

    *cores = (cores_t){.config = *config->renderer, .display = config->display, .port = config->port};
    cores->config.buffers = 2;
    cores->config.row_first = cores->config.row_end = 0;
    for (unsigned core = 0; core < 2; core++) {
        cores->halves[core].block = config->blocks[core];
        cores->halves[core].block_bytes = config->block_bytes[core];
    }
    /* The tiles that the smaller block has room for, for both. */
    for (unsigned core = 0; core < 2; core++) {
        cores_half_t *half = &cores->halves[core];
        tuile_config_t alone = *config->renderer;

        alone.buffers = 2;
        if ((error = tuile_init(&half->renderer, &alone, half->block, half->block_bytes, NULL))) { return error; }
        if (core == 0 || tuile_config(half->renderer)->tile_height < cores->config.tile_height) {
            cores->config.tile_height = tuile_config(half->renderer)->tile_height;
        }
    }
    cores->border = (uint16_t)((tile_rows(cores) + 1u) / 2u);
    for (unsigned core = 0; core < 2; core++) {
        if ((error = lay_out(cores, core))) { return error; }
    }
    return tuile_stream_check(tuile_config(cores->halves[0].renderer), cores->display);
}

/* Whoever has the lock. The write before this one, of whichever core, is waited for in it. */
static int send_tile(tuile_display_t *display, const tuile_tile_t *tile) {
    const int result = tuile_display_window(display, tile->x, tile->y, tile->width, tile->height);

    return result ? result : tuile_display_write(display, tile->bytes, (size_t)tile->size_bytes);
}

/* The tiles of a core's band, to the display. After an error of either core both stop at their next tile. */
static int draw_tiles(cores_t *cores, tuile_t *renderer) {
    tuile_tile_t tile;
    int result;

    while (!look(&cores->broken) && (result = tuile_next(renderer, &tile)) != 0) {
        if (result > 0) {
            cores->port->lock(cores->port->context);
            result = send_tile(cores->display, &tile);
            cores->port->unlock(cores->port->context);
        }
        if (result < 0) {
            show(&cores->broken, 1);
            return result;
        }
    }
    return 0;
}

static void draw_half(cores_t *cores, unsigned core) {
    cores_half_t *half = &cores->halves[core];
    const uint32_t start = now(cores);
    int result = lay_out(cores, core);

    half->stats = (tuile_stats_t){0};
    if (!result && !(result = tuile_begin(half->renderer, cores->scene))) {
        result = draw_tiles(cores, half->renderer);
        (void)tuile_end(half->renderer, &half->stats); /* it was begun, so it can be ended */
    }
    half->result = result;
    half->busy = now(cores) - start;
}

void cores_serve(cores_t *cores) {
    uint32_t done = cores->done;

    for (;;) {
        while (look(&cores->asked) == done) {
            if (look(&cores->closed)) { return; }
            pause(cores);
        }
        draw_half(cores, 1);
        show(&cores->done, ++done);
        notify(cores);
    }
}

static int finish(cores_t *cores) {
    const int waited = tuile_display_wait(cores->display);

    for (unsigned core = 0; core < 2; core++) {
        if (cores->halves[core].result) { return cores->halves[core].result; }
    }
    return waited ? waited : tuile_display_present(cores->display);
}

int cores_frame(cores_t *cores, const tuile_scene_t *scene) {
    const uint32_t frame = cores->asked + 1u;

    cores->scene = scene;
    cores->broken = 0;
    show(&cores->asked, frame);
    notify(cores);
    draw_half(cores, 0);
    while (look(&cores->done) != frame) {
        pause(cores);
    }
    cores->border = (uint16_t)cores_border(cores->border, tile_rows(cores), cores->halves[0].busy, cores->halves[1].busy);
    return finish(cores);
}

void cores_close(cores_t *cores) {
    show(&cores->closed, 1);
    notify(cores);
}
