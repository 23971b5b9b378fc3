// Why an element is as it is: what the mapper says of it, and the detections of the last seconds that made it.

const BACK_S = 3, MOST_FRAMES = 40;

/** The ids of the lines that an element comes from. */
const linesOf = ({type, id}, why) => (type === 'lane' ? why.lanes?.[id]?.lines ?? [] : id === undefined ? [] : [id]);

/** What the trail of another vehicle tells. */
function toldBy({properties: {drove}}) {
  if (!drove) return ['It drove less than 5 m in any lane, and tells no direction.'];
  return drove.map(({lane, along_m}) => `It drove ${Math.abs(along_m).toFixed(0)} m ${along_m < 0 ? 'against' : 'along'} lane ${lane}: that speaks ${along_m < 0 ? 'against' : 'for'} its direction.`);
}

/** What the mapper says of an element, in sentences. It knows nothing of a second map. */
export function sentencesOf(element, why) {
  if (element.type === 'trail') return toldBy(element);
  if (!why || element.pane) return [];
  if (element.layer === 'detections') return [why.detections?.[Number(element.key.split('/')[1])]?.text].filter(Boolean);
  if (element.type === 'lane') return why.lanes?.[element.id]?.text ?? [];
  return why.lines?.[element.id]?.text ?? [];
}

/** The detections that made an element, and its evidence over time, of the frames before the one that is shown. */
export class Evidence {
  detections = [];  // [{line, share}], share from 0 (old) to 1 (now)
  curve = [];       // [{index, ago_s, value}], log odds of the frames, the newest first
  observed = [];    // [seconds before now] of the frames of which a detection observes it
  #of = '';
  #lane = null;     // its id, if it is one

  constructor(feed, changed) {
    Object.assign(this, {feed, changed});
  }

  clear() {
    this.#of = '';
    this.detections = [];
    this.curve = [];
    this.observed = [];
  }

  /** Looks `element` up in the frames before `summary`, whose reasons are `why`. To be called when one of them is another one. */
  async look(element, summary, why) {
    const of = `${element.key} ${summary.index}`;
    if (of === this.#of) return;
    this.#of = of;
    this.#lane = element.type === 'lane' ? element.id : null;
    const ids = new Set(linesOf(element, why)), indices = [];
    for (let i = summary.index; i >= this.feed.first.index && indices.length < MOST_FRAMES && summary.time_s - this.feed.at(i).time_s <= BACK_S; --i) indices.push(i);
    const frames = await Promise.all(indices.map((index) => this.feed.frame(index)));
    if (of !== this.#of) return;  // another one is wanted by now
    this.detections = [];
    this.curve = [];
    this.observed = [];
    frames.forEach((frame, i) => frame?.why && this.#take(frame, ids, {index: indices[i], ago_s: summary.time_s - this.feed.at(indices[i]).time_s}));
    this.changed();
  }

  #take({elements, why}, ids, {index, ago_s}) {
    const known = this.#lane === null ? [...ids].map((id) => why.lines?.[id]) : [why.lanes?.[this.#lane]];
    for (const one of known) if (one) this.curve.push({index, ago_s, value: one.log_odds});
    if (why.detections?.some(({lines}) => lines.some((id) => ids.has(id)))) this.observed.push(ago_s);
    for (const {layer, key, shapes} of elements) {
      if (layer !== 'detections') continue;
      const {lines = []} = why.detections?.[Number(key.split('/')[1])] ?? {};
      if (lines.some((id) => ids.has(id))) for (const {line} of shapes) if (line) this.detections.push({line, share: 1 - ago_s / BACK_S});
    }
  }

  paint(pen, painter, camera) {
    for (const {line, share} of this.detections) {
      pen.globalAlpha = 0.15 + 0.5 * share;
      painter.line(pen, camera, line, {colour: painter.dark ? '#7db0ff' : '#1f5fd0', width: 1.2});
    }
    pen.globalAlpha = 1;
  }

  /** The curve as SVG, with the log odds that are needed and a mark at each frame of which a detection observes it. A click calls `go(index of a frame)`. Null: there is none. */
  picture({publish, confirm, show_lane, hide_lane}, go) {
    if (this.curve.length < 2) return null;
    const needed = this.#lane === null ? [['published', publish], ['confirmed', confirm]] : [['hidden', hide_lane], ['shown', show_lane]];
    const name = 'http://www.w3.org/2000/svg', width = 260, height = 64, marks = 15, svg = document.createElementNS(name, 'svg');
    const values = this.curve.map(({value}) => value), low = Math.min(0, ...values), high = Math.max(needed[1][1], ...values) * 1.05;
    const y = (value) => height - 3 - ((value - low) / (high - low)) * (height - 6), x = (ago_s) => width - 4 - (ago_s / BACK_S) * (width - 70);
    svg.setAttribute('viewBox', `0 0 ${width} ${height + marks}`);
    const add = (tag, attributes, text) => {
      const node = document.createElementNS(name, tag);
      for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
      node.textContent = text ?? '';
      svg.append(node);
    };
    for (const [title, value] of needed) {
      add('line', {x1: 66, x2: width, y1: y(value), y2: y(value), class: 'needed'});
      add('text', {x: 0, y: y(value) + 3}, `${title} ${value.toFixed(1)}`);
    }
    add('text', {x: 0, y: height + marks - 2}, 'detected');
    for (const ago_s of this.observed) add('line', {x1: x(ago_s), x2: x(ago_s), y1: height + 2, y2: height + marks - 1, class: 'detected'});
    add('polyline', {points: this.curve.map(({ago_s, value}) => `${x(ago_s).toFixed(1)},${y(value).toFixed(1)}`).join(' '), class: 'curve'});
    svg.onclick = ({clientX}) => {
      const {left, width: seen} = svg.getBoundingClientRect();
      const distance = ({ago_s}) => Math.abs(x(ago_s) - ((clientX - left) / seen) * width);
      go(this.curve.reduce((best, point) => (distance(point) < distance(best) ? point : best)).index);
    };
    svg.setAttribute('class', 'evidence');
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', 'Log odds of the last 3 s; a click goes there');
    return svg;
  }
}
