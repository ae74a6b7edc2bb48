/* What the sending thread of hal/linux is worth: a frame on a made-up spidev whose messages take as long as their bits, drawn by
 * somebody who is busy for as long. Under umockdev-wrapper. */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "../../hal/display.h"
#include "../../hal/panels/ili9341.h"
#include "../mock/linux.h"

enum { WIDTH = 240, HEIGHT = 320, CLOCK_HZ = 10000000, FRAMES = 8 };

static double now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec / 1e6;
}

static void draw(double ms) {
    const struct timespec time = {0, (long)(ms * 1e6)};
    (void)nanosleep(&time, NULL);
}

/* Milliseconds of the fastest frame, as other programs may disturb the rest; negative when it failed. */
static double measure(bool no_worker, uint32_t max_chunk_bytes, uint32_t tile_rows, double draw_ms) {
    static mock_linux_t mock;
    static uint8_t tiles[2][WIDTH * HEIGHT * 2];
    const uint32_t tile_bytes = WIDTH * tile_rows * 2;
    tuile_linux_config_t config = mock_linux_config();
    tuile_linux_t port;
    tuile_display_t display;
    double best = 1e9;
    int result;

    mock = (mock_linux_t){0};
    mock_linux_open(&mock, "ili9341");
    config.no_worker = no_worker;
    if (mock_linux_port(&mock, &port, &config)) { return -1; }
    port.bus.max_chunk_bytes = max_chunk_bytes;
    result = tuile_display_init(&display,
                                &(tuile_display_config_t){.bus = &port.bus, .panel = &tuile_ili9341, .pixel_clock_hz = CLOCK_HZ});
    mock.wire_time = true;
    for (unsigned frame = 0; frame < FRAMES && !result; frame++) {
        const double begin = now_ms();
        for (uint32_t y = 0; y < HEIGHT && !result; y += tile_rows) {
            draw(draw_ms * tile_rows / HEIGHT);
            if (!(result = tuile_display_window(&display, 0, y, WIDTH, tile_rows))) {
                result = tuile_display_write(&display, tiles[y / tile_rows % 2], tile_bytes);
            }
        }
        if (!result) { result = tuile_display_present(&display); }
        if (now_ms() - begin < best) { best = now_ms() - begin; }
    }
    tuile_linux_close(&port);
    mock_linux_close(&mock);
    return result ? -1 : best;
}

int main(void) {
    static const uint32_t rows[] = {8, 40, 160};
    static const double draws[] = {30, 120};
    const double wire_ms = WIDTH * HEIGHT * 16.0 / CLOCK_HZ * 1e3;

    (void)printf("240x320 RGB565 at %.0f MHz: %.1f ms on the wire; ms a frame\n", CLOCK_HZ / 1e6, wire_ms);
    (void)printf("%8s %8s  %10s %18s %22s\n", "drawing", "tile", "no thread", "thread, per chunk", "thread, whole buffer");
    for (size_t d = 0; d < sizeof draws / sizeof draws[0]; d++) {
        for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
            const double none = measure(true, 0, rows[r], draws[d]), chunks = measure(false, 4092, rows[r], draws[d]);
            const double whole = measure(false, 0, rows[r], draws[d]);
            (void)printf("%5.0f ms  240x%-4u %10.1f %11.1f (%.2f) %15.1f (%.2f)\n", draws[d], rows[r], none, chunks, none / chunks,
                         whole, none / whole);
        }
    }
    return mock_linux_end(NULL);
}
