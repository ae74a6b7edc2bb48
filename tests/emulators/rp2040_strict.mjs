// What an RP2040 would not do, though its emulator does: each rule throws a Violation that says which was broken.
//
// Numbers in brackets are sections of the RP2040's data sheet.

export class Violation extends Error {}

export function refuse(message) { throw new Violation(message); }

const RESETS_BASE = 0x4000c000;
const WATCHDOG_TICK = 0x4005802c;
const SPI_DR = 0x08;
const SPI_CPSR = 0x10;
const TXDMAE = 2;

// Bits of RESETS by the first address of what they hold in reset (2.14.3).
const RESET_BITS = new Map([
  [0x40000000, [19, 'SYSINFO']], [0x40004000, [18, 'SYSCFG']], [0x40014000, [5, 'IO_BANK0']], [0x40018000, [6, 'IO_QSPI']],
  [0x4001c000, [8, 'PADS_BANK0']], [0x40020000, [9, 'PADS_QSPI']], [0x40028000, [12, 'PLL_SYS']], [0x4002c000, [13, 'PLL_USB']],
  [0x40030000, [1, 'BUSCTRL']], [0x40034000, [22, 'UART0']], [0x40038000, [23, 'UART1']], [0x4003c000, [16, 'SPI0']],
  [0x40040000, [17, 'SPI1']], [0x40044000, [3, 'I2C0']], [0x40048000, [4, 'I2C1']], [0x4004c000, [0, 'ADC']],
  [0x40050000, [14, 'PWM']], [0x40054000, [21, 'TIMER']], [0x4005c000, [15, 'RTC']], [0x4006c000, [20, 'TBMAN']],
  [0x50000000, [2, 'DMA']], [0x50100000, [24, 'USBCTRL']], [0x50110000, [24, 'USBCTRL']], [0x50200000, [10, 'PIO0']],
  [0x50300000, [11, 'PIO1']],
]);
const IN_RESET_AT_START = 0x1ffffff & ~(1 << 6 | 1 << 9); // the boot ROM reads flash, so its pads are awake
const TIMER = 0x40054000;

const hex = (n) => `0x${(n >>> 0).toString(16)}`;

/** Puts the rules round an emulated chip. Returns where the DMA's state can be asked for. */
export function beStrict(rp) {
  const resets = rp.peripherals[0x4000c];
  const read = { 1: rp.readUint8.bind(rp), 2: rp.readUint16.bind(rp), 4: rp.readUint32.bind(rp) };
  const write = { 1: rp.writeUint8.bind(rp), 2: rp.writeUint16.bind(rp), 4: rp.writeUint32.bind(rp) };
  const sram = rp.sramView;
  const state = { dma: false, ticking: false, prescaler: 0 };

  resets.reset = IN_RESET_AT_START;
  resets.readUint32 = function (offset) {
    return offset === 8 ? ~this.reset & 0x1ffffff : Object.getPrototypeOf(this).readUint32.call(this, offset);
  };
  for (const level of ['debug', 'info']) { rp.logger[level] = () => {}; }
  for (const level of ['warn', 'error']) {
    rp.logger[level] = (part, message) => refuse(`emulator: ${part}: ${message}, at ${hex(rp.core.PC)}`);
  }

  const where = () => (state.dma ? 'by DMA' : `at ${hex(rp.core.PC)}`);
  const check = (address, size, writes) => {
    if (address & (size - 1)) { refuse(`unaligned: ${size} bytes at ${hex(address)}, ${where()}`); }
    if (address < 0x4000 && writes) { refuse(`a write to the boot ROM: ${hex(address)}, ${where()}`); }
    if (address >= 0x10000000 && address < 0x18000000 && writes) { refuse(`a write to flash: ${hex(address)}, ${where()}`); }
    if (address < 0x40000000 || address >= 0x60000000) { return; }
    const [bit, name] = RESET_BITS.get((address & 0xffffc000) >>> 0) ?? [];
    if (bit !== undefined && resets.reset >>> bit & 1) { refuse(`${name} is in reset, but ${hex(address)} is used, ${where()}`); }
    // Writes of bytes and half-words appear on the whole word (2.1.4).
    if (size < 4 && writes && !state.dma) { refuse(`a register written in ${size} bytes: ${hex(address)}, ${where()}`); }
    if (((address & 0xffffc000) >>> 0) === TIMER && !state.ticking) {
      refuse(`the timer is used, but nothing ticks (4.7.2): ${hex(address)}, ${where()}`);
    }
    if (writes && (address & ~0x3000) >>> 0 === WATCHDOG_TICK) { state.ticking = true; }
  };
  // RAM and flash first: nearly all accesses are to them.
  const inRam = (address) => address >= 0x20000000 && address < 0x20042000;
  rp.readUint32 = (at) => {
    const address = at >>> 0;
    if (inRam(address) && !(address & 3)) { return sram.getUint32(address - 0x20000000, true); }
    check(address, 4, false);
    return read[4](address);
  };
  rp.readUint16 = (at) => {
    const address = at >>> 0;
    if (address & 1) { check(address, 2, false); }
    if (inRam(address)) { return sram.getUint16(address - 0x20000000, true); }
    if (address >= 0x40000000) { check(address, 2, false); }
    return read[2](address);
  };
  rp.readUint8 = (at) => {
    const address = at >>> 0;
    if (address >= 0x40000000) { check(address, 1, false); }
    return read[1](address);
  };
  for (const size of [1, 2, 4]) {
    const put = write[size];
    rp[`writeUint${8 * size}`] = (at, value) => {
      const address = at >>> 0;
      if (!inRam(address) || address & (size - 1)) { check(address, size, true); }
      put(address, value);
    };
  }
  for (const channel of rp.dma.channels) {
    const alarm = channel.transferAlarm;
    const transfer = alarm.callback;
    alarm.callback = () => {
      state.dma = true;
      try { transfer(); } finally { state.dma = false; }
    };
  }

  const spi = rp.spi[0];
  const writeSpi = spi.writeUint32.bind(spi);
  spi.writeUint32 = (offset, value) => {
    if (offset === SPI_CPSR) { state.prescaler = value; }
    if (offset === SPI_DR && state.dma && !(spi.dmaControl & TXDMAE)) {
      refuse('DMA writes to SPI0, but its requests are off (SSPDMACR.TXDMAE): an RP2040 would never start');
    }
    if (offset === SPI_DR && spi.txFIFO.full) { refuse(`a byte for SPI0 is lost: its transmit FIFO is full, ${where()}`); }
    if ((offset === 0 || offset === SPI_CPSR) && (spi.busy || !spi.txFIFO.empty)) { refuse('SPI0 changes its clock in mid-frame'); }
    writeSpi(offset, value);
  };
  return state;
}

/** What must hold when a frame begins on SPI0. pins: { clock, data } */
export function checkFrame(rp, state, pins) {
  const spi = rp.spi[0];
  if ((spi.control1 & 6) !== 2) { refuse('a frame on SPI0, which is off or no master (SSPCR1)'); }
  if (state.prescaler < 2 || state.prescaler > 254 || state.prescaler & 1) {
    refuse(`SSPCPSR is ${state.prescaler}: it is to be even, 2 to 254 (4.4.4)`);
  }
  if (!(rp.clocks.periFreq > 0)) { refuse('a frame on SPI0 while clk_peri stands still'); }
  for (const [name, pin] of Object.entries(pins)) {
    const { functionSelect, outputDisable } = rp.gpio[pin];
    if (functionSelect !== 1) { refuse(`a frame on SPI0, but GPIO ${pin}, its ${name}, has the function ${functionSelect}, not SPI`); }
    if (outputDisable) { refuse(`GPIO ${pin}, the ${name} of SPI0, does not drive`); }
  }
}
