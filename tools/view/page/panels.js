// The lists beside the map: layers, events, and the service's status.

import {headOf} from './draw.js';

const EVENTS = 200;

/** A stroke, an area or an arrow in the colours of a style. */
function sampleOf(painter, name) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg'), style = painter.palette.styles[name], colour = painter.colour(style);
  const add = (tag, attributes) => {
    const node = document.createElementNS(svg.namespaceURI, tag);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    svg.append(node);
  };
  if (style.width || !style.head) add('line', {x1: 0, x2: 28, y1: 6, y2: 6, stroke: colour, 'stroke-width': style.width ?? 10, 'stroke-dasharray': style.dash ?? ''});
  if (style.head) add('polygon', {points: headOf([style.width ? 28 : 20, 6], style.head).join(' '), fill: colour});
  return svg;
}

/** Lists the colours with their meaning. */
export function showLegend(node, painter) {
  node.replaceChildren(...painter.palette.legend.map(({style, title}) => {
    const item = document.createElement('span');
    item.append(sampleOf(painter, style), title);
    return item;
  }));
}

/** The checkboxes of the layers. `shown` is a map of the layers that are shown, by name. */
export class Layers {
  constructor(node, palette, painter, changed) {
    Object.assign(this, {node, palette, painter, changed});
    this.shown = new Map(palette.layers.filter(({shown}) => shown).map((layer) => [layer.name, layer]));
  }

  set(names) {
    this.shown = new Map(this.palette.layers.filter(({name}) => names.includes(name)).map((layer) => [layer.name, layer]));
    this.show();
  }

  toggle(name) {
    const names = [...this.shown.keys()];
    this.set(names.includes(name) ? names.filter((other) => other !== name) : [...names, name]);
    this.changed();
  }

  show() {
    this.node.replaceChildren(...this.palette.layers.map(({name, title, sample}, i) => {
      const box = Object.assign(document.createElement('input'), {type: 'checkbox', checked: this.shown.has(name), onchange: () => this.toggle(name)});
      box.dataset.layer = name;
      const label = document.createElement('label');
      label.append(box, sampleOf(this.painter, sample), title + (i < 9 ? ` (${i + 1})` : ''));
      return label;
    }));
  }
}

const DRIVING = ['own_lane', 'way', 'stopline'], SERVICE = ['state', 'service', 'reset', 'counter'];
const CHOICES = {driving: new Set(DRIVING), both: new Set([...DRIVING, ...SERVICE]), all: new Set([...DRIVING, ...SERVICE, 'lineage'])};

/** The list of events, newest first. A click goes to the time of the event. `choice` is the select of the kinds. */
export class Events {
  #index = -1;

  constructor(node, {go, when, choice}) {
    Object.assign(this, {node, go, when, kinds: CHOICES[choice.value]});
    choice.onchange = () => {
      this.kinds = CHOICES[choice.value];
      this.#index = -1;
      node.replaceChildren();
    };
  }

  update(feed) {
    for (let i = Math.max(this.#index + 1, feed.first?.index ?? 0); i <= (feed.last?.index ?? -1); ++i) this.#add(feed.at(i));
    this.#index = feed.last?.index ?? -1;
    while (this.node.children.length > EVENTS) this.node.lastChild.remove();
  }

  #add(summary) {
    for (const [kind, text] of summary.events ?? []) this.#put(summary, kind, text);
    const changes = (summary.lineage ?? []).filter(({kind}) => kind !== 'born');
    if (changes.length) this.#put(summary, 'lineage', changes.map(({kind, element, id, other}) => `${element} ${id} ${kind.replaceAll('_', ' ')} ${other ?? ''}`.trim()).join(', '));
  }

  #put(summary, kind, text) {
    if (!this.kinds.has(kind)) return;
    const item = document.createElement('li'), button = document.createElement('button'), time = document.createElement('time');
    time.textContent = this.when(summary);
    button.append(time, text);
    button.dataset.kind = kind;
    const [, lost] = /^own lane ([0-9]+) is lost$/.exec(text) ?? [];
    button.onclick = () => this.go(summary, Number(lost));
    item.append(button);
    this.node.prepend(item);
  }
}

/** Lists all values of a status. */
export function showService(node, status) {
  const rows = [];
  const put = (key, value) => {
    const term = document.createElement('dt'), text = document.createElement('dd');
    term.textContent = key.replaceAll('_', ' ');
    text.textContent = typeof value === 'number' ? +value.toFixed(3) : value;
    rows.push(term, text);
  };
  for (const [key, value] of Object.entries(status)) {
    if (value === null || key === 'event') continue;
    if (key === 'counters') Object.entries(value).filter(([, count]) => count).forEach(([counter, count]) => put(counter, count));
    else if (key === 'sources') value.forEach((source) => put(`source ${source.source}`, `${source.frames} frames`));
    else if (Array.isArray(value)) put(key, value.join(', ') || 'none');
    else if (typeof value === 'object') put(key, Object.entries(value).map(([k, v]) => `${k} ${+v.toFixed(2)}`).join(', '));
    else put(key, value);
  }
  node.replaceChildren(...rows);
}
