// Runs a WebAssembly module that imports `write` from `host` and exports `_start`.
import { readFileSync, writeSync } from 'node:fs';

const host = {
  write: (start, len) => writeSync(1, new Uint8Array(instance.exports.memory.buffer, start, len)),
};
const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { host });
instance.exports._start();
