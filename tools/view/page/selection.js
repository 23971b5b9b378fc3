// The element under the pointer, the selected element, and the text about it.
import {Inspector, Memory, titleOf} from './inspect.js';
import {middle, pick, pickable} from './pick.js';
import {Evidence, sentencesOf} from './why.js';

const REACH = 9;  // pixels from a line that is still on it
const byId = (id) => document.getElementById(id);
const isSame = (a, b) => a?.key === b?.key && a?.pane === b?.pane;

/** An element that is not in the frame that is shown, but that reasons may be known of. */
export const absent = (type, id) => ({type, id, layer: type === 'lane' ? 'lanes' : 'boundaries', key: `${type === 'lane' ? 'lanes' : 'boundaries'}/${id}`, shapes: []});

export class Selection {
  element = null;  // as it was last seen
  seen = false;    // in the frame that is shown
  hovered = null;
  #memory = new Memory();
  #told = null;

  /** `view` has panes, layers, camera, feed, order (of the layers), when(summary), go(summary), isMoving(), and changed(). */
  constructor(view) {
    this.view = view;
    this.evidence = new Evidence(view.feed, () => this.#showEvidence());
    this.inspector = new Inspector(byId('inspector'), {go: view.go, select: (id, type) => this.select(this.find(id, type) ?? absent(type, id))});
  }

  newFrame(frame, summary) {
    this.#memory.add(frame, summary);
    const found = this.element && this.view.panes.find(this.element);
    if (found) this.element = found;
    this.seen = Boolean(found);
    this.why = frame.why;
    this.summary = summary;
    this.#lookForEvidence();
  }

  /** Looks what made the selected element, unless the frames go by too fast. */
  #lookForEvidence() {
    if (!this.element || !this.why || this.element.pane || this.view.isMoving()) return this.evidence.clear();
    this.evidence.look(this.element, this.summary, this.why);
  }

  #showEvidence() {
    this.#told = null;
    this.tell();
    this.view.changed();
  }

  pick(pixel) {
    const {panes, layers, camera} = this.view, {elements, pixel: at} = panes.at(pixel, camera);
    return pick(elements, layers.shown, camera.unproject(...at), REACH / camera.scale);
  }

  find(id, type) {
    const fits = {lane: ({type: t}) => t === 'lane', boundary: ({layer}) => layer === 'boundaries'}[type] ?? (() => true);
    return pickable(this.view.panes.lists[0], this.view.order).find((element) => element.id === id && fits(element)) ?? null;
  }

  select(element) {
    this.element = element;
    this.seen = Boolean(element && this.view.panes.find(element));
    this.#told = null;
    this.#lookForEvidence();
    this.tell();
    this.view.changed();
  }

  /** Selects the element with this id. Returns a point on it; null if there is no such element. */
  selectById(id) {
    const found = this.find(id);
    if (!found) return null;
    this.select(found);
    return middle(found);
  }

  /** Selects the next (`by` 1) or previous (-1) element among those with an id. */
  cycle(by) {
    const all = pickable(this.view.panes.lists[0], this.view.layers.shown).filter(({id}) => id !== undefined);
    const now = all.findIndex((element) => isSame(element, this.element));
    if (all.length) this.select(all[(Math.max(now, by > 0 ? -1 : 0) + by + all.length) % all.length]);
  }

  /** `pixel` is the place of the pointer; null if it is not on the map. */
  hover(pixel) {
    this.hovered = pixel && this.pick(pixel);
    const tip = byId('tip');
    tip.hidden = !this.hovered;
    if (this.hovered) {
      tip.textContent = [titleOf(this.hovered), this.hovered.status].filter(Boolean).join(', ');
      tip.style.left = `${Math.min(pixel[0] + 14, tip.parentElement.clientWidth - 150)}px`;
      tip.style.top = `${Math.max(4, pixel[1] - 30)}px`;
    }
    this.view.changed();
  }

  /** Outlines both elements if the column that is painted `has` them. */
  paint(pen, painter, has) {
    const {hovered, element, view: {camera}} = this;
    if (element && !element.pane && has(element)) this.evidence.paint(pen, painter, camera);
    if (hovered && !isSame(hovered, element) && has(hovered)) painter.highlight(pen, camera, hovered, false);
    if (element && this.seen && has(element)) painter.highlight(pen, camera, element, true);
  }

  /** Updates the text on the page if it has changed. To be called often. */
  tell() {
    const {element, inspector, seen, view: {feed, when}} = this;
    if (feed.first) this.#memory.forget(feed.first.index);
    if (!element) {
      if (this.#told !== '') inspector.clear();
      this.#told = '';
      return;
    }
    const known = element.pane ? [] : this.#memory.history(element, feed.summaries, feed.first);  // of the first map alone
    const sentences = sentencesOf(element, this.why);
    const told = JSON.stringify([element.key, element.status, element.properties, seen, known.length, sentences]);
    if (told === this.#told) return;
    this.#told = told;
    inspector.show(element, seen ? element : null, known.map((entry) => ({...entry, when: when(entry.summary)})),
      {sentences, picture: this.why && this.evidence.picture(this.why, (index) => this.view.go(this.view.feed.at(index)))});
  }
}
