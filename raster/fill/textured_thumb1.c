/* Set-up, rows and pixels of small textured triangles in Thumb-1. The numbers are those of fill/small.h and surface/textured.h, to
 * the bit.
 *
 * What pays: the list's loop, set-up and rows are one function. Sides come first: of a face that covers no centre gradients are
 * never made. One that touches columns beside the tile takes rows of its own, which are cut to the tile's columns. Products are as
 * long as their factors' bounds want: a number of 16 bits or less is one factor wherever that may be, and what a gradient is at the
 * first centre follows from its parts before they are put together. Rows and pixels share one running depth, light, address and
 * map: a row moves them from the last pixel of the one above to its own first.
 *
 * Registers of pixels: r0 address of depth, r1 depth, r3 light, r4 from depth to colour, r7 mask with the shift in its lowest byte,
 * where a shift by a register looks (bits of the map that it lets pass there fall out behind the shift); r8, r9, r10, r11 dx of
 * depth and light, map, its dx, r12 the row's end, lr what rounds a colour.
 *
 * A texel is lit by one product for all and one for green, which is taken out of the first again: all that is below a colour's bits
 * is then its own. Green is the 6 bits at 0 in its product, so that what rounds it is a short number.
 *
 * Instructions: ARMv6-M Architecture Reference Manual (DDI 0419), chapter A6.
 */
#include "../tune.h"

#include "../assembly.h"
#include "textured_thumb.h"

#if ASSEMBLY_THUMB1

#include "textured_thumb1_set_up.h"

static __attribute__((noinline, used)) void textured_thumb_far(textured_far_t *face, int32_t to_x, int32_t to_y) {
    const small_corners_t corners = {0, 0, face->x1, face->y1, face->x2, face->y2};
    const vertex_t v0 = {0, 0, face->depth_light[0]};
    const int32_t z0 = (int32_t)(face->depth_light[0] >> 8), light0 = (int32_t)(face->depth_light[0] & 0xff);
    const triangle_gradients_t g = small_gradients_exact(
        &corners, (int32_t)(face->depth_light[1] >> 8) - z0, (int32_t)(face->depth_light[2] >> 8) - z0,
        (int32_t)(face->depth_light[1] & 0xff) - light0, (int32_t)(face->depth_light[2] & 0xff) - light0, true);
    face->depth_light[0] = (uint32_t)small_at(g.depth, triangle_depth_of(&v0), to_x, to_y);
    face->depth_light[1] = (uint32_t)g.depth.dx;
    face->depth_light[2] = (uint32_t)g.depth.dy;
    face->light = (uint32_t)small_at(g.light, triangle_light_of(&v0), to_x, to_y) + TEXTURED_BIAS;
    face->light_dx = (uint32_t)g.light.dx;
    face->light_dy = (uint32_t)g.light.dy;
}

/* clang-format off */

#define TEXEL_OF_PALETTE \
    LINE("ldrb r2, [r5, r2]") \
    LINE("ldr r5, [sp, #PALETTE]") \
    LINE("lsls r2, r2, #1") \
    LINE("ldrh r2, [r5, r2]")

#define TEXEL_OF_COLOURS \
    LINE("lsls r2, r2, #1") \
    LINE("ldrh r2, [r5, r2]")

/* Only columns of the tile. ENTRY: of the first row. */
#define CLAMP(ENTRY) \
    LINE("b 39f") \
    LINE(ENTRY "movs r5, #0") \
    LINE("str r5, [sp, #COLUMN]") \
    LINE("39: ldr r5, [sp, #CLAMP_LEFT]") \
    LINE("cmp r2, r5") \
    LINE("bge 39f") \
    LINE("movs r2, r5") \
    LINE("39: ldr r5, [sp, #CLAMP_RIGHT]") \
    LINE("cmp r4, r5") \
    LINE("ble 39f") \
    LINE("movs r4, r5") \
    LINE("39:")

/* ENTRY: r7 as the step to a row leaves it, r2 and r4 its first column and the one behind its last, r6 from where all is to r2. TEXEL: from an index in r2 to a colour
 * there, by the texels in r5. */
#define ROWS(ENTRY, TEXEL, CLAMP) \
    UNIFIED \
    LINE("32: ldr r6, [sp, #COLUMN]") \
    LINE("str r4, [sp, #COLUMN]") \
    LINE("subs r6, r2, r6") \
    LINE(ENTRY "lsls r5, r6, #1") \
    LINE("adds r0, r0, r5") \
    LINE("subs r4, r4, r2") \
    LINE("lsls r4, r4, #1") \
    LINE("adds r4, r4, r0") \
    LINE("mov r12, r4") \
    LINE("mov r5, r8") \
    LINE("muls r5, r6, r5") \
    LINE("adds r1, r1, r5") \
    LINE("mov r5, r9") \
    LINE("muls r5, r6, r5") \
    LINE("adds r3, r3, r5") \
    LINE("mov r5, r11") \
    LINE("muls r5, r6, r5") \
    LINE("add r10, r5") \
    LINE("ldmia r7, {r4, r7}") \
    LINE("33: ldrh r2, [r0]") \
    LINE("lsrs r5, r1, #16") \
    LINE("cmp r5, r2") \
    LINE("bls 34f") \
    LINE("strh r5, [r0]") \
    LINE("mov r2, r10") \
    LINE("ands r2, r7") \
    LINE("lsls r5, r2, #8") \
    LINE("orrs r2, r5") \
    LINE("lsrs r2, r7") \
    LINE("ldr r5, [sp, #TEXELS]") \
    TEXEL \
    LINE("lsrs r5, r3, #26") \
    LINE("lsls r6, r2, #21") \
    LINE("lsrs r6, r6, #26") \
    LINE("muls r6, r5, r6") \
    LINE("adds r6, #32") \
    LINE("lsls r6, r6, #5") \
    LINE("muls r2, r5, r2") \
    LINE("subs r2, r2, r6") \
    LINE("add r2, lr") \
    LINE("eors r6, r2") \
    LINE("ldr r5, [sp, #FIELD]") \
    LINE("ands r6, r5") \
    LINE("eors r2, r6") \
    LINE("lsrs r2, r2, #6") \
    LINE("rev16 r2, r2") \
    LINE("strh r2, [r0, r4]") \
    LINE("34: add r1, r8") \
    LINE("add r3, r9") \
    LINE("add r10, r11") \
    LINE("adds r0, #2") \
    LINE("cmp r0, r12") \
    LINE("bne 33b") \
    LINE("30: ldr r5, [sp, #ROWS]") \
    LINE("subs r5, r5, #1") \
    LINE("beq 36f") \
    LINE("str r5, [sp, #ROWS]") \
    LINE("31: add r7, sp, #SIDES") \
    LINE("ldmia r7!, {r2, r4, r5, r6}") \
    LINE("adds r2, r2, r5") \
    LINE("adds r4, r4, r6") \
    LINE("str r2, [sp, #SIDES]") \
    LINE("str r4, [sp, #SIDES + 4]") \
    LINE("ldmia r7!, {r5, r6}") \
    LINE("adds r1, r1, r5") \
    LINE("adds r3, r3, r6") \
    LINE("ldmia r7!, {r5, r6}") \
    LINE("add r10, r5") \
    LINE("adds r0, r0, r6") \
    LINE("asrs r2, r2, #20") \
    LINE("asrs r4, r4, #20") \
    CLAMP \
    LINE("cmp r2, r4") \
    LINE("blt 32b") \
    LINE("b 30b") \
    LINE("36: ldr r5, [sp, #BELOW]") \
    LINE("movs r6, #0") \
    LINE("str r6, [sp, #BELOW]") \
    LINE("str r5, [sp, #ROWS]") \
    LINE("ldr r6, [sp, #NEXT_SLOPE]") \
    LINE("cmp r5, #0") \
    LINE("bne 38f") \
    LINE("b 28b") \
    LINE("38: ldr r5, [sp, #NEXT_X]") \
    LINE("ldr r2, [sp, #CORNERS + 4]")      /* which side bends? */ \
    LINE("ldr r4, [sp, #CORNERS + 12]") \
    LINE("cmp r2, r4") \
    LINE("bge 37f") \
    LINE("str r5, [sp, #SIDES]") \
    LINE("str r6, [sp, #SIDES + 8]") \
    LINE("b 31b") \
    LINE("37: str r5, [sp, #SIDES + 4]") \
    LINE("str r6, [sp, #SIDES + 12]") \
    LINE("b 31b")

ASSEMBLY_FUNCTION void textured_thumb(textured_run_t *run) {
    (void)run;
    __asm__ volatile(
        UNIFIED
        FRAME
        ENTER

        LINE("86: b 87f")

        /* to the next face */
        LINE("10: ldr r0, [sp, #LIST + 4]")
        LINE("uxth r0, r0")
        LINE("ldr r1, [sp, #COUNT]")
        LINE("adds r1, #1")
        LINE("str r1, [sp, #COUNT]")

        /* r0: the face's record, number + 1 */
        LINE("11: str r0, [sp, #LIST]")
        LINE("subs r3, r0, #1")
        LINE("ldr r1, [sp, #LIMIT]")
        LINE("cmp r3, r1")
        LINE("bhs 90b")
        LINE("ldr r2, [sp, #ARENA]")
        LINE("ldr r4, [sp, #RECORD_BYTES]")
        LINE("muls r4, r0, r4")
        LINE("subs r2, r2, r4")
        LINE("ldrh r5, [r2, #8]")
        LINE("ldrb r6, [r2, #6]")
        LINE("ldmia r2!, {r3, r4}")
        LINE("str r3, [sp, #LIST + 4]")
        LINE("lsls r6, r6, #16")
        LINE("orrs r5, r6")
        LINE("ldr r6, [sp, #SOURCE]")
        LINE("cmp r5, r6")
        LINE("bne 86b")
        LINE("17: lsls r7, r4, #24")
        LINE("beq 90b")                     /* no triangle */

        /* r4 s1, r5 s2, r6 t1, r7 t2, r0 at least how far they go */
        LINE("lsrs r3, r3, #16")
        LINE("lsls r3, r3, #2")
        LINE("asrs r7, r7, #22")
        LINE("lsls r4, r4, #16")
        LINE("asrs r4, r4, #24")
        LINE("lsls r4, r4, #2")
        LINE("add r0, sp, #OFFSETS")
        LINE("stmia r0!, {r3, r4, r7}")
        LINE("ldr r0, [sp, #TEXCOORDS]")
        LINE("adds r0, r0, r3")
        LINE("ldr r6, [r0, r7]")
        LINE("ldr r7, [r0, r4]")
        LINE("ldr r0, [r0]")
        LINE("str r0, [sp, #FIRST_COORDINATES]")
        LINE("sxth r1, r0")
        LINE("asrs r0, r0, #16")
        LINE("sxth r4, r6")
        LINE("subs r4, r4, r1")
        LINE("sxth r5, r7")
        LINE("subs r5, r5, r1")
        LINE("asrs r6, r6, #16")
        LINE("subs r6, r6, r0")
        LINE("asrs r7, r7, #16")
        LINE("subs r7, r7, r0")
        LINE("add r0, sp, #COORDINATES")
        LINE("stmia r0!, {r4-r7}")
        LINE("asrs r0, r4, #31")
        LINE("eors r0, r4")
        LINE("asrs r1, r5, #31")
        LINE("eors r1, r5")
        LINE("adds r0, r0, r1")
        LINE("asrs r1, r6, #31")
        LINE("eors r1, r6")
        LINE("adds r0, r0, r1")
        LINE("asrs r1, r7, #31")
        LINE("eors r1, r7")
        LINE("adds r0, r0, r1")
        LINE("ldr r1, [sp, #ACROSS]")
        LINE("cmp r0, r1")
        LINE("bhs 88f")
        LINE("mov r8, r0")
        LINE("muls r4, r7, r4")
        LINE("muls r5, r6, r5")
        LINE("subs r4, r4, r5")
        LINE("asrs r5, r4, #31")
        LINE("eors r4, r5")
        LINE("mov r9, r4")                  /* texels of the level? */

        /* r0 x|y, r1 depth and light ... of three corners, r0 ... r5 */
        LINE("add r0, sp, #OFFSETS")
        LINE("ldmia r0!, {r3, r4, r7}")
        LINE("ldr r1, [sp, #VERTICES]")
        LINE("lsls r3, r3, #1")
        LINE("adds r1, r1, r3")
        LINE("lsls r4, r4, #1")
        LINE("adds r6, r1, r4")
        LINE("lsls r7, r7, #1")
        LINE("adds r7, r1, r7")
        LINE("ldmia r1, {r0, r1}")
        LINE("ldmia r7!, {r2, r3}")
        LINE("ldmia r6!, {r4, r5}")
        LINE("add r6, sp, #LIGHTS")
        LINE("stmia r6!, {r3, r5}")

        /* affine? */
        LINE("lsrs r7, r1, #8")
        LINE("lsrs r3, r3, #8")
        LINE("subs r3, r3, r7")
        LINE("lsrs r5, r5, #8")
        LINE("subs r5, r5, r7")
        LINE("stmia r6!, {r1, r3, r5}")
        LINE("asrs r6, r3, #31")
        LINE("eors r3, r6")
        LINE("asrs r6, r5, #31")
        LINE("eors r5, r6")
        LINE("adds r3, r3, r5")
        LINE("lsrs r3, r3, #8")
        LINE("adds r3, #1")
        LINE("ldr r6, [sp, #ONE]")
        LINE("add r6, r8")
        LINE("muls r3, r6, r3")
        LINE("lsrs r1, r1, #16")
        LINE("ldr r6, [sp, #LOG2_ONE]")
        LINE("lsls r1, r6")
        LINE("cmp r3, r1")
        LINE("bhi 88f")

        /* r0 x0, r6 y0, r2 x1, r3 y1, r4 x2, r5 y2, from the first corner for the others */
        LINE("asrs r6, r0, #16")
        LINE("asrs r3, r2, #16")
        LINE("subs r3, r3, r6")
        LINE("asrs r5, r4, #16")
        LINE("subs r5, r5, r6")
        LINE("sxth r0, r0")
        LINE("sxth r2, r2")
        LINE("subs r2, r2, r0")
        LINE("sxth r4, r4")
        LINE("subs r4, r4, r0")
        LINE("add r7, sp, #CORNERS")
        LINE("stmia r7!, {r2-r5}")

        /* the first centre */
        LINE("ldr r1, [sp, #TOP]")
        LINE("subs r1, r1, r6")
        LINE("asrs r6, r1, #4")
        LINE("bpl 70f")
        LINE("lsls r1, r1, #28")
        LINE("lsrs r1, r1, #28")
        LINE("13: ldr r7, [sp, #HEIGHT]")
        LINE("adds r7, r7, r6")
        LINE("str r7, [sp, #ROWS_LEFT]")
        LINE("ldr r7, [sp, #STRIDE]")
        LINE("muls r6, r7, r6")
        LINE("ldr r7, [sp, #DEPTH]")
        LINE("subs r7, r7, r6")
        LINE("movs r6, #8")
        LINE("subs r6, r6, r0")
        LINE("asrs r0, r6, #4")
        LINE("lsls r0, r0, #1")
        LINE("subs r7, r7, r0")
        LINE("str r7, [sp, #FIRST]")
        LINE("lsls r6, r6, #28")
        LINE("lsrs r6, r6, #28")
        LINE("str r6, [sp, #TO_X]")
        LINE("str r1, [sp, #DOWN]")
        LINE("lsls r0, r6, #16")
        LINE("ldr r7, [sp, #START]")
        LINE("subs r7, r7, r0")
        LINE("mov r8, r7")

        /* large enough, and of the level? */
        LINE("movs r7, r4")
        LINE("muls r7, r3, r7")
        LINE("movs r0, r2")
        LINE("muls r0, r5, r0")
        LINE("subs r7, r7, r0")
        LINE("str r7, [sp, #AREA]")
        LINE("ldr r0, [sp, #LEAST_AREA]")
        LINE("cmp r7, r0")
        LINE("blt 80f")
        LINE("81:")
        OF_LEVEL("91f")
        LINE("14: cmp r3, r5")
        LINE("bge 16f")
        LINE("b 15f")
        LINE("16: b 40f")
        LINE("88: b 90b")

        /* it begins above the tile's end: r1 is to_y */
        LINE("70: movs r6, #0")
        LINE("b 13b")

        IS_SMALL
        OTHER_LEVEL
        OTHER_SOURCE
        APPEND);

    __asm__ volatile(
        UNIFIED
        LINE("15:")
        EDGES("r2", "r3", "r4", "r5", "r2", "r4", "r3", "r5", "50f")
        LINE("50: b 51f")
        LINE("40:")
        EDGES("r4", "r5", "r2", "r3", "r3", "r5", "r2", "r4", "51f")

        /* the first row that is not empty */
        LINE("51: add r7, sp, #BELOW")
        LINE("stmia r7!, {r0-r5}")
        LINE("adds r0, r0, r1")
        LINE("ldr r1, [sp, #DOWN]")
        LINE("add r0, r12")                 /* -rows above it */
        LINE("cmp r0, #0")
        LINE("beq 52f")
        LINE("ldr r2, [sp, #STRIDE]")
        LINE("muls r2, r0, r2")
        LINE("ldr r3, [sp, #FIRST]")
        LINE("subs r3, r3, r2")
        LINE("str r3, [sp, #FIRST]")
        LINE("lsls r0, r0, #4")
        LINE("subs r1, r1, r0")
        LINE("52: lsrs r0, r1, #4")
        LINE("str r0, [sp, #DOWN]")
        LINE("lsls r1, r1, #28")
        LINE("lsrs r1, r1, #28")
        LINE("str r1, [sp, #TO_Y]")

        RECIPROCAL
        MAP_OF_FACE

        /* depths near one another? */
        LINE("add r0, sp, #DEPTHS")
        LINE("ldmia r0!, {r2-r7}")          /* and corners */
        LINE("ldr r0, [sp, #NEAR]")
        LINE("adds r1, r2, r0")
        LINE("adds r0, r3, r0")
        LINE("orrs r0, r1")
        LINE("lsrs r0, r0, #18")
        LINE("beq 61f")
        LINE("b 71f")
        LINE("61:")
        DEPTH_OF_FACE
        LIGHT_OF_FACE
        LINE("58: ldr r0, [sp, #DOWN]")
        LINE("cmp r0, #0")
        LINE("beq 59f")
        LINE("ldr r2, [sp, #DEPTH_DY]")
        LINE("muls r2, r0, r2")
        LINE("adds r1, r1, r2")
        LINE("ldr r2, [sp, #LIGHT_DY]")
        LINE("muls r2, r0, r2")
        LINE("adds r3, r3, r2")
        LINE("ldr r2, [sp, #MAP_DY]")
        LINE("muls r2, r0, r2")
        LINE("add r10, r2")

        /* rows */
        LINE("59: ldr r0, [sp, #ROUND]")
        LINE("mov lr, r0")
        LINE("ldr r0, [sp, #FIRST]")
        LINE("ldr r2, [sp, #SIDES]")
        LINE("asrs r2, r2, #20")
        LINE("ldr r4, [sp, #SIDES + 4]")
        LINE("asrs r4, r4, #20")
        LINE("str r4, [sp, #COLUMN]")
        LINE("movs r6, r2")
        LINE("add r7, sp, #COLOUR")
        LINE("ldr r5, [sp, #ROWS_AT]")
        LINE("mov pc, r5")

        LINE("71:")
        FAR_FACE);

    __asm__ volatile(ROWS("73: ", TEXEL_OF_PALETTE, ) ROWS("74: ", TEXEL_OF_COLOURS, )
                     ROWS("", TEXEL_OF_PALETTE, CLAMP("75: ")) ROWS("", TEXEL_OF_COLOURS, CLAMP("76: ")));
}

/* clang-format on */

#endif
