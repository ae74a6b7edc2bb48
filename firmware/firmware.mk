# Programs for boards. Included by the Makefile; a board is a folder of firmware/ with a board.mk, see firmware/README.md.

FIRMWARE := $(BUILD)/firmware
BOARDS := $(patsubst firmware/%/board.mk,%,$(wildcard firmware/*/board.mk))

# Armv6-M. With -Os gcc 12 lets a function free its stack by popping into r1, r2 or r3, while a caller in the same file believes, by
# -fipa-ra, that the function leaves them alone: polygons were filled from one side of the window to the other.
FIRMWARE_V6M := -mthumb -fno-ipa-ra

include $(patsubst %,firmware/%/board.mk,$(BOARDS))

$(BUILD)/need/riscv: ; $(call need,gcc-riscv64-unknown-elf,a compiler for RISC-V)
$(BUILD)/need/emulators: ; $(call need,qemu-system-arm qemu-system-misc python3,emulated boards)

# ---- models: compiled by the simulator, as files for it and as sources for boards -----------------------------------
FIRMWARE_MODELS := cube room spider bunny
$(FIRMWARE)/models/cube.%: MESH_FROM := firmware/models/cube.obj --tree
$(FIRMWARE)/models/room.%: MESH_FROM := tests/models/room.obj --tree
$(FIRMWARE)/models/spider.%: MESH_FROM := $(SPIDER) --no-textures
$(FIRMWARE)/models/bunny.%: MESH_FROM := $(BUNNY) --no-textures --max-faces 4000
$(FIRMWARE)/models/cube.c $(FIRMWARE)/models/cube.tuile: firmware/models/cube.obj firmware/models/cube.mtl
$(FIRMWARE)/models/room.c $(FIRMWARE)/models/room.tuile: tests/models/room.obj tests/models/room.mtl
$(FIRMWARE)/models/spider.c $(FIRMWARE)/models/spider.tuile: $(SPIDER)
$(FIRMWARE)/models/bunny.c $(FIRMWARE)/models/bunny.tuile: $(BUNNY)
$(FIRMWARE)/models/%.c: $(TUILE)
	@mkdir -p $(@D)
	@echo "  mesh $@"; $(TUILE) mesh $(MESH_FROM) -o $@ --name model_$* >/dev/null
$(FIRMWARE)/models/%.tuile: $(TUILE)
	@mkdir -p $(@D)
	@echo "  mesh $@"; $(TUILE) mesh $(MESH_FROM) -o $@ >/dev/null

.PHONY: firmware firmware-models
firmware-models: $(FIRMWARE_MODELS:%=$(FIRMWARE)/models/%.tuile) ## the models of the scenes, for `tuile scene`

# ---- programs -------------------------------------------------------------------------------------------------------
# What every board builds, beside its own folder and BOARD_SRC. What it does not use is left out by the linker.
FIRMWARE_SRC := $(wildcard raster/*.c raster/*/*.c hal/*.c firmware/*.c firmware/board/*.c)
FIRMWARE_FLAGS := -std=c11 -Os -ffreestanding -ffunction-sections -fdata-sections -fstack-usage -fcallgraph-info=su,da $(WARN)

# $(call scene_bits,cube room): -DSCENES=(SCENE_CUBE|SCENE_ROOM), as firmware/scenes.h numbers them
scene_bit_cube := 1
scene_bit_room := 2
scene_bit_spider := 4
scene_bit_bunny := 8
comma := ,
empty :=
scene_bits = -DSCENES=\($(subst $(empty) $(empty),+,$(foreach s,$(1),$(scene_bit_$(s))))\)

# $(call firmware_program,FOLDER,BOARD,FLAGS): FOLDER/frames.elf, .bin and .hex from the board's sources, built with the flags.
define firmware_program
$(1)/frames.elf: $$(patsubst %.c,$(1)/%.o,$$(FIRMWARE_SRC) $$(wildcard firmware/$(2)/*.c) $$($(2)_SRC)) \
                 $$(patsubst %,$(1)/model_%.o,$$($(2)_SCENES)) firmware/$(2)/link.ld
	@echo "  $(2) $$@"; $$($(2)_TOOLS)gcc $(3) -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings -Wl,-Map,$(1)/frames.map \
	  -T firmware/$(2)/link.ld $$(filter %.o,$$^) -lgcc -o $$@
	@$$($(2)_TOOLS)objcopy -O binary $$@ $(1)/frames.bin
	@$$($(2)_TOOLS)objcopy -O ihex $$@ $(1)/frames.hex

$(1)/model_%.o: $$(FIRMWARE)/models/%.c | toolchain-$(2)
	@mkdir -p $$(@D)
	@$$($(2)_TOOLS)gcc $(3) -std=c11 -ffreestanding -fdata-sections -c $$< -o $$@

$(1)/firmware/board/memory.o: FIRMWARE_MORE := -fno-tree-loop-distribute-patterns
$(1)/%.o: %.c Makefile firmware/firmware.mk firmware/$(2)/board.mk | toolchain-$(2)
	@mkdir -p $$(@D)
	@echo "  $(2) $$<"; $$($(2)_TOOLS)gcc $(3) $$(FIRMWARE_FLAGS) $$(FIRMWARE_MORE) $$(call scene_bits,$$($(2)_SCENES)) $$($(2)_DEFINES) -MMD -MP -c $$< -o $$@
endef

define firmware_board
$(call firmware_program,$(FIRMWARE)/$(1),$(1),$($(1)_FLAGS))
.PHONY: firmware-$(1) toolchain-$(1)
firmware: firmware-$(1)
firmware-$(1): $(FIRMWARE)/$(1)/frames.elf
	@$($(1)_TOOLS)size $$<
toolchain-$(1): $(BUILD)/need/$($(1)_NEED)
	@command -v $($(1)_TOOLS)gcc >/dev/null || { echo "$(1): $($(1)_TOOLS)gcc is not there, though its package is; look at PATH" >&2; exit 1; }
endef
$(foreach board,$(BOARDS),$(eval $(call firmware_board,$(board))))

firmware: ## every board's program: elf, bin and hex in build/firmware/BOARD
firmware-%:
	@echo "There is no board $*; there are: $(BOARDS)" >&2; exit 1
