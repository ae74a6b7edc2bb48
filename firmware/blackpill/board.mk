# Black Pill: STM32F411 with a panel on SPI1, of which a model is in tests/emulators/ (blackpill.c).
blackpill_TOOLS := arm-none-eabi-
blackpill_NEED := arm
blackpill_FLAGS := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
blackpill_STACK := 8160 # bytes: link.ld's room without the guard
blackpill_PANEL := st7789-240x240
blackpill_SCENES := cube room spider bunny
blackpill_DEFINES := -DTUILE_FEATURES=576 -DTUILE_FORMATS=1
blackpill_SRC := $(wildcard firmware/cortex_m/*.c) hal/panels/st7789.c

.PHONY: flash-blackpill
flash-blackpill: $(call firmware_folder,blackpill)/demo.elf ## the Black Pill's: by dfu-util while its boot loader runs, else by an ST-Link
	@sh firmware/blackpill/flash.sh $< $(<:.elf=.bin)
