# The Arduino Uno. Its program is not one of the boards' (firmware.mk): it has no room for the player and the full renderer.

UNO := $(FIRMWARE)/uno
UNO_SRC := $(wildcard firmware/uno/*.c) firmware/board/memory.c hal/display.c hal/panel.c hal/wire.c hal/panels/ssd1306.c \
           raster/pixel.c $(filter-out raster/compact/view.c,$(wildcard raster/compact/*.c))
# gnu11: flash is an address space of its own (raster/flash.h). -fno-ivopts: gcc 5.4 dies of pointers into it in loops. The other -fno-
# together save 1 366 bytes of 29 396, and -fno-tree-switch-conversion tables in RAM.
UNO_FLAGS := -mmcu=atmega328p -std=gnu11 -Os -ffreestanding -fno-ivopts -fno-tree-loop-optimize -fno-move-loop-invariants \
             -fno-inline-small-functions -fno-tree-switch-conversion -mstrict-X -mcall-prologues -DTUILE_BUS_QUEUES=0 -ffunction-sections -fdata-sections -fstack-usage
# frames is what tests run, demo what is put on a board: each a file with a main.
UNO_MAIN_frames := $(UNO)/firmware/uno/main.o
UNO_MAIN_demo := $(UNO)/firmware/uno/demo.o
UNO_OBJ := $(filter-out $(UNO_MAIN_frames) $(UNO_MAIN_demo),$(patsubst %.c,$(UNO)/%.o,$(UNO_SRC))) $(UNO)/firmware/uno/start.o $(UNO)/model_cube.o $(UNO)/model_room.o

$(BUILD)/need/avr: ; $(call need,gcc-avr binutils-avr,a compiler for AVR)

$(OBJ)/uno_views: $(OBJ)/tests/emulators/uno_views.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

$(UNO)/model_%.c: $(FIRMWARE)/models/%.tuile $(OBJ)/uno_views
	@mkdir -p $(@D)
	@echo "  views $@"; $(OBJ)/uno_views $* $< >$@.new && mv $@.new $@

.PHONY: toolchain-uno
toolchain-uno: $(BUILD)/need/avr
	@command -v avr-gcc >/dev/null || { echo "uno: avr-gcc is not there, though its package is; look at PATH" >&2; exit 1; }

$(UNO)/model_%.o: $(UNO)/model_%.c | toolchain-uno
	@avr-gcc $(UNO_FLAGS) -I. -c $< -o $@

$(UNO)/firmware/board/memory.o: UNO_MORE := -fno-tree-loop-distribute-patterns
$(UNO)/%.o: %.c Makefile firmware/uno/uno.mk | toolchain-uno
	@mkdir -p $(@D)
	@echo "  uno $<"; avr-gcc $(UNO_FLAGS) $(UNO_MORE) $(WARN) -MMD -MP -c $< -o $@

$(UNO)/%.o: %.S firmware/uno/uno.mk | toolchain-uno
	@mkdir -p $(@D)
	@echo "  uno $<"; avr-gcc -mmcu=atmega328p -c $< -o $@

UNO_ELF := $(FIRMWARE_PROGRAMS:%=$(UNO)/%.elf)
$(UNO)/frames.elf: $(UNO_MAIN_frames)
$(UNO)/demo.elf: $(UNO_MAIN_demo)
$(UNO_ELF): $(UNO_OBJ) firmware/uno/link.ld
	@echo "  uno $@"; avr-gcc -mmcu=atmega328p -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings -Wl,--relax -Wl,-Map,$(@:.elf=.map) \
	  -T firmware/uno/link.ld $(filter %.o,$^) -lgcc -o $@
	@avr-objcopy -O binary $@ $(@:.elf=.bin)
	@avr-objcopy -O ihex $@ $(@:.elf=.hex)

.PHONY: firmware-uno
ifeq ($(FIRMWARE_OWN),)
firmware: firmware-uno
endif
firmware-uno: $(if $(FIRMWARE_OWN),no-model-uno,$(UNO_ELF)) ## the Arduino Uno's programs: build/firmware/uno/demo.hex
	@avr-size $^
.PHONY: no-model-uno
no-model-uno:
	@echo "uno: no MODEL=FILE here: beside its views, which are computed ahead, a model has 2900 bytes of flash; see firmware/uno/README.md" >&2; exit 1
