// Pictures of a recording as it is played, for the moving picture of the page:
//   node moving.mjs LANELOOM RECORDING FOLDER
import {mkdirSync} from 'node:fs';
import {join} from 'node:path';
import {launch, openTab, start, stopAll, until} from './tools.mjs';

const [laneloom, recording, folder] = process.argv.slice(2);
const STEP = 2;  // frames from one picture to the next
mkdirSync(folder, {recursive: true});
const {lines: [url]} = await start(laneloom, ['view', '--in', recording, '--port', '0'], 1);
const browser = await launch();
const page = await openTab(browser, url);
await page.setViewport({width: 960, height: 600});
await until(page, () => window.laneloom?.feed.complete);
await page.evaluate(() => window.laneloom.player.pause());
const [first, last] = await page.evaluate(() => [window.laneloom.feed.first.index, window.laneloom.feed.last.index]);
for (let index = first; index <= last; index += STEP) {
  await page.evaluate((wanted) => window.laneloom.player.seek(window.laneloom.feed.at(wanted)), index);
  await until(page, (wanted) => Number(document.body.dataset.number) === wanted, index);
  await page.screenshot({path: join(folder, `${String(index).padStart(4, '0')}.png`)});
}
await browser.close();
await stopAll();
