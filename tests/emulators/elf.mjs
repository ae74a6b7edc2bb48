// What a run needs of a program's files. ELF: what is loaded where, and where symbols are; 32 bits, little-endian. UF2: what goes where.

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

/** Calls load(address, bytes) for each block of a UF2 file; throws where the boot ROM would ignore one, or wait for more. */
export function loadUf2(file, family, load) {
  const count = file.length / 512;
  for (let block = 0; block < count; block++) {
    const [first, second, flags, address, size, number, blocks, of] = [0, 4, 8, 12, 16, 20, 24, 28].map((o) => file.readUInt32LE(512 * block + o));
    if (first !== 0x0a324655 || second !== 0x9e5d5157 || file.readUInt32LE(512 * block + 508) !== 0x0ab16f30) {
      throw new Error(`block ${block} of the UF2 file has not its magic numbers`);
    }
    if (flags !== 0x2000 || of !== family || size !== 256 || address % 256 || number !== block || blocks !== count) {
      throw new Error(`block ${block} of the UF2 file would not be taken`);
    }
    load(address, file.subarray(512 * block + 32, 512 * block + 32 + size));
  }
}
