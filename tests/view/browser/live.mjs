// Drives a headless Chromium through a live view: node live.mjs LANELOOMD LANELOOM DOMAIN [PICTURE]
// Exits with 1 where something is not as a person would find it.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readdirSync, rmSync} from 'node:fs';
import http from 'node:http';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {once} from 'node:events';
import WebSocket from 'ws';
import {clickALane, launch, openTab, start, stop, stopAll, until} from './tools.mjs';

const [laneloomd, laneloom, domain, picture] = process.argv.slice(2);
const dds = ['--domain', domain, '--vehicle-id', 'browser'];
const startService = async () => (await start(laneloomd, dds)).program;
const startViewer = async (port) => {
  const {program, lines: [url]} = await start(laneloom, ['view', '--port', port, ...dds], 1);
  return {viewer: program, url};
};

const banner = (page) => page.evaluate(() => ({state: document.body.dataset.state, reasons: document.getElementById('reasons').textContent}));
const isState = (page, state) => until(page, (wanted) => document.body.dataset.state === wanted, state);
const isMode = (page, mode) => until(page, (wanted) => document.body.dataset.mode === wanted, mode);
const hasLanes = (page) => until(page, () => window.laneloom?.elements.some(({type}) => type === 'lane'));

async function showsAPictureAtOnce(browser, url) {
  const begin = performance.now(), page = await openTab(browser, url);
  await until(page, () => window.laneloom?.elements.length > 0 && window.laneloom.drawn.frames > 0);
  console.log(`first picture: ${(performance.now() - begin).toFixed(0)} ms after the tab was opened`);
  return page;
}

async function pausesScrubsAndJumpsToLive(page) {
  await page.focus('#map');
  await page.keyboard.press('Space');
  await isMode(page, 'paused');
  const paused = await page.evaluate(() => window.laneloom.player.summary.index);
  await until(page, (index) => window.laneloom.feed.last.index > index + 5, paused);
  assert.equal(await page.evaluate(() => window.laneloom.player.summary.index), paused, 'what is paused stands still');
  const id = await clickALane(page);
  assert.ok((await page.$$eval('#inspector .history li', (items) => items.length)) > 0, `lane ${id} has a history`);
  await page.keyboard.press('ArrowLeft');
  await until(page, (index) => window.laneloom.player.summary.index === index - 1, paused);
  const box = await (await page.$('#timeline')).boundingBox();
  await page.mouse.click(box.x + 0.15 * box.width, box.y + 0.5 * box.height);
  await until(page, (index) => window.laneloom.player.summary.index < index - 1, paused);
  await page.click('#live');
  await isMode(page, 'live');
  await until(page, () => window.laneloom.player.summary === window.laneloom.feed.last);
}

/** One tab is suspended as a browser does it; the other loses nothing. */
async function aSuspendedTabSlowsNobody(browser, page, url) {
  const other = await openTab(browser, url);
  await hasLanes(other);
  const debug = await other.createCDPSession();
  await debug.send('Page.setWebLifecycleState', {state: 'frozen'});
  await page.bringToFront();
  const newest = () => page.evaluate(() => ({number: window.laneloom.player.frame.number, at_ms: performance.now(), lost: window.laneloom.feed.lost}));
  const begin = await newest();
  await until(page, (number) => window.laneloom.player.frame.number >= number + 50, begin.number);
  const end = await newest();
  assert.equal(end.lost, begin.lost, 'no frame was lost');
  console.log(`beside a suspended tab: ${(1e3 * (end.number - begin.number) / (end.at_ms - begin.at_ms)).toFixed(2)} frames/s, none lost`);
  await debug.send('Page.setWebLifecycleState', {state: 'active'});
  await other.bringToFront();
  await until(other, (number) => window.laneloom.player.frame.number >= number, end.number);
  assert.deepEqual(other.complaints.filter((text) => !text.includes('Back-Forward Cache')), []);  // which ended its stream
  await other.close();
  await page.bringToFront();
}

async function saysThatTheServiceIsGone(browser, page, url, service) {
  await stop(service, 'SIGKILL');
  await isState(page, 'STALE');
  await until(page, () => document.body.classList.contains('frozen') && !document.getElementById('veil').hidden);
  if (picture) await page.screenshot({path: picture.replace('.png', '_stale.png')});
  const late = await openTab(browser, url);
  await isState(late, 'STALE');
  await until(late, () => document.getElementById('reasons').textContent.startsWith('the service is gone'));
  assert.deepEqual(late.complaints, []);
  await late.close();
  await page.bringToFront();
  const again = await startService();
  await isState(page, 'OK');
  await until(page, () => !document.body.classList.contains('frozen'));
  await until(page, () => [...document.querySelectorAll('#events button')].some(({textContent}) => textContent.includes('another session')));
  await page.evaluate(() => [...document.querySelectorAll('#events button')].find(({textContent}) => textContent.includes('another session')).click());
  await isMode(page, 'paused');
  await until(page, () => window.laneloom.player.summary.events?.some(([, text]) => text.includes('another session')));
  await page.click('#live');
  return again;
}

/** No figure of the service's table is broken over two lines. */
async function keepsNumbersWhole(page) {
  await page.evaluate(() => (document.getElementById('service').closest('details').open = true));
  await until(page, () => document.querySelectorAll('#service dd').length > 10);
  const broken = await page.$$eval('#service dd', (cells) => cells.filter((cell) => {
    const range = document.createRange();
    range.selectNodeContents(cell);
    return /^[\d.]+$/.test(cell.textContent) && new Set([...range.getClientRects()].map(({top}) => top)).size > 1;
  }).map(({textContent}) => textContent));
  assert.deepEqual(broken, []);
  await page.evaluate(() => (document.getElementById('service').closest('details').open = false));
}

/** The band of states is red in one piece as long as the outage. Where the piece lies depends on when it was drawn, so that only its length is asked. */
async function paintsTheOutageRed(page) {
  const {red_s, lasted_s} = await page.evaluate(() => {
    const {timeline, feed} = window.laneloom, gone = feed.summaries.findLast(({alive}) => alive === false);
    const back = feed.summaries.find(({index, repeated}) => index > gone.index && !repeated), wanted = getComputedStyle(document.documentElement).getPropertyValue('--stale').trim();
    timeline.draw();
    const {canvas, left} = timeline, {first, last} = feed, width = (canvas.clientWidth - left - 52) * (devicePixelRatio || 1);
    const {data} = canvas.getContext('2d').getImageData(0, 2, canvas.width, 1);
    let run = 0, longest = 0;
    for (let pixel = 0; pixel < data.length; pixel += 4) {
      const colour = `#${[...data.slice(pixel, pixel + 3)].map((value) => value.toString(16).padStart(2, '0')).join('')}`;
      run = colour === wanted ? run + 1 : 0;
      longest = Math.max(longest, run);
    }
    return {red_s: (longest / width) * Math.max(10, last.time_s - first.time_s), lasted_s: back.time_s - gone.time_s};
  });
  console.log(`the outage lasted ${lasted_s.toFixed(2)} s, ${red_s.toFixed(2)} s are red`);
  assert.ok(lasted_s > 0);
  assert.ok(red_s > 0.6 * lasted_s && red_s < 1.5 * lasted_s + 0.2);
}

/** A tab that is opened after an incident sees it, a link goes there, and it can be saved. */
async function remembersForATabThatComesLater(browser, page, url) {
  const {time_s, number} = await page.evaluate(() => window.laneloom.feed.summaries[5]), late = await openTab(browser, `${url}#t=${time_s}`);
  await isMode(late, 'paused');
  await until(late, (wanted) => window.laneloom.player.frame?.number === wanted, number);
  const {lost, incidents} = await late.evaluate(() => ({lost: window.laneloom.feed.lost, incidents: window.laneloom.feed.summaries.filter(({alive}) => alive === false).length}));
  assert.ok(incidents > 0, 'the tab knows when the service was gone');
  assert.equal(lost, 0);
  const folder = mkdtempSync(join(tmpdir(), 'laneloom-save-')), debug = await late.createCDPSession();
  await debug.send('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: folder, eventsEnabled: true});
  const done = new Promise((resolve) => debug.on('Browser.downloadProgress', ({state}) => state === 'completed' && resolve()));
  await late.click('#save');
  await done;
  const [file] = readdirSync(folder), info = JSON.parse(execFileSync(laneloom, ['info', join(folder, file), '--json'], {encoding: 'utf8'}));
  assert.ok(info.configuration.includes('mapper:') && info.version, 'the recording has version and configuration');
  rmSync(folder, {recursive: true});
  await late.click('#live');
  await until(late, () => window.laneloom.player.summary === window.laneloom.feed.last);
  assert.deepEqual(late.complaints, []);
  await late.close();
  const forgotten = await openTab(browser, `${url}#t=1`);
  await until(forgotten, () => document.getElementById('toast').textContent.includes('no longer remembers'));
  await forgotten.close();
  await page.bringToFront();
}

async function recoversWithTheViewer(browser, viewer, url) {
  const page = await openTab(browser, url);  // whose console tells of the connection
  await hasLanes(page);
  await stop(viewer, 'SIGKILL');
  await until(page, () => document.getElementById('reasons').textContent.startsWith('no connection'));
  assert.equal((await banner(page)).state, 'STALE');
  const again = await startViewer(new URL(url).port);
  await isState(page, 'OK');
  await page.reload();
  await hasLanes(page);
  await page.close();
  return again.viewer;
}

const statusOf = (url, headers) => new Promise((resolve) => http.get(url, {headers}, (answer) => {
  answer.resume();
  resolve(answer.statusCode);
}));
async function statusOfStream(url, options) {
  const [, {statusCode}] = await once(new WebSocket(url.replace('http', 'ws') + 'live', options), 'unexpected-response');
  return statusCode;
}

async function refusesStrangers(browser, url) {
  const origin = 'http://evil.example', host = 'evil.example';
  assert.equal(await statusOf(url, {}), 200);
  assert.equal(await statusOf(url, {Host: host}), 403);
  assert.equal(await statusOf(url, {Origin: origin}), 403);
  assert.equal(await statusOfStream(url, {origin}), 403);
  assert.equal(await statusOfStream(url, {headers: {Host: host}}), 403);
  const elsewhere = http.createServer((_, answer) => answer.setHeader('Content-Type', 'text/html').end('<title>elsewhere</title>'));
  elsewhere.listen(0, '127.0.0.1');
  await once(elsewhere, 'listening');
  const page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${elsewhere.address().port}/`);
  const got = await page.evaluate(async (target) => {
    const socket = new WebSocket(target.replace('http', 'ws') + 'live');
    const stream = await new Promise((resolve) => Object.assign(socket, {onmessage: () => resolve('a frame'), onclose: () => resolve('nothing')}));
    return [stream, await fetch(target + 'info').then(() => 'an answer', () => 'nothing')];
  }, url);
  assert.deepEqual(got, ['nothing', 'nothing'], 'a page of another origin reads nothing');
  await page.close();
  elsewhere.close();
}

const browser = await launch();
try {
  let {viewer, url} = await startViewer('0');
  const early = await openTab(browser, url);
  await until(early, () => document.getElementById('reasons').textContent === 'no map was heard yet');
  let service = await startService();
  await start(laneloom, ['publish', '--scenario', 'town', '--noise', 'inhouse', '--traffic', 'usual', '--loop', '--wait-for-readers', '2', ...dds]);
  await isState(early, 'OK');
  await hasLanes(early);
  assert.deepEqual(early.complaints, []);
  await early.close();
  const page = await showsAPictureAtOnce(browser, url);
  await hasLanes(page);
  await until(page, () => window.laneloom.feed.summaries.length > 30);
  await pausesScrubsAndJumpsToLive(page);
  if (picture) await page.screenshot({path: picture});
  await until(page, () => ['trail', 'car'].every((wanted) => window.laneloom.elements.some(({layer, type}) => layer === 'traffic' && type === wanted)));
  await aSuspendedTabSlowsNobody(browser, page, url);
  service = await saysThatTheServiceIsGone(browser, page, url, service);
  await paintsTheOutageRed(page);
  await remembersForATabThatComesLater(browser, page, url);
  await keepsNumbersWhole(page);
  const {ms, worst_ms, frames} = await page.evaluate(() => window.laneloom.drawn);
  console.log(`drawing: ${ms.toFixed(2)} ms a frame, at most ${worst_ms.toFixed(2)} ms, ${frames} frames`);
  await refusesStrangers(browser, url);
  assert.deepEqual(page.complaints, []);
  await page.close();
  viewer = await recoversWithTheViewer(browser, viewer, url);
  assert.deepEqual(await stop(viewer), [0, null]);
} finally {
  await browser.close();
  await stopAll();
}
