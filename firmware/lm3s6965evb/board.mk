# QEMU has this board with its panel, and lets it have other cores: one image, built for the least of them, runs on all.
lm3s6965evb_TOOLS := arm-none-eabi-
lm3s6965evb_NEED := arm
lm3s6965evb_FLAGS := -mcpu=cortex-m0 $(FIRMWARE_V6M)
lm3s6965evb_STACK := 6112 # bytes: link.ld's room without the guard
lm3s6965evb_PANEL := ssd0323
lm3s6965evb_SCENES := cube room spider
lm3s6965evb_DEFINES := -DTUILE_FEATURES=576 -DTUILE_FORMATS=0x80
lm3s6965evb_SRC := $(wildcard firmware/cortex_m/*.c) hal/panels/ssd0323.c
