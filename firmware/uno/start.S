; ATmega328P: from reset to main. Interrupts are never let in, so that of the 26 vectors (12.4) only the first is there: the others would be
; 100 bytes. A main that returns parks with code 64.

; I/O addresses (data space - 0x20)
#define SPL 0x3D
#define SPH 0x3E
#define SREG 0x3F

        .section .vectors, "ax", @progbits
        .global vectors
vectors:
        jmp     reset

        .section .text.start, "ax", @progbits
        .global reset
reset:
        eor     r1, r1                  ; gcc's zero
        out     SREG, r1
        ldi     r28, lo8(stack_top)
        ldi     r29, hi8(stack_top)
        out     SPH, r29
        out     SPL, r28

        ldi     r26, lo8(data_start)    ; .data from flash
        ldi     r27, hi8(data_start)
        ldi     r30, lo8(data_load)
        ldi     r31, hi8(data_load)
        ldi     r17, hi8(data_end)
        rjmp    2f
1:      lpm     r0, Z+
        st      X+, r0
2:      cpi     r26, lo8(data_end)
        cpc     r27, r17
        brne    1b

        ldi     r17, hi8(bss_end)       ; .bss
        rjmp    4f
3:      st      X+, r1
4:      cpi     r26, lo8(bss_end)
        cpc     r27, r17
        brne    3b

        ldi     r18, 0xA5               ; paint the stack: stack.c counts what is left of it
        ldi     r17, hi8(stack_top + 1)
5:      st      X+, r18
        cpi     r26, lo8(stack_top + 1)
        cpc     r27, r17
        brne    5b

        call    main
        eor     r1, r1
        ldi     r24, 64
        ldi     r25, 0
        jmp     uno_park

; The compiler asks for these where there are .data and .bss: both are served above.
        .global __do_copy_data, __do_clear_bss
        .set    __do_copy_data, reset
        .set    __do_clear_bss, reset
