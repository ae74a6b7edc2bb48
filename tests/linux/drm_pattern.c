/* Draws a pattern on the first connector of a DRM device by plain ioctls: a frame, and then a part of another, told by DIRTYFB.
 * Usage: drm_pattern /dev/dri/cardN */
#include "pattern.h"

#include <drm/drm.h>
#include <drm/drm_fourcc.h>
#include <drm/drm_mode.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

/* What stands between the program and the picture. */
typedef struct card {
    int file;
    uint32_t connector, crtc, buffer, pitch_px;
    struct drm_mode_modeinfo mode;
    uint32_t *pixels;
} card_t;

static bool call(const card_t *card, unsigned long request, void *argument, const char *name) {
    int result;

    do {
        result = ioctl(card->file, request, argument);
    } while (result < 0 && errno == EINTR);
    if (result < 0) { (void)fprintf(stderr, "drm_pattern: %s: %s\n", name, strerror(errno)); }
    return result == 0;
}

static bool find_mode(card_t *card) {
    struct drm_mode_card_res resources = {.count_connectors = 1, .count_crtcs = 1};
    struct drm_mode_get_connector connector = {0};
    struct drm_mode_modeinfo modes[8];

    resources.connector_id_ptr = (uintptr_t)&card->connector;
    resources.crtc_id_ptr = (uintptr_t)&card->crtc;
    if (!call(card, DRM_IOCTL_MODE_GETRESOURCES, &resources, "GETRESOURCES")) { return false; }
    connector.connector_id = card->connector;
    if (!call(card, DRM_IOCTL_MODE_GETCONNECTOR, &connector, "GETCONNECTOR")) { return false; } /* looks for modes */
    if (connector.count_modes == 0 || connector.count_modes > 8) {
        (void)fprintf(stderr, "drm_pattern: %u modes\n", connector.count_modes);
        return false;
    }
    connector.modes_ptr = (uintptr_t)modes;
    connector.count_props = connector.count_encoders = 0;
    if (!call(card, DRM_IOCTL_MODE_GETCONNECTOR, &connector, "GETCONNECTOR")) { return false; }
    card->mode = modes[0];
    return true;
}

static bool make_buffer(card_t *card) {
    struct drm_mode_create_dumb dumb = {.width = card->mode.hdisplay, .height = card->mode.vdisplay, .bpp = 32};
    struct drm_mode_fb_cmd2 frame = {
        .width = card->mode.hdisplay, .height = card->mode.vdisplay, .pixel_format = DRM_FORMAT_XRGB8888};
    struct drm_mode_map_dumb map = {0};
    void *pixels;

    if (!call(card, DRM_IOCTL_MODE_CREATE_DUMB, &dumb, "CREATE_DUMB")) { return false; }
    frame.handles[0] = map.handle = dumb.handle;
    frame.pitches[0] = dumb.pitch;
    if (!call(card, DRM_IOCTL_MODE_ADDFB2, &frame, "ADDFB2") || !call(card, DRM_IOCTL_MODE_MAP_DUMB, &map, "MAP_DUMB")) {
        return false;
    }
    pixels = mmap(NULL, dumb.size, PROT_READ | PROT_WRITE, MAP_SHARED, card->file, (off_t)map.offset);
    if (pixels == MAP_FAILED) {
        perror("drm_pattern: mmap");
        return false;
    }
    card->pixels = pixels;
    card->buffer = frame.fb_id;
    card->pitch_px = dumb.pitch / 4;
    return true;
}

static void draw(const card_t *card, uint32_t round) {
    const bool part = round > 0;
    const uint32_t right = part ? PATTERN_RIGHT : card->mode.hdisplay, bottom = part ? PATTERN_BOTTOM : card->mode.vdisplay;

    for (uint32_t y = part ? PATTERN_TOP : 0; y < bottom; y++) {
        for (uint32_t x = part ? PATTERN_LEFT : 0; x < right; x++) {
            card->pixels[y * card->pitch_px + x] = pattern_pixel(x, y, round);
        }
    }
}

int main(int count, char **arguments) {
    card_t card = {.file = count == 2 ? open(arguments[1], O_RDWR | O_CLOEXEC) : -1};
    struct drm_mode_crtc crtc = {.count_connectors = 1, .mode_valid = 1};
    struct drm_clip_rect clip = {.x1 = PATTERN_LEFT, .y1 = PATTERN_TOP, .x2 = PATTERN_RIGHT, .y2 = PATTERN_BOTTOM};
    struct drm_mode_fb_dirty_cmd dirty = {.num_clips = 1, .clips_ptr = (uintptr_t)&clip};

    if (card.file < 0) {
        perror("drm_pattern");
        return 1;
    }
    if (!find_mode(&card) || !make_buffer(&card)) { return 1; }
    draw(&card, 0);
    crtc.set_connectors_ptr = (uintptr_t)&card.connector;
    crtc.crtc_id = card.crtc;
    crtc.fb_id = card.buffer;
    crtc.mode = card.mode;
    if (!call(&card, DRM_IOCTL_MODE_SETCRTC, &crtc, "SETCRTC")) { return 1; }
    draw(&card, 1);
    dirty.fb_id = card.buffer;
    if (!call(&card, DRM_IOCTL_MODE_DIRTYFB, &dirty, "DIRTYFB")) { return 1; }
    (void)printf("%ux%u\n", card.mode.hdisplay, card.mode.vdisplay);
    return 0;
}
