/* Vectors, a stack, and the model in flash. */
    .syntax unified
    .thumb
    .section .vectors, "a"
    .word stack_end
    .word guest_start + 1
    .rept 14
    .word guest_fault + 1
    .endr
    .text
    .thumb_func
    .global guest_start
guest_start:
    ldr r0, =bss_start
    ldr r1, =bss_end
    movs r2, #0
1:  cmp r0, r1
    bhs 2f
    str r2, [r0]
    adds r0, #4
    b 1b
2:  bl guest_main
    .thumb_func
guest_fault:
    b guest_fault
    .section .model, "a"
    .balign 8
    .global guest_model
    .global guest_model_end
guest_model:
    .incbin GUEST_MODEL
guest_model_end:
