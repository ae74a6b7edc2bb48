# Programs for boards. Included by the Makefile; a board is a folder of firmware/ with a board.mk, see firmware/README.md.

FIRMWARE := $(BUILD)/firmware
BOARDS := $(patsubst firmware/%/board.mk,%,$(wildcard firmware/*/board.mk))

# Armv6-M. With -Os gcc 12 lets a function free its stack by popping into r1, r2 or r3, while a caller in the same file believes, by
# -fipa-ra, that the function leaves them alone: polygons were filled from one side of the window to the other.
FIRMWARE_V6M := -mthumb -fno-ipa-ra

# frames is what tests run, demo what is put on a board.
FIRMWARE_PROGRAMS := frames demo

# Where the programs of $(call firmware_folder,BOARD) are: with MODEL=FILE elsewhere, so that those without it stay as they are.
FIRMWARE_OWN := $(if $(MODEL),-model)
FIRMWARE_BUILT := $(if $(MODEL),demo,$(FIRMWARE_PROGRAMS))
firmware_folder = $(FIRMWARE)/$(1)$(FIRMWARE_OWN)

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
# What every board builds beside the files with a main, its own folder and BOARD_SRC. What it does not use is left out by the linker.
FIRMWARE_MAIN_frames := firmware/board/frames.c
FIRMWARE_MAIN_demo := firmware/demo/demo.c
FIRMWARE_SRC := $(filter-out $(FIRMWARE_MAIN_frames),$(wildcard raster/*.c raster/*/*.c hal/*.c firmware/*.c firmware/board/*.c))
FIRMWARE_FLAGS := -std=c11 -Os -ffreestanding -ffunction-sections -fdata-sections -fstack-usage -fcallgraph-info=su,da $(WARN)

# The letters of the demo's text.
$(FIRMWARE)/font.c: sim/fonts/tuile-6x10.bdf $(TUILE)
	@mkdir -p $(@D)
	@echo "  font $@"; $(TUILE) font $< -o $@ --range 32,45-46,48-57,97-122 --name demo_font >/dev/null

# $(call scene_bits,cube room): -DSCENES=(SCENE_CUBE|SCENE_ROOM), as firmware/scenes.h numbers them
scene_bit_cube := 1
scene_bit_room := 2
scene_bit_spider := 4
scene_bit_bunny := 8
scene_bit_model := 16
comma := ,
empty :=
scene_bits = -DSCENES=\($(subst $(empty) $(empty),+,$(foreach s,$(1),$(scene_bit_$(s))))\)

# What all programs of a board are linked from: $(call firmware_scenes,FOLDER,SCENES), which differ by scenes, and $(call firmware_code,
# FOLDER,BOARD), which do not; $(call firmware_objects,FOLDER,BOARD): both.
FIRMWARE_SCENES_SRC := firmware/scenes.c firmware/board/models.c
firmware_scenes = $(FIRMWARE_SCENES_SRC:%.c=$(1)/%.o) $(patsubst %,$(1)/model_%.o,$(2))
firmware_code = $(patsubst %.c,$(1)/%.o,$(filter-out $(FIRMWARE_SCENES_SRC),$(FIRMWARE_SRC)) $(wildcard firmware/$(2)/*.c) $($(2)_SRC)) \
                $(1)/firmware/font.o
firmware_objects = $(call firmware_code,$(1),$(2)) $(call firmware_scenes,$(1),$($(2)_SCENES))
# Those of a board as it is built now, with MODEL=FILE or without.
firmware_linked = $(call firmware_code,$(FIRMWARE)/$(1),$(1)) \
                  $(call firmware_scenes,$(call firmware_folder,$(1)),$(if $(FIRMWARE_OWN),model,$($(1)_SCENES)))

# $(call firmware_compile,BOARD,FLAGS,SCENES), $(call firmware_data,BOARD,FLAGS), $(call firmware_link,BOARD,FLAGS): recipes. The last one
# writes a map, a .bin and a .hex beside the target.
define firmware_compile
	@mkdir -p $(@D)
	@echo "  $(1) $<"; $($(1)_TOOLS)gcc $(2) $(FIRMWARE_FLAGS) $(FIRMWARE_MORE) $(call scene_bits,$(3)) $($(1)_DEFINES) -MMD -MP -c $< -o $@
endef
define firmware_data
	@mkdir -p $(@D)
	@$($(1)_TOOLS)gcc $(2) -std=c11 -ffreestanding -fdata-sections -c $< -o $@
endef
define firmware_link
	@echo "  $(1) $@"; $(firmware_linker) $($(1)_TOOLS)gcc $(2) -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings -Wl,-Map,$(@:.elf=.map) \
	  -T firmware/$(1)/link.ld $(filter %.o,$^) -lgcc -o $@
	@$($(1)_TOOLS)objcopy -O binary $@ $(@:.elf=.bin)
	@$($(1)_TOOLS)objcopy -O ihex $@ $(@:.elf=.hex)
endef

# $(call firmware_program,FOLDER,BOARD,FLAGS): FOLDER/frames.elf and FOLDER/demo.elf from the board's sources, built with the flags.
define firmware_program
$(FIRMWARE_PROGRAMS:%=$(1)/%.elf): $$(call firmware_objects,$(1),$(2)) firmware/$(2)/link.ld
	$$(call firmware_link,$(2),$(3))
$(foreach p,$(FIRMWARE_PROGRAMS),$(1)/$(p).elf: $(FIRMWARE_MAIN_$(p):%.c=$(1)/%.o)
)
$(1)/model_%.o: $$(FIRMWARE)/models/%.c | toolchain-$(2)
	$$(call firmware_data,$(2),$(3))
$(1)/firmware/font.o: $$(FIRMWARE)/font.c | toolchain-$(2)
	$$(call firmware_data,$(2),$(3))
$(1)/firmware/board/memory.o: FIRMWARE_MORE := -fno-tree-loop-distribute-patterns
$(1)/%.o: %.c Makefile firmware/firmware.mk firmware/$(2)/board.mk | toolchain-$(2)
	$$(call firmware_compile,$(2),$(3),$$($(2)_SCENES))
endef

# With MODEL=FILE the programs have that model as their only scene, and a folder of their own, beside that of the others. The model is
# compiled anew each time, and what depends on it is made if it has changed.
ifneq ($(FIRMWARE_OWN),)
FIRMWARE_MODEL := $(FIRMWARE)/model
.PHONY: compile-model
compile-model: ;
$(FIRMWARE_MODEL)/model.c: compile-model $(TUILE)
	@sh firmware/demo/model.sh compile $(TUILE) $(@D)

define firmware_own
$(call firmware_folder,$(1))/model_model.o: $(FIRMWARE_MODEL)/model.c | toolchain-$(1)
	$$(call firmware_data,$(1),$($(1)_FLAGS))
$(FIRMWARE_SCENES_SRC:%.c=$(call firmware_folder,$(1))/%.o): $(call firmware_folder,$(1))/%.o: %.c Makefile firmware/firmware.mk firmware/$(1)/board.mk | toolchain-$(1)
	$$(call firmware_compile,$(1),$($(1)_FLAGS),model)
$(FIRMWARE_PROGRAMS:%=$(call firmware_folder,$(1))/%.elf): firmware_linker = sh firmware/demo/model.sh link $(TUILE) $(FIRMWARE_MODEL) $(1) $$@
$(FIRMWARE_PROGRAMS:%=$(call firmware_folder,$(1))/%.elf): $$(call firmware_linked,$(1)) firmware/$(1)/link.ld
	$$(call firmware_link,$(1),$($(1)_FLAGS))
	@sh firmware/demo/model.sh ram $(TUILE) $(FIRMWARE_MODEL) $(1) $($(1)_PANEL) \
	  $$$$((0x$$$$($($(1)_TOOLS)nm -S $$@ | awk '$$$$4 == "block" { print $$$$2 }')))
$(foreach p,$(FIRMWARE_PROGRAMS),$(call firmware_folder,$(1))/$(p).elf: $(FIRMWARE_MAIN_$(p):%.c=$(FIRMWARE)/$(1)/%.o)
)
endef
$(foreach board,$(BOARDS),$(eval $(call firmware_own,$(board))))
endif

define firmware_board
$(call firmware_program,$(FIRMWARE)/$(1),$(1),$($(1)_FLAGS))
.PHONY: firmware-$(1) toolchain-$(1)
firmware: firmware-$(1)
firmware-$(1): $(patsubst %,$(call firmware_folder,$(1))/%.elf,$(FIRMWARE_BUILT))
	@$($(1)_TOOLS)size $$(filter %.elf,$$^)
toolchain-$(1): $(BUILD)/need/$($(1)_NEED)
	@command -v $($(1)_TOOLS)gcc >/dev/null || { echo "$(1): $($(1)_TOOLS)gcc is not there, though its package is; look at PATH" >&2; exit 1; }
endef
$(foreach board,$(BOARDS),$(eval $(call firmware_board,$(board))))

firmware: ## every board's programs: elf, bin and hex in build/firmware/BOARD; firmware-BOARD one's, with MODEL=my.obj MAX_FACES=N a model of your own
no_board = echo "There is no board $(1); there are: $(2)" >&2; exit 1
firmware-%:
	@$(call no_board,$*,$(BOARDS) uno)
flash-%:
	@$(call no_board,$* to flash from here,blackpill pico pico2)
