// Links to the view and time, the remembered view, and pictures of the view.
import {SvgPen} from './svg.js';

const KEY = 'laneloom view';

/** The state in the link (#…), else the one that was remembered in this browser. */
export function restore() {
  const linked = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
  if (Object.keys(linked).length) return linked;
  try {
    return JSON.parse(localStorage.getItem(KEY)) ?? {};
  } catch {
    return {};
  }
}

export function remember(state) {
  try {
    localStorage.setItem(KEY, JSON.stringify(state));
  } catch {  // the browser keeps nothing
  }
}

/** The state of the page: the view, and with `linked` also the time and the selected element. */
export function stateOf({camera, layers, player, theme, selection: {element}}, linked) {
  const state = {mode: camera.mode, ...(camera.fitted && !(linked && camera.mode === 'free') ? {} : {scale: camera.scale.toFixed(2)}), layers: [...layers.shown.keys()].join(), theme};
  if (!linked) return state;
  if (camera.mode === 'free') Object.assign(state, {x: camera.x.toFixed(2), y: camera.y.toFixed(2), up: camera.up.toFixed(4)});
  if (!player.following && player.summary) state.t = player.summary.time_s;
  if (element) state.select = element.key;
  return state;
}

export function applyState(app, {mode, scale, layers, theme, x, y, up, t, select}) {
  const {camera} = app;
  if (['heading', 'north'].includes(mode) || (mode === 'free' && x)) camera.mode = mode;
  for (const [key, value] of Object.entries({scale, x, y, up})) if (Number.isFinite(parseFloat(value))) camera[key] = parseFloat(value);
  if (Number.isFinite(parseFloat(scale))) camera.fitted = false;
  camera.zoom(1);
  app.setTheme(theme ?? 'auto');
  if (layers !== undefined) app.layers.set(layers.split(','));
  if (t) goOnceKnown(app, Number(t));
  if (select) selectOnceSeen(app, select);
}

function selectOnceSeen({player, panes, selection}, wanted) {
  const look = () => {
    const found = panes.find({key: wanted});
    if (!found) return;
    player.removeEventListener('frame', look);
    selection.select(found);
  };
  player.addEventListener('frame', look);
}

/** Goes to a time of a recording once it is loaded, or to one that the server of a live view remembers. */
function goOnceKnown(app, time_s) {
  const {feed, player} = app;
  if (feed.live) {
    const remembered = () => (feed.first.time_s <= time_s ? player.seekTime(time_s) : app.toast('The server no longer remembers the time of this link.'));
    feed.addEventListener('history', remembered, {once: true});
    return;
  }
  player.playing = false;
  const go = () => {
    if (!feed.complete && !(feed.last?.time_s >= time_s)) return;
    feed.removeEventListener('frame', go);
    player.seekTime(time_s);
  };
  feed.addEventListener('frame', go);
}

export async function copyLink(state) {
  history.replaceState(null, '', `#${new URLSearchParams(state)}`);
  try {
    await navigator.clipboard.writeText(location.href);
    return 'The link is copied.';
  } catch {
    return 'The link is in the address bar.';
  }
}

function download(blob, name) {
  const link = Object.assign(document.createElement('a'), {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The PNG is twice as large as the view, with a caption. */
export function downloadPng(canvas) {
  canvas.toBlob((blob) => download(blob, 'laneloom.png'), 'image/png');
}

/** Saves the last minute as a recording. Returns a text about it. */
export async function saveRecording() {
  try {
    const answer = await fetch('/save');
    if (!answer.ok) return `Nothing was saved: ${await answer.text()}`;
    download(await answer.blob(), `laneloom_${new Date().toISOString().replace(/[:.]/g, '-').slice(0, 19)}.mcap`);
    return 'The last messages are saved: 60 s, or 8 MB.';
  } catch {
    return 'Nothing was saved: there is no connection to laneloom view.';
  }
}

export function downloadSvg(canvas, paint) {
  const pen = new SvgPen(canvas.clientWidth, canvas.clientHeight);
  paint(pen);
  download(new Blob([pen.text()], {type: 'image/svg+xml'}), 'laneloom.svg');
}
