# How fast microcontrollers would be: instructions of events, fitted to counted ones. Included by the Makefile.

$(OBJ)/predict_events: $(OBJ)/tests/predict/events.o $(OBJ)/tests/bench/turntable.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@

PREDICT_CORES := cortex-m0plus cortex-m4 rv32imac
PREDICT = $(PYTHON) tests/predict/costs.py $(1) $(BENCH_COMMON) --events $(OBJ)/predict_events
PREDICT_NEEDS := $(OBJ)/predict_events $(call bench_needs,spider bunny sphere house)

.PHONY: predict-costs predict-costs-uno predict-check predict-check-pico predict-check-uno predict-cycles
predict-costs: $(PREDICT_NEEDS) ## counts frames by QEMU and writes sim/predict_costs.c, what predictions of pace are made from
	@$(call make_guests,$(PREDICT_CORES))
	@$(call PREDICT,fit)

predict-check: $(PREDICT_NEEDS) predict-check-pico predict-check-uno ## the same table held against frames that it was not fitted to, and against the emulated Pico's and Uno's
	@$(call make_guests,$(PREDICT_CORES))
	@$(call PREDICT,check)

predict-cycles: $(PREDICT_NEEDS) ## cycles of counted instructions by the cores' reference manuals, for sim/mcu.c
	@$(call make_guests,$(PREDICT_CORES))
	@$(call PREDICT,cycles)

predict-check-pico: $(TUILE) $(pico_FOLDER)/frames.elf firmware-models $(RP2040JS)
	@$(PYTHON) tests/predict/pico.py $(TUILE) $(FIRMWARE)/models $(EMULATE_RP2040) --program $(pico_FOLDER)/frames.elf

PREDICT_UNO = @mkdir -p $(BENCH_OUT)/uno && $(PYTHON) tests/predict/uno.py $(1) $(TUILE) $(OBJ)/predict_events $(FIRMWARE)/models \
  $(OBJ)/uno show $(UNO)/frames.bin $(FIRMWARE)/models $(BENCH_OUT)/uno
PREDICT_UNO_NEEDS := $(TUILE) $(OBJ)/predict_events $(OBJ)/uno $(UNO)/frames.elf firmware-models
predict-costs-uno: $(PREDICT_UNO_NEEDS) ## the same for the ATmega328P, by simavr: writes sim/predict_costs_uno.c
	$(call PREDICT_UNO,fit)

predict-check-uno: $(PREDICT_UNO_NEEDS)
	$(call PREDICT_UNO,check)
