/* The project's own font as part of the program: the file as it is, so that there is one source of it. */
#include "font.h"

__asm__(".section .rodata\n"
        ".global font_default_text\n"
        "font_default_text:\n"
        ".incbin \"sim/fonts/tuile-6x10.bdf\"\n"
        ".global font_default_end\n"
        "font_default_end:\n"
        ".byte 0\n"
        ".text\n");
