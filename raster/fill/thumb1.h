/* What all loops over small triangles in Thumb-1 share, with a texture and without: fill/small_thumb1.c and
 * fill/textured_thumb1.c. */
#ifndef TUILE_FILL_THUMB1_H
#define TUILE_FILL_THUMB1_H

/* clang-format off */

#define LINE(text) text "\n"

#define UNIFIED LINE(".syntax unified") /* which gcc does not take for Thumb-1 */

/* What a caller wants again onto the stack, with the loop's frame of FRAME bytes below it; and back. */
#define OPEN_FRAME \
    LINE("push {r4-r7, lr}") \
    LINE("mov r4, r8") \
    LINE("mov r5, r9") \
    LINE("mov r6, r10") \
    LINE("mov r7, r11") \
    LINE("push {r4-r7}") \
    LINE("sub sp, #FRAME")
#define CLOSE_FRAME \
    LINE("add sp, #FRAME") \
    LINE("pop {r4-r7}") \
    LINE("mov r8, r4") \
    LINE("mov r9, r5") \
    LINE("mov r10, r6") \
    LINE("mov r11, r7") \
    LINE("pop {r4-r7, pc}")

/* clang-format on */

#endif
