# The Black Pill's program as it is flashed: unicorn has the core, stm32f411.c what it uses of the chip. Included by the Makefile.

$(BUILD)/need/unicorn: ; $(call need,libunicorn-dev,an emulator of Cortex-M4)
$(call objects,tests/emulators/blackpill.c): | $(BUILD)/need/unicorn
$(OBJ)/blackpill: $(call objects,tests/emulators/blackpill.c tests/emulators/stm32f411.c)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ -lunicorn -o $@
BLACKPILL_OBJ = $(filter-out %/blackpill/firmware/blackpill/board.o %/blackpill/firmware/blackpill/spi.o,$(call mps2_objects,blackpill))
test-firmware-blackpill: test-firmware-blackpill-chip
.PHONY: test-firmware-blackpill-chip
test-firmware-blackpill-chip: $(FIRMWARE)/blackpill/frames.elf $(OBJ)/blackpill $(PANEL_FRAMES) firmware-models
	@COMPILE='$(blackpill_TOOLS)gcc $(blackpill_FLAGS) $(FIRMWARE_FLAGS) $(call scene_bits,$(blackpill_SCENES)) -Ifirmware/blackpill' \
	  LINK='$(blackpill_TOOLS)gcc $(blackpill_FLAGS) -nostdlib -nostartfiles -Wl,--gc-sections -T firmware/blackpill/link.ld $(BLACKPILL_OBJ)' \
	  sh $(EMULATORS)/blackpill.sh $(BUILD) $(OBJ)/blackpill $(PANEL_FRAMES)
