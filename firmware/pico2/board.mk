# Raspberry Pi Pico 2: RP2350, of which the first Cortex-M33 is used, with a panel on SPI0 as on the Pico. No emulator has the chip: its
# objects run on another with the same core (firmware/mps2/).
pico2_TOOLS := arm-none-eabi-
pico2_NEED := pico
pico2_FLAGS := -mcpu=cortex-m33 -mthumb -mfloat-abi=soft -DRP2350
pico2_STACK := 8160 # bytes: link.ld's room without the guard
pico2_PANEL := st7789-240x240
pico2_SCENES := cube room spider bunny
pico2_DEFINES := -DTUILE_FEATURES=576 -DTUILE_FORMATS=1
pico2_SRC := $(wildcard firmware/cortex_m/*.c firmware/rp2/*.c) hal/panels/ili9341.c hal/panels/st7789.c

pico2_FOLDER := $(BUILD)/firmware/pico2
pico2_UF2 := $(FIRMWARE_BUILT:%=$(call firmware_folder,pico2)/%.uf2)
$(pico2_UF2): %.uf2: %.elf firmware/rp2/uf2.py
	@python3 firmware/rp2/uf2.py e48bff59 10000000 $(<:.elf=.bin) $@
firmware-pico2: $(pico2_UF2)

.PHONY: flash-pico2
flash-pico2: $(call firmware_folder,pico2)/demo.uf2 ## likewise the Pico 2's: volume RP2350
	@sh firmware/rp2/flash.sh RP2350 rp2350 $(<:.uf2=.elf) $<

# ---- both cores (firmware/rp2/programs/two_cores.c) ----
pico2_MORE := $(BUILD)/firmware/pico2-more
pico2_OBJ = $(call firmware_objects,$(pico2_FOLDER),pico2)
$(pico2_MORE)/two_cores.elf: $(pico2_MORE)/two_cores.o $(pico2_MORE)/clocks.o $(pico2_FOLDER)/frames.elf
	@echo "  pico2 $@"; $(pico2_TOOLS)gcc $(pico2_FLAGS) -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings \
	  -T firmware/pico2/link.ld $(filter-out %/firmware/rp2/clocks.o,$(pico2_OBJ)) $(filter %.o,$^) -lgcc -o $@
$(pico2_MORE)/two_cores.o: firmware/rp2/programs/two_cores.c
$(pico2_MORE)/clocks.o: firmware/rp2/clocks.c
$(pico2_MORE)/two_cores.o $(pico2_MORE)/clocks.o:
	@mkdir -p $(@D)
	@echo "  pico2 $@"; $(pico2_TOOLS)gcc $(pico2_FLAGS) $(FIRMWARE_FLAGS) $(call scene_bits,$(pico2_SCENES)) -DTUILE_CORES=2 -MMD -MP -c $< -o $@
firmware-pico2: $(if $(FIRMWARE_OWN),,$(pico2_MORE)/two_cores.elf)
