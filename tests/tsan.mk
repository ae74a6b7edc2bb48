# Two threads under ThreadSanitizer. Included by the Makefile. VARIANT=tsan has only what tests/test_cores.c is made of.

ifeq ($(VARIANT),tsan)
CFLAGS_CORE += -fsanitize=thread
CFLAGS_HOST += -fsanitize=thread
LDFLAGS += -fsanitize=thread
endif

TSAN_SRC := tests/test_cores.c tests/support/board.c $(wildcard sim/chips/*.c) $(addprefix sim/,bus.c error.c output.c panels.c picture.c)
$(BUILD)/tsan/threads: $(patsubst %.c,$(BUILD)/tsan/%.o,$(TSAN_SRC) $(CORE_SRC))
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -o $@

.PHONY: test-tsan
test-tsan: $(BUNNY_6000) ## what two cores do, by two threads under ThreadSanitizer
	@$(MAKE) --no-print-directory VARIANT=tsan $(BUILD)/tsan/threads
	@BUNNY_6000=$(BUNNY_6000) TSAN_OPTIONS=halt_on_error=1 $(BUILD)/tsan/threads

$(OBJ)/bench-cores: $(OBJ)/tests/bench/cores.o $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ -lpthread -o $@

.PHONY: bench-cores
bench-cores: $(OBJ)/bench-cores firmware-models ## how much faster two cores draw than one
	@$(OBJ)/bench-cores $(FIRMWARE)/models
