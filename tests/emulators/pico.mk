# The Pico in an emulator that is a library for Node. Included by the Makefile.

RP2040JS_FOLDER := $(BUILD)/emulators
RP2040JS := $(RP2040JS_FOLDER)/node_modules/rp2040js/package.json
EMULATE_RP2040 = node tests/emulators/rp2040.mjs --modules $(RP2040JS_FOLDER)

# Node is Debian's, unless there is one already: other packagings of it conflict with Debian's npm.
$(BUILD)/need/node:
	@command -v npm >/dev/null || { echo "Installing nodejs npm by apt-get: emulated boards"; $(SUDO) apt-get update -qq && \
	  $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends nodejs npm >/dev/null; }
	@mkdir -p $(@D) && touch $@

$(RP2040JS): tests/emulators/package.json tests/emulators/package-lock.json | $(BUILD)/need/node
	@mkdir -p $(RP2040JS_FOLDER)
	@cp $^ $(RP2040JS_FOLDER)/
	@echo "  npm ci in $(RP2040JS_FOLDER)"; cd $(RP2040JS_FOLDER) && npm ci --silent --no-audit --no-fund
	@touch $@

PANEL_FRAMES := $(OBJ)/emulators/panel_frames
$(PANEL_FRAMES): $(call objects,tests/emulators/panel_frames.c tests/emulators/trace.c) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@mkdir -p $(@D)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

test-firmware-pico: firmware-pico $(pico_MORE)/overlap.elf $(pico_MUTANTS) firmware-models $(PANEL_FRAMES) $(RP2040JS) stack-pico size-firmware-pico
	@sh tests/emulators/pico.sh $(BUILD) $(PANEL_FRAMES) $$($(call STACK,$(pico_FOLDER),pico) --quiet)
	@COMPILE='$(pico_TOOLS)gcc $(pico_FLAGS) $(FIRMWARE_FLAGS) $(call scene_bits,$(pico_SCENES)) $(pico_DEFINES) -Ifirmware' \
	  LINK='$(pico_TOOLS)gcc $(pico_FLAGS) -nostdlib -nostartfiles -Wl,--gc-sections -T firmware/pico/link.ld $(filter-out %/firmware/update.o,$(pico_OBJ))' \
	  sh tests/emulators/pico_update.sh $(BUILD) $(PANEL_FRAMES)

PANEL ?= st7789-240x240
emulate-pico: $(call firmware_folder,pico)/frames.elf $(if $(FIRMWARE_OWN),,firmware-models) $(PANEL_FRAMES) $(RP2040JS) ## runs it on an emulated RP2040: frames as PNG, times of each; PANEL=ili9341 OPTIONS='scene=bunny frames=32'
	@mkdir -p $(<D)/frames
	@$(EMULATE_RP2040) --program $< --trace $(<D)/frames/wire --options 'panel=$(PANEL) $(OPTIONS)'
	@$(PANEL_FRAMES) $(<D)/frames/wire $(PANEL) $(FIRMWARE)/model$(if $(FIRMWARE_OWN),,s) any $(<D)/frames/$(PANEL)
	@rm $(<D)/frames/wire
	@echo "Pictures: $(<D)/frames/$(PANEL)-*.png"
