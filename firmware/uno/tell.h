/* What the program tells: an event in GPIOR0, with GPIOR1 and GPIOR2 as its arguments. On a real board nobody listens; an
 * emulator's harness (tests/emulators/uno.c) does. */
#ifndef FIRMWARE_UNO_TELL_H
#define FIRMWARE_UNO_TELL_H

typedef enum uno_event {
    UNO_BEGINS = 1, /* a frame: number of the scene's line in `shows`, number of the frame in the scene's script */
    UNO_SHOWN = 2,  /* the same frame is out */
    UNO_STACK = 3,  /* bytes of stack never used: low, high */
    UNO_ROUND = 4,  /* all frames have been shown; they begin again */
    UNO_PARKED = 5, /* the end, with a code (board_code_t, firmware/board/board.h) */
} uno_event_t;

/* The lines of `shows`: which scene, by which method. */
enum { UNO_CUBE_ZBUFFER, UNO_ROOM_TREE, UNO_CUBE_TREE, UNO_SHOWS };

/* Frames 0, STEP, 2 STEP ... of a scene's script are in flash. */
#define UNO_FRAMES 8
#define UNO_STEP 4

#endif
