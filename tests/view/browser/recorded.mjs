// Drives a headless Chromium through a recording, and through its frames by two configurations side by side:
//   node recorded.mjs LANELOOM RECORDING FRAMES TRUTH CONFIG CONFIG [PICTURE]
// Exits with 1 where something is not as a person would find it.
import assert from 'node:assert/strict';
import {existsSync, mkdtempSync, readFileSync, rmSync, truncateSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {clickALane, clickALineOf, dropFiles, launch, openTab, start, stop, stopAll, until} from './tools.mjs';

const [laneloom, recording, frames, truth, configA, configB, picture] = process.argv.slice(2);
const MOST_BYTES = 200_000;  // of the page and its modules
const screenshot = (page, name) => picture && page.screenshot({path: picture.replace('.png', `${name}.png`)});

async function findsALaneByItsId(page) {
  const id = await clickALane(page);
  await page.keyboard.press('Escape');
  await until(page, () => !document.getElementById('selected'));
  await page.type('#findId', String(id));
  await page.keyboard.press('Enter');
  await until(page, (wanted) => document.getElementById('selected')?.textContent.endsWith(` ${wanted}`), id);
}

async function pauseStepAndSeek(page) {
  const number = () => page.evaluate(() => Number(document.body.dataset.number));
  await page.click('#play');
  await until(page, () => document.body.dataset.mode === 'paused');
  const paused = await number();
  await page.click('[data-do="forward"]');
  await until(page, (before) => Number(document.body.dataset.number) === before + 1, paused);
  await page.evaluate(() => window.laneloom.player.seek(window.laneloom.feed.last));
  await until(page, () => Number(document.body.dataset.number) === window.laneloom.feed.last.index);
  await page.evaluate(() => window.laneloom.player.seek(window.laneloom.feed.first));
  await until(page, () => Number(document.body.dataset.number) === window.laneloom.feed.first.index);
}

async function lookAround(page) {
  const scale = () => page.evaluate(() => window.laneloom.camera.scale);
  const before = await scale();
  await page.click('[data-do="zoomIn"]');
  assert.ok(await scale() > before, 'the map is nearer');
  await page.click('[data-do="north"]');
  assert.equal(await page.evaluate(() => window.laneloom.camera.mode), 'north');
  const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
  const first = await theme();
  await page.click('[data-do="theme"]');
  assert.notEqual(await theme(), first, 'dark and light change');
  await page.click('[data-do="reset"]');
}

async function isSmall(page) {
  const sizes = await page.evaluate(() => performance.getEntries().filter(({name}) => name === location.href.split('#')[0] || /\.(js|css)$/.test(name))
    .map(({name, decodedBodySize}) => [name, decodedBodySize]));
  const sum = sizes.reduce((total, [, size]) => total + size, 0);
  console.log(`page and modules: ${sizes.length} files, ${sum} bytes`);
  assert.ok(sizes.length > 10 && sizes.every(([, size]) => size > 0));
  assert.ok(sum <= MOST_BYTES);
}

/** Only keys: layers, elements one after the other, measuring, and a link that keeps view, time and what is chosen. */
async function isUsableByKeys(page) {
  await page.focus('#map');
  const shown = () => page.evaluate(() => [...window.laneloom.layers.shown.keys()].join());
  const before = await shown();
  await page.keyboard.press('1');
  assert.notEqual(await shown(), before);
  await page.keyboard.press('1');
  assert.equal(await shown(), before);
  await page.keyboard.press(']');
  await until(page, () => document.getElementById('selected'));
  const first = await page.$eval('#selected', ({textContent}) => textContent);
  await page.keyboard.press(']');
  await until(page, (title) => document.getElementById('selected').textContent !== title, first);
  await page.keyboard.press('?');
  await until(page, () => document.getElementById('help').open);
  await page.keyboard.press('Escape');
  await page.keyboard.press('n');
  await page.keyboard.press('w');
  await page.keyboard.press('c');
  await until(page, () => location.hash.includes('t=') && location.hash.includes('select='));
}

async function aLinkOpensTheSame(browser, page) {
  const look = (tab) => tab.evaluate(() => {
    const {camera: {mode, x, y, scale}, player, selection} = window.laneloom;
    return JSON.stringify([mode, x.toFixed(2), y.toFixed(2), scale.toFixed(2), player.summary.index, selection.element?.key]);
  });
  const link = await page.evaluate(() => location.href), wanted = await look(page), other = await openTab(browser, link);
  await until(other, () => window.laneloom?.feed.complete && window.laneloom.selection.element && window.laneloom.player.summary);
  await until(other, (index) => window.laneloom.player.summary.index === index, JSON.parse(wanted)[4]);
  assert.equal(await look(other), wanted);
  assert.deepEqual(other.complaints, []);
  await other.close();
  await page.bringToFront();
}

async function measures(page) {
  await page.keyboard.press('m');
  const box = await (await page.$('#map')).boundingBox(), at = (x) => [box.x + x, box.y + box.height / 2];
  await page.mouse.click(...at(200));
  await page.mouse.click(...at(300));
  const [[ax, ay], [bx, by]] = await page.evaluate(() => window.laneloom.measuring);
  assert.ok(Math.abs(Math.hypot(bx - ax, by - ay) - 100 / await page.evaluate(() => window.laneloom.camera.scale)) < 1e-6);
  await screenshot(page, '_measured');
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => window.laneloom.measuring), null);
}

/** PNG and SVG of what is seen, as files. */
async function savesPictures(page) {
  const folder = mkdtempSync(join(tmpdir(), 'laneloom-view-')), debug = await page.createCDPSession();
  await debug.send('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: folder, eventsEnabled: true});
  for (const [key, name] of [['p', 'laneloom.png'], ['g', 'laneloom.svg']]) {
    const done = new Promise((resolve) => debug.on('Browser.downloadProgress', ({state}) => state === 'completed' && resolve()));
    await page.keyboard.press(key);
    await done;
    assert.ok(existsSync(join(folder, name)), name);
  }
  const png = readFileSync(join(folder, 'laneloom.png')), seen = await page.$eval('#map', ({clientWidth, clientHeight}) => [clientWidth, clientHeight]);
  assert.equal(png.subarray(1, 4).toString(), 'PNG');
  assert.equal(png.readUInt32BE(16), 2 * seen[0], 'the PNG is at twice the size');
  assert.ok(png.readUInt32BE(20) > 2 * seen[1] + 60, 'the PNG has a caption and a legend');
  const drawn = await page.evaluate((text) => {
    const picture = new DOMParser().parseFromString(text, 'image/svg+xml');
    return [picture.querySelectorAll('parsererror').length, picture.querySelectorAll('path').length, picture.querySelectorAll('text').length];
  }, readFileSync(join(folder, 'laneloom.svg'), 'utf8'));
  assert.equal(drawn[0], 0);
  assert.ok(drawn[1] > 20 && drawn[2] > 2, `the SVG has ${drawn}`);
  rmSync(folder, {recursive: true});
}

/** Everything is in reach on a tablet, and in both themes. */
async function fitsOnATablet(page) {
  for (const [width, height, name] of [[1024, 768, '_tablet'], [768, 1024, '_upright']]) {
    await page.setViewport({width, height});
    await until(page, (w) => window.laneloom.canvas.clientWidth > 0.5 * w, width);
    const outside = await page.$$eval('button, #find, #timeline', (nodes) => nodes
      .filter((node) => node.offsetParent && !node.closest('aside, dialog'))
      .map((node) => node.getBoundingClientRect()).filter(({left, right, bottom}) => left < 0 || right > innerWidth || bottom > innerHeight).length);
    assert.equal(outside, 0, `at ${width} x ${height} all buttons are on the screen`);
    await screenshot(page, name);
  }
  await page.setViewport({width: 1280, height: 720});
}

/** The whole range of the map is seen, at any size of the window. */
async function fitsTheRange(page) {
  await page.click('[data-do="reset"]');
  for (const [width, height] of [[2560, 1440], [1280, 720], [1024, 768]]) {
    await page.setViewport({width, height});
    await until(page, (w) => window.laneloom.canvas.clientWidth > 0.5 * w && window.laneloom.drawn, width);
    const {box, size} = await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => {
      const {camera, elements} = window.laneloom, flat = elements.find(({layer}) => layer === 'range').shapes[0].line;
      const corners = Array.from({length: flat.length / 2}, (_, i) => camera.project(flat[2 * i], flat[2 * i + 1]));
      done({box: ['min', 'max'].map((f) => [0, 1].map((k) => Math[f](...corners.map((corner) => corner[k])))), size: [camera.width, camera.height]});
    })));
    assert.ok(box[0].every((low) => low >= 0) && box[1].every((high, k) => high <= size[k]), `at ${width} x ${height}: ${box} is within ${size}`);
    assert.ok(box[1].some((high, k) => high - box[0][k] > 0.8 * size[k]), `at ${width} x ${height} the range fills the window`);
  }
  await page.setViewport({width: 1280, height: 720});
}

/** The worst moments are listed, and a click goes there. The figures have curves and means. */
async function tellsOfQuality(page) {
  await until(page, () => document.querySelectorAll('#worst button').length > 0 && document.querySelectorAll('#quality tr').length > 4);
  const {worst_s, shown_s} = await page.evaluate(() => {
    const {feed, quality} = window.laneloom, button = document.querySelector('#worst button');
    button.click();
    return {worst_s: button.querySelector('time').textContent, shown_s: feed.first.time_s, maps: quality.maps};
  });
  await until(page, (wanted) => window.laneloom.when(window.laneloom.player.summary) === wanted, worst_s);
  assert.ok(shown_s >= 0);
  const titles = await page.$$eval('#quality th:first-child', (cells) => cells.map(({textContent}) => textContent));
  for (const title of ['own lane', 'jump at 10 m', 'lanes', 'unsteady lanes']) assert.ok(titles.includes(title), `${titles} has ${title}`);
}

/** With a truth, the truth is a panel, and errors are those by the truth. */
async function showsTheTruth(browser) {
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', '--in', recording, '--truth', truth, '--port', '0'], 1);
  const page = await openTab(browser, url);
  await until(page, () => window.laneloom?.feed.complete && window.laneloom.elements.length > 0);
  await hasLanesAt(page, 8);
  const {columns, names, lanes} = await page.evaluate(() => {
    const {panes} = window.laneloom;
    return {columns: panes.columns, names: panes.names, lanes: panes.lists[1].filter(({type}) => type === 'lane').map(({shapes}) => shapes[0].style)};
  });
  assert.deepEqual([columns, names], [2, ['map', 'truth']]);
  assert.ok(lanes.includes('lane_own') && lanes.includes('lane_oncoming'), `the lanes of the truth are ${lanes}`);
  await tellsOfQuality(page);
  const titles = await page.$$eval('#quality th:first-child', (cells) => cells.map(({textContent}) => textContent));
  assert.ok(titles.includes('recall') && !titles.includes('recall, later seen'));
  const recall = await page.evaluate(() => window.laneloom.feed.at(100).quality[0].recall);
  assert.ok(recall > 0.3 && recall <= 1, `recall ${recall}`);
  await screenshot(page, '_truth');
  assert.deepEqual(page.complaints, []);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

/** A click on a line tells what made it; a click on a detection tells what became of it. */
async function tellsWhy(page) {
  await hasLanesAt(page, 8);
  await page.evaluate(() => window.laneloom.player.pause());
  const line = await page.evaluate(() => {
    const {elements, selection, player} = window.laneloom, found = elements.find(({layer, status, id}) => layer === 'boundaries' && status === 'confirmed' && player.frame.why.lines[id]);
    selection.select(found);
    return found.id;
  });
  await until(page, () => document.querySelectorAll('.why p').length >= 3 && window.laneloom.selection.evidence.detections.length > 0 && document.querySelector('.why .curve'));
  const text = await page.$eval('.why', ({textContent}) => textContent);
  assert.ok(text.includes(`${line} is confirmed, with log odds of`), text);
  await screenshot(page, '_why');
  const fates = await page.evaluate(() => {
    const {elements, selection} = window.laneloom;
    return elements.filter(({layer}) => layer === 'detections').map((detection) => {
      selection.select(detection);
      return document.querySelector('.why')?.textContent ?? 'nothing';
    });
  });
  assert.ok(fates.length > 0 && fates.every((fate) => /taken: |dropped: |not used: /.test(fate)), fates.join());
  assert.ok(fates.some((fate) => fate.includes('it observes line')), fates.join());
  await page.evaluate(() => {
    const {elements, selection} = window.laneloom;
    selection.select(elements.find(({type}) => type === 'lane'));
  });
  await until(page, () => /Left side, .*Right side, /s.test(document.querySelector('.why')?.textContent ?? ''));
  await page.keyboard.press('Escape');
}

async function goesToEvents(page) {
  await page.evaluate(() => window.laneloom.player.seek(window.laneloom.feed.last));
  await until(page, () => document.querySelector('#events button'));
  const time = await page.$eval('#events button', (button) => {
    button.click();
    return button.querySelector('time').textContent;
  });
  await until(page, (wanted) => window.laneloom.when(window.laneloom.player.summary) === wanted, time);
}

const hasLanesAt = async (page, seconds) => {
  await page.evaluate((s) => window.laneloom.player.seekTime(window.laneloom.feed.first.time_s + s), seconds);
  await until(page, () => window.laneloom.elements.some(({type}) => type === 'lane'));
};

async function showsOneMap(browser) {
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', '--in', recording, '--port', '0'], 1);
  const page = await openTab(browser, url);
  await until(page, () => window.laneloom?.feed.complete && window.laneloom.elements.length > 0);
  await isSmall(page);
  await hasLanesAt(page, 8);
  await pauseStepAndSeek(page);
  await hasLanesAt(page, 8);
  await screenshot(page, '');
  await findsALaneByItsId(page);
  await lookAround(page);
  await isUsableByKeys(page);
  await aLinkOpensTheSame(browser, page);
  await measures(page);
  await savesPictures(page);
  await fitsOnATablet(page);
  await fitsTheRange(page);
  await tellsOfQuality(page);
  await goesToEvents(page);
  const {ms, worst_ms, frames: count} = await page.evaluate(() => window.laneloom.drawn);
  console.log(`drawing: ${ms.toFixed(2)} ms a frame, at most ${worst_ms.toFixed(2)} ms, ${count} frames`);
  assert.deepEqual(page.complaints, []);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

/** Other vehicles are a layer with a legend; a trail tells of which lanes it tells the direction. Frames without maps are mapped. */
async function showsOtherVehicles(browser) {
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', frames, '--port', '0'], 1);
  const page = await openTab(browser, url);
  await until(page, () => window.laneloom?.feed.complete && window.laneloom.elements.length > 0);
  await page.evaluate(() => window.laneloom.player.pause());
  await hasLanesAt(page, 12);
  await until(page, () => ['trail', 'car', 'told direction'].every((wanted) => window.laneloom.elements.some(({layer, type}) => layer === 'traffic' && type === wanted)));
  await page.$$eval('summary', (nodes) => nodes.filter(({textContent}) => /Layers|Legend/.test(textContent)).forEach((node) => node.click()));
  const legend = await page.$$eval('#legend span', (items) => items.map(({textContent}) => textContent));
  for (const title of ['other vehicle', 'its trail', 'told by trails']) assert.ok(legend.includes(title), `${legend} has ${title}`);
  const key = await clickALineOf(page, 'trail');
  await until(page, () => /^(It drove [0-9]+ m (along|against) lane|It drove less than 5 m)/.test(document.querySelector('.why p')?.textContent ?? ''));
  await screenshot(page, '_traffic');
  // A trail that was driven along a lane leads to it, and the lane says that trails told its direction.
  await page.evaluate(() => {
    const {elements, selection} = window.laneloom, told = new Set(elements.filter(({type}) => type === 'told direction').map(({key}) => Number(key.split('/')[1])));
    selection.select(elements.find(({type, properties}) => type === 'trail' && told.has(properties.drove?.[0].lane)));
  });
  await page.$eval('[data-key="drove"] .chip', (chip) => chip.click()); // in one step, as the panel may be drawn anew
  await until(page, () => /^lane /.test(document.getElementById('selected').textContent) && document.querySelector('[data-key="direction_evidence"]'));
  assert.ok(await page.$eval('[data-key="direction_evidence"]', ({textContent}) => textContent.includes('traffic')));
  await page.click('[data-layer="traffic"]');
  await until(page, () => !window.laneloom.layers.shown.has('traffic'));
  assert.equal(await page.evaluate((hidden) => {
    const {camera, elements, selection} = window.laneloom, {line} = elements.find(({key}) => key === hidden).shapes[0];
    return selection.pick(camera.project(line[0], line[1]))?.type;
  }, key) === 'trail', false, 'what is not shown cannot be picked');
  assert.deepEqual(page.complaints, []);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

/** Two configurations of one drive, which move together. */
async function comparesTwo(browser) {
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', '--in', frames, '--config', configA, '--config', configB, '--port', '0'], 1);
  const page = await openTab(browser, url);
  await until(page, () => window.laneloom?.feed.complete && window.laneloom.elements.length > 0);
  await hasLanesAt(page, 8);
  const state = () => page.evaluate(() => {
    const {panes, camera, canvas} = window.laneloom;
    return {names: panes.names, columns: panes.columns, width: camera.width, whole: canvas.clientWidth,
      lines: panes.lists.map((list) => JSON.stringify(list.filter(({layer}) => layer === 'boundaries').map(({shapes}) => shapes)))};
  });
  const beside = await state();
  assert.deepEqual(beside.names, [configA, configB]);
  assert.deepEqual([beside.columns, beside.width], [2, beside.whole / 2]);
  assert.notEqual(beside.lines[0], beside.lines[1], 'the maps differ');
  await tellsOfQuality(page);
  assert.deepEqual(await page.$$eval('#quality tr:first-child th', (cells) => cells.map(({textContent}) => textContent)), ['', configA, configB, 'difference']);
  await hasLanesAt(page, 8);
  const lane = await clickALane(page, 1);
  assert.equal(await page.evaluate(() => window.laneloom.selection.element.pane), 1, `lane ${lane} is of the second map`);
  await screenshot(page, '_beside');
  await savesPictures(page);
  await tellsWhy(page);
  await page.keyboard.press('v');
  const over = await state();
  assert.deepEqual([over.columns, over.width], [1, over.whole]);
  await screenshot(page, '_over');
  assert.deepEqual(page.complaints, []);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

const toasts = (page, part) => until(page, (wanted) => !document.getElementById('toast').hidden && document.getElementById('toast').textContent.includes(wanted), part);
const shows = (page, title) => until(page, (wanted) => window.laneloom?.info.title === wanted && window.laneloom.elements.length > 0, title);

/** A file that is dropped onto the page, or chosen, is shown beside what the viewer shows. A file that cannot be shown is refused with the reason. */
async function opensFiles(browser) {
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', recording, '--port', '0'], 1);
  const page = await openTab(browser, url), folder = mkdtempSync(join(tmpdir(), 'laneloom-view-'));
  await shows(page, recording);
  await dropFiles(page, [resolve(frames)]);
  await shows(page, frames);
  assert.ok(page.url().startsWith(`${url}?view=1`), page.url());
  const first = await openTab(browser, page.url());
  await shows(first, frames);
  await page.bringToFront();
  await page.keyboard.press('Escape');
  const [chooser] = await Promise.all([page.waitForFileChooser(), page.click('[data-do="open"]')]);
  await chooser.accept([resolve(recording)]);
  await shows(page, recording);
  assert.ok(page.url().startsWith(`${url}?view=2`), page.url());
  // The file before is gone, which its tab says; the viewer's own view is there still.
  await first.bringToFront();
  await first.evaluate(() => window.laneloom.player.seek(window.laneloom.feed.last));
  await until(first, () => document.getElementById('reasons').textContent === 'the file is open no longer');
  await first.goto(url);
  await shows(first, recording);
  const complaints = (tab) => tab.complaints.filter((text) => !text.includes('410'));  // of a file that is gone
  assert.deepEqual(complaints(first), []);
  await first.close();
  await page.bringToFront();
  const odd = join(folder, `näme.${'ä'.repeat(80)} of a "drive".jsonl`);  // the server takes 100 letters, of which none is a '.' in front
  writeFileSync(odd, '{"this": "is no frame"}\n');
  await dropFiles(page, [odd]);
  await until(page, () => /^_{81}of_a__drive_.jsonl: .*/.test(document.getElementById('reasons').textContent) && document.body.dataset.state === 'STALE');
  const large = join(folder, 'large.mcap');
  writeFileSync(large, '');
  truncateSync(large, 256 * 2 ** 20 + 1);
  await dropFiles(page, [large]);
  await toasts(page, 'large.mcap has 257 MB; at most 256 can be dropped');
  await dropFiles(page, [odd, large]);
  await toasts(page, 'One file at a time');
  await until(page, () => document.getElementById('drop').hidden);
  rmSync(folder, {recursive: true});
  assert.deepEqual(complaints(page), []);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

/** A viewer that other hosts can reach takes no files. */
async function opensNoFilesOfOthers(browser) {
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', recording, '--listen', '0.0.0.0', '--port', '0'], 1);
  const page = await openTab(browser, url);
  await shows(page, recording);
  await dropFiles(page, [resolve(frames)]);
  await toasts(page, 'This viewer can be reached by other hosts, and takes no files');
  assert.equal(await page.evaluate(async () => (await fetch('/open?name=a', {method: 'PUT', body: 'x'})).status), 413);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

const OUTAGE_S = [10, 16];  // in which the network detects nothing

/** Frames of a drive whose network fails for a while. */
function withOutage(path, to) {
  const lines = readFileSync(path, 'utf8').trim().split('\n').map((line) => JSON.parse(line));
  for (const frame of lines) if (frame.t > OUTAGE_S[0] && frame.t < OUTAGE_S[1]) frame.detections = [];
  writeFileSync(to, lines.map((frame) => `${JSON.stringify(frame)}\n`).join(''));
}

const CLICK_MS = 10e3;

/** The walk of tools/view/README.md, click by click: from a lost own lane to the moment and the cause. */
async function leadsToTheCauseInFiveClicks(browser) {
  withOutage('straight.frames.jsonl', 'outage.frames.jsonl');
  const {program: viewer, lines: [url]} = await start(laneloom, ['view', 'outage.frames.jsonl', '--port', '0'], 1);
  const page = await openTab(browser, url);
  const at_s = () => page.evaluate(() => window.laneloom.player.summary.time_s);
  const isAt = (condition, ...values) => until(page, condition, ...values);
  // 1. The worst moment: the view stays there, and the lane that was lost tells why. The list is sorted anew until all is read.
  await isAt(() => window.laneloom?.feed.complete && /no own lane for [0-9.]+ s$/.test(document.querySelector('#worst li:first-child button')?.textContent ?? ''));
  await page.$eval('#worst li:first-child button', (button) => button.click()); // in one step, as the list may be drawn anew
  await isAt(() => document.body.dataset.mode === 'paused' && !window.laneloom.player.summary.quality[0].own_lane
    && /On its (left|right): .*in the last 3\.0 s, 0 of 3[01] frames did\./s.test(document.querySelector('.why')?.textContent ?? ''));
  const lost_s = await at_s();
  assert.ok(lost_s > OUTAGE_S[0] + 2 && lost_s < OUTAGE_S[1], `the own lane is lost at ${lost_s} s`);
  assert.match(await page.$eval('#selected', ({textContent}) => textContent), /^lane [0-9]+$/);
  await screenshot(page, '_walk1');
  // 2. A line that it lay on.
  await page.$eval('.why .chip', (chip) => chip.click());
  await isAt(() => /in view and missed/.test(document.querySelector('.why')?.textContent ?? '') && document.querySelector('.why .curve') && document.querySelector('#selected').textContent.startsWith('boundary') && window.laneloom.selection.evidence.curve[0]?.index === window.laneloom.player.summary.index);
  await screenshot(page, '_walk2');
  // 3. The left end of its curve, where its evidence falls already. 4. The last mark below it: the last frame of which a detection observes it.
  const clickTheCurve = async (choice, tries = 5) => {
    const before_s = await at_s();
    const place = await page.evaluate((left) => {
      const curve = document.querySelector('.why .curve'), {a, d, e, f} = curve.getScreenCTM();
      const marks = [...document.querySelectorAll('.why .detected')].map((mark) => ({x: mark.x1.baseVal.value, y: mark.y1.baseVal.value}));
      const {x, y} = (left ? [...curve.points] : marks).reduce((best, point) => ((left ? point.x < best.x : point.x > best.x) ? point : best));
      return [a * x + e, d * y + f];
    }, choice === 'left');
    await page.mouse.click(...place);
    const is_there = await page.waitForFunction((time_s) => {
      const {player: {summary}, selection: {evidence: {curve}}} = window.laneloom;
      return summary.time_s < time_s && curve[0]?.index === summary.index && document.querySelector('.why .curve');
    }, {timeout: CLICK_MS}, before_s).catch(() => null);
    if (!is_there && tries > 1) await clickTheCurve(choice, tries - 1);  // the curve was drawn anew while it was clicked
    else assert.ok(is_there, 'a click on the curve goes there');
  };
  await clickTheCurve('left');
  await clickTheCurve('last mark');
  assert.equal((await at_s()).toFixed(1), OUTAGE_S[0].toFixed(1));
  await screenshot(page, '_walk4');
  // 5. A frame on: the moment at which the detections ended. What was clicked is observed no longer.
  const detected = () => page.evaluate(() => window.laneloom.elements.filter(({layer}) => layer === 'detections').length);
  assert.ok(await detected() > 0);
  await page.click('[data-do="forward"]');
  await isAt((before_s) => window.laneloom.player.summary.time_s > before_s + 0.05, OUTAGE_S[0]);
  assert.equal(await detected(), 0);
  await isAt(() => /No detection of this frame observes it/.test(document.querySelector('.why').textContent));
  await screenshot(page, '_walk5');
  assert.deepEqual(page.complaints, []);
  await page.close();
  assert.deepEqual(await stop(viewer), [0, null]);
}

const browser = await launch();
try {
  await showsOneMap(browser);
  await showsTheTruth(browser);
  await comparesTwo(browser);
  await showsOtherVehicles(browser);
  await leadsToTheCauseInFiveClicks(browser);
  await opensFiles(browser);
  await opensNoFilesOfOthers(browser);
} finally {
  await browser.close();
  await stopAll();
}
