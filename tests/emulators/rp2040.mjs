// Runs a program on an emulated RP2040 and writes down what its panel's wires did.
//
// node rp2040.mjs --modules FOLDER --program FILE.elf [--flash FILE.uf2] [--trace FILE] [--options TEXT] [--press AT:MS,...] [--seconds N] [--quiet]
//
// FOLDER: where npm has put rp2040js. FILE.uf2: what goes into flash, in the place of the program's segments. --seconds: of this machine's processor, 300 by default. --press: at AT ms of the
// board's time the button is held for MS, and its contact bounces. The program's lines are printed with their times, and
// for each frame how long it took, the part of it that the core slept, and that of its bits on the wire. Exit code 0 when the program
// parked with 0; else 1 and one line on stderr that begins with the reason.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { loadElf, loadUf2, findSymbol } from './elf.mjs';
import { Trace } from './trace.mjs';
import { Violation, beStrict, checkFrame, refuse } from './rp2040_strict.mjs';

const PINS = { dc: 16, select: 17, clock: 18, data: 19, light: 20, reset: 21, button: 15 }; // firmware/rp2/port.h, board.c
const HIGH = 1;
const LOW = 0;
const FLASH = 0x10000000;
const RP2040_FAMILY = 0xe48bff56;
const OPTIONS_AT = 0x1ff000;
const PARK = 1; // of BKPT; the code is in r0
const HARD_FAULT = 3;
const FUNCTION_PWM = 4;

const { values: args } = parseArgs({
  options: {
    modules: { type: 'string' }, program: { type: 'string' }, flash: { type: 'string' }, trace: { type: 'string' }, options: { type: 'string' }, press: { type: 'string', default: '' },
    seconds: { type: 'string', default: '300' }, quiet: { type: 'boolean', default: false },
  },
});
const { RP2040 } = createRequire(resolve(args.modules, 'x.js'))('rp2040js');

const rp = new RP2040();
const { core, clock } = rp;
const spi = rp.spi[0];
const trace = new Trace(args.trace);
const strict = beStrict(rp);
const elf = readFileSync(args.program);
const lines = [];
let parked = null;

if (args.flash) {
  loadUf2(readFileSync(args.flash), RP2040_FAMILY, (address, bytes) => rp.flash.set(bytes, address - FLASH));
} else {
  loadElf(elf, (address, bytes) => rp.flash.set(bytes, address - FLASH));
}
if (args.options) { rp.flash.set(Buffer.from(`${args.options}\0`, 'latin1'), OPTIONS_AT); }

// ---- the wires ----
const level = (pin) => rp.gpio[pin].value;
const bits = { sum: 0 };
let frame = null; // on the wire
const frameEnds = clock.createAlarm(() => {
  const { value, dc, start, width, rate } = frame;
  if (level(PINS.select) !== LOW) { refuse('a frame ends while the panel is not selected'); }
  if (level(PINS.dc) !== dc || (dc !== LOW && dc !== HIGH)) { refuse('D/C moves, or is not driven, during a frame'); }
  frame = null;
  bits.sum += width / rate;
  if (width === 16) { trace.byte(value >>> 8, dc, rate, start); }
  trace.byte(value & 0xff, dc, rate, start);
  spi.completeTransmit(0xff);
});
spi.onTransmit = (value) => {
  checkFrame(rp, strict, { clock: PINS.clock, data: PINS.data });
  if (spi.dataBits !== 8 && spi.dataBits !== 16) { refuse(`frames of ${spi.dataBits} bits`); }
  if (level(PINS.select) !== LOW) { refuse('a frame begins while the panel is not selected'); }
  frame = { value, dc: level(PINS.dc), start: clock.nanos, width: spi.dataBits, rate: spi.clockFrequency };
  frameEnds.schedule(spi.dataBits * 1e9 / spi.clockFrequency);
};
rp.gpio[PINS.dc].addListener(() => {
  if (spi.busy || !spi.txFIFO.empty) { refuse('D/C moves while SPI0 is busy'); }
});
rp.gpio[PINS.select].addListener((now) => {
  if (spi.busy || !spi.txFIFO.empty) { refuse('the chip select moves while SPI0 is busy'); }
  if (now !== HIGH) { return; }
  if (!spi.rxFIFO.empty) { refuse('the receive FIFO of SPI0 was not drained'); }
  trace.endRun();
});
rp.gpio[PINS.reset].addListener((now) => {
  if (now === HIGH || now === LOW) { trace.reset(now, clock.nanos); }
});

// The backlight, as the PWM slice of its pin is set.
const slice = rp.pwm.channels[PINS.light / 2 % 8];
const writeSlice = slice.writeRegister.bind(slice);
let shining = 0;
slice.writeRegister = (offset, value) => {
  writeSlice(offset, value);
  const on = slice.csr & 1 && rp.gpio[PINS.light].functionSelect === FUNCTION_PWM;
  const now = on ? Math.min(255, Math.round((slice.cc & 0xffff) * 255 / (slice.top + 1))) : 0;
  if (now !== shining) { trace.light(shining = now, clock.nanos); }
};

// The button, between its pin and ground: open, the level is that of a pull-up, if there is one.
let closed = false;
Object.defineProperty(rp.gpio[PINS.button], 'rawInputValue', { get: () => !closed && rp.gpio[PINS.button].pullupEnabled, set: () => {} });
const BOUNCES_MS = [0, 0.3, 0.5, 1.9, 2.0, 5, 5.1]; // each turns the contact over, the last one for good
for (const [at, length] of args.press.split(',').filter(Boolean).map((text) => text.split(':').map(Number))) {
  for (const [start, last] of [[at, true], [at + length, false]]) {
    BOUNCES_MS.forEach((offset, i) => clock.createAlarm(() => { closed = i % 2 ? !last : last; }).schedule((start + offset) * 1e6));
  }
}

// ---- what the program tells ----
let told = '';
rp.uart[0].onByte = (byte) => {
  if (byte !== 10) {
    told += String.fromCharCode(byte);
    return;
  }
  lines.push(told);
  trace.text(told, clock.nanos);
  if (!args.quiet) { console.log(`${told}${shownTimes()} at ${(clock.nanos / 1e6).toFixed(3)}`); }
  told = '';
};

const begins = findSymbol(elf, 'frame_begins');
const ends = findSymbol(elf, 'frame_ends');
const times = { start: 0, asleep: 0, bits: 0, last: null };
let asleep = 0;
function mark(pc) {
  const now = clock.nanos;
  if (pc === begins) {
    Object.assign(times, { start: now, asleep, bits: bits.sum });
  } else {
    times.last = { all: now - times.start, asleep: asleep - times.asleep, wire: (bits.sum - times.bits) * 1e9 };
  }
  trace.frame(pc === begins ? 1 : 0, now);
}
function shownTimes() {
  if (!times.last) { return ''; }
  const { all, asleep: slept, wire } = times.last;
  times.last = null;
  const ms = (ns) => (ns / 1e6).toFixed(3);
  return ` ms ${ms(all)} asleep ${ms(slept)} wire ${ms(wire)} cycles ${Math.round(all * rp.clkSys / 1e9)}`;
}

// ---- the core ----
rp.onBreak = (code) => {
  const at = (core.PC - 2) & ~1;
  if (rp.readUint16(at) >>> 8 === 0xde) { // UDF: the emulator has no faults of its own
    core.PC = at;
    core.exceptionEntry(HARD_FAULT);
  } else if (code === PARK) {
    parked = core.registers[0];
  } else {
    refuse(`BKPT ${code} at 0x${at.toString(16)}`);
  }
};

const busySeconds = () => (process.cpuUsage().user + process.cpuUsage().system) / 1e6;

function run(seconds) {
  core.PC = FLASH;
  for (let i = 1; parked === null; i++) {
    if (core.waiting) {
      if (core.pendingInterrupts & core.enabledInterrupts) { // WFI ends for what waits already, let in or not
        core.waiting = false;
        continue;
      }
      const next = clock.nextAlarm;
      if (!next) { refuse('the core sleeps, and nothing will wake it'); }
      asleep += next.nanos - clock.nanos;
      clock.tick(next.nanos - clock.nanos);
    } else {
      const pc = core.PC;
      if (pc === begins || pc === ends) { mark(pc); }
      const nanos = core.executeInstruction() * 1e9 / rp.clkSys;
      // tick, but without its call where nothing is due
      if (clock.nextAlarm && clock.nextAlarm.nanos <= clock.nanosCounter + nanos) {
        clock.tick(nanos);
      } else {
        clock.nanosCounter += nanos;
      }
    }
    if (!(i & 0xfffff) && busySeconds() > seconds) { refuse(`not done after ${seconds} s`); }
  }
}

let reason = null;
try {
  run(Number(args.seconds));
  if (parked !== 0) { reason = `the program parked with ${parked}`; }
} catch (error) {
  if (!(error instanceof Violation)) { throw error; }
  reason = error.message;
}
trace.close();
if (reason) {
  console.error(`rp2040: ${reason}; after ${(clock.nanos / 1e6).toFixed(3)} ms; last told: ${lines.slice(-3).join(' | ') || 'nothing'}`);
  process.exit(1);
}
