/* Small textured triangles by SSE2 (visibility/smalls_sse2.c) against smalls_draw of visibility/rows.h: by the test that holds
 * assembly for microcontrollers against the same twin, emulators/twins_textured.c, here on the machine that builds it.
 */
#include "support/check.h"

#include <inttypes.h>
#include <stdarg.h>

/* The files under test are built into this one, since what they call is the test's. */
#define textured_source_open twins_source_open
#define smalls_textured sse2_smalls_textured
#define smalls_textured_sse2 sse2_smalls_textured_sse2
#define zbuffer_textured_tile sse2_zbuffer_textured_tile
#define zbuffer_textured_now sse2_zbuffer_textured_now
#include "../raster/visibility/rows.h"

/* Faces that it leaves to C, which draws them. */
static uint32_t left_to_c;

bool counted(bool drawn_by_c);
bool counted(bool drawn_by_c) {
    left_to_c += drawn_by_c;
    return drawn_by_c;
}
#define small_prepare(...) counted(small_prepare(__VA_ARGS__))
#include "../raster/visibility/smalls_sse2.c"
#undef small_prepare
#include "../raster/visibility/zbuffer_textured.c"

enum { SSE2 = ASSEMBLY_SSE2 };

#undef smalls_textured
#undef zbuffer_textured_tile
#undef zbuffer_textured_now
#undef ASSEMBLY_SSE2
#define smalls_textured c_smalls_textured
#define zbuffer_textured_tile c_zbuffer_textured_tile
#define zbuffer_textured_now c_zbuffer_textured_now
#define ASSEMBLY_SSE2 0
void c_smalls_textured(tuile_t *t, walk_t *walk, uint32_t limit);
int c_zbuffer_textured_tile(tuile_t *t, uint16_t row);
void c_zbuffer_textured_now(tuile_t *t, uint32_t number);
#include "../raster/visibility/zbuffer_textured.c"

#undef smalls_textured
#define smalls_textured counted_smalls_textured
void counted_smalls_textured(tuile_t *t, walk_t *walk, uint32_t limit);
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wsign-conversion" /* written for fewer warnings */
#pragma GCC diagnostic ignored "-Wattributes"      /* tune.h: the functions under test are optimized in their own way */
#endif
#include "emulators/twins_faces.c"
#include "emulators/twins_textured.c"

void counted_smalls_textured(tuile_t *of, walk_t *walk, uint32_t limit) {
    const uint32_t others = of->stats.faces_setup;
    left_to_c = 0;
    sse2_smalls_textured(of, walk, limit);
    drawn += of->stats.faces_setup - others - left_to_c;
}

void __real_textured_thumb(textured_run_t *run) { (void)run; }

void twins_tell(const char *text, ...) {
    va_list list;
    va_start(list, text);
    for (; text; text = va_arg(list, const char *)) {
        print_message("%s%" PRId32, text, va_arg(list, int32_t));
    }
    va_end(list);
    print_message("\n");
}

bool twins_equal(const char *what, const void *assembly_, const void *c, size_t size_bytes) {
    const uint8_t *a = assembly_, *b = c;
    for (size_t i = 0; i < size_bytes; i++) {
        if (a[i] != b[i]) {
            twins_tell(what, INT32_C(0), ": byte ", (int32_t)i, " by SSE2 ", (int32_t)a[i], ", by C ", (int32_t)b[i], NULL);
            return false;
        }
    }
    return true;
}

static void sse2_has_the_bits_of_c(void **state) {
    (void)state;
    if (!SSE2) { skip(); }
    assert_true(twins_test());
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(sse2_has_the_bits_of_c)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
