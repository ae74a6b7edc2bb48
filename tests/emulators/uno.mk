# The Arduino Uno in simavr.

$(BUILD)/need/simavr: ; $(call need,libsimavr-dev libelf-dev,an emulator of AVR)
$(OBJ)/tests/emulators/uno.o: CFLAGS_HOST += -isystem /usr/include/simavr
$(OBJ)/tests/emulators/uno.o: | $(BUILD)/need/simavr
$(OBJ)/uno: $(OBJ)/tests/emulators/uno.o $(OBJ)/tests/emulators/uno_demo.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -lsimavr -lelf -o $@

.PHONY: size-firmware-uno test-firmware-uno emulate-uno
size-firmware: size-firmware-uno
size-firmware-uno: $(UNO_ELF)
	@for p in $(FIRMWARE_PROGRAMS); do echo "uno $$p, bytes:"; \
	  $(PYTHON) $(EMULATORS)/image.py $(UNO)/$$p.elf $(UNO)/$$p.map --tools avr- --budget firmware/uno/budget || exit 1; done

test-firmware: test-firmware-uno
test-firmware-uno: $(OBJ)/uno $(UNO_ELF) size-firmware-uno
	@$(OBJ)/uno test $(UNO)/frames.bin $(FIRMWARE)/models
	@$(OBJ)/uno demo $(UNO)/demo.bin $(FIRMWARE)/models
	@sh $(EMULATORS)/uno_mutants.sh $(OBJ)/uno $(UNO) $(FIRMWARE)/models $(UNO)/mutants $(UNO_FLAGS)

emulate-uno: $(OBJ)/uno $(UNO)/frames.elf ## runs the Uno in simavr: frames as PNG, cycles of each
	@mkdir -p $(UNO)/frames && $(OBJ)/uno show $(UNO)/frames.bin $(FIRMWARE)/models $(UNO)/frames
