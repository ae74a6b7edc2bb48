# A Linux board: Debian's own arm64 kernel in QEMU, with a panel on an SPI bus and USB devices on a virtual controller. Included by the Makefile.

LINUX := $(BUILD)/linux
SYSROOT := $(LINUX)/sysroot/done-$(shell echo $(SIM_PACKAGES) | cksum | cut -d ' ' -f 1)
GUEST := $(LINUX)/guest/board.dtb
GUEST_MODULES := spi-gpio virtio_mmio 9pnet_virtio 9p vhci-hcd
APT_ARM64 := sh tests/linux/apt.sh $(LINUX)/apt

$(BUILD)/need/linux: ; $(call need,qemu-system-arm gcc-aarch64-linux-gnu device-tree-compiler cpio kmod,a Linux board in QEMU and a compiler for it)

$(SYSROOT): tests/linux/apt.sh
	@echo "Fetching arm64 libraries for the guest (unpacked under $(@D), not installed)"
	@rm -rf $(@D) $(LINUX)/share/lib
	@$(APT_ARM64) whole $(@D) $(SIM_PACKAGES)
	@touch $@

$(LINUX)/kernel/done:
	@echo "Fetching Debian's arm64 kernel for the guest (unpacked under $(@D), not installed)"
	@$(APT_ARM64) alone $(@D) linux-image-arm64
	@touch $@

$(LINUX)/busybox/bin/busybox:
	@$(APT_ARM64) alone $(LINUX)/busybox busybox-static
	@touch $@

$(GUEST): $(LINUX)/kernel/done $(LINUX)/busybox/bin/busybox tests/linux/make_guest.sh tests/linux/init tests/linux/board.dts $(BUILD)/need/linux
	@sh tests/linux/make_guest.sh $(LINUX)/kernel $(LINUX)/busybox $(@D) $(GUEST_MODULES)

# What is built for the guest: VARIANT=arm64.
ifeq ($(VARIANT),arm64)
CC := aarch64-linux-gnu-gcc
CFLAGS_CORE += --sysroot=$(abspath $(dir $(SYSROOT)))
CFLAGS_HOST += --sysroot=$(abspath $(dir $(SYSROOT)))
LDFLAGS += --sysroot=$(abspath $(dir $(SYSROOT)))
$(CORE_OBJ) $(SIM_OBJ): | $(SYSROOT) $(BUILD)/need/linux
endif

# ---- programs ----
$(OBJ)/linux/panel_trace: $(OBJ)/tests/linux/panel_trace.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
$(OBJ)/linux/spi_picture: $(OBJ)/tests/linux/spi_picture.o $(SIM_LIB_OBJ) $(CORE_OBJ)
$(OBJ)/linux/test_linux: $(OBJ)/tests/linux/test_linux.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
$(OBJ)/linux/%:
	@mkdir -p $(@D)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_LINUX) -o $@
$(OBJ)/linux/panel_trace $(OBJ)/linux/test_linux: LIBS_LINUX := $(LIBS_TEST)

.PHONY: test-linux linux-share
linux-share: $(TUILE) $(OBJ)/linux/spi_picture # with VARIANT=arm64
	@mkdir -p $(LINUX)/share/bin $(LINUX)/share/models
	@cp tests/models/room.* $(LINUX)/share/models/
	@cp $^ $(LINUX)/share/bin/
	@sh tests/linux/libraries.sh $(dir $(SYSROOT)) $(LINUX)/share/lib $^

test-linux: $(GUEST) $(TUILE) $(OBJ)/linux/panel_trace $(OBJ)/linux/test_linux ## a panel and USB displays under Debian's own kernel, in QEMU
	@$(MAKE) --no-print-directory linux-share VARIANT=arm64
	@$(TUILE) render tests/models/room.obj --eye 0,1,3 --at 0,1,0 --shade gouraud --out $(LINUX)/share/sim.ppm
	@sh tests/linux/run.sh $(LINUX) $(OBJ)/linux/panel_trace ili9341 tests/linux/run_linux 100
	@BUILD=$(BUILD) $(OBJ)/linux/test_linux
