# Boards in emulators. Included by the Makefile.

EMULATORS := tests/emulators
PYTHON := PYTHONDONTWRITEBYTECODE=1 python3
# $(call STACK,FOLDER,BOARD,PROGRAM): PROGRAM is frames where it is left out.
STACK = $(PYTHON) $(EMULATORS)/stack.py $(1)/$(or $(3),frames).elf $(1) --tools $($(2)_TOOLS) --calls firmware/calls \
        --without $(filter-out $(or $(3),frames),$(FIRMWARE_PROGRAMS))

# $(call DEMO,BOARD,FOLDER): holds the demo's frames against the simulator's.
DEMO = $(PYTHON) $(EMULATORS)/demo.py $(1) $(2)/demo.elf --wanted firmware/$(1)/frames --tuile $(TUILE) --models $(FIRMWARE)/models --out $(2)/demo

$(OBJ)/wire_trace: $(call objects,tests/emulators/wire_trace.c tests/emulators/trace.c) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

$(FIRMWARE)/libcount.so: $(EMULATORS)/count.c
	@mkdir -p $(@D)
	@echo "  gcc $@"; gcc -std=c11 -D_GNU_SOURCE -O2 -fPIC -shared -fvisibility=hidden $(WARN) $< -o $@

# ---- figures of the linked images, held against what the boards have -------------------------------------------------
.PHONY: size-firmware stack test-firmware $(BOARDS:%=size-firmware-%) $(BOARDS:%=stack-%) $(BOARDS:%=test-firmware-%)
size-firmware: $(BOARDS:%=size-firmware-%) ## flash and RAM of each board's program, by module, against its budget; no heap, no float
stack: $(BOARDS:%=stack-%) ## the deepest stack that each board's program may take, against its room

define emulated_figures
size-firmware-$(1): $(FIRMWARE_PROGRAMS:%=$(FIRMWARE)/$(1)/%.elf) $(BUILD)/need/emulators
	@for p in $(FIRMWARE_PROGRAMS); do echo "$(1) $$$$p, bytes:"; \
	  $$(PYTHON) $(EMULATORS)/image.py $(FIRMWARE)/$(1)/$$$$p.elf $(FIRMWARE)/$(1)/$$$$p.map --tools $($(1)_TOOLS) --budget firmware/$(1)/budget || exit 1; done
stack-$(1): $(FIRMWARE_PROGRAMS:%=$(FIRMWARE)/$(1)/%.elf) $(BUILD)/need/emulators
	@echo "$(1) frames:"
	@$$(call STACK,$(FIRMWARE)/$(1),$(1)) --room $($(1)_STACK)
	@echo "$(1) demo:"
	@$$(call STACK,$(FIRMWARE)/$(1),$(1),demo) --room $($(1)_STACK)
endef
$(foreach board,$(BOARDS),$(eval $(call emulated_figures,$(board))))

# ---- the LM3S6965 board: one image for all cores, and one built for each ---------------------------------------------
LM3S := $(FIRMWARE)/lm3s6965evb
LM3S_CORES := m3 m4 m7 m33
$(foreach core,$(LM3S_CORES),$(eval $(call firmware_program,$(LM3S)-$(core),lm3s6965evb,-mcpu=cortex-$(core) -mthumb -mfloat-abi=soft)))
LM3S_RUN := $(PYTHON) $(EMULATORS)/lm3s6965evb.py
LM3S_ALL := cortex-m0,cortex-m3,cortex-m4,cortex-m7,cortex-m33

test-firmware-lm3s6965evb: $(LM3S)/frames.elf $(LM3S_CORES:%=$(LM3S)-%/frames.elf) $(TUILE) firmware-models $(BUILD)/need/emulators \
                           stack-lm3s6965evb size-firmware-lm3s6965evb
	@$(LM3S_RUN) test $(LM3S)/frames.elf --cpu $(LM3S_ALL) --wanted firmware/lm3s6965evb/frames --tuile $(TUILE) \
	  --models $(FIRMWARE)/models --out $(LM3S)/out --stack $$($(call STACK,$(LM3S),lm3s6965evb) --quiet)
	@echo "Sending only what has changed:"
	@$(LM3S_RUN) test $(LM3S)/frames.elf --cpu cortex-m3 --options 'update=16 rows=8' --wanted firmware/lm3s6965evb/frames --tuile $(TUILE) \
	  --models $(FIRMWARE)/models --out $(LM3S)/out
	@echo "Built for each core:"
	@for core in $(LM3S_CORES); do $(call STACK,$(LM3S)-$$core,lm3s6965evb) --room $(lm3s6965evb_STACK) --quiet >/dev/null || exit 1; done
	@$(LM3S_RUN) test $(LM3S)/frames.elf --cpu $(subst $(empty) $(empty),$(comma),$(foreach c,$(LM3S_CORES),cortex-$(c):$(LM3S)-$(c)/frames.elf)) \
	  --wanted firmware/lm3s6965evb/frames --tuile $(TUILE) --models $(FIRMWARE)/models --out $(LM3S)/out
	@$(call DEMO,lm3s6965evb,$(LM3S))

# OPTIONS='scene=spider method=zbuffer frames=32'
OPTIONS := frames=4
emulate-lm3s6965evb: $(call firmware_folder,lm3s6965evb)/frames.elf $(FIRMWARE)/libcount.so $(BUILD)/need/emulators ## runs it in QEMU: frames as PNG, instructions of each; OPTIONS='scene=spider frames=32'
	@$(LM3S_RUN) show $< --out $(<D)/frames --plugin $(FIRMWARE)/libcount.so --options '$(OPTIONS)'

# ---- boards without a panel in their emulator: the SiFive E ------------------------------------------------------------
# $(call WIRE_TEST,BOARD,IMAGE,FOLDER), $(call WIRE_SHOW,BOARD,IMAGE,FOLDER)
WIRE_TEST = $(PYTHON) $(EMULATORS)/wire_board.py test $(2) --board $(1) --wire-trace $(OBJ)/wire_trace --wanted firmware/$(1)/frames \
  --tuile $(TUILE) --models $(FIRMWARE)/models --out $(3)/out --stack $$($(call STACK,$(3),$(1)) --quiet)
WIRE_SHOW = $(PYTHON) $(EMULATORS)/wire_board.py show $(2) --board $(1) --wire-trace $(OBJ)/wire_trace --out $(3)/frames \
  --plugin $(FIRMWARE)/libcount.so --options '$(OPTIONS)'
SIFIVE := $(FIRMWARE)/sifive_e

test-firmware-sifive_e: $(SIFIVE)/frames.elf $(OBJ)/wire_trace $(TUILE) firmware-models $(BUILD)/need/emulators stack-sifive_e size-firmware-sifive_e
	@$(call WIRE_TEST,sifive_e,$(SIFIVE)/frames.elf,$(SIFIVE))
	@$(call DEMO,sifive_e,$(SIFIVE)) --wire-trace $(OBJ)/wire_trace

emulate-sifive_e: $(call firmware_folder,sifive_e)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(BUILD)/need/emulators ## the same
	@$(call WIRE_SHOW,sifive_e,$<,$(<D))

# ---- Black Pill and Pico 2: their objects on boards of QEMU with the same cores (firmware/mps2/), all but those that touch the chip --------
MPS2 := $(FIRMWARE)/mps2
mps2_OWN_blackpill := firmware/blackpill
mps2_OWN_pico2 := firmware/pico2 firmware/rp2
mps2_MAP_blackpill := -Wl,--defsym=FLASH_AT=0 -Wl,--defsym=RAM_AT=0x20000000 -Wl,--defsym=RAM_BYTES=128K
mps2_MAP_pico2 := -Wl,--defsym=FLASH_AT=0x10000000 -Wl,--defsym=RAM_AT=0x80000000 -Wl,--defsym=RAM_BYTES=520K

# $(call mps2_board,BOARD,OBJECTS): MPS2/BOARD/frames.elf, with MODEL=FILE MPS2/BOARD-model/frames.elf. The block is as large as in the board's own program.
define mps2_board
$(MPS2)/$(1)$(FIRMWARE_OWN)/frames.elf: $(MPS2)/$(1)$(FIRMWARE_OWN)/board.o $(MPS2)/$(1)$(FIRMWARE_OWN)/wire_board.o $(call firmware_folder,$(1))/frames.elf firmware/mps2/link.ld
	@echo "  mps2 $$@"; $($(1)_TOOLS)gcc $($(1)_FLAGS) -nostdlib -nostartfiles -Wl,--gc-sections -Wl,--fatal-warnings $(mps2_MAP_$(1)) \
	  -T firmware/mps2/link.ld $$(filter %.o,$$^) $(filter-out $(patsubst %,$(FIRMWARE)/$(1)/%/%,$(mps2_OWN_$(1))),$(2)) -lgcc -o $$@
$(MPS2)/$(1)$(FIRMWARE_OWN)/board.o: firmware/mps2/board.c
$(MPS2)/$(1)$(FIRMWARE_OWN)/wire_board.o: firmware/board/wire/wire_board.c
$(MPS2)/$(1)$(FIRMWARE_OWN)/board.o $(MPS2)/$(1)$(FIRMWARE_OWN)/wire_board.o: $(call firmware_folder,$(1))/frames.elf
	@mkdir -p $$(@D)
	@size=$$$$($($(1)_TOOLS)nm -S $(call firmware_folder,$(1))/frames.elf | awk '$$$$4 == "block" { print $$$$2 }'); \
	$($(1)_TOOLS)gcc $($(1)_FLAGS) $(FIRMWARE_FLAGS) $(call scene_bits,$($(1)_SCENES)) -DBLOCK_BYTES=0x$$$$size -MMD -MP -c $$(filter %.c,$$^) -o $$@

test-firmware-$(1): $(MPS2)/$(1)$(FIRMWARE_OWN)/frames.elf $(OBJ)/wire_trace $(TUILE) firmware-models $(BUILD)/need/emulators firmware-$(1) stack-$(1) size-firmware-$(1)
	@$$(call WIRE_TEST,$(1),$(MPS2)/$(1)$(FIRMWARE_OWN)/frames.elf,$(FIRMWARE)/$(1))
.PHONY: emulate-$(1)
emulate-$(1): $(MPS2)/$(1)$(FIRMWARE_OWN)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(BUILD)/need/emulators
	@$$(call WIRE_SHOW,$(1),$$<,$(call firmware_folder,$(1)))
endef
emulate-blackpill: ## its objects on QEMU's Cortex-M4: frames as PNG, instructions of each; nothing of SPI, DMA and clocks
emulate-pico2: ## likewise on QEMU's Cortex-M33
mps2_objects = $(call firmware_linked,$(1)) $(FIRMWARE_MAIN_frames:%.c=$(FIRMWARE)/$(1)/%.o)
$(foreach board,blackpill pico2,$(eval $(call mps2_board,$(board),$(call mps2_objects,$(board)))))

# ---- all ----------------------------------------------------------------------------------------------------------------
.PHONY: emulate-lm3s6965evb emulate-sifive_e test-firmware-checks test-firmware-harness test-firmware-input test-firmware-twins
test-firmware-checks: $(BUILD)/need/arm $(BUILD)/need/emulators # that the checks of images find what they look for
	@$(PYTHON) $(EMULATORS)/test_checks.py $(FIRMWARE)/checks
test-firmware-harness: $(LM3S)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(BUILD)/need/emulators # that the harness tells what goes wrong
	@$(PYTHON) $(EMULATORS)/test_harness.py $(LM3S)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(FIRMWARE)/harness

test-firmware-input: $(TUILE) firmware-lm3s6965evb firmware-sifive_e $(BUILD)/need/avr $(BUILD)/need/emulators # that wrong input is told
	@$(PYTHON) $(EMULATORS)/test_input.py $(BUILD)

# $(call TWINS,NAME,SOURCES,WRAPPED,TARGETS)
TWINS = @sh $(EMULATORS)/twins.sh $(FIRMWARE)/twins $(1) '$(2)' '$(3)' $(4)
THUMB2 := cortex-m3 cortex-m4 cortex-m33
test-firmware-twins: $(BUILD)/need/bench-targets # that assembly does to the byte what its C twin does
	$(call TWINS,vertex,raster/geometry/vertex.c raster/geometry/vertex_thumb.c raster/geometry/vertex_thumb1.c raster/divide.c,vertex_thumb,$(THUMB2) cortex-m0plus)
	$(call TWINS,small,raster/visibility/zbuffer.c raster/fill/small_thumb.c raster/fill/small_thumb_flat.c raster/fill/small_thumb1.c raster/fill/small_thumb1_flat.c raster/divide.c,small_thumb_gouraud small_thumb_flat,$(THUMB2) cortex-m0plus)
	$(call TWINS,textured,raster/visibility/zbuffer_textured.c raster/fill/textured_thumb.c raster/fill/textured_thumb1.c raster/fill/small_thumb.c raster/fill/small_thumb1.c raster/surface/textured.c raster/divide.c,textured_thumb,$(THUMB2) cortex-m0plus)
	$(call TWINS,face,raster/frame/face_plain.c raster/frame/face_thumb.c raster/frame/face_thumb1.c,face_thumb,$(THUMB2) cortex-m0plus)

test-firmware: test-firmware-checks test-firmware-harness test-firmware-input test-firmware-twins $(BOARDS:%=test-firmware-%) ## boards in emulators: frames equal to the simulator's, faults, sizes, stack

emulate-%:
	@$(call no_board,$* in an emulator,$(BOARDS) uno)
stack-%:
	@$(call no_board,$* whose stack is bounded,$(BOARDS))
size-firmware-% test-firmware-%:
	@$(call no_board,$*,$(BOARDS) uno)
