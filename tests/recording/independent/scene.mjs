// Reads the scenes of a recording and compares them with the elements that had to be drawn.
//   node scene.mjs RECORDING EXPECTED
// A line of EXPECTED is a message: topic, log_time, and entities or translation and rotation, in the order of topics'
// log times.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";
import { McapIndexedReader } from "@mcap/core";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { decompressHandlers, readable } from "./files.mjs";

const [recording, expectedFile] = process.argv.slice(2);
const expected = readFileSync(expectedFile, "utf8").trim().split("\n").map((line) => JSON.parse(line));
const kList = 2, kNear = 1e-6;

function near(a, b, what) {
  assert.equal(a.length, b.length, what);
  a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) < kNear, `${what}: ${a} is not ${b}`));
}

const flat = (point) => [point.x, point.y]; // seen from above: layers lie over one another
const absolute = (primitive) => primitive.points.map((p) =>
  flat({ x: p.x + primitive.pose.position.x, y: p.y + primitive.pose.position.y }));

function onLine([x, y], line) {
  return line.slice(1).some(([bx, by], i) => {
    const [ax, ay] = line[i], dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
    const t = squared > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / squared)) : 0;
    return Math.hypot(ax + t * dx - x, ay + t * dy - y) < kNear;
  });
}

function checkShape(shape, entity, what) {
  const points = shape.points.map(([x, y]) => [x, y]);
  const take = (list) => {
    assert.ok(list.length > 0, `${what}: ${shape.form} is missing`);
    const primitive = list.shift(), { r, g, b, a } = primitive.color;
    near([r, g, b, a], shape.colour, `${what}: colour`);
    return primitive;
  };
  if (shape.form === "text") {
    const text = take(entity.texts);
    assert.equal(text.text, shape.text);
    return near(flat(text.pose.position), points[0], what);
  }
  const isFilled = shape.form === "arrow" || (shape.form === "area" && entity.triangles.length > 0);
  const primitive = take(isFilled ? entity.triangles : entity.lines);
  const found = absolute(primitive);
  if (isFilled) for (const index of primitive.indices) assert.ok(index < found.length, what);
  if (shape.form === "arrow") return near(found[0], points[0], what);
  if (shape.form === "line" && shape.dashed) {
    assert.equal(primitive.type, kList);
    assert.equal(found.length % 2, 0);
    return found.forEach((point) => assert.ok(onLine(point, points), `${what}: ${point} is not on the line`));
  }
  assert.equal(found.length, points.length, what);
  found.forEach((point, i) => near(point, points[i], what));
}

const shown = new Map(); // ids by topic
function checkScene(update, wanted) {
  const before = shown.get(wanted.topic) ?? new Set(), now = new Set(wanted.entities.map(({ id }) => id));
  shown.set(wanted.topic, now);
  assert.deepEqual(new Set(update.deletions.map(({ id }) => id)), before.difference?.(now) ??
    new Set([...before].filter((id) => !now.has(id))));
  assert.deepEqual(update.entities.map(({ id }) => id), wanted.entities.map(({ id }) => id));
  update.entities.forEach((entity, i) => {
    const { frame_id, type, status, shapes } = wanted.entities[i];
    const metadata = new Map(entity.metadata.map(({ key, value }) => [key, value]));
    assert.equal(metadata.size, entity.metadata.length, "keys are unique");
    assert.deepEqual([entity.frame_id, metadata.get("type"), metadata.get("status")], [frame_id, type, status]);
    assert.ok(entity.lifetime.sec > 0);
    for (const shape of shapes) checkShape(shape, entity, `${wanted.topic} ${entity.id}`);
    assert.equal(entity.lines.length + entity.triangles.length + entity.texts.length, 0, "nothing else is drawn");
  });
  return update.deletions.length;
}

const byTopic = Map.groupBy?.(expected, ({ topic }) => topic) ?? expected.reduce(
  (map, message) => map.set(message.topic, [...(map.get(message.topic) ?? []), message]), new Map());
const reader = await McapIndexedReader.Initialize({ readable: readable(recording), decompressHandlers });
const decoders = new Map(); // by channel
let count = 0, deleted = 0;
for await (const message of reader.readMessages({ topics: [...byTopic.keys()], validateCrcs: true })) {
  const channel = reader.channelsById.get(message.channelId), schema = reader.schemasById.get(channel.schemaId);
  assert.deepEqual([channel.messageEncoding, schema.encoding], ["cdr", "omgidl"]);
  if (!decoders.has(channel.id))
    decoders.set(channel.id, new MessageReader(schema.name, parseIDL(new TextDecoder().decode(schema.data))));
  const decoded = decoders.get(channel.id).readMessage(message.data), wanted = byTopic.get(channel.topic).shift();
  assert.equal(message.logTime.toString(), wanted.log_time);
  count += 1;
  if (channel.topic !== "/tf") {
    assert.equal(schema.name, "foxglove::SceneUpdate");
    deleted += checkScene(decoded, wanted);
    continue;
  }
  assert.equal(schema.name, "foxglove::FrameTransform");
  const { timestamp, parent_frame_id, child_frame_id, translation: t, rotation: q } = decoded;
  assert.equal(BigInt(timestamp.sec) * 1_000_000_000n + BigInt(timestamp.nsec), message.logTime);
  assert.deepEqual([parent_frame_id, child_frame_id], ["map", "body"]);
  near([t.x, t.y, t.z], wanted.translation, "translation");
  near([q.x, q.y, q.z, q.w], wanted.rotation, "rotation");
}
assert.equal(count, expected.length);
assert.ok(deleted > 0, "something has retired");
console.log(`${count} messages are as drawn, ${deleted} entities were deleted`);
