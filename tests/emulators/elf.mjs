// What a run needs of an ELF file: what is loaded where, and where symbols are. 32 bits, little-endian.

const PT_LOAD = 1;
const SHT_SYMTAB = 2;

/** Calls load(address, bytes) for each segment with contents, at its load address. */
export function loadElf(file, load) {
  const at = file.readUInt32LE(28);
  const size = file.readUInt16LE(42);
  for (let i = 0; i < file.readUInt16LE(44); i++) {
    const header = at + i * size;
    const [type, offset, , address, bytes] = [0, 4, 8, 12, 16].map((o) => file.readUInt32LE(header + o));
    if (type === PT_LOAD && bytes > 0) { load(address, file.subarray(offset, offset + bytes)); }
  }
}

/** The address of a symbol, without the bit that says Thumb; throws when there is none. */
export function findSymbol(file, name) {
  const at = file.readUInt32LE(32);
  const size = file.readUInt16LE(46);
  const field = (section, o) => file.readUInt32LE(at + section * size + o);
  for (let section = 0; section < file.readUInt16LE(48); section++) {
    if (field(section, 4) !== SHT_SYMTAB) { continue; }
    const names = field(field(section, 24), 16);
    const first = field(section, 16);
    for (let symbol = first; symbol < first + field(section, 20); symbol += 16) {
      const start = names + file.readUInt32LE(symbol);
      if (file.toString('latin1', start, file.indexOf(0, start)) === name) { return file.readUInt32LE(symbol + 4) & ~1; }
    }
  }
  throw new Error(`the program has no ${name}`);
}
