# Figures: what a frame costs. Included by the Makefile.

BENCH := tests/bench
BENCH_OUT := $(BUILD)/bench
SIZE ?= 320x240
TILE ?= 320x24 32x32 320x240
MODEL ?= spider bunny
METHODS ?= zbuffer scanline warnock painter tree
SHADES ?= flat gouraud textured-gouraud
MEMORY ?= 4M
BENCH_GUESTS := cortex-m0plus cortex-m3 cortex-m4 cortex-m33 rv32imac
TARGETS ?= x86-64 $(BENCH_GUESTS) atmega328p rp2040
BENCH_JOBS ?= $(shell nproc)

$(BUILD)/need/bench: ; $(call need,valgrind python3,instruction counts)
$(BUILD)/need/bench-targets: ; $(call need,qemu-system-arm qemu-system-misc gcc-arm-none-eabi gcc-riscv64-unknown-elf,instruction counts on microcontrollers)

# ---- models by name: MODEL='spider bunny-2000 FILE' ----------------------------------------------------------------------
# NAME=FILE, or NAME=FILE:FACES, the most triangles; NAME-FACES is NAME with so many at most.
HOUSE := $(dir $(SPIDER))../IFC/AC14-FZK-Haus.ifc
BENCH_SPHERE := $(BENCH_OUT)/sphere.obj
BENCH_KNOWN := spider=$(SPIDER) bunny=$(BUNNY):6000 room=tests/models/room.obj floor=tests/models/floor.obj beams=tests/models/beams.obj \
               cube=firmware/models/cube.obj sphere=$(BENCH_SPHERE) house=$(HOUSE)
bench_from_spider := $(SPIDER)
bench_from_bunny := $(BUNNY)
bench_from_sphere := $(BENCH_SPHERE)
bench_from_house := $(HOUSE)
bench_from = $(foreach m,$(1),$(bench_from_$(firstword $(subst -, ,$(m)))) $(filter $(BUILD)/%,$(m)))

$(OBJ)/sphere: $(OBJ)/tests/bench/sphere.o
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ -lm -o $@
$(BENCH_SPHERE): $(OBJ)/sphere
	@mkdir -p $(@D) && $< >$@
$(HOUSE): $(SPIDER) ;

# ---- programs ------------------------------------------------------------------------------------------------------------
$(OBJ)/bench $(OBJ)/guest_scene: $(OBJ)/tests/bench/turntable.o
$(OBJ)/guest_scene: $(OBJ)/tests/bench/qemu/guest_scene.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@
$(OBJ)/bench: $(OBJ)/tests/bench/bench.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

# raster/ for each emulated processor; ROOT, ending in /: of another tree.
ROOT ?=
BENCH_GUEST ?= $(BENCH_OUT)/guest
BENCH_GUEST_SRC := $(patsubst $(ROOT)%,%,$(filter-out $(addprefix $(ROOT)raster/,compact/%),$(wildcard $(ROOT)raster/*.c $(ROOT)raster/*/*.c)))
GUESTS ?= $(BENCH_GUESTS)
define guest_target
$(BENCH_GUEST)/$(1)/%.o: $(ROOT)%.c $(BENCH)/qemu/target.sh | $(BUILD)/need/bench-targets
	@mkdir -p $$(@D)
	@echo "  $(1) $$<"; sh $(BENCH)/qemu/cc.sh $(1) -MMD -MP -c $$< -o $$@
endef
$(foreach target,$(BENCH_GUESTS),$(eval $(call guest_target,$(target))))
.PHONY: bench-guests
bench-guests: $(foreach t,$(filter $(BENCH_GUESTS),$(GUESTS)),$(patsubst %.c,$(BENCH_GUEST)/$(t)/%.o,$(BENCH_GUEST_SRC))) ;
make_guests = $(if $(filter $(BENCH_GUESTS),$(1)),$(MAKE) --no-print-directory -j$(BENCH_JOBS) bench-guests GUESTS='$(1)')

BENCH_PROGRAMS := $(OBJ)/bench $(OBJ)/guest_scene $(FIRMWARE)/libcount.so $(TUILE)
BENCH_COMMON = --bench $(OBJ)/bench --scene $(OBJ)/guest_scene --guest $(BENCH_GUEST) --plugin $(FIRMWARE)/libcount.so --tuile $(TUILE) \
               --out $(BENCH_OUT) --jobs $(BENCH_JOBS) $(addprefix --known ,$(BENCH_KNOWN))
bench_needs = $(BENCH_PROGRAMS) $(BUILD)/need/bench $(call bench_from,$(1))

# ---- make bench ----------------------------------------------------------------------------------------------------------
# Boards draw their own scenes; both programs print the cycles of each frame.
BENCH_UNO = mkdir -p $(BENCH_OUT)/uno && $(OBJ)/uno show $(UNO)/frames.bin $(FIRMWARE)/models $(BENCH_OUT)/uno
BENCH_RP2040 = $(EMULATE_RP2040) --program $(pico_FOLDER)/frames.elf --options 'panel=st7789-240x240 frames=8'
bench_board_needs = $(if $(filter atmega328p,$(1)),$(OBJ)/uno $(UNO)/frames.elf) $(if $(filter rp2040,$(1)),$(pico_FOLDER)/frames.elf $(RP2040JS))

.PHONY: bench bench-methods bench-instances bench-linux
bench: $(call bench_needs,$(MODEL)) $(call bench_board_needs,$(TARGETS)) ## what frames cost, by callgrind, QEMU and the boards' emulators; MODEL='NAME FILE ...' TILE=WxH SIZE=WxH TARGETS= METHODS= SHADES=
	@$(call make_guests,$(TARGETS))
	@$(PYTHON) $(BENCH)/bench.py rows $(BENCH_COMMON) --size $(SIZE) --tiles '$(TILE)' --targets '$(TARGETS)' --methods '$(METHODS)' \
	  --shades '$(SHADES)' --memory $(MEMORY) --board 'atmega328p=$(BENCH_UNO)' --board "rp2040=$(BENCH_RP2040)" $(MODEL)
	@$(PYTHON) $(BENCH)/charts.py $(BENCH_OUT)

# ---- charts --------------------------------------------------------------------------------------------------------------
# The cost against faces, of the first model, and against pixels and memory, of the second.
SWEEP_TARGETS ?= x86-64 cortex-m3
SWEEP_MODELS ?= bunny spider
.PHONY: bench-charts
bench-charts: $(call bench_needs,$(SWEEP_MODELS)) ## counts for some minutes, and draws build/bench/*.svg: phases (of make bench), cost against faces, pixels, memory
	@$(call make_guests,$(SWEEP_TARGETS))
	@$(PYTHON) $(BENCH)/bench.py sweep $(BENCH_COMMON) --targets '$(SWEEP_TARGETS)' $(SWEEP_MODELS)
	@$(PYTHON) $(BENCH)/charts.py $(BENCH_OUT)

# ---- the budget ----------------------------------------------------------------------------------------------------------
# The list of what is counted, and the most that each may take: tests/bench/budget.
BENCH_BUDGET = $(PYTHON) $(BENCH)/budget.py $(1) $(BENCH_COMMON) --file $(BENCH)/budget --readme README.md

.PHONY: bench-budget bench-budget-write test-bench
bench-budget: $(BENCH)/budget $(call bench_needs,spider) ## fails when a frame takes over one per cent more instructions than tests/bench/budget says
	@$(call make_guests,$(BENCH_GUESTS))
	@$(call BENCH_BUDGET,check)
bench-budget-write: $(BENCH)/budget $(call bench_needs,spider) ## writes tests/bench/budget, and the README's table of it, anew
	@$(call make_guests,$(BENCH_GUESTS))
	@$(call BENCH_BUDGET,write)

test-bench: $(call bench_needs,) # that the bench's scripts find what they look for
	@$(call make_guests,cortex-m3)
	@$(PYTHON) $(BENCH)/test_bench.py $(BENCH_OUT)/test $(BENCH_COMMON)
	@$(PYTHON) $(BENCH)/test_charts.py $(BENCH_OUT)/test

# ---- what a change did ---------------------------------------------------------------------------------------------------
# By the z-buffer in strips, where METHODS and TILE are not given.
usual = $(if $(filter file,$(origin $(1))),$(2),$($(1)))
.PHONY: bench-compare
bench-compare: $(call bench_needs,$(MODEL)) ## counts BASE=REVISION and this tree: before, after and per cent, by phase; MODEL= TARGETS= METHODS= SHADES= as of bench
	@$(call make_guests,$(TARGETS))
	@$(PYTHON) $(BENCH)/compare.py $(BENCH_COMMON) '--base=$(BASE)' --make '$(MAKE)' --size $(SIZE) --tiles '$(call usual,TILE,320x24)' \
	  --targets '$(TARGETS)' --methods '$(call usual,METHODS,zbuffer)' --shades '$(SHADES)' --memory $(MEMORY) $(MODEL)

# ---- tables of the README ------------------------------------------------------------------------------------------------
.PHONY: bench-table bench-table-check
bench-table: ## rows of the README's "Speed" from build/bench/bench.json, for the first MODEL that make bench has counted in TILE='320x24 32x32'
	@$(PYTHON) $(BENCH)/readme.py print $(BENCH_OUT)/bench.json $(basename $(notdir $(firstword $(MODEL))))
bench-table-check: ## that the README's "Speed" says the same
	@$(PYTHON) $(BENCH)/readme.py check $(BENCH_OUT)/bench.json $(basename $(notdir $(firstword $(MODEL)))) README.md

# ---- others ---------------------------------------------------------------------------------------------------------------
# Four scenes, each compiled without and with a display tree: NAME[@EYE@AT@FOV], model units.
METHODS_SCENES := sphere spider room@0,1.2,1.7@0,1,0@70 house@17,8,10@6,2,-5@45
METHODS_TILE ?= 320x24
COMPARED := $(BUILD)/bench/methods
COMPARED_MODELS := $(foreach n,sphere spider room house,$(COMPARED)/$(n).tuile $(COMPARED)/$(n)-tree.tuile)
$(COMPARED)/sphere.tuile $(COMPARED)/sphere-tree.tuile: $(BENCH_SPHERE)
$(COMPARED)/spider.tuile $(COMPARED)/spider-tree.tuile: $(SPIDER)
$(COMPARED)/room.tuile $(COMPARED)/room-tree.tuile: tests/models/room.obj
$(COMPARED)/house.tuile $(COMPARED)/house-tree.tuile: $(HOUSE)
$(COMPARED)/%-tree.tuile: $(TUILE)
	@mkdir -p $(@D)
	$(TUILE) mesh $(filter-out $(TUILE),$^) --no-textures --tree -o $@ >/dev/null
$(COMPARED)/%.tuile: $(TUILE)
	@mkdir -p $(@D)
	$(TUILE) mesh $(filter-out $(TUILE),$^) --no-textures -o $@ >/dev/null

bench-methods: $(OBJ)/bench $(BUILD)/need/bench $(COMPARED_MODELS) ## the five methods over four scenes: instructions, memory, overdraw, flash
	@sh tests/bench/methods.sh $(OBJ)/bench $(COMPARED) $(COMPARED) $(SIZE) $(METHODS_TILE) $(METHODS_SCENES)

$(OBJ)/instances: $(OBJ)/tests/bench/instances.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

bench-instances: $(OBJ)/instances $(BUILD)/need/bench $(COMPARED)/sphere.tuile ## what instances cost that nobody sees
	@sh tests/bench/instances.sh $(OBJ)/instances $(BUILD)/bench 16 tests/models/link.obj $(COMPARED)/sphere.tuile

$(OBJ)/bench-linux: $(OBJ)/tests/bench/linux.o $(call objects,$(MOCK_SRC)) $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -lumockdev -lgobject-2.0 -lglib-2.0 -o $@

bench-linux: $(OBJ)/bench-linux ## what the sending thread of a Linux board is worth
	@umockdev-wrapper $<
