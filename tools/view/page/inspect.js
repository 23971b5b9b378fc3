// The properties of the selected element, in words, and its history.

const NAMES = {existence_probability: 'existence', lateral_stddev_mean_m: 'σ lateral (mean)', lateral_stddev_max_m: 'σ lateral (max)',
  age_s: 'age', unseen_s: 'last seen before', inferred_m: 'inferred at', observations: 'observations', drove: 'drove along'};
const UNITS = {mps: ' m/s', m: ' m', s: ' s', deg: '°'}, UNIT = /_(mps|m|s|deg)$/;
const REFERENCES = new Set(['left_borders', 'right_borders', 'left_border_of', 'right_border_of', 'from', 'to', 'lane', 'lanes', 'drove',
  'left_neighbours', 'right_neighbours', 'predecessors', 'successors']);

export const titleOf = ({type, id, properties}) => [type, id ?? properties?.object].filter((part) => part !== undefined).join(' ');

function make(tag, properties = {}, ...children) {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
}

function words(key) {
  return NAMES[key] ?? key.replace(UNIT, '').replaceAll('_', ' ');
}

function number(value) {
  return Number.isInteger(value) ? String(value) : String(+value.toFixed(3));
}

function plain(value, unit) {
  if (typeof value === 'number') return number(value) + unit;
  if (!Array.isArray(value)) return typeof value === 'object' && value ? Object.entries(value).map(([k, v]) => `${words(k)} ${plain(v, '')}`).join(', ') : String(value);
  if (value.length === 3 && typeof value[0] === 'number' && typeof value[2] === 'string') return `${number(value[0])} to ${number(value[1])} m ${value[2]}`;  // a style's stretch
  if (value.length === 2 && value.every((v) => typeof v === 'number')) return `${number(value[0])} to ${number(value[1])}${unit}`;
  return value.length ? value.map((item) => plain(item, unit)).join('; ') : 'none';
}

export class Inspector {
  /** `select(id, type)` selects another element; `go(summary)` goes to a time. */
  constructor(node, {select, go}) {
    Object.assign(this, {node, select, go});
    this.clear();
  }

  clear() {
    this.node.replaceChildren(make('p', {textContent: 'Click something on the map, or find it by its id.'}));
  }

  /** Shows the element `selected`. `element` is the same in the present frame, or null if it is not there. `why` has sentences and a picture. */
  show(selected, element, history, why) {
    const parts = [make('h2', {id: 'selected', textContent: titleOf(selected)})];
    if (!element) parts.push(make('p', {textContent: 'It is not in this frame.'}));
    else {
      const list = make('dl');
      if (element.status) this.#row(list, 'status', element.status);
      for (const [key, value] of Object.entries(element.properties ?? {})) if (key !== 'lineage') this.#row(list, key, value);
      parts.push(list);
      const note = this.#note(element);
      if (note) parts.push(make('p', {textContent: note}));
    }
    if (why.sentences.length) {
      const text = make('section', {className: 'why'}, make('h2', {textContent: 'Why?'}), ...(why.picture ? [why.picture] : []), ...why.sentences.map((sentence) => make('p', {}, ...this.#linked(sentence, selected))));
      parts.splice(1, 0, text);
    }
    if (history.length) parts.push(make('h2', {textContent: 'History'}), this.#history(history));
    this.#replace(parts, `${selected.pane ?? 0} ${selected.key}`);
  }

  /** Keeps the focus on its button while the same element is shown. A button that led to another element is gone, and what is new begins at the top. */
  #replace(parts, shown) {
    const buttons = () => [...this.node.querySelectorAll('button')], focused = buttons().indexOf(document.activeElement);
    this.node.replaceChildren(...parts);
    if (focused >= 0) ((shown === this.shown && buttons()[focused]) || this.node).focus({preventScroll: true});
    if (shown !== this.shown) this.node.parentElement.scrollTop = 0;
    this.shown = shown;
  }

  /** A sentence, with a button for each line and lane that it names, but for the selected one. */
  #linked(sentence, {id: own}) {
    return sentence.split(/\b((?:laneline|roadedge|stopline|line|boundary|lane) [0-9]+)\b/i).map((part, i) => {
      const [type, id] = part.split(' ');
      if (i % 2 === 0 || Number(id) === own) return part;
      return make('button', {className: 'chip', textContent: part, onclick: () => this.select(Number(id), type.toLowerCase() === 'lane' ? 'lane' : 'boundary')});
    });
  }

  #row(list, key, value) {
    const unit = UNITS[UNIT.exec(key)?.[1]] ?? '';
    const cell = make('dd', {}, ...(REFERENCES.has(key) ? this.#chips(key, value) : [plain(value, unit)]));
    cell.dataset.key = key;
    list.append(make('dt', {textContent: words(key)}), cell);
  }

  #chips(key, value) {
    const items = Array.isArray(value) ? value : [value];
    if (!items.length) return ['none'];
    const type = key.endsWith('borders') ? 'boundary' : 'lane';
    return items.map((item) => {
      const id = typeof item === 'object' ? item[type] : item;
      const detail = typeof item === 'object' ? plain(Object.fromEntries(Object.entries(item).filter(([k]) => k !== type)), ' m') : '';
      if (!id) return make('span', {textContent: 'unseen ', title: detail});
      return make('button', {className: 'chip', textContent: id, title: detail, onclick: () => this.select(id, type)});
    });
  }

  #note({status, properties = {}}) {
    const evidence = properties.existence_probability === undefined ? '' : `, existence ${number(properties.existence_probability)}`;
    const seen = properties.observations === undefined ? '' : `seen ${properties.observations} times`;
    if (status === 'tentative') return `Tentative: ${seen || 'one of its boundaries is'}${evidence}, not enough to rely on.`;
    if (status === 'inferred') return 'Inferred: nothing was seen there; it was concluded from what lies beside it.';
    return '';
  }

  #history(history) {
    return make('ol', {className: 'history'}, ...history.map(({summary, text, when}) =>
      make('li', {}, make('button', {onclick: () => this.go(summary)}, make('time', {textContent: when}), text))));
  }
}

/** Remembers the times at which the status of each element changed, from the frames that were shown. */
export class Memory {
  #tracks = new Map();

  add(frame, summary) {
    for (const {key, id, status} of frame.elements) {
      if (id === undefined || !status) continue;
      const track = this.#tracks.get(key) ?? [];
      if (!track.length || (track.at(-1).status !== status && track.at(-1).summary.index < summary.index)) track.push({status, summary});
      this.#tracks.set(key, track);
    }
  }

  forget(before) {
    for (const [key, track] of this.#tracks)
      if (track.at(-1).summary.index < before) this.#tracks.delete(key);
  }

  /** The events in the life of an element, in the order of time. What has no id has none. */
  history(element, summaries, first) {
    if (element.id === undefined) return [];
    const found = [], statuses = (this.#tracks.get(element.key) ?? []).map(({status, summary}) => ({summary, text: `is ${status}`}));
    for (const summary of summaries)
      for (const {kind, id, other} of summary.lineage ?? [])
        if (id === element.id || other === element.id)
          found.push({summary, text: `${id === element.id ? '' : `${id} `}${kind.replaceAll('_', ' ')}${other ? ` ${other}` : ''}`});
    return [...found, ...statuses].filter(({summary}) => summary.index >= first.index).sort((a, b) => a.summary.index - b.summary.index);
  }
}
