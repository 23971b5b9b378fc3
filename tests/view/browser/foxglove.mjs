// Reads a live view by Foxglove's WebSocket protocol, with Foxglove's client and as its newer programs do, and compares
// what is drawn with the elements that the page gets: node foxglove.mjs LANELOOMD LANELOOM DOMAIN
import assert from 'node:assert/strict';
import {once} from 'node:events';
import {parseIDL} from '@foxglove/omgidl-parser';
import {MessageReader} from '@foxglove/omgidl-serialization';
import foxglove from '@foxglove/ws-protocol';
import WebSocket from 'ws';
import {start, stop, stopAll} from './tools.mjs';

const {FoxgloveClient} = foxglove;
const [laneloomd, laneloom, domain] = process.argv.slice(2);
const dds = ['--domain', domain, '--vehicle-id', 'foxglove'];
const COMPARED = 20, TOPICS = ['/laneloom/scene', '/laneloom/scene/ids', '/tf'], FOREIGN = 'https://app.foxglove.dev';
const MAP_LAYERS = new Set(['lanes', 'uncertainty', 'boundaries', 'stoplines', 'linkages', 'way']);
const LIST = 2, NEAR_M = 0.0051, NEAR_COLOUR = 0.0025, WITHIN_MS = 120000;

/** Of a channel's messages. */
function decoderOf({topic, schemaName, schema, schemaEncoding, encoding}) {
  assert.deepEqual([encoding, schemaEncoding], ['cdr', 'omgidl'], topic);
  const reader = new MessageReader(schemaName, parseIDL(schema));
  return (data) => reader.readMessage(data);
}

/** Foxglove's own client, which knows the older subprotocol. */
function listenAsWebsocketV1(url, take) {
  const client = new FoxgloveClient({ws: new WebSocket(url, [FoxgloveClient.SUPPORTED_SUBPROTOCOL])}), channels = new Map();
  client.on('error', (error) => take.error(error));
  client.on('advertise', (advertised) => advertised.filter(({topic}) => TOPICS.includes(topic)).forEach((channel) =>
    channels.set(client.subscribe(channel.id), {topic: channel.topic, decode: decoderOf(channel)})));
  client.on('message', ({subscriptionId, timestamp, data}) => {
    const {topic, decode} = channels.get(subscriptionId);
    take.message(topic, timestamp, decode(data));
  });
  return () => client.close();
}

/** By hand: the newer subprotocol, which no client on npm knows. */
function listenAsSdkV1(url, take) {
  const socket = new WebSocket(url, ['foxglove.sdk.v1', 'foxglove.websocket.v1']), channels = [];
  socket.on('open', () => assert.equal(socket.protocol, 'foxglove.sdk.v1'));
  socket.on('error', (error) => take.error(error));
  socket.on('message', (data, isBinary) => {
    if (isBinary) {
      assert.equal(data[0], 1);
      const {topic, decode} = channels[data.readUInt32LE(1)];
      return take.message(topic, data.readBigUInt64LE(5), decode(data.subarray(13)));
    }
    const message = JSON.parse(data);
    if (message.op === 'serverInfo') assert.ok(message.sessionId.length > 0);
    if (message.op !== 'advertise') return;
    channels.push(...message.channels.filter(({topic}) => TOPICS.includes(topic)).map((channel) => ({id: channel.id, topic: channel.topic, decode: decoderOf(channel)})));
    socket.send(JSON.stringify({op: 'subscribe', subscriptions: channels.map(({id}, i) => ({id: i, channelId: id}))}));
  });
  return () => socket.close();
}

function colourOf(palette, {style, opacity = 1}) {
  const hex = palette.styles[style].dark, [r, g, b, a] = [1, 3, 5, 7].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
  return [r, g, b, a * opacity];
}

const near = (a, b, tolerance, what) => {
  assert.equal(a.length, b.length, what);
  a.forEach((value, i) => assert.ok(Math.abs(value - b[i]) <= tolerance, `${what}: ${a} is not ${b}`));
};
const absolute = ({points, pose: {position}}) => points.flatMap(({x, y}) => [x + position.x, y + position.y]);

function distanceToLine(x, y, flat) {
  let least = Infinity;
  for (let i = 2; i < flat.length; i += 2) {
    const [ax, ay, bx, by] = flat.slice(i - 2, i + 2), dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
    const t = squared > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / squared)) : 0;
    least = Math.min(least, Math.hypot(ax + t * dx - x, ay + t * dy - y));
  }
  return least;
}

function compareShape(shape, entity, palette, what) {
  const list = shape.text !== undefined ? entity.texts : shape.arrow || (shape.area && entity.triangles.length) ? entity.triangles : entity.lines;
  const primitive = list.shift();
  assert.ok(primitive, `${what} is not drawn`);
  const {r, g, b, a} = primitive.color;
  near([r, g, b, a], colourOf(palette, shape), NEAR_COLOUR, `${what}: colour`);
  if (shape.text !== undefined) {
    assert.equal(primitive.text, shape.text, what);
    return near([primitive.pose.position.x, primitive.pose.position.y], shape.at, NEAR_M, what);
  }
  const points = absolute(primitive);
  if (shape.arrow) return near(points.slice(0, 2), shape.arrow.slice(0, 2), NEAR_M, what);
  if (shape.area) {  // there the sides run one after the other, here around
    const sides = (flat) => flat.map((value) => value.toFixed(1)).sort();
    return near(sides(points).map(Number), sides(shape.area).map(Number), 0.11, what);
  }
  if (primitive.type !== LIST) return near(points, shape.line, NEAR_M, what);
  for (let i = 0; i < points.length; i += 2)
    assert.ok(distanceToLine(points[i], points[i + 1], shape.line) < 2 * NEAR_M, `${what}: a dash is not on its line`);
}

function compareScene(scene, elements, palette) {
  const drawn = scene.entities.filter(({frame_id}) => frame_id === 'map');
  assert.deepEqual(drawn.map(({id}) => id), elements.map((element) => element.key));
  drawn.forEach((entity, i) => {
    const {key: id, type, status, shapes} = elements[i], metadata = new Map(entity.metadata.map((pair) => [pair.key, pair.value]));
    assert.deepEqual([metadata.get('type'), metadata.get('status')], [type, status], id);
    shapes.forEach((shape) => compareShape(shape, entity, palette, id));
  });
}

/** What came by each of the clients, until enough of it can be compared. */
async function gather(url) {
  const frames = new Map(), clients = {websocketV1: new Map(), sdkV1: new Map()}, transforms = [];
  const page = new WebSocket(`${url}live`);
  page.on('message', (text) => {
    const frame = JSON.parse(text);
    if (frame.alive && frame.elements.some(({type}) => type === 'lane')) frames.set(Math.round(frame.time_s * 1e3), frame);
  });
  let close = [];
  await new Promise((resolve, reject) => {
    setTimeout(() => reject(new Error('too little came')), WITHIN_MS).unref();
    const common = () => [...frames.keys()].filter((ms) => Object.values(clients).every((messages) => messages.get(ms)?.size === 2));
    const take = (messages) => ({error: reject, message(topic, time_ns, message) {
      if (topic === '/tf') return transforms.push({time_ns, message});
      const ms = Math.round(Number(BigInt(time_ns) / 1000n) / 1e3);
      messages.set(ms, (messages.get(ms) ?? new Map()).set(topic, message));
      if (common().length >= COMPARED) resolve();
    }});
    close = [listenAsWebsocketV1(url, take(clients.websocketV1)), listenAsSdkV1(url, take(clients.sdkV1))];
  });
  close.forEach((end) => end());
  page.close();
  return {frames, clients, transforms};
}

async function statusOf(url, protocols, options) {
  const socket = new WebSocket(url, protocols, options);
  const answer = await Promise.race([once(socket, 'open').then(() => 101), once(socket, 'unexpected-response').then(([, {statusCode}]) => statusCode)]);
  socket.terminate();
  return answer;
}

try {
  const {program: viewer, lines: [page, stream]} = await start(laneloom, ['view', '--port', '0', '--foxglove', '--allow-origin', FOREIGN, ...dds], 2);
  const url = page.replace('http', 'ws');
  assert.equal(stream, url);
  await start(laneloomd, dds);
  await start(laneloom, ['publish', '--scenario', 'town', '--noise', 'inhouse', '--loop', '--wait-for-readers', '2', ...dds]);
  const palette = await (await fetch(`${page}palette`)).json(), {frames, clients, transforms} = await gather(url);
  let compared = 0, entities = 0;
  for (const messages of Object.values(clients))
    for (const [ms, topics] of messages) {
      const frame = frames.get(ms);
      if (!frame || topics.size < 2) continue;
      compareScene(topics.get('/laneloom/scene'), frame.elements.filter(({layer}) => MAP_LAYERS.has(layer)), palette);
      compareScene(topics.get('/laneloom/scene/ids'), frame.elements.filter(({layer}) => layer === 'ids'), palette);
      compared += 1;
      entities += topics.get('/laneloom/scene').entities.length;
    }
  assert.ok(compared >= 2 * COMPARED && transforms.length > COMPARED);
  for (const {time_ns, message: {timestamp, parent_frame_id, child_frame_id, rotation: q}} of transforms) {
    assert.deepEqual([parent_frame_id, child_frame_id], ['map', 'body']);
    assert.equal(BigInt(timestamp.sec) * 1_000_000_000n + BigInt(timestamp.nsec), BigInt(time_ns));
    assert.ok(Math.abs(Math.hypot(q.x, q.y, q.z, q.w) - 1) < 1e-9);
  }
  const protocol = ['foxglove.sdk.v1'], evil = {origin: 'http://evil.example'}, foreign = {origin: FOREIGN};
  assert.equal(await statusOf(url, protocol, evil), 403);
  assert.equal(await statusOf(url, protocol, foreign), 101);
  assert.equal(await statusOf(`${url}live`, [], foreign), 403, 'an origin that is allowed gets scenes, not the page\'s stream');
  assert.deepEqual(await stop(viewer), [0, null]);
  console.log(`${compared} scenes with ${entities} entities are as the page draws them, and ${transforms.length} transforms are well formed`);
} finally {
  await stopAll();
}
