// A link to the view and time, what is remembered, and pictures of what is seen.
import {SvgPen} from './svg.js';

const KEY = 'laneloom view';

/** As of a link (#…), else as it was left here. */
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

export function downloadPng(canvas) {
  canvas.toBlob((blob) => download(blob, 'laneloom.png'), 'image/png');
}

export function downloadSvg(camera, paint) {
  const pen = new SvgPen(camera.width, camera.height);
  paint(pen);
  download(new Blob([pen.text()], {type: 'image/svg+xml'}), 'laneloom.svg');
}
