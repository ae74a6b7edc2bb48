/* Constant data that stay in flash.
 *
 * Most machines read flash as they read memory, and TUILE_FLASH says nothing there. On an AVR a constant is copied into RAM when
 * the program starts, unless its type says that it lies in the program's memory, which has instructions of its own: `const
 * TUILE_FLASH` is that type, in a definition as behind a pointer. The compiler then reads through the right instructions, and
 * refuses a pointer to flash where one to memory is wanted. Bytes that go to functions which take either must be read out first:
 * TUILE_FLASH_APART is 1 where that is so.
 */
#ifndef TUILE_FLASH_H
#define TUILE_FLASH_H

#if defined(__FLASH) /* gcc for AVR, with -std=gnu11: named address spaces (ISO/IEC TR 18037) are an extension of C11 */
#define TUILE_FLASH __flash
#define TUILE_FLASH_APART 1
#else
#define TUILE_FLASH
#define TUILE_FLASH_APART 0
#endif

#if defined(__AVR__) && !defined(__FLASH)
#error "build for AVR with -std=gnu11"
#endif

#endif
