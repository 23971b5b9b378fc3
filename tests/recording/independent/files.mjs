// Files and decompression, as @mcap/core wants them.
import wasmLz4 from "@foxglove/wasm-lz4";
import wasmZstd from "@foxglove/wasm-zstd";
import { readFileSync } from "node:fs";

await wasmLz4.isLoaded;
await wasmZstd.isLoaded;

export const decompressHandlers = {
  lz4: (bytes, size) => wasmLz4(bytes, Number(size)),
  zstd: (bytes, size) => wasmZstd.decompress(bytes, Number(size)),
};

export const compressZstd = (bytes) => wasmZstd.compress(bytes);

export function readable(path) {
  const bytes = readFileSync(path);
  return {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  };
}
