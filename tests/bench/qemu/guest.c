/* The frames of the bench on an emulated microcontroller: the model in flash, no C library. Prints a hash of all pictures, which
 * must be that of the host.
 *
 * Defined by the compiler's arguments: SCENE, the header that guest_scene wrote; WIDTH, HEIGHT, TILE_WIDTH, TILE_HEIGHT; SHADE,
 * EFFECTS and METHOD as of tuile_config_t; MEMORY bytes.
 */
#include "../../../raster/memory.h"
#include "../../../raster/tuile.h"

extern const uint8_t guest_model[], guest_model_end[]; /* start.S */
static tuile_model_t model;

#include SCENE

static _Alignas(8) uint8_t block[MEMORY];

/* Nothing is counted but what happens between these two. */
void guest_from(void);
void guest_to(void);
int guest_main(void);

__attribute__((noinline)) void guest_from(void) { __asm__ volatile("" ::: "memory"); }
__attribute__((noinline)) void guest_to(void) { __asm__ volatile("" ::: "memory"); }

/* ---- what the compiler may call ---- */

/* Words at a time where all is aligned. */
void *memcpy(void *restrict to, const void *restrict from, size_t size_bytes) {
    uint8_t *t = to;
    const uint8_t *f = from;
    if ((((uintptr_t)t | (uintptr_t)f) & 3u) == 0) {
        for (; size_bytes >= 4; size_bytes -= 4, t += 4, f += 4) {
            *(uint32_t *)(void *)t = *(const uint32_t *)(const void *)f;
        }
    }
    while (size_bytes--) {
        *t++ = *f++;
    }
    return to;
}

void *memmove(void *to, const void *from, size_t size_bytes) {
    uint8_t *t = to;
    const uint8_t *f = from;
    if (t <= f) { return memcpy(to, from, size_bytes); }
    if ((((uintptr_t)t | (uintptr_t)f | size_bytes) & 3u) == 0) {
        for (; size_bytes; size_bytes -= 4) {
            *(uint32_t *)(void *)(t + size_bytes - 4) = *(const uint32_t *)(const void *)(f + size_bytes - 4);
        }
    }
    while (size_bytes--) {
        t[size_bytes] = f[size_bytes];
    }
    return to;
}

void *memset(void *to, int value, size_t size_bytes) {
    uint8_t *t = to;
    const uint32_t word = (uint8_t)value * 0x01010101u;
    if (((uintptr_t)t & 3u) == 0) {
        for (; size_bytes >= 4; size_bytes -= 4, t += 4) {
            *(uint32_t *)(void *)t = word;
        }
    }
    while (size_bytes--) {
        *t++ = (uint8_t)value;
    }
    return to;
}

/* ---- semihosting ---- */

static void call(uint32_t operation, uintptr_t argument) {
#if defined(__riscv)
    register uint32_t a0 __asm__("a0") = operation;
    register uintptr_t a1 __asm__("a1") = argument;
    __asm__ volatile(".balign 16\n.option push\n.option norvc\nslli x0, x0, 0x1f\nebreak\nsrai x0, x0, 7\n.option pop"
                     : "+r"(a0)
                     : "r"(a1)
                     : "memory");
#else
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
#endif
}

static void print(const char *text) { call(0x04, (uintptr_t)text); }

static void end(uint32_t code) {
    const uint32_t block_of_two[2] = {0x20026, code};
    call(0x20, (uintptr_t)block_of_two);
}

static void print_hex(const char *before, uint64_t value) {
    char text[17] = {0};
    for (int i = 0; i < 16; i++) {
        text[i] = "0123456789abcdef"[value >> (60 - 4 * i) & 15];
    }
    print(before);
    print(text);
    print("\n");
}

/* ---- the frames ---- */

static uint64_t hash_tile(uint64_t hash, const tuile_tile_t *tile) {
    for (uint32_t i = 0; i < tile->size_bytes; i++) {
        hash = (hash ^ tile->bytes[i]) * 1099511628211u;
    }
    return hash;
}

static int frame(tuile_t *renderer, const tuile_scene_t *scene, uint64_t *hash) {
    tuile_tile_t tile;
    guest_from();
    int result = tuile_begin(renderer, scene);
    if (result) { return result; }
    while ((result = tuile_next(renderer, &tile)) == 1) {
        guest_to();
        *hash = hash_tile(*hash, &tile);
        guest_from();
    }
    (void)tuile_end(renderer, NULL);
    guest_to();
    return result;
}

int guest_main(void) {
    static const tuile_config_t config = {.width = WIDTH,
                                          .height = HEIGHT,
                                          .tile_width = TILE_WIDTH,
                                          .tile_height = TILE_HEIGHT,
                                          .shade = SHADE,
                                          .effects = EFFECTS,
                                          .method = METHOD,
                                          .cluster_vertices = SCENE_CLUSTER_VERTICES,
                                          .corners = SCENE_CORNERS,
                                          .tree_depth = SCENE_TREE_DEPTH};
    tuile_scene_t scene = {
        .instance_count = 1, .lights = &scene_light, .light_count = 1, .ambient = SCENE_AMBIENT, .camera = scene_camera};
    uint64_t hash = 14695981039346656037u;
    tuile_t *renderer;
    int result = tuile_model_open(&model, guest_model, (size_t)(guest_model_end - guest_model));
    if (!result) { result = tuile_init(&renderer, &config, block, sizeof block, NULL); }
    for (unsigned i = 0; i < SCENE_FRAMES && !result; i++) {
        scene.instances = &scene_frames[i];
        result = frame(renderer, &scene, &hash);
    }
    if (result) { print(tuile_error_text(result)); }
    print_hex("hash ", hash);
    end((uint32_t)(result != 0));
    return 0;
}
