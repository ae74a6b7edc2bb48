# Boards in emulators. Included by the Makefile.

$(OBJ)/wire_trace: $(OBJ)/tests/emulators/wire_trace.o $(SIM_LIB_OBJ) $(CORE_OBJ)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@
