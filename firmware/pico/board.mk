# Raspberry Pi Pico: RP2040 with a panel on SPI0. The second stage of its boot is sealed by the build.
pico_TOOLS := arm-none-eabi-
pico_NEED := pico
pico_FLAGS := -mcpu=cortex-m0plus $(FIRMWARE_V6M)
pico_STACK := 8160 # bytes: link.ld's room without the guard
pico_PANEL := st7789-240x240
pico_SCENES := cube room spider bunny
pico_DEFINES := -DTUILE_FEATURES=576 -DTUILE_FORMATS=1
pico_BOOT2 := $(BUILD)/firmware/pico-boot2
pico_SRC := $(wildcard firmware/cortex_m/*.c firmware/rp2/*.c) hal/panels/ili9341.c hal/panels/st7789.c $(pico_BOOT2).c

$(BUILD)/need/pico: ; $(call need,gcc-arm-none-eabi python3,a compiler for Cortex-M)

$(pico_BOOT2).c: firmware/pico/boot2.S firmware/pico/boot2.py $(BUILD)/need/pico
	@mkdir -p $(@D)
	@$(pico_TOOLS)gcc -mcpu=cortex-m0plus -mthumb -c $< -o $(pico_BOOT2).o
	@$(pico_TOOLS)objcopy -O binary -j .text $(pico_BOOT2).o $(pico_BOOT2).bin
	@python3 firmware/pico/boot2.py seal $(pico_BOOT2).bin $@

# ---- other programs of the same objects: what the DMA saves, and programs that are broken on purpose (firmware/rp2/port.c) --
# In a folder of their own, since the objects of frames.elf are read for its stack.
pico_FOLDER := $(BUILD)/firmware/pico
pico_MORE := $(BUILD)/firmware/pico-more
pico_MUTANTS := $(patsubst %,$(pico_MORE)/mutant_%.elf,1 2 3 4)
pico_OBJ = $(call firmware_objects,$(pico_FOLDER),pico) $(pico_FOLDER)/firmware/board/frames.o

# $(call pico_relink,WITHOUT): the objects of frames.elf but some, with others in their place.
define pico_relink
	@echo "  pico $@"; $(pico_TOOLS)gcc $(pico_FLAGS) -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings \
	  -T firmware/pico/link.ld $(filter-out $(addprefix %/,$(1)),$(pico_OBJ)) $(filter %.o,$^) -lgcc -o $@
endef
define pico_compile
	@mkdir -p $(@D)
	@echo "  pico $@"; $(pico_TOOLS)gcc $(pico_FLAGS) $(FIRMWARE_FLAGS) $(call scene_bits,$(pico_SCENES)) $(1) -MMD -MP -c $< -o $@
endef

$(pico_MORE)/overlap.elf: $(pico_MORE)/overlap.o $(pico_FOLDER)/frames.elf
	$(call pico_relink,firmware/board/frames.o)
$(pico_MORE)/overlap.o: firmware/rp2/programs/overlap.c
	$(call pico_compile)

$(pico_MUTANTS): $(pico_MORE)/mutant_%.elf: $(pico_MORE)/mutant_%.o $(pico_FOLDER)/frames.elf
	$(call pico_relink,firmware/rp2/port.o)
$(pico_MUTANTS:.elf=.o): $(pico_MORE)/mutant_%.o: firmware/rp2/port.c
	$(call pico_compile,-DMUTANT=$*)

# Both cores (firmware/rp2/programs/two_cores.c).
$(pico_MORE)/two_cores.elf: $(pico_MORE)/two_cores.o $(pico_MORE)/clocks.o $(pico_FOLDER)/frames.elf
	$(call pico_relink,firmware/board/frames.o firmware/rp2/clocks.o)
$(pico_MORE)/two_cores.o: firmware/rp2/programs/two_cores.c
	$(call pico_compile,-DTUILE_CORES=2)
$(pico_MORE)/clocks.o: firmware/rp2/clocks.c
	$(call pico_compile,-DTUILE_CORES=2)
firmware-pico: $(if $(FIRMWARE_OWN),,$(pico_MORE)/two_cores.elf)

# ---- onto a board ----
pico_UF2 := $(FIRMWARE_BUILT:%=$(call firmware_folder,pico)/%.uf2)
$(pico_UF2): %.uf2: %.elf firmware/rp2/uf2.py
	@python3 firmware/rp2/uf2.py e48bff56 10000000 $(<:.elf=.bin) $@
firmware-pico: $(pico_UF2)

.PHONY: flash-pico
flash-pico: $(call firmware_folder,pico)/demo.uf2 ## puts the Pico's demo on a board: by its volume RPI-RP2 if that is mounted, else by openocd
	@sh firmware/rp2/flash.sh RPI-RP2 rp2040 $(<:.uf2=.elf) $<
