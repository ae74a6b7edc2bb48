# Boards in emulators. Included by the Makefile.

EMULATORS := tests/emulators
PYTHON := PYTHONDONTWRITEBYTECODE=1 python3
# $(call STACK,FOLDER,BOARD,PROGRAM): PROGRAM is frames where it is left out.
STACK = $(PYTHON) $(EMULATORS)/stack.py $(1)/$(or $(3),frames).elf $(1) --tools $($(2)_TOOLS) --calls firmware/calls \
        --without $(filter-out $(or $(3),frames),$(FIRMWARE_PROGRAMS))

# $(call DEMO,BOARD,FOLDER): holds the demo's frames against the simulator's.
DEMO = $(PYTHON) $(EMULATORS)/demo.py $(1) $(2)/demo.elf --wanted firmware/$(1)/frames --tuile $(TUILE) --models $(FIRMWARE)/models --out $(2)/demo

$(OBJ)/wire_trace: $(OBJ)/tests/emulators/wire_trace.o $(SIM_LIB_OBJ) $(CORE_OBJ)
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
emulate-lm3s6965evb: $(LM3S)/frames.elf $(FIRMWARE)/libcount.so $(BUILD)/need/emulators ## runs it in QEMU: frames as PNG, instructions of each; OPTIONS='scene=spider frames=32'
	@$(LM3S_RUN) show $< --out $(LM3S)/frames --plugin $(FIRMWARE)/libcount.so --options '$(OPTIONS)'

# ---- the SiFive E ------------------------------------------------------------------------------------------------------
SIFIVE := $(FIRMWARE)/sifive_e
SIFIVE_RUN = $(PYTHON) $(EMULATORS)/sifive_e.py $(1) $(SIFIVE)/frames.elf --wire-trace $(OBJ)/wire_trace

test-firmware-sifive_e: $(SIFIVE)/frames.elf $(OBJ)/wire_trace $(TUILE) firmware-models $(BUILD)/need/emulators stack-sifive_e size-firmware-sifive_e
	@$(call SIFIVE_RUN,test) --wanted firmware/sifive_e/frames --tuile $(TUILE) --models $(FIRMWARE)/models --out $(SIFIVE)/out \
	  --stack $$($(call STACK,$(SIFIVE),sifive_e) --quiet)
	@$(call DEMO,sifive_e,$(SIFIVE)) --wire-trace $(OBJ)/wire_trace

emulate-sifive_e: $(SIFIVE)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(BUILD)/need/emulators ## the same
	@$(call SIFIVE_RUN,show) --out $(SIFIVE)/frames --plugin $(FIRMWARE)/libcount.so --options '$(OPTIONS)'

# ---- all ----------------------------------------------------------------------------------------------------------------
.PHONY: emulate-lm3s6965evb emulate-sifive_e test-firmware-checks test-firmware-harness
test-firmware-checks: $(BUILD)/need/arm $(BUILD)/need/emulators # that the checks of images find what they look for
	@$(PYTHON) $(EMULATORS)/test_checks.py $(FIRMWARE)/checks
test-firmware-harness: $(LM3S)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(BUILD)/need/emulators # that the harness tells what goes wrong
	@$(PYTHON) $(EMULATORS)/test_harness.py $(LM3S)/frames.elf $(OBJ)/wire_trace $(FIRMWARE)/libcount.so $(FIRMWARE)/harness

test-firmware: test-firmware-checks test-firmware-harness $(BOARDS:%=test-firmware-%) ## boards in emulators: frames equal to the simulator's, faults, sizes, stack

emulate-%:
	@echo "There is no board $* in an emulator; there are: $(BOARDS)" >&2; exit 1
