/* What the boot ROM of an RP2040 copies from the first 256 bytes of flash to RAM and starts, once its check sum is right (RP2040 data
 * sheet, 2.8.1.3): it lets flash be read as memory, by the command 03h that every flash has, and goes to the program behind it.
 * Position-independent; boot2.py fills it up to 252 bytes and appends the check sum.
 *
 * SSI registers: RP2040 data sheet, 4.10.13. */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    .equ SSI, 0x18000000
    .equ SSI_CTRLR0, 0x00
    .equ SSI_CTRLR1, 0x04
    .equ SSI_SSIENR, 0x08
    .equ SSI_BAUDR, 0x14
    .equ SSI_SPI_CTRLR0, 0xf4
    .equ VTOR, 0xe000ed08
    .equ VECTORS, 0x10000100

    .section .text
    .global boot2
    .thumb_func
boot2:
    ldr r3, =SSI
    movs r0, #0
    str r0, [r3, #SSI_SSIENR] /* nothing changes while it is enabled */
    movs r1, #4
    str r1, [r3, #SSI_BAUDR] /* 125 MHz / 4 = 31.25 MHz: the command is for 33 MHz at least */
    ldr r1, =(31 << 16) | (3 << 8) /* frames of 32 bits, a command and what it reads */
    str r1, [r3, #SSI_CTRLR0]
    ldr r1, =(0x03 << 24) | (2 << 8) | (6 << 2) /* read, with 8 bits of command and 24 of address, all by one line */
    ldr r2, =SSI + SSI_SPI_CTRLR0
    str r1, [r2]
    str r0, [r3, #SSI_CTRLR1] /* one frame at a time */
    movs r1, #1
    str r1, [r3, #SSI_SSIENR]
    ldr r0, =VECTORS
    ldr r1, =VTOR
    str r0, [r1]
    ldmia r0!, {r1, r2} /* the stack's top and the reset handler */
    msr msp, r1
    bx r2
    .ltorg
