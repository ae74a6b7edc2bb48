/* Set-up, rows and pixels of small textured triangles in Thumb-2. The numbers are those of fill/small.h and surface/textured.h, to
 * the bit. Built as fill/small_thumb.c is, which see; what is added:
 *
 * A pixel has fourteen numbers and three that come and go. Two registers are two numbers each: the mask of whole texels has the
 * shift of the index in its lowest byte, where a shift by a register looks, and its own bits end above; bits of the address that it
 * lets pass there fall out behind the shift. What rounds colours counts the row's pixels in bits above those of a colour, and the
 * count's borrow ends the loop. The palette is loaded for each pixel. What rows have in registers and pixels do not want is stored
 * and loaded four at a time.
 *
 * A texel is lit by one product for red and blue and one for green, which bfi puts between them. Green is the 6 bits at 0 there, so
 * that one number rounds both: its bit 5 is half a step of blue and of green, its bit 16 of red, above all of green.
 */
#include "../tune.h"

#include "../assembly.h"
#include "textured_thumb.h"

#if ASSEMBLY_THUMB2

#include "thumb.h"

/* clang-format off */

/* At the stack pointer, bytes. The side of the bend is the one that changes there. */
#define FRAME \
    LINE(".equ BEND_SLOPE, 0")   /* of that side, and of the other */ \
    LINE(".equ OTHER_SLOPE, 4") \
    LINE(".equ STRIDE, 8")       /* bytes */ \
    LINE(".equ ROW, 12")         /* what rows have in r8, r9, r11 and r12; behind it what pixels have there */ \
    LINE(".equ COPY, 28")        /* of the run */ \
    LINE(".equ PALETTE, COPY + 16") \
    LINE(".equ LIMIT, COPY + 20") \
    LINE(".equ ARENA, COPY + 24")     /* and bytes of a record */ \
    LINE(".equ SOURCE, COPY + 32")    /* and known */ \
    LINE(".equ VERTICES, COPY + 40")  /* and texcoords */ \
    LINE(".equ TOP, COPY + 48")       /* and height */ \
    LINE(".equ DEPTH, COPY + 56")     /* and stride */ \
    LINE(".equ S_INSIDE, COPY + 64") \
    LINE(".equ ACROSS, COPY + 68") \
    LINE(".equ ONE, COPY + 72") \
    LINE(".equ LOG2_ONE, COPY + 76") \
    LINE(".equ LEVEL, COPY + 80") \
    LINE(".equ LEFT, COPY + 120")     /* and width */ \
    LINE(".equ OTHER, COPY + 128")    /* and mask, texels */ \
    LINE(".equ RUN_LIST, 176") \
    LINE(".equ DEPTH_DY, 204") \
    LINE(".equ LIGHT_DY, 208") \
    LINE(".equ MAP_DY, 212") \
    LINE(".equ FIRST, 216")       /* address of depth in the face's first row and column */ \
    LINE(".equ ROWS_LEFT, 220")   /* of the tile, from that row on */ \
    LINE(".equ START, 224")       /* small_start(0) */ \
    LINE(".equ NEXT_X, 228")      /* the side below the bend, a row before its first, and its slope */ \
    LINE(".equ MAP, 236")         /* at the first centre, and its dx */ \
    LINE(".equ TO_X, 244")        /* and to_y */ \
    LINE(".equ CORNER, 252")      /* s and t of the first corner, then in 1/256 texel */ \
    LINE(".equ DEPTH_LIGHT, 260") /* of the first corner */ \
    LINE(".equ LIST, 264")        /* the face's record: number + 1, first word */ \
    LINE(".equ RUN, 272")         /* textured_run_t */ \
    LINE(".equ COUNT, 276") \
    LINE(".equ END, 280") \
    LINE(".equ KEPT, 0") \
    LINE(".equ FRAME, 284") \
    LINE(".equ FROM_CORNER, 0")       /* of a level */ \
    LINE(".equ ALWAYS, 4") \
    LINE(".equ UPPER, 8")             /* and pixels_up */ \
    LINE(".equ LOWER, 16") \
    LINE(".equ UP, 20")               /* and down */ \
    LINE(".equ T_UNIT, 28") \
    LINE(".equ S_UNIT, 32")
_Static_assert(offsetof(textured_run_t, palette) == 16 && offsetof(textured_run_t, source) == 32 &&
                   offsetof(textured_run_t, s_inside) == 64 && offsetof(textured_run_t, level) == 80 &&
                   offsetof(textured_run_t, left) == 120 && offsetof(textured_run_t, other) == 128 &&
                   offsetof(textured_run_t, place) == 176 && sizeof(textured_run_level_t) == 40 &&
                   offsetof(textured_run_level_t, lower) == 16 && offsetof(textured_run_level_t, s_unit) == 32,
               "offsets in the assembly");
_Static_assert(offsetof(record_surface_t, source) == 8 && TEXTURED_FRACTION == 8 && TEXTURED_BIAS == 1 << 25,
               "numbers in the assembly");

/* r4: second word of the record; r3: its first word; r1: vertices; lr: texcoords. To r0 x|y, r1 depth and light ... of three
 * corners, r0 ... r5, and lr, r11, r12 their s|t. */
#define CORNERS \
    LINE("lsls r7, r4, #24") \
    LINE("beq 90f")                         /* no triangle */ \
    LINE("lsrs r3, r3, #16") \
    LINE("add r8, r1, r3, lsl #3") \
    LINE("add lr, lr, r3, lsl #2") \
    LINE("add r9, r8, r7, asr #21") \
    LINE("add r11, lr, r7, asr #22") \
    LINE("sbfx r10, r4, #8, #8") \
    LINE("add r12, lr, r10, lsl #2") \
    LINE("add r10, r8, r10, lsl #3") \
    LINE("ldr lr, [lr]") \
    LINE("ldr r11, [r11]") \
    LINE("ldr r12, [r12]") \
    LINE("ldrd r0, r1, [r8]") \
    LINE("ldrd r2, r3, [r9]") \
    LINE("ldrd r4, r5, [r10]")

/* The edges of a triangle, its mid corner being (XM, YM), on the side of the bend, its lowest one (XL, YL); r0 start, r9 to_y, r8
 * rows left of the tile. Then the rows. r1 depth, r3 its dx, lr light, r10 its dx, r8 rows, r9 the bend's side, r11 the other one. */
#define EDGES(XM, YM, XL, YL, ROWS) \
    LINE("lsls r5, " XL ", #20") \
    LINE("sdiv r5, r5, " YL) \
    LINE("mul r11, r5, r9") \
    LINE("add r11, r0, r11, asr #4") \
    LINE("sub r12, r9, " YL) \
    LINE("asr r12, r12, #4")                /* -rows */ \
    LINE("adds r8, r8, r12") \
    LINE("bmi 20f") \
    LINE("21: subs " YL ", " YL ", " YM) \
    LINE("subs " XL ", " XL ", " XM) \
    LINE("subs r8, r9, " YM) \
    LINE("bpl 25f") \
    LINE("lsls " XM ", " XM ", #20") \
    LINE("sdiv " YM ", " XM ", " YM) \
    LINE("mul r9, " YM ", r9") \
    LINE("add r9, r0, r9, asr #4") \
    LINE("strd " YM ", r5, [sp, #BEND_SLOPE]") \
    LINE("and r5, r8, #15")                 /* from the bend to the next centre */ \
    LINE("asr r8, r8, #4")                  /* -rows above the bend */ \
    LINE("subs r12, r8, r12")               /* rows below it */ \
    LINE("ble 24f") \
    LINE("add r0, r0, " XM ", asr #4") \
    LINE("lsls " XL ", " XL ", #20") \
    LINE("sdiv " XL ", " XL ", " YL) \
    LINE("mul r5, r5, " XL) \
    LINE("add r5, r0, r5, asr #4") \
    LINE("subs r5, r5, " XL) \
    LINE("strd r5, " XL ", [sp, #NEXT_X]") \
    LINE("add r8, r12, r8, lsl #16") \
    LINE("22: ldr r0, [sp, #FIRST]") \
    LINE("ldrd r6, r7, [sp, #MAP]") \
    LINE("mov r12, #0") \
    LINE("b " ROWS) \
    LINE("24: subs r8, r8, r12")            /* none */ \
    LINE("lsls r8, r8, #16") \
    LINE("b 22b") \
    LINE("25: lsls " XL ", " XL ", #20")    /* no rows above the bend: r8 from it to the first centre */ \
    LINE("sdiv " XL ", " XL ", " YL) \
    LINE("mul r8, r8, " XL) \
    LINE("add r0, r0, " XM ", lsl #16") \
    LINE("add r9, r0, r8, asr #4") \
    LINE("strd " XL ", r5, [sp, #BEND_SLOPE]") \
    LINE("lsl r8, r12, #16") \
    LINE("b 22b") \
    LINE("20: sub r12, r12, r8")            /* it reaches below the tile */ \
    LINE("push {r0, r1, r2, r3}") \
    LINE("ldr r0, [sp, #16 + LIST]") \
    LINE("ldrd r1, r3, [sp, #16 + ARENA]") \
    LINE("ldr r2, [sp, #16 + END]") \
    LINE("mls r1, r0, r3, r1") \
    LINE("movs r3, #0") \
    LINE("strh r0, [r2]") \
    LINE("strh r3, [r1]")                   /* its next */ \
    LINE("str r1, [sp, #16 + END]") \
    LINE("pop {r0, r1, r2, r3}") \
    LINE("b 21b")

/* LEFT, RIGHT: sides. r8 is -rows * 2^16, with the rows below the bend added. r12: the column that r0, r1, lr and r6 are of. TEXEL:
 * from an index in r2 to a colour there. */
#define ROWS(ENTRY, LEFT, RIGHT, TEXEL) \
    LINE("30: ldm sp, {r2, r4, r5}") \
    LINE("31: add r9, r9, r2") \
    LINE("add r11, r11, r4") \
    LINE("adds r0, r0, r5") \
    LINE("add r5, sp, #DEPTH_DY") \
    LINE("ldm r5, {r2, r4, r5}") \
    LINE("add r1, r1, r2") \
    LINE("add lr, lr, r4") \
    LINE("adds r6, r6, r5") \
    LINE(ENTRY " asr r2, " LEFT ", #20") \
    LINE("cmp r2, " RIGHT ", asr #20") \
    LINE("bge 35f") \
    LINE("sub r4, r2, r12") \
    LINE("asr r12, " RIGHT ", #20") \
    LINE("mla r1, r3, r4, r1") \
    LINE("mla lr, r10, r4, lr") \
    LINE("mla r6, r7, r4, r6") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE("sub r5, r12, r2") \
    LINE("add r2, sp, #ROW") \
    LINE("stm r2!, {r8, r9, r11, r12}") \
    LINE("ldm r2, {r8, r9, r11, r12}") \
    LINE("add r12, r12, r5, lsl #22") \
    LINE("32: ldrh r2, [r0], #2") \
    LINE("cmp r2, r1, lsr #16") \
    LINE("bhs 33f") \
    LINE("lsrs r2, r1, #16") \
    LINE("strh r2, [r0, #-2]") \
    LINE("and r2, r6, r8") \
    LINE("orr r2, r2, r2, lsl #8") \
    LINE("lsr r2, r2, r8") \
    TEXEL \
    LINE("lsr r4, lr, #26") \
    LINE("ubfx r5, r2, #5, #6") \
    LINE("bic r2, r2, #0x7e0") \
    LINE("mla r5, r5, r4, r12") \
    LINE("mla r2, r2, r4, r12") \
    LINE("lsrs r5, r5, #6") \
    LINE("bfi r2, r5, #11, #6") \
    LINE("lsrs r2, r2, #6") \
    LINE("rev16 r2, r2") \
    LINE("strh r2, [r0, r11]") \
    LINE("33: add r1, r1, r3") \
    LINE("add lr, lr, r10") \
    LINE("adds r6, r6, r7") \
    LINE("subs r12, r12, #0x400000") \
    LINE("bcs 32b") \
    LINE("ldm sp, {r2, r4, r5, r8, r9, r11, r12}") \
    LINE("adds r8, r8, #0x10000") \
    LINE("bmi 31b") \
    LINE("b 36f") \
    LINE("35: adds r8, r8, #0x10000") \
    LINE("bmi 30b") \
    LINE("36: beq 10b") \
    LINE("rsbs r8, r8, #0") \
    LINE("lsls r8, r8, #16") \
    LINE("ldrd r9, r2, [sp, #NEXT_X]") \
    LINE("str r2, [sp, #BEND_SLOPE]") \
    LINE("b 30b")

#define TEXEL_OF_PALETTE \
    LINE("ldr r4, [sp, #PALETTE]") \
    LINE("ldrb r2, [r9, r2]") \
    LINE("ldrh r2, [r4, r2, lsl #1]")

#define TEXEL_OF_COLOURS LINE("ldrh r2, [r9, r2, lsl #1]")

#define ROWS_OF_ALL \
    LINE("50: ldr r2, [sp, #PALETTE]") \
    LINE("cmp r2, #0") \
    LINE("bne 52f") \
    LINE("b 54f") \
    ROWS("52:", "r9", "r11", TEXEL_OF_PALETTE) \
    LINE("51: ldr r2, [sp, #PALETTE]") \
    LINE("cmp r2, #0") \
    LINE("bne 53f") \
    LINE("b 55f") \
    ROWS("53:", "r11", "r9", TEXEL_OF_PALETTE) \
    ROWS("54:", "r9", "r11", TEXEL_OF_COLOURS) \
    ROWS("55:", "r11", "r9", TEXEL_OF_COLOURS)

__attribute__((naked, noipa)) void textured_thumb(textured_run_t *run) {
    (void)run;
    __asm__ volatile(
        FRAME
        LINE("push {r4-r11, lr}")
        LINE("sub sp, sp, #FRAME")
        LINE("str r0, [sp, #RUN]")
        LINE("movw r1, #0xffc0")
        LINE("movt r1, #0xf")
        LINE("str r1, [sp, #START]")
        LINE("add r11, sp, #COPY")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("str r8, [sp, #STRIDE]")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("ldm r0!, {r1-r4}")
        LINE("stm r11!, {r1-r4}")
        LINE("ldm r0, {r0, r1, r2}")        /* list, end, count */
        LINE("strd r2, r1, [sp, #COUNT]")
        LINE("b 11f")

        COUNTED

        /* r0: the face's record, number + 1 */
        LINE("11: ldr r1, [sp, #LIMIT]")
        LINE("subs r3, r0, #1")
        LINE("cmp r3, r1")
        LINE("bhs 89f")
        LINE("ldrd r2, r4, [sp, #ARENA]")
        LINE("mls r2, r0, r4, r2")
        LINE("ldrd r3, r4, [r2]")
        LINE("ldrh r5, [r2, #8]")
        LINE("strd r0, r3, [sp, #LIST]")
        LINE("ubfx r6, r4, #16, #8")
        LINE("orr r5, r5, r6, lsl #16")
        LINE("ldrd r6, r7, [sp, #SOURCE]")
        LINE("cmp r5, r6")
        LINE("bne 90f")
        LINE("ldrd r1, lr, [sp, #VERTICES]")
        LINE("cmp r7, #0")
        LINE("beq 80f")
        CORNERS
        DIFFERENCES(NEAR_DIFFERENCES)

        /* the first centre */
        LINE("12: ldrd r9, r10, [sp, #TOP]")
        LINE("sub r9, r9, r8")
        LINE("asrs r8, r9, #4")
        LINE("bpl 70f")
        LINE("and r9, r9, #15")
        LINE("13: add r10, r10, r8")
        LINE("str r10, [sp, #ROWS_LEFT]")
        LINE("ldr r10, [sp, #STRIDE]")
        LINE("mul r8, r8, r10")
        LINE("ldr r10, [sp, #DEPTH]")
        LINE("sub r10, r10, r8")
        LINE("rsb r0, r0, #8")
        LINE("asr r8, r0, #4")
        LINE("and r0, r0, #15")
        LINE("sub r10, r10, r8, lsl #1")
        LINE("str r10, [sp, #FIRST]")
        LINE("strd r0, r9, [sp, #TO_X]")

        /* r9 s1, r10 t1, r11 s2, r12 t2; lr: their sizes */
        LINE("sxth r0, lr")
        LINE("asr r8, lr, #16")
        LINE("sxth r9, r11")
        LINE("sub r9, r9, r0")
        LINE("rsb r10, r8, r11, asr #16")
        LINE("sxth r11, r12")
        LINE("sub r11, r11, r0")
        LINE("rsb r12, r8, r12, asr #16")
        LINE("ldr lr, [sp, #S_INSIDE]")
        LINE("and r0, r0, lr")
        LINE("strd r0, r8, [sp, #CORNER]")
        LINE("eor lr, r9, r9, asr #31")
        LINE("eor r0, r10, r10, asr #31")
        LINE("add lr, lr, r0")
        LINE("eor r0, r11, r11, asr #31")
        LINE("add lr, lr, r0")
        LINE("eor r0, r12, r12, asr #31")
        LINE("add lr, lr, r0")
        LINE("ldr r0, [sp, #ACROSS]")
        LINE("cmp lr, r0")
        LINE("bhs 90f")

        /* affine? */
        LINE("lsr r8, r1, #8")
        LINE("rsb r0, r8, r3, lsr #8")
        LINE("rsb r8, r8, r5, lsr #8")
        LINE("eor r0, r0, r0, asr #31")
        LINE("eor r8, r8, r8, asr #31")
        LINE("add r0, r0, r8")
        LINE("lsrs r0, r0, #8")
        LINE("adds r0, r0, #1")
        LINE("ldr r8, [sp, #ONE]")
        LINE("add lr, lr, r8")
        LINE("mul r0, r0, lr")
        LINE("ldr lr, [sp, #LOG2_ONE]")
        LINE("lsr r8, r1, #16")
        LINE("lsl r8, r8, lr")
        LINE("cmp r0, r8")
        LINE("bhi 90f")
        LINE("str r1, [sp, #DEPTH_LIGHT]")

        /* r8: area, then its reciprocal; r0: texels, lr: pixels, of the level? */
        LINE("mul r8, r7, r2")
        LINE("mls r8, r6, r4, r8")
        LINE("cmp r8, #8")
        LINE("blo 90f")
        LINE("mul r0, r9, r12")
        LINE("mls r0, r11, r10, r0")
        LINE("eor r0, r0, r0, asr #31")
        LINE("ldrd r1, lr, [sp, #LEVEL + UPPER]")
        LINE("lsl lr, r8, lr")
        LINE("lsr r1, r0, r1")
        LINE("cmp r1, lr")
        LINE("bhi 91f")
        LINE("ldr r1, [sp, #LEVEL + LOWER]")
        LINE("lsrs r0, r0, r1")
        LINE("ldr r1, [sp, #LEVEL + ALWAYS]")
        LINE("orrs r0, r0, r1")
        LINE("cmp r0, lr")
        LINE("bls 91f")
        LINE("15: mvn r1, #0x80000000")
        LINE("udiv r8, r1, r8")
        LINE("ldrd r0, r1, [sp, #CORNER]")
        LINE("ldr lr, [sp, #LEVEL + FROM_CORNER]")
        LINE("lsls r0, r0, #8")
        LINE("asr r0, r0, lr")
        LINE("lsls r1, r1, #8")
        LINE("asr r1, r1, lr")
        LINE("strd r0, r1, [sp, #CORNER]")

        /* steps: r0 and r9 of s, right and down, r11 and r10 of t */
        LINE("ldrd r0, lr, [sp, #LEVEL + UP]")
        LINE("asr lr, r8, lr")
        LINE("lsl r9, r9, r0")
        LINE("lsl r10, r10, r0")
        LINE("lsl r11, r11, r0")
        LINE("lsl r12, r12, r0")
        LINE("mul r0, r11, r2")
        LINE("mls r0, r9, r4, r0")
        LINE("mul r9, r9, r7")
        LINE("mls r9, r11, r6, r9")
        LINE("mul r11, r12, r2")
        LINE("mls r11, r10, r4, r11")
        LINE("mul r10, r10, r7")
        LINE("mls r10, r12, r6, r10")
        LINE("smull r1, r0, r0, lr")
        LINE("add r0, r0, r1, lsr #31")
        LINE("smull r1, r9, r9, lr")
        LINE("add r9, r9, r1, lsr #31")
        LINE("smull r1, r11, r11, lr")
        LINE("add r11, r11, r1, lsr #31")
        LINE("smull r1, r10, r10, lr")
        LINE("add r10, r10, r1, lsr #31")

        /* r1: the map in the first row, or in that row of the top corner's pixel; r11, r10 its dx, dy */
        LINE("ldrd r1, lr, [sp, #TO_X]")
        LINE("and lr, lr, #15")
        LINE("mul r12, r0, r1")
        LINE("mla r12, r9, lr, r12")
        LINE("mul r1, r11, r1")
        LINE("mla r1, r10, lr, r1")
        LINE("ldr lr, [sp, #CORNER]")
        LINE("add r12, lr, r12, asr #4")
        LINE("ldr lr, [sp, #CORNER + 4]")
        LINE("add r1, lr, r1, asr #4")
        LINE("ldr lr, [sp, #LEVEL + T_UNIT]")
        LINE("mul r1, r1, lr")
        LINE("mul r11, r11, lr")
        LINE("mul r10, r10, lr")
        LINE("ldr lr, [sp, #LEVEL + S_UNIT]")
        LINE("mla r1, r12, lr, r1")
        LINE("mla r11, r0, lr, r11")
        LINE("mla r10, r9, lr, r10")
        LINE("ldrd r0, r9, [sp, #TO_X]")
        LINE("lsr lr, r9, #4")
        LINE("mla r1, r10, lr, r1")
        LINE("strd r1, r11, [sp, #MAP]")
        LINE("str r10, [sp, #MAP_DY]")
        LINE("ldr r1, [sp, #DEPTH_LIGHT]")

        DEPTHS
        LIGHT("0x28000000")                 /* half and TEXTURED_BIAS, times 16 */
        DEPTH("r5")
        LINE("str r5, [sp, #DEPTH_DY]")

        LINE("14: ldrd r8, r5, [sp, #ROWS_LEFT]")
        LINE("sub r0, r5, r0, lsl #16")
        LINE("cmp r2, r4")
        LINE("bge 40f")
        EDGES("r6", "r2", "r7", "r4", "50f")
        LINE("40:")
        EDGES("r7", "r4", "r6", "r2", "51f"));

    __asm__ volatile(ROWS_OF_ALL);

    /* What is seldom. */
    __asm__ volatile(
        ABOVE

        LINE("71:")
        FAR_SHADE(LINE("add lr, lr, #0x2000000")) /* TEXTURED_BIAS */
        LINE("b 14b")

        /* another level: the other one? Then they change places. */
        LINE("91: mul r0, r9, r12")
        LINE("mls r0, r11, r10, r0")
        LINE("eor r0, r0, r0, asr #31")
        LINE("ldr r1, [sp, #OTHER + UPPER]")
        LINE("lsr r1, r0, r1")
        LINE("cmp r1, lr")
        LINE("bhi 90f")
        LINE("ldr r1, [sp, #OTHER + LOWER]")
        LINE("lsrs r0, r0, r1")
        LINE("ldr r1, [sp, #OTHER + ALWAYS]")
        LINE("orrs r0, r0, r1")
        LINE("cmp r0, lr")
        LINE("bls 90f")
        LINE("push {r2-r7, r9-r12}")
        LINE("add r0, sp, #40 + LEVEL")
        LINE("add r1, sp, #40 + OTHER")
        LINE("ldm r0, {r2-r6}")
        LINE("ldm r1, {r7, r9-r12}")
        LINE("stm r0!, {r7, r9-r12}")
        LINE("stm r1!, {r2-r6}")
        LINE("ldm r0, {r2-r6}")
        LINE("ldm r1, {r7, r9-r12}")
        LINE("stm r0!, {r7, r9-r12}")
        LINE("stm r1!, {r2-r6}")
        LINE("ldrd r2, r3, [sp, #40 + COPY]")
        LINE("ldrd r4, r5, [r1]")
        LINE("strd r2, r3, [r1]")
        LINE("strd r4, r5, [sp, #40 + COPY]")
        LINE("pop {r2-r7, r9-r12}")
        LINE("b 15b")

        /* nothing is known of the face: is it short, and inside the tile's columns? */
        LINE("80:")
        CORNERS
        DIFFERENCES(TRUE_DIFFERENCES)
        SHORT
        LINE("ldr r9, [sp, #LEFT]")
        LINE("ldr r10, [sp, #LEFT + 4]")
        LINE("sub r9, r0, r9")
        LINE("cmp r9, r10")
        LINE("bhs 90f")
        LINE("add r9, r9, r6")
        LINE("cmp r9, r10")
        LINE("bhs 90f")
        LINE("subs r9, r9, r6")
        LINE("add r9, r9, r7")
        LINE("cmp r9, r10")
        LINE("blo 12b")

        LEAVE);
}

/* clang-format on */

#endif
