# RV32IMAC, in QEMU. -march stays without _zicsr, for which Debian has no libgcc; the one instruction of it is told to the assembler.
sifive_e_TOOLS := riscv64-unknown-elf-
sifive_e_NEED := riscv
sifive_e_FLAGS := -march=rv32imac -mabi=ilp32 -mcmodel=medany
sifive_e_STACK := 4576 # bytes: link.ld's room without the guard
sifive_e_PANEL := ili9341
sifive_e_SCENES := cube room spider
sifive_e_DEFINES := -DTUILE_FEATURES=512 -DTUILE_FORMATS=1
sifive_e_SRC := $(wildcard firmware/riscv/*.c firmware/board/wire/*.c) hal/panels/ili9341.c
