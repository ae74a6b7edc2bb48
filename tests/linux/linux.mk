# A Linux board: Debian's own arm64 kernel in QEMU, with a panel on an SPI bus and USB devices on a virtual controller. Included by the Makefile.

LINUX := $(BUILD)/linux
SYSROOT := $(LINUX)/sysroot/done-$(shell echo $(SIM_PACKAGES) | cksum | cut -d ' ' -f 1)
GUEST := $(LINUX)/guest/board.dtb
GUEST_MODULES := spi-gpio virtio_mmio 9pnet_virtio 9p vhci-hcd
APT_ARM64 := sh tests/linux/apt.sh $(LINUX)/apt

$(BUILD)/need/linux: ; $(call need,qemu-system-arm gcc-aarch64-linux-gnu device-tree-compiler cpio kmod libelf1,a Linux board in QEMU and a compiler for it)

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

$(GUEST): $(LINUX)/kernel/done $(LINUX)/busybox/bin/busybox tests/linux/make_guest.sh tests/linux/modules.sh \
          tests/linux/init tests/linux/board.dts $(BUILD)/need/linux
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
LINUX_LIB_OBJ := $(call objects,$(LINUX_LIB_SRC))
LINUX_TOOLS := $(addprefix $(OBJ)/linux/,panel_trace usb_device drm_pattern)
LINUX_TESTS := $(addprefix $(OBJ)/linux/,test_linux test_gud_kernel)
$(LINUX_TOOLS): $(OBJ)/linux/%: $(OBJ)/tests/linux/%.o $(LINUX_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@mkdir -p $(@D)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) -o $@
$(LINUX_TESTS): $(OBJ)/linux/%: $(OBJ)/tests/linux/%.o $(OBJ)/tests/linux/guest.o $(TEST_LIB_OBJ) $(SIM_LIB_OBJ) $(CORE_OBJ)
	@mkdir -p $(@D)
	@echo "  link $@"; $(CC) $(LDFLAGS) $^ $(LIBS_SIM) $(LIBS_TEST) -o $@

# Goals of VARIANT=arm64.
LINUX_PROGRAMS := $(TUILE) $(OBJ)/linux/usb_device $(OBJ)/linux/drm_pattern
.PHONY: linux-share test-linux test-gud-kernel
linux-share: $(LINUX_PROGRAMS)
	@mkdir -p $(LINUX)/share/bin $(LINUX)/share/models
	@cp tests/models/room.* tests/models/beams.* $(LINUX)/share/models/
	@cp $^ $(LINUX)/share/bin/
	@sh tests/linux/libraries.sh $(dir $(SYSROOT)) $(LINUX)/share/lib $^

# The panels that tests/linux/run_linux drives one after the other.
LINUX_SESSIONS := st7735-80x160 ssd1306-128x64 ili9341 st7735-80x160 st7735-80x160
test-linux: $(GUEST) $(TUILE) $(OBJ)/linux/panel_trace $(OBJ)/linux/test_linux ## a panel and USB displays under Debian's own kernel, in QEMU
	@$(MAKE) --no-print-directory linux-share VARIANT=arm64
	@sh tests/linux/run.sh $(LINUX) tests/linux/run_linux 250 $(OBJ)/linux/panel_trace $(LINUX_SESSIONS)
	@TUILE=$(TUILE) BUILD=$(BUILD) $(OBJ)/linux/test_linux

# The kernel's own driver of GUD displays against the model of one.
$(LINUX)/kernel-source/done: $(LINUX)/kernel/done tests/linux/apt.sh
	@echo "Fetching the kernel's headers and source (unpacked under $(@D), not installed)"
	@version=$$(ls $(LINUX)/kernel/lib/modules) && $(APT_ARM64) alone $(@D) linux-headers-$$version linux-headers-$${version%-arm64}-common linux-source-6.1
	@ARCHITECTURE=$$(dpkg --print-architecture) sh tests/linux/apt.sh $(LINUX)/apt-tools alone $(@D) linux-kbuild-6.1
	@touch $@

$(LINUX)/gud/gud.ko: $(LINUX)/kernel-source/done tests/linux/make_gud.sh $(BUILD)/need/linux
	@sh tests/linux/make_gud.sh $(LINUX)/kernel $(<D) $(@D)

test-gud-kernel: $(GUEST) $(LINUX)/gud/gud.ko $(OBJ)/linux/test_gud_kernel ## the kernel's own GUD driver draws on the model of such a display
	@$(MAKE) --no-print-directory linux-share VARIANT=arm64
	@sh tests/linux/modules.sh $(LINUX)/kernel $(LINUX)/share/modules $(LINUX)/gud/gud.ko
	@sh tests/linux/run.sh $(LINUX) tests/linux/run_gud_kernel 200
	@BUILD=$(BUILD) $(OBJ)/linux/test_gud_kernel
