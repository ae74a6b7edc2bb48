# Tuile: one entry for everything. `make help` lists the targets.

CC ?= gcc
ifeq ($(origin CC),default)
CC := gcc
endif
BUILD := build
# release, asan, clang: each with its own objects
VARIANT := release
OBJ := $(BUILD)/$(VARIANT)

WARN := -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wpointer-arith -Wstrict-prototypes -Wmissing-prototypes \
        -Wcast-qual -Wwrite-strings -Wundef -Wvla -Werror
CFLAGS_CORE := -std=c11 -O2 -g -ffreestanding $(WARN)
CFLAGS_HOST := -std=c11 -O2 -g -D_GNU_SOURCE $(WARN)
LIBS_SIM := -lassimp -lmeshoptimizer -lpng -lm
LIBS_TEST := -lcmocka
ifeq ($(VARIANT),asan)
CFLAGS_CORE += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
CFLAGS_HOST += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
LDFLAGS += -fsanitize=address,undefined
endif
ifeq ($(VARIANT),clang)
CC := clang
endif

CORE_SRC := $(wildcard raster/*.c raster/*/*.c hal/*.c hal/*/*.c) firmware/stream.c
SIM_SRC := $(wildcard sim/*.c sim/*/*.c)
REFERENCE_SRC := $(filter-out tests/reference/selftest.c,$(wildcard tests/reference/*.c))
SUPPORT_SRC := $(wildcard tests/support/*.c)
TEST_SRC := $(wildcard tests/test_*.c)
FUZZ_SRC := $(wildcard tests/fuzz_*.c)

objects = $(patsubst %.c,$(OBJ)/%.o,$(1))
CORE_OBJ := $(call objects,$(CORE_SRC))
SIM_OBJ := $(call objects,$(SIM_SRC))
SIM_LIB_OBJ := $(filter-out $(OBJ)/sim/main.o,$(SIM_OBJ))
TEST_LIB_OBJ := $(call objects,$(REFERENCE_SRC) $(SUPPORT_SRC))
TESTS := $(patsubst tests/%.c,$(OBJ)/%,$(TEST_SRC)) $(OBJ)/test_reference
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

.PHONY: help all demo test test-asan test-clang check bench size format format-check lint clean
help: ## this list
	@grep -hE '^[a-z-]+:.*##' Makefile | sed 's/:.*##/\t/' | expand -t 16

all: $(TUILE) ## build the simulator, build/tuile

$(BUILD)/need/sim: ; $(call need,libassimp-dev libmeshoptimizer-dev libpng-dev,model import + simplification + pictures)
$(BUILD)/need/test: ; $(call need,libcmocka-dev,tests)
$(BUILD)/need/clang: ; $(call need,clang libclang-rt-14-dev,a second compiler)
$(BUILD)/need/bench: ; $(call need,valgrind,instruction counts)
$(BUILD)/need/lint: ; $(call need,clang-tidy cppcheck,static analysis)
$(BUILD)/need/format: ; $(call need,clang-format,formatting)

# ---- objects and programs ------------------------------------------------------------------------------------------
$(CORE_OBJ): $(OBJ)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_CORE) -MMD -MP -c $< -o $@

$(OBJ)/sim/%.o: sim/%.c | $(BUILD)/need/sim
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_HOST) -MMD -MP -c $< -o $@

$(OBJ)/tests/%.o: tests/%.c | $(BUILD)/need/test $(BUILD)/need/sim
	@mkdir -p $(@D)
	$(CC) $(CFLAGS_HOST) -MMD -MP -c $< -o $@

$(TUILE): $(SIM_OBJ) $(CORE_OBJ)
	$(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

$(OBJ)/test_reference: $(OBJ)/tests/reference/selftest.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	$(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -o $@

$(OBJ)/test_%: $(OBJ)/tests/test_%.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	$(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -o $@

$(OBJ)/tests/fuzz_%.o: CFLAGS_HOST += -DFUZZ_DRIVER
$(OBJ)/fuzz_%: $(OBJ)/tests/fuzz_%.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	$(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

.SECONDARY:
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
