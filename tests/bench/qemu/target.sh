# Shared by the scripts of this folder. target NAME: sets prefix, flags, start, flash, ram and qemu of an emulated processor, cortex-m0plus,
# cortex-m3, cortex-m4, cortex-m33 or rv32imac.
target() {
    case $1 in
    rv32imac)
        prefix=riscv64-unknown-elf- start=start_riscv.S flash=0x80000000 ram=0x81000000
        flags="-march=rv32imac -mabi=ilp32 -mcmodel=medany" qemu="qemu-system-riscv32 -M virt -bios none" ;;
    cortex-m0plus | cortex-m3 | cortex-m4 | cortex-m33)
        prefix=arm-none-eabi- start=start_arm.S flash=0 ram=0x21000000
        flags="-mcpu=$1 -mthumb -mfloat-abi=soft" cpu=$1 board=mps2-an385
        case $1 in
        cortex-m0plus) cpu=cortex-m3 ;; # whose instructions are among those of the M3: no board with an M0 has the memory
        cortex-m4) board=mps2-an386 ;;
        cortex-m33) board=mps2-an505 flash=0x10000000 ram=0x80000000 ;;
        esac
        qemu="qemu-system-arm -M $board -cpu $cpu" ;;
    *)
        echo "there is no target $1; there are: cortex-m0plus cortex-m3 cortex-m4 cortex-m33 rv32imac" >&2
        return 1 ;;
    esac
    flags="$flags -std=c11 -O2 -g -ffreestanding -ffunction-sections -fdata-sections"
}
