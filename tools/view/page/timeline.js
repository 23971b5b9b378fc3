// Strips of the map's quality and the service's times, with state and events; a pointer or keys choose the time.
import {FIGURES, digits, isOutage, known, longestGap} from './quality.js';

const STATES = {OK: '--ok', DEGRADED: '--degraded', STALE: '--stale'};
const LEFT_OF = [140, 172], RIGHT = 52, BAND = 7, AXIS = 16, OWN = 14;
const SHORTEST_S = 10, ROW = {tall: 22, low: 17}, LOW_PX = 800;

/** Points of a curve: the largest of each column of pixels, with null where the curve is broken. */
function pointsOf(feed, figure, map, x) {
  const points = [], longest_s = feed.longest_s;
  let before = null;
  for (const summary of feed.summaries) {
    const value = figure.at(summary, map), time_s = (figure.time ?? ((s) => s.time_s))(summary, map);
    const isBroken = before && (figure.time ? time_s - before.time_s > longest_s : isOutage(before, summary, longest_s));
    if (isBroken) points.push(null);
    if (!figure.time || known(value)) before = figure.time ? {time_s} : summary;
    if (!known(value)) continue;
    const column = Math.round(x(time_s)), last = points.at(-1);
    if (last && last[0] === column) last[1] = Math.max(last[1], value);
    else points.push([column, value]);
  }
  return points;
}

/** Bars in a row. Those of one look that touch are one bar, which is at least a pixel wide. */
class Bars {
  #bars = [];

  constructor(pen, top, height) {
    Object.assign(this, {pen, top, height});
  }

  add(from, to, colour, alpha = 1) {
    const last = this.#bars.at(-1);
    if (last && last.colour === colour && last.alpha === alpha && from - last.to < 1) last.to = Math.max(last.to, to);
    else this.#bars.push({from, to, colour, alpha});
  }

  paint() {
    const {pen, top, height} = this;
    for (const {from, to, colour, alpha} of this.#bars) {
      pen.fillStyle = colour;
      pen.globalAlpha = alpha;
      pen.fillRect(Math.round(from), top, Math.max(1, Math.round(to) - Math.round(from)), height);
    }
    pen.globalAlpha = 1;
  }
}

export class Timeline {
  #still = document.createElement('canvas');  // all but the cursor
  #drawn = '';

  constructor(canvas, feed, player, names = []) {
    Object.assign(this, {canvas, feed, player});
    this.maps = Math.max(1, names.filter((name) => name !== 'truth').length);
    this.left = LEFT_OF[Math.min(this.maps, 2) - 1];
    const seek = (event) => player.seekTime(this.#timeAt(event.offsetX));
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      seek(event);
    });
    canvas.addEventListener('pointermove', (event) => event.buttons && seek(event));
  }

  #span() {
    const {first, last, live, arrival_ms} = this.feed;
    if (!live) return [first.time_s, Math.max(last.time_s, first.time_s + SHORTEST_S)];
    const now_s = last.time_s + (performance.now() - arrival_ms) / 1e3;  // an outage lasts until now
    return [Math.min(first.time_s, now_s - SHORTEST_S), now_s];
  }

  #timeAt(x) {
    if (!this.feed.last) return 0;
    const [from, to] = this.#span();
    return from + ((x - this.left) / (this.canvas.clientWidth - this.left - RIGHT)) * (to - from);
  }

  /** The strips that have something to show. What was measured by truth is not shown by later detections as well. */
  #strips() {
    const {summaries} = this.feed, some = summaries.length > 400 ? summaries.filter((_, i) => i % Math.ceil(summaries.length / 400) === 0) : summaries;
    const has = new Set(FIGURES.filter(({at}) => some.some((summary) => known(at(summary, 0)))).map(({key}) => key));
    return FIGURES.filter(({key, instead}) => has.has(key) && !has.has(instead));
  }

  draw() {
    const {canvas, feed} = this, ratio = devicePixelRatio || 1, width = canvas.clientWidth;
    if (!feed.last || !width) return;
    feed.longest_s = longestGap(feed.summaries);
    const strips = this.#strips(), row = innerHeight < LOW_PX ? ROW.low : ROW.tall, height = BAND + OWN + AXIS + row * strips.length;
    canvas.style.height = `${height}px`;
    const [from, to] = this.#span(), {left} = this, x = (time_s) => left + ((time_s - from) / (to - from)) * (width - left - RIGHT);
    const css = getComputedStyle(document.documentElement), colour = (name) => css.getPropertyValue(name).trim();
    const state = [width, height, ratio, document.documentElement.dataset.theme, feed.summaries.length, feed.first.index, feed.live && to.toFixed(1)].join();
    if (state !== this.#drawn) {
      this.#drawn = state;
      const pen = this.#fit(this.#still, width, height, ratio), area = {pen, x, width, colour};
      this.#states(area);
      this.#own(area);
      strips.forEach((strip, i) => this.#strip(area, strip, BAND + OWN + i * row, row));
      this.#ticks(area, from, to, height);
    }
    const pen = this.#fit(canvas, width, height, ratio);
    pen.drawImage(this.#still, 0, 0, width, height);
    strips.forEach((strip, i) => this.#label({pen, colour}, strip, BAND + OWN + (i + 1) * row));
    this.#cursor({pen, x, colour}, height);
    this.#describe(from, to);
  }

  #fit(canvas, width, height, ratio) {
    const size = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = '11px system-ui, "DejaVu Sans", sans-serif';
    return pen;
  }

  #label({pen, colour}, {title, unit, at}, bottom) {
    const {summary} = this.player, values = Array.from({length: this.maps}, (_, map) => summary && at(summary, map));
    pen.textAlign = 'left';
    pen.fillStyle = colour('--faint');
    pen.fillText(title, 4, bottom - 5);
    pen.textAlign = 'right';
    values.filter((value, map) => !map || known(value)).forEach((value, map) => {
      pen.fillStyle = colour(map ? '--other' : '--text');
      pen.fillText(known(value) ? digits(value) : '', this.left - 6 - 32 * (values.length - 1 - map), bottom - 5);
    });
  }

  #strip(area, figure, top, height) {
    const {pen, width, colour, x} = area, curves = Array.from({length: this.maps}, (_, map) => pointsOf(this.feed, figure, map, x));
    const most = curves.flat().reduce((largest, point) => (point ? Math.max(largest, point[1]) : largest), figure.floor);
    const y = (value) => top + height - 1 - (height - 4) * Math.min(1, Math.max(0, value) / most);
    pen.fillStyle = colour('--line');
    pen.fillRect(this.left, top + height - 1, width - this.left - RIGHT, 1);
    if (curves.length > 1) this.#difference(area, curves, y);
    curves.forEach((points, map) => {
      pen.strokeStyle = colour(map ? '--other' : '--accent');
      pen.lineWidth = 1.2;
      pen.beginPath();
      let broken = true;
      for (const point of points) {
        if (point) broken ? pen.moveTo(point[0], y(point[1])) : pen.lineTo(point[0], y(point[1]));
        if (point && broken) pen.lineTo(point[0] + 1, y(point[1]));
        broken = !point;
      }
      pen.stroke();
    });
    pen.textAlign = 'left';
    pen.fillStyle = colour('--faint');
    pen.fillText(digits(most, figure.unit), width - RIGHT + 5, top + 11);
  }

  /** Fills between the curves of two maps, in the colour of the one that is higher. */
  #difference({pen, colour}, [one, other], y) {
    const values = new Map(one.filter(Boolean));
    pen.globalAlpha = 0.35;
    for (const point of other) {
      if (!point || !values.has(point[0])) continue;
      const [column, value] = point, a = y(values.get(column)), b = y(value);
      pen.fillStyle = colour(b < a ? '--other' : '--accent');
      pen.fillRect(column, Math.min(a, b), 1, Math.abs(a - b));
    }
    pen.globalAlpha = 1;
  }

  /** Calls `visit(summary, from, to, outage)` for the stretch of time that each summary stands for. */
  #stretches({x}, visit) {
    const {summaries, live, longest_s} = this.feed, [, now_s] = this.#span();
    summaries.forEach((summary, i) => {
      const next = summaries[i + 1] ?? {time_s: live ? now_s : summary.time_s};
      const whole = summary.alive === false || summary.repeated, outage = isOutage(summary, next, longest_s);
      const end_s = outage ? (whole ? summary.time_s : summary.time_s + longest_s) : next.time_s;
      visit(summary, x(summary.time_s), x(end_s), outage ? x(next.time_s) : null);
    });
  }

  /** Draws a band of the states, with a mark at each event. An outage is red for as long as it lasted. */
  #states(area) {
    const {pen, colour} = area, bars = new Bars(pen, 0, BAND - 3), outages = new Bars(pen, 0, BAND - 3), marks = [];
    this.#stretches(area, (summary, from, end, outage) => {
      bars.add(from, end, colour(STATES[summary.state] ?? '--none'));
      if (outage !== null && summary.state) outages.add(end, outage, colour('--stale'));
      if (summary.events) marks.push(from);
    });
    bars.paint();
    outages.paint();
    pen.fillStyle = colour('--text');
    for (const at of marks) pen.fillRect(at - 1, 0, 2, BAND + 2);
  }

  /** Draws the ids of the own lane: a bar for each, with red where there is none. */
  #own(area) {
    const {pen, colour} = area, rows = this.maps, height = (OWN - 4) / rows;
    pen.textAlign = 'left';
    pen.fillStyle = colour('--faint');
    pen.fillText('own lane', 4, BAND + OWN - 4);
    for (let map = 0; map < rows; ++map) {
      let before = null, shade = false;
      const bars = new Bars(pen, BAND + 2 + map * height, height - 1);
      this.#stretches(area, (summary, from, end) => {
        const quality = summary.quality?.[map];
        if (!quality) return;
        if (quality.own_lane && before && quality.own_lane !== before) shade = !shade;
        if (quality.own_lane) before = quality.own_lane;
        bars.add(from, end, colour(quality.own_lane ? (map ? '--other' : '--accent') : '--stale'), quality.own_lane ? (shade ? 0.8 : 0.45) : 1);
      });
      bars.paint();
    }
  }

  #ticks({pen, x, colour}, from, to, height) {
    const most = Math.max(2, Math.min(12, Math.floor((x(to) - x(from)) / 70)));
    const step = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600].find((s) => (to - from) / s <= most) ?? 7200;
    pen.fillStyle = colour('--faint');
    pen.textAlign = 'center';
    const end = this.feed.live ? to : from;  // live: before now
    for (let i = 0; i * step <= to - from; ++i) {
      const time_s = this.feed.live ? end - i * step : end + i * step;
      pen.fillText(`${this.feed.live && i ? '−' : ''}${i * step} s`, x(time_s), height - 3);
    }
  }

  #cursor({pen, x, colour}, height) {
    if (!this.player.summary) return;
    const at = x(this.player.summary.time_s);
    pen.fillStyle = colour('--text');
    pen.fillRect(at - 1, 0, 2, height - 14);
    pen.beginPath();
    [[at - 6, 0], [at + 6, 0], [at, 8]].forEach(([px, py]) => pen.lineTo(px, py));
    pen.fill();
  }

  #describe(from, to) {
    const now = this.player.summary?.time_s ?? from;
    this.canvas.setAttribute('aria-valuemax', (to - from).toFixed(1));
    this.canvas.setAttribute('aria-valuenow', (now - from).toFixed(1));
  }
}
