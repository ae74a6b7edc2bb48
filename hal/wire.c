#include "wire.h"

unsigned tuile_wire_bits(unsigned wire) {
    switch (wire) {
    case TUILE_WIRE_RGB565:
    case TUILE_WIRE_RGB565_LE: return 16;
    case TUILE_WIRE_RGB444: return 12;
    case TUILE_WIRE_RGB666:
    case TUILE_WIRE_BGR888: return 24;
    case TUILE_WIRE_XRGB8888: return 32;
    case TUILE_WIRE_RGB332:
    case TUILE_WIRE_GREY8: return 8;
    case TUILE_WIRE_GREY4:
    case TUILE_WIRE_GREY4_TURNED:
    case TUILE_WIRE_RGB111:
    case TUILE_WIRE_XRGB1111: return 4;
    case TUILE_WIRE_MONO_PAGES:
    case TUILE_WIRE_MONO_PAGES_TURNED:
    case TUILE_WIRE_MONO_ROWS: return 1;
    default: return 0;
    }
}
