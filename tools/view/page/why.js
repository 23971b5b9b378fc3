// Why an element is as it is: what the mapper says of it, and the detections of the last seconds that made it.

const BACK_S = 3, MOST_FRAMES = 40;

/** The ids of the lines that an element comes from. */
function linesOf({type, id, properties = {}}) {
  if (type !== 'lane') return id === undefined ? [] : [id];
  return [...(properties.left_borders ?? []), ...(properties.right_borders ?? [])].map(({boundary}) => boundary).filter(Boolean);
}

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
  if (element.type === 'lane') return why.lanes?.[element.id] ?? [];
  return why.lines?.[element.id]?.text ?? [];
}

/** The detections that made an element, and its evidence over time, of the frames before the one that is shown. */
export class Evidence {
  detections = [];  // [{line, share}], share from 0 (old) to 1 (now)
  curve = [];       // [[seconds before now, log odds]]
  #of = '';

  constructor(feed, changed) {
    Object.assign(this, {feed, changed});
  }

  clear() {
    this.#of = '';
    this.detections = [];
    this.curve = [];
  }

  /** Looks `element` up in the frames before `summary`. To be called when either is another one. */
  async look(element, summary) {
    const of = `${element.key} ${summary.index}`;
    if (of === this.#of) return;
    this.#of = of;
    const ids = new Set(linesOf(element)), indices = [];
    for (let i = summary.index; i >= this.feed.first.index && indices.length < MOST_FRAMES && summary.time_s - this.feed.at(i).time_s <= BACK_S; --i) indices.push(i);
    const frames = await Promise.all(indices.map((index) => this.feed.frame(index)));
    if (of !== this.#of) return;  // another one is wanted by now
    this.detections = [];
    this.curve = [];
    frames.forEach((frame, i) => frame?.why && this.#take(frame, ids, element.type === 'lane', summary.time_s - this.feed.at(indices[i]).time_s));
    this.changed();
  }

  #take({elements, why}, ids, several, ago_s) {
    if (!several) for (const id of ids) if (why.lines?.[id]) this.curve.push([ago_s, why.lines[id].log_odds]);
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

  /** The curve as SVG, with the log odds that are needed to be published and confirmed. Null: there is none. */
  picture({publish, confirm}) {
    if (this.curve.length < 2) return null;
    const name = 'http://www.w3.org/2000/svg', width = 260, height = 64, svg = document.createElementNS(name, 'svg');
    const values = this.curve.map(([, value]) => value), low = Math.min(0, ...values), high = Math.max(confirm, ...values) * 1.05;
    const y = (value) => height - 3 - ((value - low) / (high - low)) * (height - 6), x = (ago_s) => width - 4 - (ago_s / BACK_S) * (width - 70);
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    const add = (tag, attributes, text) => {
      const node = document.createElementNS(name, tag);
      for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
      node.textContent = text ?? '';
      svg.append(node);
    };
    for (const [title, value] of [['published', publish], ['confirmed', confirm]]) {
      add('line', {x1: 66, x2: width, y1: y(value), y2: y(value), class: 'needed'});
      add('text', {x: 0, y: y(value) + 3}, `${title} ${value.toFixed(1)}`);
    }
    add('polyline', {points: this.curve.map(([ago_s, value]) => `${x(ago_s).toFixed(1)},${y(value).toFixed(1)}`).join(' '), class: 'curve'});
    svg.setAttribute('class', 'evidence');
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', 'Log odds of the last 3 s');
    return svg;
  }
}
