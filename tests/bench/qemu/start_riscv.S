/* A stack, and the model behind the program. */
    .section .vectors, "ax"
    .global guest_start
guest_start:
    la sp, stack_end
    la t0, bss_start
    la t1, bss_end
1:  bgeu t0, t1, 2f
    sw zero, 0(t0)
    addi t0, t0, 4
    j 1b
2:  call guest_main
3:  j 3b
    .section .model, "a"
    .balign 8
    .global guest_model
    .global guest_model_end
guest_model:
    .incbin GUEST_MODEL
guest_model_end:
