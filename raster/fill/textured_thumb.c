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
 *
 * Sides come first, and nothing of the texture is asked for before some centre is covered. So a face that is left to C may have
 * been put behind those that reach below, or to the right: then it is taken away there.
 *
 * The map is made at the first centre that is covered, (x, y) sixteenths from the corner. There steps times x and y, modulo 2^32,
 * come to what they do in whole numbers, since the face is less than 2^15 / 256 texels across, though either product may be larger.
 */
#include "../tune.h"

#include "../assembly.h"
#include "textured_thumb.h"

#if ASSEMBLY_THUMB2

#include "thumb.h"

/* clang-format off */

/* At the stack pointer, bytes. */
#define FRAME \
    LINE(".equ LEFT_SLOPE, 0") \
    LINE(".equ RIGHT_SLOPE, 4") \
    LINE(".equ STRIDE, 8")            /* bytes */ \
    LINE(".equ ROW, 12")              /* what rows have in r8, r9, r11 and r12; behind it what pixels have there */ \
    LINE(".equ COPY, 28")             /* of the run, as far as its place */ \
    LINE(".equ PALETTE, COPY + 16") \
    LINE(".equ LIMIT, COPY + 20")     /* and end of the arena, bytes of a record */ \
    LINE(".equ RECORD_BYTES, COPY + 28") \
    LINE(".equ SOURCE, COPY + 32")    /* and known */ \
    LINE(".equ VERTICES, COPY + 40")  /* and texcoords */ \
    LINE(".equ TOP, COPY + 48")       /* and height */ \
    LINE(".equ DEPTH, COPY + 56")     /* and stride */ \
    LINE(".equ ACROSS, COPY + 64")    /* and one */ \
    LINE(".equ LOG2_ONE, COPY + 72") \
    LINE(".equ PIXELS_UP, COPY + 76") /* and what else a level has, in its order, and s_inside */ \
    LINE(".equ LOWER, COPY + 84") \
    LINE(".equ UP, COPY + 92") \
    LINE(".equ T_UNIT, COPY + 100") \
    LINE(".equ FROM_CORNER, COPY + 108") \
    LINE(".equ INSTANCE, COPY + 116") /* and model's texcoords */ \
    LINE(".equ LEFT, COPY + 124")     /* and width */ \
    LINE(".equ RUN_LIST, 132") \
    LINE(".equ LEVELS, 144")          /* behind it */ \
    LINE(".equ DEPTH_DY, 160") \
    LINE(".equ LIGHT_DY, 164") \
    LINE(".equ MAP_DY, 168") \
    LINE(".equ START, 172")           /* small_start(0) */ \
    LINE(".equ NEXT_X, 176")          /* the side below the bend, a row before its first, and its slope */ \
    LINE(".equ MAP, 184")             /* at the first pixel, and its dx */ \
    LINE(".equ CORNERS, 192")         /* r0 ... r7 before sides are made, and s|t of three corners */ \
    LINE(".equ FIRST_ST, 232")        /* the last of them is that of the first corner */ \
    LINE(".equ LIST, 236")            /* the face's record: number + 1, first word */ \
    LINE(".equ RUN, 244")             /* textured_run_t */ \
    LINE(".equ COUNT, 248") \
    LINE(".equ END, 252") \
    LINE(".equ END_BEFORE, 256")      /* the last face went behind it */ \
    LINE(".equ MATCH, 260")           /* the source if faces are known to be short and inside; else -1 */ \
    LINE(".equ DRAW, 264")            /* ROWS of textures with a palette, or without */ \
    LINE(".equ DRAW_INSIDE, 268")     /* that is this one but for faces that touch columns beside the tile's */ \
    LINE(".equ DRAW_BESIDE, 272") \
    LINE(".equ BOUNDS, 276")          /* of such: the tile's first column, from the corner's, and that behind its last */ \
    LINE(".equ RIGHT, 284")           /* and is_short */ \
    LINE(".equ HANDED, 292")          /* the face went to the right there; or NULL; of such faces */ \
    LINE(".equ FRAME, 300") \
    LINE(".equ RUN_RIGHT, 508") \
    LINE(".equ KEPT, 24")             /* below that while gradients are made: the first row that is not empty */
_Static_assert(offsetof(textured_run_t, palette) == 16 && offsetof(textured_run_t, source) == 32 &&
                   offsetof(textured_run_t, across) == 64 && offsetof(textured_run_t, pixels_up) == 76 &&
                   offsetof(textured_run_t, s_inside) == 112 && offsetof(textured_run_t, instance) == 116 &&
                   offsetof(textured_run_t, left) == 124 && offsetof(textured_run_t, place) == 132 &&
                   offsetof(textured_run_t, levels) == 144 && offsetof(textured_run_t, right) == 508 &&
                   offsetof(textured_run_t, is_short) == 512 && sizeof(textured_run_level_t) == 40 &&
                   offsetof(textured_run_level_t, lower) == 4 && offsetof(textured_run_level_t, from_corner) == 28,
               "offsets in the assembly");
_Static_assert(offsetof(record_surface_t, source) == 8 && sizeof(source_slot_t) == 2 * sizeof(vertex_t) &&
                   offsetof(source_slot_t, instance) == 4 && offsetof(source_slot_t, colours) == 6 &&
                   offsetof(source_slot_t, attributes) == 8 && TEXTURED_FRACTION == 8 && TEXTURED_BIAS == 1 << 25,
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
    LINE("ldr r12, [lr, r10, lsl #2]") \
    LINE("add r10, r8, r10, lsl #3") \
    LINE("ldr lr, [lr]") \
    LINE("ldr r11, [r11]") \
    LINE("ldrd r0, r1, [r8]") \
    LINE("ldrd r2, r3, [r9]") \
    LINE("ldrd r4, r5, [r10]")

#define PUT_AWAY LINE("str r0, [sp, #CORNERS]")
#define RIGHT_RECORD LINE("ldr r10, [sp, #RECORD_BYTES]") LINE("mls r11, r12, r10, r11")
#define RECORD LINE("ldr r3, [sp, #16 + RECORD_BYTES]") LINE("str r2, [sp, #16 + END_BEFORE]") LINE("mls r1, r0, r3, r1")

/* r3 left side, r11 right one. A bit in r8 tells which of them has the bend. */
#define KEEP_LEFT LINE("strd lr, r5, [sp, #LEFT_SLOPE]") LINE("push {r0, r2, r3, r8, r11, r12}")
#define KEEP_RIGHT \
    LINE("strd r5, lr, [sp, #LEFT_SLOPE]") LINE("orr r8, r8, #0x8000") LINE("push {r0, r2, r3, r8, r11, r12}")
#define TO_INSIDE LINE("b 15f")
#define TO_BESIDE LINE("ldr r1, [sp, #KEPT + DRAW_BESIDE]") LINE("str r1, [sp, #KEPT + DRAW]") LINE("b 15b")

/* With what a face has of them. */
#define BENDS(WHERE) \
    EDGES("r6", "r2", "r7", "r4", "r3", "r11", , , RECORD, "r3", "r11", "bge", KEEP_LEFT TO_##WHERE, WHERE) \
    LINE("40:") \
    EDGES("r7", "r4", "r6", "r2", "r11", "r3", , , RECORD, "r3", "r11", "bge", KEEP_RIGHT TO_##WHERE, WHERE)

/* To s1 in r5, t1 r11, s2 lr, t2 r12; r8 area; r0 texels and r1 pixels, of the level? Is the face near enough, and affine? */
#define ASKED \
    LINE("15: add lr, sp, #KEPT + CORNERS + 4") \
    LINE("ldm lr, {r1-r7, r11, r12, lr}") \
    LINE("lsr r8, r1, #8") \
    LINE("rsb r3, r8, r3, lsr #8") \
    LINE("rsb r5, r8, r5, lsr #8") \
    LINE("eor r3, r3, r3, asr #31") \
    LINE("eor r5, r5, r5, asr #31") \
    LINE("adds r3, r3, r5") \
    LINE("lsrs r3, r3, #8") \
    LINE("sxth r10, lr") \
    LINE("asr r8, lr, #16") \
    LINE("sxth r5, r11") \
    LINE("sub r5, r5, r10") \
    LINE("rsb r11, r8, r11, asr #16") \
    LINE("sxth lr, r12") \
    LINE("sub lr, lr, r10") \
    LINE("rsb r12, r8, r12, asr #16") \
    LINE("eor r8, r5, r5, asr #31") \
    LINE("eor r10, r11, r11, asr #31") \
    LINE("add r8, r8, r10") \
    LINE("eor r10, lr, lr, asr #31") \
    LINE("add r8, r8, r10") \
    LINE("eor r10, r12, r12, asr #31") \
    LINE("add r8, r8, r10") \
    LINE("ldrd r0, r10, [sp, #KEPT + ACROSS]") \
    LINE("cmp r8, r0") \
    LINE("bhs 92f") \
    LINE("add r8, r8, r10") \
    LINE("mla r3, r3, r8, r8") \
    LINE("ldr r0, [sp, #KEPT + LOG2_ONE]") \
    LINE("lsrs r1, r1, #16") \
    LINE("lsls r1, r0") \
    LINE("cmp r3, r1") \
    LINE("bhi 92f") \
    LINE("mul r8, r7, r2") \
    LINE("mls r8, r6, r4, r8") \
    LINE("cmp r8, #8") \
    LINE("blo 92f") \
    LINE("mul r0, r5, r12") \
    LINE("mls r0, lr, r11, r0") \
    LINE("eor r0, r0, r0, asr #31") \
    LINE("ldrd r1, r3, [sp, #KEPT + PIXELS_UP]") \
    LINE("lsl r1, r8, r1") \
    LINE("lsr r3, r0, r3") \
    LINE("cmp r3, r1") \
    LINE("bhi 91f") \
    LINE("ldrd r3, r10, [sp, #KEPT + LOWER]") \
    LINE("lsr r3, r0, r3") \
    LINE("orr r3, r3, r10") \
    LINE("cmp r3, r1") \
    LINE("bls 91f")

/* r8: the reciprocal of the area. Steps: r0 and r5 of s, right and down, lr and r11 of t. The first corner, 1/256 texel: r10 s,
 * r12 t. Then the map. */
#define MAPPED \
    LINE("16: mvn r0, #0x80000000") \
    LINE("udiv r8, r0, r8") \
    LINE("ldrd r0, r1, [sp, #KEPT + UP]") \
    LINE("asr r3, r8, r1") \
    LINE("lsls r5, r0") \
    LINE("lsl r11, r11, r0") \
    LINE("lsl lr, lr, r0") \
    LINE("lsl r12, r12, r0") \
    LINE("mul r0, lr, r2") \
    LINE("mls r0, r5, r4, r0") \
    LINE("mul r5, r5, r7") \
    LINE("mls r5, lr, r6, r5") \
    LINE("mul lr, r12, r2") \
    LINE("mls lr, r11, r4, lr") \
    LINE("mul r11, r11, r7") \
    LINE("mls r11, r12, r6, r11") \
    LINE("smull r1, r0, r0, r3") \
    LINE("add r0, r0, r1, lsr #31") \
    LINE("smull r1, r5, r5, r3") \
    LINE("add r5, r5, r1, lsr #31") \
    LINE("smull r1, lr, lr, r3") \
    LINE("add lr, lr, r1, lsr #31") \
    LINE("smull r1, r11, r11, r3") \
    LINE("add r11, r11, r1, lsr #31") \
    LINE("ldr r1, [sp, #KEPT + FIRST_ST]") \
    LINE("ldrd r3, r12, [sp, #KEPT + FROM_CORNER]") \
    LINE("sxth r10, r1") \
    LINE("and r10, r10, r12") \
    LINE("lsl r10, r10, #8") \
    LINE("asr r10, r10, r3") \
    LINE("asr r12, r1, #16") \
    LINE("lsl r12, r12, #8") \
    LINE("asr r12, r12, r3") \
    LINE("ldr r1, [sp, #4]")                /* column */ \
    LINE("ldr r3, [sp, #KEPT + CORNERS]")   /* to_x */ \
    LINE("add r1, r3, r1, lsl #4") \
    LINE("mul r3, r0, r1") \
    LINE("mla r3, r5, r9, r3") \
    LINE("add r10, r10, r3, asr #4") \
    LINE("mul r3, lr, r1") \
    LINE("mla r3, r11, r9, r3") \
    LINE("add r12, r12, r3, asr #4") \
    LINE("ldrd r1, r3, [sp, #KEPT + T_UNIT]") \
    LINE("mul r12, r12, r1") \
    LINE("mla r12, r10, r3, r12") \
    LINE("mul lr, lr, r1") \
    LINE("mla lr, r0, r3, lr") \
    LINE("mul r11, r11, r1") \
    LINE("mla r11, r5, r3, r11") \
    LINE("strd r12, lr, [sp, #KEPT + MAP]") \
    LINE("str r11, [sp, #KEPT + MAP_DY]")

/* From the first row on: r0 address, r2 first column, r8 left side, r9 -rows * 2^16, with the bit of KEEP, r11 right side. r1 and lr
 * are at column 0 until they are moved. */
#define FIRST \
    LINE("14: pop {r0, r2, r8, r9, r11, r12}") \
    LINE("ldrd r6, r7, [sp, #MAP]") \
    LINE("asr r12, r11, #20") \
    LINE("subs r5, r12, r2") \
    LINE("mla r1, r3, r2, r1") \
    LINE("mla lr, r10, r2, lr") \
    LINE("ldr pc, [sp, #DRAW]")

/* What the first row of a face that touches columns beside the tile's wants else. */
#define ENTRY_INSIDE(ENTRY)
#define ENTRY_BESIDE(ENTRY) LINE(ENTRY) LAST_BESIDE("r11") LINE("subs r5, r12, r2") LINE("b 38f")

/* Behind its last row. */
#define LAST_ROW_INSIDE LINE("beq 10b")
#define LAST_ROW_BESIDE LINE("beq 39f")

/* r12: the column that r0, r1, lr and r6 are of, behind the row's last. TEXEL: from an index in r2 to a colour there. ENTRY: of
 * those inside, and BESIDE of the others. */
#define ROWS(ENTRY, BESIDE, TEXEL, WHERE) \
    ENTRY_##WHERE(BESIDE) \
    LINE("30: ldm sp, {r2, r4, r5}") \
    LINE("31: add r8, r8, r2") \
    LINE("add r11, r11, r4") \
    LINE("adds r0, r0, r5") \
    LINE("add r5, sp, #DEPTH_DY") \
    LINE("ldm r5, {r2, r4, r5}") \
    LINE("add r1, r1, r2") \
    LINE("add lr, lr, r4") \
    LINE("adds r6, r6, r5") \
    MOVE_##WHERE("r8", "r11", "bge") \
    LINE("mla r1, r3, r4, r1") \
    LINE("mla lr, r10, r4, lr") \
    LINE("mla r6, r7, r4, r6") \
    LINE("add r0, r0, r4, lsl #1") \
    LINE(ENTRY " add r2, sp, #ROW") \
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
    LINE("adds r9, r9, #0x10000") \
    LINE("bmi 31b") \
    LINE("b 36f") \
    LINE("35: adds r9, r9, #0x10000") \
    LINE("bmi 30b") \
    LINE("36: lsls r9, r9, #17")            /* carry: the bend is on the right */ \
    LAST_ROW_##WHERE \
    LINE("rsb r9, r9, #0") \
    LINE("asr r9, r9, #1") \
    LINE("bcs 37f") \
    LINE("ldrd r8, r2, [sp, #NEXT_X]") \
    LINE("str r2, [sp, #LEFT_SLOPE]") \
    LINE("b 30b") \
    LINE("37: ldrd r11, r2, [sp, #NEXT_X]") \
    LINE("str r2, [sp, #RIGHT_SLOPE]") \
    LINE("b 30b")

#define TEXEL_OF_PALETTE \
    LINE("ldr r4, [sp, #PALETTE]") \
    LINE("ldrb r2, [r9, r2]") \
    LINE("ldrh r2, [r4, r2, lsl #1]")

#define TEXEL_OF_COLOURS LINE("ldrh r2, [r9, r2, lsl #1]")

ASSEMBLY_FUNCTION void textured_thumb(textured_run_t *run) {
    (void)run;
    __asm__ volatile(
        FRAME
        LINE("push {r4-r11, lr}")
        LINE("sub sp, sp, #FRAME")
        LINE("str r0, [sp, #RUN]")
        LINE("ldrd r1, r2, [r0, #RUN_RIGHT]")
        LINE("strd r1, r2, [sp, #RIGHT]")
        LINE("movw r1, #0xffc0")
        LINE("movt r1, #0xf")
        LINE("str r1, [sp, #START]")
        LINE("add r11, sp, #COPY")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("cmp r5, #0")                  /* palette */
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("str r8, [sp, #STRIDE]")
        LINE("ittee ne")
        LINE("adrne r9, 52f + 1")           /* Thumb */
        LINE("adrne r10, 53f + 1")
        LINE("adreq r9, 54f + 1")
        LINE("adreq r10, 55f + 1")
        LINE("str r9, [sp, #DRAW]")
        LINE("strd r9, r10, [sp, #DRAW_INSIDE]")
        LINE("cmp r2, #0")                  /* known */
        LINE("ite ne")
        LINE("movne r9, r1")                /* source */
        LINE("moveq r9, #-1")
        LINE("str r9, [sp, #MATCH]")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("ldm r0!, {r1-r8}")
        LINE("stm r11!, {r1-r8}")
        LINE("ldm r0, {r1, r2, r3, r4}")    /* width, list, end, count */
        LINE("str r1, [r11]")
        LINE("strd r4, r3, [sp, #COUNT]")
        LINE("mov r0, r2")
        LINE("b 11f")

        COUNTED

        /* r0: the face's record, number + 1 */
        LINE("11: ldr r1, [sp, #LIMIT]")
        LINE("subs r3, r0, #1")
        LINE("cmp r3, r1")
        LINE("bhs 89f")
        LINE("ldrd r2, r4, [sp, #LIMIT + 4]")
        LINE("mls r2, r0, r4, r2")
        LINE("ldrd r3, r4, [r2]")
        LINE("ldrh r5, [r2, #8]")
        LINE("strd r0, r3, [sp, #LIST]")
        LINE("ubfx r6, r4, #16, #8")
        LINE("orr r5, r5, r6, lsl #16")
        LINE("ldr r6, [sp, #MATCH]")
        LINE("cmp r5, r6")
        LINE("bne 87f")
        LINE("17: ldrd r1, lr, [sp, #VERTICES]")
        CORNERS
        DIFFERENCES(NEAR_DIFFERENCES)
        LINE("add r9, sp, #CORNERS + 4")
        LINE("stm r9, {r1-r7, r11, r12, lr}")
        CENTRE(PUT_AWAY)
        BENDS(INSIDE)

        ASKED
        MAPPED
        LINE("add r10, sp, #KEPT + CORNERS")
        LINE("ldm r10, {r0-r7}")
        DEPTHS
        LIGHT("0x28000000")                 /* half and TEXTURED_BIAS, times 16 */
        DEPTH("r5")
        LINE("str r5, [sp, #KEPT + DEPTH_DY]")
        FIRST);

    __asm__ volatile(ROWS("52:", , TEXEL_OF_PALETTE, INSIDE) ROWS("54:", , TEXEL_OF_COLOURS, INSIDE));
    __asm__ volatile(ROWS("38:", "53:", TEXEL_OF_PALETTE, BESIDE) ROWS("38:", "55:", TEXEL_OF_COLOURS, BESIDE)
        LINE("39: ldr r2, [sp, #DRAW_INSIDE]")
        LINE("str r2, [sp, #DRAW]")
        LINE("b 10b"));

    /* What is seldom. */
    __asm__ volatile(
        ABOVE

        LINE("71:")
        FAR_SHADE(LINE("add lr, lr, #0x2000000")) /* TEXTURED_BIAS */
        LINE("b 14b")

        /* another source, or nothing is known of the face */
        LINE("87: ldrd r6, r7, [sp, #SOURCE]")
        LINE("eors r6, r6, r5")
        LINE("beq 80f")
        LINE("lsrs r6, r6, #16")
        LINE("bne 90f")                     /* another material, too */
        LINE("uxth r6, r5")
        LINE("ldr r1, [sp, #VERTICES]")
        LINE("add r8, r1, r6, lsl #3")
        LINE("ldrd r9, r10, [r8]")          /* source_slot_t */
        LINE("ldrh r8, [r8, #8]")
        LINE("ldrd r11, r12, [sp, #INSTANCE]")
        LINE("eor r10, r10, r11")
        LINE("orrs r10, r10, r8")           /* no colours, no attributes */
        LINE("bne 90f")
        LINE("subs r6, r9, r6")
        LINE("add r12, r12, r6, lsl #2")
        LINE("str r12, [sp, #VERTICES + 4]")
        LINE("str r5, [sp, #SOURCE]")
        LINE("cbz r7, 80f")
        LINE("str r5, [sp, #MATCH]")
        LINE("b 17b")

        /* is it short, and inside the tile's columns? */
        LINE("80: ldr r6, [sp, #RIGHT + 4]") /* is_short */
        LINE("ldrd r1, lr, [sp, #VERTICES]")
        LINE("cmp r6, #0")
        LINE("bne 85f")
        CORNERS
        DIFFERENCES(TRUE_DIFFERENCES)
        SHORT
        LINE("b 84f")
        LINE("85:")
        CORNERS
        DIFFERENCES(NEAR_DIFFERENCES)
        LINE("84: add r9, sp, #CORNERS + 4")
        LINE("stm r9, {r1-r7, r11, r12, lr}")
        TEST_INSIDE("LEFT", "12b")
        TO_THE_RIGHT(RIGHT_RECORD)
        CENTRE(PUT_BOUNDS("LEFT", "1") PUT_AWAY)
        BENDS(BESIDE)
        ABOVE

        /* another level: the first that is not too fine, if the run has it and it is not too coarse */
        LINE("91: ldr r3, [sp, #KEPT + RUN]")
        LINE("adds r3, r3, #LEVELS")
        LINE("93: ldr r10, [r3], #40")
        LINE("lsr r10, r0, r10")
        LINE("cmp r10, r1")
        LINE("bhi 93b")
        LINE("subs r3, r3, #36")
        LINE("ldr r10, [r3]")
        LINE("lsr r10, r0, r10")
        LINE("ldr r0, [r3, #4]")
        LINE("orr r10, r10, r0")
        LINE("cmp r10, r1")
        LINE("bls 92f")
        LINE("push {r2, r4, r5, r6, r7, r11, r12}")
        LINE("subs r3, r3, #4")
        LINE("ldm r3, {r0, r1, r2, r4, r5, r6, r7, r10, r11, r12}")
        LINE("add r3, sp, #28 + KEPT + LOWER - 4")
        LINE("stm r3, {r0, r1, r2, r4, r5, r6, r7, r10}")
        LINE("strd r11, r12, [sp, #28 + KEPT + COPY]")
        LINE("pop {r2, r4, r5, r6, r7, r11, r12}")
        LINE("b 16b")

        /* left to C, and put behind no others yet */
        LINE("92: add sp, sp, #KEPT")
        LINE("ldrd r0, r4, [sp, #LIST]")
        LINE("ldrd r1, r3, [sp, #LIMIT + 4]")
        LINE("ldr r2, [sp, #RIGHT]")
        LINE("mls r1, r0, r3, r1")
        LINE("movs r3, #0")
        LINE("cmp r1, r2")
        LINE("bne 94f")
        LINE("ldr r2, [sp, #HANDED]")
        LINE("strh r3, [r2]")
        LINE("strh r4, [r1]")               /* its next */
        LINE("str r2, [sp, #RIGHT]")
        LINE("b 90f")
        LINE("94: ldr r2, [sp, #END]")
        LINE("cmp r1, r2")
        LINE("bne 90f")
        LINE("ldr r2, [sp, #END_BEFORE]")
        LINE("strh r3, [r2]")
        LINE("strh r4, [r1]")
        LINE("str r2, [sp, #END]")
        LINE("b 90f")
        LEAVE(LINE("ldr r1, [sp, #SOURCE]") LINE("str r1, [r0, #32]") LINE("ldr r1, [sp, #RIGHT]") LINE("str r1, [r0, #RUN_RIGHT]"),
              "{r1, r2, r3}"));
}

/* clang-format on */

#endif
