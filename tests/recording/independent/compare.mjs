// Reads a recording and compares every field of every message with what was written.
//   node compare.mjs RECORDING EXPECTED
// A line of EXPECTED is a message: topic, type, log_time, publish_time, sequence and message, in file order.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { decompressHandlers, readable } from "./files.mjs";

const [recording, expectedFile] = process.argv.slice(2);
const expected = readFileSync(expectedFile, "utf8").trim().split("\n").map((line) => JSON.parse(line));

/// The value as JSON has it: numbers of 64 bits as text, typed arrays as lists.
function plain(value) {
  if (typeof value === "bigint") return value.toString();
  if (Array.isArray(value) || ArrayBuffer.isView(value)) return Array.from(value, plain);
  if (value !== null && typeof value === "object")
    return Object.fromEntries(Object.entries(value).map(([key, field]) => [key, plain(field)]));
  return value;
}

const decoders = new Map(); // by channel
function decode(channel, schema, data) {
  if (!decoders.has(channel.id)) {
    assert.equal(channel.messageEncoding, "cdr");
    assert.equal(schema.encoding, "omgidl");
    decoders.set(channel.id, new MessageReader(schema.name, parseIDL(new TextDecoder().decode(schema.data))));
  }
  return plain(decoders.get(channel.id).readMessage(data));
}

let fields = 0;
function countFields(value) {
  if (value === null || typeof value !== "object") fields += 1;
  else Object.values(value).forEach(countFields);
}

function check(message, channel, schema, wanted) {
  const read = {
    topic: channel.topic,
    type: schema.name,
    log_time: message.logTime.toString(),
    publish_time: message.publishTime.toString(),
    sequence: message.sequence,
    message: decode(channel, schema, message.data),
  };
  assert.deepEqual(read, wanted);
  countFields(read.message);
}

const byTime = [...expected].sort((a, b) => (BigInt(a.log_time) < BigInt(b.log_time) ? -1 : 1));
const indexed = await McapIndexedReader.Initialize({ readable: readable(recording), decompressHandlers });
assert.equal(indexed.statistics.messageCount, BigInt(expected.length));
assert.equal(indexed.statistics.chunkCount, indexed.chunkIndexes.length);
assert.equal(indexed.statistics.metadataCount, 1);
assert.deepEqual(indexed.metadataIndexes.map((index) => index.name), ["laneloom"]);
assert.ok(indexed.chunkIndexes.length > 1);
let count = 0;
for await (const message of indexed.readMessages({ validateCrcs: true })) {
  const channel = indexed.channelsById.get(message.channelId);
  check(message, channel, indexed.schemasById.get(channel.schemaId), byTime[count++]);
}
assert.equal(count, expected.length);
for (const [id, channel] of indexed.channelsById) {
  const ofTopic = expected.filter((message) => message.topic === channel.topic);
  assert.equal(indexed.statistics.channelMessageCounts.get(id), BigInt(ofTopic.length));
  // The message indexes alone lead to the same messages.
  let ofIndex = 0;
  for await (const _ of indexed.readMessages({ topics: [channel.topic] })) ofIndex += 1;
  assert.equal(ofIndex, ofTopic.length);
}

const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
stream.append(readFileSync(recording));
const schemas = new Map(), channels = new Map();
count = 0;
for (let record; (record = stream.nextRecord()); ) {
  if (record.type === "Schema") schemas.set(record.id, record);
  if (record.type === "Channel") channels.set(record.id, record);
  if (record.type !== "Message") continue;
  const channel = channels.get(record.channelId);
  check(record, channel, schemas.get(channel.schemaId), expected[count++]);
}
assert.ok(stream.done());
assert.equal(count, expected.length);
console.log(`${count} messages with ${fields} fields are equal, twice`);
