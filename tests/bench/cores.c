/* How much faster two cores draw than one: by two threads, each scene of the boards, 240 x 240.
 *
 * Usage: cores MODELS   the folder of the compiled models
 * Two ratios of tiles per second. Work: by the processor time of the busier thread, which is what two free cores would take. Clock:
 * by the clock on the wall, which this machine's other work is in. */
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "../../firmware/cores.h"
#include "../../firmware/scenes.h"

#define SIDE 240
#define FRAMES 64u
#define BLOCK_BYTES (256u * 1024u)

static _Alignas(8) uint8_t blocks[2][BLOCK_BYTES];
static _Alignas(4) uint8_t model[1u << 20];

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static void lock(void *context) { (void)context, (void)pthread_mutex_lock(&mutex); }

static void unlock(void *context) { (void)context, (void)pthread_mutex_unlock(&mutex); }

static void pause_thread(void *context) { (void)context, (void)sched_yield(); }

static uint64_t clock_us(clockid_t clock) {
    struct timespec time;

    (void)clock_gettime(clock, &time);
    return (uint64_t)time.tv_sec * 1000000u + (uint64_t)time.tv_nsec / 1000u;
}

static uint32_t thread_us(void *context) {
    (void)context;
    return (uint32_t)clock_us(CLOCK_THREAD_CPUTIME_ID);
}

static const cores_port_t port = {.lock = lock, .unlock = unlock, .pause = pause_thread, .now = thread_us};

/* A display that takes everything and shows nothing. */
static int describe(void *context, const tuile_display_config_t *config, tuile_view_t *view) {
    (void)context, (void)config;
    *view = (tuile_view_t){.width = SIDE, .height = SIDE, .align_x = 1, .align_y = 1, .wire = TUILE_WIRE_RGB565};
    return 0;
}

static int nothing(void *context) {
    (void)context;
    return 0;
}

static int window(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    (void)context, (void)x, (void)y, (void)width, (void)height;
    return 0;
}

static int write_nothing(void *context, const uint8_t *bytes, size_t size_bytes) {
    (void)context, (void)bytes, (void)size_bytes;
    return 0;
}

static int show(void *context, bool first) {
    (void)context, (void)first;
    return 0;
}

static const tuile_device_t device = {
    .describe = describe, .start = nothing, .window = window, .write = write_nothing, .show = show, .sleep = nothing};

typedef struct times {
    uint64_t work_us, clock_us;
} times_t;

static void check(int error) {
    if (!error) { return; }
    (void)fprintf(stderr, "cores: %s\n", tuile_stream_error_text(error));
    exit(1);
}

static times_t one_core(scene_stage_t *stage, const tuile_config_t *config, tuile_display_t *display) {
    times_t times = {0};
    tuile_t *renderer;

    check(tuile_init(&renderer, config, blocks[0], BLOCK_BYTES, NULL));
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        check(scene_frame(stage, frame));
        const uint64_t work = clock_us(CLOCK_THREAD_CPUTIME_ID), start = clock_us(CLOCK_MONOTONIC);
        check(tuile_stream_frame(renderer, &stage->scene, display, NULL));
        times.work_us += clock_us(CLOCK_THREAD_CPUTIME_ID) - work;
        times.clock_us += clock_us(CLOCK_MONOTONIC) - start;
    }
    return times;
}

static void *serve(void *context) {
    cores_serve(context);
    return NULL;
}

static times_t two_cores(scene_stage_t *stage, const tuile_config_t *config, tuile_display_t *display) {
    static cores_t cores;
    times_t times = {0};
    pthread_t thread;

    check(cores_open(&cores, &(cores_config_t){.renderer = config,
                                               .display = display,
                                               .port = &port,
                                               .blocks = {blocks[0], blocks[1]},
                                               .block_bytes = {BLOCK_BYTES, BLOCK_BYTES}}));
    if (pthread_create(&thread, NULL, serve, &cores) != 0) { exit(1); }
    for (uint32_t frame = 0; frame < FRAMES; frame++) {
        check(scene_frame(stage, frame));
        const uint64_t start = clock_us(CLOCK_MONOTONIC);
        check(cores_frame(&cores, &stage->scene));
        times.clock_us += clock_us(CLOCK_MONOTONIC) - start;
        times.work_us += cores.halves[0].busy > cores.halves[1].busy ? cores.halves[0].busy : cores.halves[1].busy;
    }
    cores_close(&cores);
    (void)pthread_join(thread, NULL);
    return times;
}

static void compare(const scene_script_t *script, const char *folder, uint8_t aa) {
    static scene_stage_t stage;
    tuile_config_t config = {.width = SIDE, .height = SIDE, .tile_height = 8, .aa = aa};
    tuile_display_t display;
    char path[4096];
    size_t size = 0;
    FILE *file;

    (void)snprintf(path, sizeof path, "%s/%s.tuile", folder, script->model);
    file = fopen(path, "rb");
    if (file) {
        size = fread(model, 1, sizeof model, file);
        (void)fclose(file);
    }
    check(scene_open(&stage, script, model, size, SIDE, SIDE));
    check(tuile_display_init(&display, &(tuile_display_config_t){.device = &device}));
    scene_configure(&stage, &config);
    (void)one_core(&stage, &config, &display); /* caches */
    const times_t one = one_core(&stage, &config, &display), two = two_cores(&stage, &config, &display);
    (void)printf("%-8s %u samples a pixel: one core %5u us a frame; two: %.2f times as many tiles by work, %.2f by the clock\n",
                 script->name, 1u << 2 * aa, (unsigned)(one.work_us / FRAMES), (double)one.work_us / (double)two.work_us,
                 (double)one.clock_us / (double)two.clock_us);
}

int main(int count, char **arguments) {
    for (unsigned i = 0; count == 2 && i < scene_count; i++) {
        compare(scenes[i], arguments[1], TUILE_AA_NONE);
        compare(scenes[i], arguments[1], TUILE_AA_4X4);
    }
    return count == 2 ? 0 : 2;
}
