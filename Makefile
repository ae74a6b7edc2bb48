# Tuile: one entry for everything. `make help` lists the targets.

CC ?= gcc
ifeq ($(origin CC),default)
CC := gcc
endif
BUILD := build
# release, asan, clang, arm64: each with its own objects
VARIANT := release
OBJ := $(BUILD)/$(VARIANT)

ifeq ($(VARIANT),clang)
CC := clang
endif

WARN := -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wpointer-arith -Wstrict-prototypes -Wmissing-prototypes \
        -Wcast-qual -Wwrite-strings -Wundef -Wvla -Wno-missing-field-initializers -Werror # a field that is left out is 0, the default
CFLAGS_CORE := -std=c11 -O2 -g -ffreestanding -fno-pie $(WARN) # as on a board: constants with pointers are read-only
LDFLAGS := -no-pie
CFLAGS_HOST := -std=c11 -O2 -g -D_GNU_SOURCE $(WARN)
LIBS_SIM := -lassimp -lmeshoptimizer -lpng -ljpeg -lgpiod -lusb-1.0 -llz4 -lpthread -lm
LIBS_TEST := -lcmocka
ifeq ($(VARIANT),asan)
CFLAGS_CORE += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
CFLAGS_HOST += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS += -fsanitize=address,undefined
endif

CORE_SRC := $(wildcard raster/*.c raster/*/*.c hal/*.c hal/panels/*.c hal/template/*.c firmware/*.c)
HOSTED_SRC := $(wildcard hal/linux/*.c hal/usb/*.c) # the ports that have an operating system under them
SIM_SRC := $(wildcard sim/*.c sim/*/*.c)
REFERENCE_SRC := $(wildcard tests/reference/*.c)
SUPPORT_SRC := $(wildcard tests/support/*.c)
LINUX_LIB_SRC := tests/linux/pins.c tests/linux/usbip.c # what programs of tests/linux share
MESA_SRC := $(wildcard tests/mesa/*.c)
MOCK_SRC := $(wildcard tests/mock/*.c) # made-up devices for tests/test_mock_*.c
TEST_SRC := $(wildcard tests/test_*.c)
FUZZ_SRC := $(wildcard tests/fuzz_*.c)

objects = $(patsubst %.c,$(OBJ)/%.o,$(1))
CORE_OBJ := $(call objects,$(CORE_SRC))
SIM_OBJ := $(call objects,$(SIM_SRC) $(HOSTED_SRC))
SIM_LIB_OBJ := $(filter-out $(OBJ)/sim/main.o,$(SIM_OBJ))
TEST_LIB_OBJ := $(call objects,$(REFERENCE_SRC) $(SUPPORT_SRC) $(LINUX_LIB_SRC))
TESTS := $(patsubst tests/%.c,$(OBJ)/%,$(TEST_SRC))
MOCK_TESTS := $(filter $(OBJ)/test_mock_%,$(TESTS))
FUZZERS := $(patsubst tests/%.c,$(OBJ)/%,$(FUZZ_SRC))

ifeq ($(VARIANT),release)
TUILE := $(BUILD)/tuile
else
TUILE := $(OBJ)/tuile
endif

# ---- what is needed from Debian ------------------------------------------------------------------------------------
# $(call need,packages,why): installs those that are missing, and says so.
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
define need
	@missing=""; for p in $(1); do \
	  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
	if [ -n "$$missing" ]; then \
	  echo "Installing$$missing by apt-get: $(2)"; \
	  $(SUDO) apt-get update -qq && \
	  $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null; fi
	@mkdir -p $(@D) && touch $@
endef

.PHONY: golden help all demo test test-asan test-clang check docs-pictures gallery install-udev size size-arm format format-check lint clean
help: ## this list
	@grep -hE '^[a-z0-9_-]+:.*##' Makefile tests/linux/linux.mk firmware/firmware.mk tests/emulators/emulators.mk firmware/uno/uno.mk tests/emulators/uno.mk firmware/pico/board.mk firmware/pico2/board.mk firmware/blackpill/board.mk tests/emulators/pico.mk tests/emulators/blackpill.mk tests/bench/bench.mk tests/predict/predict.mk tests/tsan.mk | sed 's/:.*##/\t/' | expand -t 16

all: $(TUILE) ## build the simulator, build/tuile

SIM_PACKAGES := libassimp-dev libmeshoptimizer-dev libpng-dev libjpeg62-turbo-dev libgpiod-dev libusb-1.0-0-dev liblz4-dev
$(BUILD)/need/sim: ; $(call need,$(SIM_PACKAGES),model import + simplification + pictures + displays)
$(BUILD)/need/test: ; $(call need,libcmocka-dev umockdev libumockdev-dev pkg-config,tests)
$(BUILD)/need/mesa: ; $(call need,libosmesa6-dev,a second renderer to compare with)
$(BUILD)/need/clang: ; $(call need,clang libclang-rt-14-dev,a second compiler)
$(BUILD)/need/lint: ; $(call need,clang-tidy cppcheck,static analysis)
$(BUILD)/need/arm: ; $(call need,gcc-arm-none-eabi,code sizes on Cortex-M)
$(BUILD)/need/format: ; $(call need,clang-format,formatting)

# ---- objects and programs ------------------------------------------------------------------------------------------
$(CORE_OBJ): $(OBJ)/%.o: %.c Makefile
	@mkdir -p $(@D)
	@echo "  $(notdir $(CC)) $<"; $(CC) $(CFLAGS_CORE) -MMD -MP -c $< -o $@

$(OBJ)/sim/%.o: sim/%.c Makefile | $(BUILD)/need/sim
	@mkdir -p $(@D)
	@echo "  $(notdir $(CC)) $<"; $(CC) $(CFLAGS_HOST) -MMD -MP -c $< -o $@

$(call objects,$(HOSTED_SRC)): $(OBJ)/%.o: %.c Makefile | $(BUILD)/need/sim
	@mkdir -p $(@D)
	@echo "  $(notdir $(CC)) $<"; $(CC) $(CFLAGS_HOST) -MMD -MP -c $< -o $@

$(OBJ)/tests/%.o: tests/%.c Makefile | $(BUILD)/need/test $(BUILD)/need/sim
	@mkdir -p $(@D)
	@echo "  $(notdir $(CC)) $<"; $(CC) $(CFLAGS_HOST) $(CFLAGS_TEST) -MMD -MP -c $< -o $@

# The default font stands in its object as it is.
$(OBJ)/sim/font_default.o: sim/fonts/tuile-6x10.bdf

$(TUILE): $(SIM_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

$(OBJ)/test_%: $(OBJ)/tests/test_%.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -o $@

# Beside another renderer; it is linked to nothing else.
$(call objects,$(MESA_SRC)): | $(BUILD)/need/mesa
$(OBJ)/test_mesa: $(call objects,$(MESA_SRC))
$(OBJ)/test_mesa: LIBS_TEST += -lOSMesa

# Under umockdev, see RUN_TESTS.
$(MOCK_TESTS): $(call objects,$(MOCK_SRC))
$(MOCK_TESTS): LIBS_TEST += -lumockdev -lgobject-2.0 -lglib-2.0
$(patsubst $(OBJ)/%,$(OBJ)/tests/%.o,$(MOCK_TESTS)) $(call objects,$(MOCK_SRC) tests/bench/linux.c): CFLAGS_TEST = $(patsubst -I%,-isystem %,$(shell pkg-config --cflags umockdev-1.0))

# hal/linux is written for libgpiod 1 and 2. Where the system's is version 1, its tests are built against version 2 as well, from
# Debian's backports: fetched by an apt with lists of its own, unpacked under build/, not installed.
GPIOD2 := $(BUILD)/gpiod2
GPIOD2_TESTS := $(patsubst $(OBJ)/test_mock_linux_%,$(OBJ)/test_mock_gpiod2_%,$(filter $(OBJ)/test_mock_linux_%,$(MOCK_TESTS)))
GPIOD2_OBJ := $(OBJ)/gpiod2/lines_v1.o $(OBJ)/gpiod2/lines_v2.o
$(GPIOD2)/lib/libgpiod.a: tests/mock/gpiod2.sh
	@echo "Fetching libgpiod 2 from Debian's backports for the tests of hal/linux (unpacked under $(GPIOD2), not installed)"
	@sh tests/mock/gpiod2.sh $(GPIOD2)

$(GPIOD2_OBJ): $(OBJ)/gpiod2/%.o: hal/linux/%.c Makefile $(GPIOD2)/lib/libgpiod.a
	@mkdir -p $(@D)
	@echo "  $(notdir $(CC)) $< (libgpiod 2)"; $(CC) $(CFLAGS_HOST) -I$(GPIOD2)/include -MMD -MP -c $< -o $@

$(GPIOD2_TESTS): $(OBJ)/test_mock_gpiod2_%: $(OBJ)/tests/test_mock_linux_%.o $(GPIOD2_OBJ) $(call objects,$(MOCK_SRC)) $(TEST_LIB_OBJ) \
  $(filter-out $(OBJ)/hal/linux/lines_v%.o,$(SIM_LIB_OBJ)) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(subst -lgpiod,$(GPIOD2)/lib/libgpiod.a,$(LIBS_SIM)) $(LIBS_TEST) -lumockdev -lgobject-2.0 -lglib-2.0 -o $@

$(OBJ)/tests/fuzz_%.o: CFLAGS_HOST += -DFUZZ_DRIVER
$(OBJ)/fuzz_%: $(OBJ)/tests/fuzz_%.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -o $@

.SECONDARY:
-include $(shell find $(BUILD) \( -path $(BUILD)/linux -o -path $(BUILD)/bench/base \) -prune -o -name '*.d' -print 2>/dev/null)

# ---- models from Debian packages: downloaded and unpacked under build/, not installed ------------------------------
MODELS := $(BUILD)/models
SPIDER := $(MODELS)/assimp-testmodels/usr/share/assimp/models/OBJ/spider.obj
BUNNY := $(MODELS)/glmark2-data/usr/share/glmark2/models/bunny.obj
BUNNY_6000 := $(MODELS)/bunny6000.tuile

define fetch
	@mkdir -p $(MODELS)/$(1)
	@echo "Fetching the Debian package $(1) for $(2) (unpacked under $(MODELS), not installed)"
	@cd $(MODELS)/$(1) && { apt-get download -qq $(1) 2>/dev/null || { $(SUDO) apt-get update -qq && apt-get download -qq $(1) 2>/dev/null; }; } && \
	  dpkg-deb -x $(1)_*.deb . && rm -f $(1)_*.deb && touch $(abspath $(3))
endef

$(SPIDER): ; $(call fetch,assimp-testmodels,spider.obj,$(SPIDER))
$(BUNNY): ; $(call fetch,glmark2-data,bunny.obj,$(BUNNY))
$(BUNNY_6000): $(BUNNY) $(TUILE)
	$(TUILE) mesh $(BUNNY) -o $@ --max-faces 6000

# ---- demo ----------------------------------------------------------------------------------------------------------
demo: $(TUILE) $(SPIDER) $(BUNNY_6000) ## two real models on the simulated panel, 36 frames each, as pictures in build/demo
	@mkdir -p $(BUILD)/demo
	$(TUILE) render $(SPIDER) --rotate 90 --frames 36 --shade gouraud --background 182030 --out $(BUILD)/demo/spider-%02d.png --sheet $(BUILD)/demo/spider.png
	$(TUILE) render $(BUNNY_6000) --frames 36 --shade gouraud --background 302018 --memory 64K --out $(BUILD)/demo/bunny-%02d.png --sheet $(BUILD)/demo/bunny.png
	@echo "Pictures: $(BUILD)/demo/*.png; contact sheets: $(BUILD)/demo/spider.png and $(BUILD)/demo/bunny.png"

# ---- tests ---------------------------------------------------------------------------------------------------------
# Tests named test_mock_* see devices that umockdev makes up: its library stands between them and the kernel, behind ASan's.
MOCK_RUN := umockdev-wrapper
ifeq ($(VARIANT),asan)
MOCK_RUN = env LD_PRELOAD=$(shell $(CC) -print-file-name=libasan.so):libumockdev-preload.so.0
endif
RUN_TESTS = for t in $(1); do echo "== $$t"; case $$t in */test_mock_*) under="$(MOCK_RUN)" ;; *) under= ;; esac; \
  TUILE=$(TUILE) SPIDER=$(SPIDER) BUNNY_6000=$(BUNNY_6000) BUILD=$(BUILD) $$under $$t || exit 1; done

check: $(TESTS) $(GPIOD2_TESTS) $(FUZZERS) $(TUILE) $(SPIDER) $(BUNNY_6000)
	@$(call RUN_TESTS,$(FUZZERS))
	@$(call RUN_TESTS,$(TESTS) $(GPIOD2_TESTS))

test: ## builds and passes everything: gcc, emulated boards, predicted pace, instruction counts, sanitizers, clang, a real kernel
	$(MAKE) --no-print-directory check objects
	$(MAKE) --no-print-directory test-firmware
	$(MAKE) --no-print-directory predict-check-pico predict-check-uno
	$(MAKE) --no-print-directory test-bench bench-budget
	$(MAKE) --no-print-directory check VARIANT=asan
	$(MAKE) --no-print-directory test-tsan
	$(MAKE) --no-print-directory test-clang
	$(MAKE) --no-print-directory test-linux

golden: $(filter $(OBJ)/test_golden%,$(TESTS)) $(TUILE) $(SPIDER) $(BUNNY_6000) ## draw the golden pictures anew; look at them before you commit them
	@export UPDATE_GOLDEN=1; $(call RUN_TESTS,$(filter $(OBJ)/test_golden%,$(TESTS)))

test-asan: ## all tests under ASan and UBSan
	$(MAKE) --no-print-directory check VARIANT=asan

test-clang: $(BUILD)/need/clang ## the simulator and all tests built by clang
	$(MAKE) --no-print-directory clang-programs VARIANT=clang
	@$(call RUN_TESTS,$(BUILD)/clang/test_fill $(BUILD)/clang/test_golden)

.PHONY: clang-programs objects
clang-programs: $(TESTS) $(TUILE)

# No heap, no float, no state: proved on the objects of raster/, hal/ and the frame loop.
objects: $(CORE_OBJ)
	@sh tests/objects.sh $(CORE_OBJ)
	@sh tests/methods.sh $(OBJ)/methods.o $(CC) $(CFLAGS_CORE)
	@sh tests/features.sh $(OBJ)/features $(CC) $(CFLAGS_CORE)

include tests/linux/linux.mk
include firmware/firmware.mk firmware/uno/uno.mk
include tests/emulators/emulators.mk tests/emulators/pico.mk tests/emulators/blackpill.mk tests/emulators/uno.mk tests/bench/bench.mk tests/predict/predict.mk tests/tsan.mk

# ---- figures -------------------------------------------------------------------------------------------------------
# ---- pictures of docs/methods.md: one view of each method, from the inside of a room and of four beams -----------------
PICTURES := docs/pictures
ROOM_VIEW := --rotate 90 --eye 0,1.2,2.4 --at 0,1,0 --fov 70
BEAMS_VIEW := --rotate 90 --eye 0.8,0.6,4.6 --at 0,0,0
docs-pictures: $(TUILE) $(COMPARED)/room-tree.tuile ## draw the pictures of docs/methods.md anew; look at them before you commit them
	@mkdir -p $(PICTURES)
	$(TUILE) render tests/models/room.obj $(ROOM_VIEW) --show zbuffer-overdraw --out $(PICTURES)/zbuffer.png
	$(TUILE) render tests/models/room.obj $(ROOM_VIEW) --show scanline-edges --out $(PICTURES)/scanline.png
	$(TUILE) render tests/models/room.obj $(ROOM_VIEW) --show warnock-windows --out $(PICTURES)/warnock.png
	$(TUILE) render tests/models/beams.obj $(BEAMS_VIEW) --show painter-order --out $(PICTURES)/painter.png
	$(TUILE) render $(COMPARED)/room-tree.tuile $(ROOM_VIEW) --show tree-order --out $(PICTURES)/tree.png

# docs/gallery.md is the list: each of its commands draws one picture.
gallery: $(TUILE) $(SPIDER) $(BUNNY_6000) ## draw the pictures of docs/gallery.md anew; look at them before you commit them
	@mkdir -p $(PICTURES)/gallery
	@awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' docs/gallery.md | SPIDER=$(SPIDER) BUNNY=$(BUNNY_6000) sh -e

size: $(CORE_OBJ) ## code size of each part, and that no part has data of its own
	@size $(CORE_OBJ) | awk 'NR == 1 { print; next } { print; text += $$1; data += $$2; bss += $$3 } \
	  END { print text "\t" data "\t" bss "\t\t\ttotal"; exit data + bss > 0 }'

size-arm: $(BUILD)/need/arm ## code size of a renderer of each method on Cortex-M0+ and M3
	@sh tests/size_arm.sh $(BUILD)/arm arm-none-eabi- -std=c11 -ffreestanding $(WARN)

size-features: $(BUILD)/need/arm ## code size of each feature on Cortex-M3
	@sh tests/size_features.sh $(BUILD)/arm arm-none-eabi- -std=c11 -ffreestanding $(WARN)

install-udev: ## udev's rules: the groups spi, gpio and plugdev may draw on displays
	@if [ -z "$(DESTDIR)" ]; then for g in spi gpio plugdev; do getent group $$g >/dev/null || $(SUDO) groupadd --system $$g; done; fi
	$(SUDO) install -D -m 644 hal/linux/60-tuile.rules $(DESTDIR)/etc/udev/rules.d/60-tuile.rules
	@if [ -z "$(DESTDIR)" ] && command -v udevadm >/dev/null; then $(SUDO) udevadm control --reload && $(SUDO) udevadm trigger; fi

FORMATTED := $(shell git ls-files '*.c' '*.h' 2>/dev/null)
format: $(BUILD)/need/format ## clang-format all sources
	clang-format -i $(FORMATTED)

lint: $(BUILD)/need/lint $(BUILD)/need/sim $(BUILD)/need/test ## clang-tidy and cppcheck
	clang-tidy --quiet --warnings-as-errors='*' $(filter-out hal/template/%,$(CORE_SRC)) $(HOSTED_SRC) $(SIM_SRC) -- -std=c11 -D_GNU_SOURCE
	cppcheck --quiet --error-exitcode=1 --std=c11 --inline-suppr --enable=warning,performance,portability \
	  --suppress=missingIncludeSystem --suppress=shiftNegativeLHS $(CORE_SRC) $(HOSTED_SRC) $(SIM_SRC)

clean: ## remove build/
	rm -rf $(BUILD)
