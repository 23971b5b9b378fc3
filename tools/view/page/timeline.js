// Strips of the service's figures over time, with state and events; a pointer or keys choose the time.

const STRIPS = [
  {title: 'tick', unit: 'ms', keys: ['tick_max_ms', 'tick_ms'], floor: 5},
  {title: 'age', unit: 's', keys: ['lag_s', 'age_s'], floor: 0.2},
  {title: 'refused', unit: '/s', keys: ['refused'], floor: 1, rate: true},
  {title: 'latency', unit: 'ms', keys: ['latency_ms'], floor: 5},
];
const STATES = {OK: '--ok', DEGRADED: '--degraded', STALE: '--stale'};
const LEFT = 106, RIGHT = 10, BAND = 7;
const SHORTEST_S = 10;

export class Timeline {
  constructor(canvas, feed, player) {
    Object.assign(this, {canvas, feed, player});
    const seek = (event) => player.seekTime(this.#timeAt(event.offsetX));
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      seek(event);
    });
    canvas.addEventListener('pointermove', (event) => event.buttons && seek(event));
  }

  #span() {
    const {first, last, live} = this.feed;
    if (live) return [Math.min(first.time_s, last.time_s - SHORTEST_S), last.time_s];  // which is now
    return [first.time_s, Math.max(last.time_s, first.time_s + SHORTEST_S)];
  }

  #timeAt(x) {
    if (!this.feed.last) return 0;
    const [from, to] = this.#span();
    return from + ((x - LEFT) / (this.canvas.clientWidth - LEFT - RIGHT)) * (to - from);
  }

  draw() {
    const {canvas, feed} = this, ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
    if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    const pen = canvas.getContext('2d'), css = getComputedStyle(document.documentElement);
    const colour = (name) => css.getPropertyValue(name).trim();
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    if (!feed.last) return;
    const [from, to] = this.#span(), x = (time_s) => LEFT + ((time_s - from) / (to - from)) * (width - LEFT - RIGHT);
    const each = (height - BAND - 16) / STRIPS.length;
    const area = {pen, x, width, colour};
    STRIPS.forEach((strip, i) => this.#strip(area, strip, BAND + i * each, each));
    this.#states(area);
    this.#ticks(area, from, to, height);
    this.#cursor(area, height);
    this.#describe(from, to);
  }

  /** The largest value of each column of pixels. */
  #columns({x}, key, rate) {
    const columns = new Map();
    let before = null;
    for (const summary of this.feed.summaries) {
      let value = summary[key];
      if (rate && value !== undefined) {
        const previous = before;
        if (!before || value !== before.value || summary.time_s - before.time_s > 1) before = {value, time_s: summary.time_s};
        value = previous && before !== previous ? Math.max(0, value - previous.value) / Math.max(0.1, summary.time_s - previous.time_s) : 0;
      }
      if (value === undefined || value === null) continue;
      const column = Math.round(x(summary.time_s));
      columns.set(column, Math.max(value, columns.get(column) ?? -Infinity));
    }
    return columns;
  }

  #strip(area, {title, unit, keys, floor, rate}, top, height) {
    const {pen, width, colour} = area, curves = keys.map((key) => this.#columns(area, key, rate));
    const most = Math.max(floor, ...curves.map((columns) => Math.max(0, ...columns.values())));
    pen.font = '11px system-ui, sans-serif';
    pen.textAlign = 'left';
    pen.fillStyle = colour('--faint');
    const now = this.player.summary?.[keys.at(-1)];
    pen.fillText(rate || now === undefined || now === null ? title : `${title} ${now.toPrecision(3)} ${unit}`, 4, top + height - 5);
    pen.strokeStyle = colour('--line');
    pen.lineWidth = 1;
    pen.strokeRect(LEFT, top + height - 0.5, width - LEFT - RIGHT, 0);
    curves.forEach((columns, i) => {
      pen.strokeStyle = colour(i === curves.length - 1 ? '--accent' : '--faint');
      pen.beginPath();
      for (const [column, value] of columns) pen.lineTo(column, top + height - 1 - (height - 3) * Math.min(1, Math.max(0, value) / most));
      pen.stroke();
    });
    pen.textAlign = 'right';
    pen.fillStyle = colour('--faint');
    pen.fillText(`${most.toPrecision(2)} ${unit}`, width - RIGHT, top + 10);
  }

  /** Draws a band of the states, with a mark at each event. */
  #states({pen, x, colour}) {
    const {summaries} = this.feed;
    summaries.forEach((summary, i) => {
      const from = x(summary.time_s), to = i + 1 < summaries.length ? x(summaries[i + 1].time_s) : from + 1;
      pen.fillStyle = colour(summary.alive === false ? '--stale' : STATES[summary.state] ?? '--none');
      pen.fillRect(from, 0, Math.max(1, to - from), BAND - 3);
      if (!summary.events) return;
      pen.fillStyle = colour('--text');
      pen.fillRect(from - 1, 0, 2, BAND + 2);
    });
  }

  #ticks({pen, x, colour}, from, to, height) {
    const step = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800, 3600].find((s) => (to - from) / s <= 12) ?? 7200;
    pen.fillStyle = colour('--faint');
    pen.textAlign = 'center';
    const end = this.feed.live ? to : from;  // live: before now
    for (let i = 0; i * step <= to - from; ++i) {
      const time_s = this.feed.live ? end - i * step : end + i * step;
      pen.fillText(`${this.feed.live && i ? '−' : ''}${i * step} s`, Math.min(Math.max(x(time_s), LEFT + 8), this.canvas.clientWidth - 16), height - 3);
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
