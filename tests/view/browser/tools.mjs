// Functions that the tests of the page share.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import puppeteer from 'puppeteer-core';

const PATIENCE_MS = 120000; // on a busy host

const ARGUMENTS = ['--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run'];
export const launch = () => puppeteer.launch({executablePath: '/usr/bin/chromium', args: ARGUMENTS, timeout: PATIENCE_MS});

export const until = (page, condition, ...values) => page.waitForFunction(condition, {timeout: PATIENCE_MS}, ...values);

const running = new Set();

/** Starts a program; what it prints first is `lines`. */
export async function start(command, words, lines = 0) {
  const program = spawn(command, words, {stdio: ['ignore', 'pipe', 'inherit']});
  running.add(program);
  program.once('exit', () => running.delete(program));
  let text = '';
  program.stdout.on('data', (part) => (text += part));
  while (text.split('\n').length <= lines) await Promise.race([once(program.stdout, 'data'), once(program, 'exit').then(([code]) => assert.fail(`${words[0]} ended with ${code}`))]);
  return {program, lines: text.split('\n')};
}

export async function stop(program, signal = 'SIGTERM') {
  const ended = once(program, 'exit');
  program.kill(signal);
  return ended;
}

export const stopAll = () => Promise.all([...running].map((program) => stop(program)));

/** A tab whose complaints, and those of its console, are kept. */
export async function openTab(browser, url) {
  const page = await browser.newPage();
  page.complaints = [];
  await page.setViewport({width: 1280, height: 720});
  page.on('pageerror', ({message}) => page.complaints.push(message));
  page.on('console', (message) => ['error', 'warn'].includes(message.type()) && page.complaints.push(message.text()));
  await page.goto(url, {timeout: PATIENCE_MS});
  return page;
}

/** Drops files of this computer onto the page, as a file manager does. */
export async function dropFiles(page, files) {
  const debug = await page.createCDPSession();
  for (const type of ['dragEnter', 'dragOver', 'drop'])
    await debug.send('Input.dispatchDragEvent', {type, x: 200, y: 200, data: {items: [], files, dragOperationsMask: 1}});
  await debug.detach();
}

/** A place on the screen at which a click finds a lane: halfway between its left and its right side, where no panel covers it. Whole pixels, as those of a mouse are. */
const laneOnScreen = (page, pane) => page.evaluate((column) => {
  const {camera, canvas, panes, selection} = window.laneloom, box = canvas.getBoundingClientRect(), left = column * camera.width;
  const places = panes.lists[column].filter(({layer, type}) => layer === 'lanes' && type === 'lane').flatMap(({id, shapes}) => {
    const outline = shapes.find(({area}) => area).area, last = outline.length - 2;
    return Array.from({length: Math.floor(last / 4)}, (_, k) =>
      ({id, at: camera.project((outline[2 * k] + outline[last - 2 * k]) / 2, (outline[2 * k + 1] + outline[last - 2 * k + 1]) / 2).map(Math.floor)}));
  });
  const found = places.find(({id, at: [x, y]}) =>
    x > 0 && y > 0 && x < camera.width && y < box.height && selection.pick([left + x, y])?.id === id &&
    document.elementFromPoint(box.x + left + x, box.y + y) === canvas);
  return found ? {id: found.id, x: box.x + left + found.at[0], y: box.y + found.at[1]} : null;
}, pane);

/** A place on the screen at which a click finds an element of this type, on one of its lines that no panel covers. */
const lineOnScreen = (page, type) => page.evaluate((wanted) => {
  const {camera, canvas, elements, selection} = window.laneloom, box = canvas.getBoundingClientRect();
  const places = elements.filter((element) => element.type === wanted).flatMap(({key, shapes}) => shapes.flatMap(({line = []}) =>
    Array.from({length: Math.max(0, line.length / 2 - 1)}, (_, i) => ({key, at: camera.project((line[2 * i] + line[2 * i + 2]) / 2, (line[2 * i + 1] + line[2 * i + 3]) / 2).map(Math.floor)}))));
  const found = places.find(({key, at: [x, y]}) => x > 0 && y > 0 && x < camera.width && y < box.height && selection.pick([x, y])?.key === key &&
    document.elementFromPoint(box.x + x, box.y + y) === canvas);
  return found ? {key: found.key, x: box.x + found.at[0], y: box.y + found.at[1]} : null;
}, type);

const nextPicture = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => done())));

/** Clicks a line of an element of this type; the map has to stand still. Returns the element's key. */
export async function clickALineOf(page, type) {
  const line = await lineOnScreen(page, type);
  assert.ok(line, `a ${type} can be clicked`);
  await page.mouse.click(line.x, line.y);
  await until(page, (key) => window.laneloom.selection.element?.key === key, line.key);
  return line.key;
}

/** Clicks a lane of the map in this column, which has to stand still. Clicks again while the page still moves. Returns the lane's id. */
export async function clickALane(page, pane = 0) {
  for (const until_ms = Date.now() + PATIENCE_MS; ; await nextPicture(page)) {
    const lane = await laneOnScreen(page, pane);
    if (lane) await page.mouse.click(lane.x, lane.y);
    if (lane && await page.evaluate(() => document.getElementById('selected')?.textContent) === `lane ${lane.id}`) return lane.id;
    assert.ok(Date.now() < until_ms, lane ? `lane ${lane.id} is selected` : 'a lane can be clicked');
  }
}
