// Drives a headless Chromium through a recording: node recorded.mjs LANELOOM RECORDING [PICTURE]
// Exits with 1 where something is not as a person would find it.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import puppeteer from 'puppeteer-core';

const [laneloom, recording, picture] = process.argv.slice(2);

/** Starts the viewer; its URL is the first line that it prints. */
async function startViewer() {
  const viewer = spawn(laneloom, ['view', '--in', recording, '--port', '0'], {stdio: ['ignore', 'pipe', 'inherit']});
  const [line] = await once(viewer.stdout, 'data');
  return {viewer, url: String(line).trim()};
}

const until = (page, condition, ...values) => page.waitForFunction(condition, {timeout: 20000}, ...values);

/** A place on the screen at which a click finds a lane: halfway between its left and its right side. */
const laneOnScreen = (page) => page.evaluate(() => {
  const {camera, canvas, elements} = window.laneloom, box = canvas.getBoundingClientRect();
  const places = elements.filter(({layer, type}) => layer === 'lanes' && type === 'lane').flatMap(({id, shapes}) => {
    const outline = shapes.find(({area}) => area).area, last = outline.length - 2;
    return Array.from({length: Math.floor(last / 4)}, (_, k) =>
      ({id, at: camera.project((outline[2 * k] + outline[last - 2 * k]) / 2, (outline[2 * k + 1] + outline[last - 2 * k + 1]) / 2)}));
  });
  const found = places.find(({id, at: [x, y]}) =>
    x > 0 && y > 0 && x < box.width && y < box.height && window.laneloom.pick([x, y])?.id === id);
  return found ? {id: found.id, x: box.x + found.at[0], y: box.y + found.at[1]} : null;
});

async function clickALane(page) {
  const lane = await laneOnScreen(page);
  assert.ok(lane, 'a lane can be clicked');
  await page.mouse.click(lane.x, lane.y);
  await until(page, (title) => document.getElementById('selected')?.textContent === title, `lane ${lane.id}`);
  await page.keyboard.press('Escape');
  await until(page, () => !document.getElementById('selected'));
  await page.type('#findId', String(lane.id));
  await page.keyboard.press('Enter');
  await until(page, (id) => document.getElementById('selected')?.textContent.endsWith(` ${id}`), lane.id);
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

const {viewer, url} = await startViewer();
const browser = await puppeteer.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu']});
try {
  const page = await browser.newPage(), complaints = [];
  await page.setViewport({width: 1280, height: 720});
  page.on('pageerror', ({message}) => complaints.push(message));
  page.on('console', (message) => ['error', 'warn'].includes(message.type()) && complaints.push(message.text()));
  await page.goto(url);
  await until(page, () => window.laneloom?.feed.complete && window.laneloom.elements.length > 0);
  await page.evaluate(() => window.laneloom.player.seekTime(window.laneloom.feed.first.time_s + 8));
  await until(page, () => window.laneloom.elements.some(({type}) => type === 'lane'));
  await pauseStepAndSeek(page);
  await page.evaluate(() => window.laneloom.player.seekTime(window.laneloom.feed.first.time_s + 8));
  await until(page, () => window.laneloom.elements.some(({type}) => type === 'lane'));
  if (picture) await page.screenshot({path: picture});
  await clickALane(page);
  await lookAround(page);
  assert.deepEqual(complaints, []);
} finally {
  await browser.close();
  viewer.kill('SIGTERM');
}
assert.deepEqual(await once(viewer, 'exit'), [0, null]);
