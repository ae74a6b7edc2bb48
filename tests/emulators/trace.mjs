// Writes what a panel's wires did, for trace.c to read: trace.h has the format.
import { openSync, writeSync, closeSync } from 'node:fs';

const KIND = { bytes: 1, reset: 2, light: 3, text: 4, frame: 5 };
const FLUSH_BYTES = 1 << 20;

export class Trace {
  constructor(path) {
    this.file = path ? openSync(path, 'w') : null;
    this.parts = [];
    this.waiting = 0;
    this.run = null; // bytes of one level of D/C, of one transaction
  }

  put(kind, flag, time, payload) {
    if (!this.file) { return; }
    const head = Buffer.alloc(16);
    head.writeUInt8(kind, 0);
    head.writeUInt8(flag, 1);
    head.writeUInt32LE(payload.length, 4);
    head.writeBigUInt64LE(BigInt(Math.round(time)), 8);
    this.parts.push(head, payload);
    this.waiting += payload.length + 16;
    if (this.waiting > FLUSH_BYTES) { this.flush(); }
  }

  flush() {
    writeSync(this.file, Buffer.concat(this.parts));
    this.parts = [];
    this.waiting = 0;
  }

  /** A byte went out, whose first bit began at a time. */
  byte(value, data, clock, time) {
    if (this.run && (this.run.data !== data || this.run.clock !== clock)) { this.endRun(); }
    if (!this.run) { this.run = { data, clock, time, bytes: [] }; }
    this.run.bytes.push(value);
  }

  /** The transaction is over. */
  endRun() {
    if (!this.run) { return; }
    const { data, clock, time, bytes } = this.run;
    const rate = Buffer.alloc(4);
    rate.writeUInt32LE(Math.floor(clock));
    this.run = null;
    this.put(KIND.bytes, data, time, Buffer.concat([rate, Buffer.from(bytes)]));
  }

  reset(level, time) { this.mark(KIND.reset, level, time); }
  light(level, time) { this.mark(KIND.light, level, time); }
  frame(begins, time) { this.mark(KIND.frame, begins, time); }
  text(line, time) {
    this.endRun();
    this.put(KIND.text, 0, time, Buffer.from(line, 'latin1'));
  }

  mark(kind, flag, time) {
    this.endRun();
    this.put(kind, flag, time, Buffer.alloc(0));
  }

  close() {
    if (!this.file) { return; }
    this.endRun();
    this.flush();
    closeSync(this.file);
    this.file = null;
  }
}
