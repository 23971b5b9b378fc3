// Writes files with each of the ways that @mcap/core has.
//   node write.mjs FOLDER
// Every file has the messages 0, 1, 2, … of two topics, their number as JSON, whose log times are not in order.
import { McapWriter, TempBuffer } from "@mcap/core";
import lz4 from "lz4js";
import { writeFileSync } from "node:fs";
import { compressZstd } from "./files.mjs";

const folder = process.argv[2];
const kMessages = 1000;

const compressions = {
  none: undefined,
  lz4: (bytes) => ({ compression: "lz4", compressedData: lz4.compress(bytes) }),
  zstd: (bytes) => ({ compression: "zstd", compressedData: compressZstd(bytes) }),
};
const layouts = {
  indexed: {},
  unindexed: { useMessageIndex: false, useChunkIndex: false },
  bare: {
    useMessageIndex: false, useChunkIndex: false, useStatistics: false, useSummaryOffsets: false,
    repeatSchemas: false, repeatChannels: false,
  },
  unchunked: { useChunks: false },
};

async function write(name, options) {
  const file = new TempBuffer();
  const writer = new McapWriter({ writable: file, chunkSize: 3000, ...options });
  await writer.start({ profile: "test", library: "another" });
  const schemaId = await writer.registerSchema({
    name: "number", encoding: "jsonschema", data: new TextEncoder().encode('{"type": "number"}'),
  });
  const channels = [];
  for (const [topic, schema] of [["even", schemaId], ["odd", 0]])
    channels.push(await writer.registerChannel({
      topic, schemaId: schema, messageEncoding: "json", metadata: new Map([["key", "value"]]),
    }));
  for (let i = 0; i < kMessages; ++i) {
    if (i === kMessages / 2) {
      await writer.addAttachment({
        name: "a", logTime: 0n, createTime: 0n, mediaType: "text/plain", data: new Uint8Array(10_000),
      });
      await writer.addMetadata({ name: "m", metadata: new Map([["key", "value"]]) });
    }
    await writer.addMessage({
      channelId: channels[i % 2], sequence: i, publishTime: BigInt(i),
      logTime: BigInt(1_000_000 + i + (i % 10 === 0 ? 300 : 0)), // every tenth comes early
      data: new TextEncoder().encode(String(i)),
    });
  }
  await writer.end();
  writeFileSync(`${folder}/${name}.mcap`, file.get());
}

for (const [compression, compressChunk] of Object.entries(compressions))
  for (const [layout, options] of Object.entries(layouts))
    if (layout !== "unchunked" || compression === "none")
      await write(`${layout}_${compression}`, { ...options, compressChunk });
