// Puts the page together.
import {Banner} from './banner.js';
import {Camera} from './camera.js';
import {Painter} from './draw.js';
import {LiveFeed, RecordedFeed} from './feed.js';
import {Inspector, Memory, titleOf} from './inspect.js';
import {listen} from './keys.js';
import {Events, Layers, showService} from './panels.js';
import {middle, pick, pickable} from './pick.js';
import {Player} from './player.js';
import {Pointer} from './pointer.js';
import {copyLink, downloadPng, downloadSvg, remember, restore} from './share.js';
import {Timeline} from './timeline.js';

const REACH = 9;          // pixels from a line that is still on it
const PAN = 60;           // pixels a key moves the map
const SLOW_MS = 200;      // between updates of what need not be quick
const byId = (id) => document.getElementById(id);

class App {
  camera = new Camera();
  memory = new Memory();
  elements = [];
  truth = [];
  selected = null;  // the element as it was last seen
  hovered = null;
  measuring = null; // points
  drawn = {frames: 0, ms: 0, worst_ms: 0, rate: 0};
  #dirty = true;
  #slow = {at: 0, frames: 0};

  constructor(info, palette, truth) {
    this.info = info;
    this.order = new Map(palette.layers.map(({name}, i) => [name, i]));
    this.truth = truth;
    this.canvas = byId('map');
    this.painter = new Painter(palette);
    this.feed = info.live ? new LiveFeed() : new RecordedFeed();
    this.player = new Player(this.feed);
    this.banner = new Banner(this.feed, this.player);
    this.timeline = new Timeline(byId('timeline'), this.feed, this.player);
    this.layers = new Layers(byId('layers'), palette, this.painter, () => this.#changed());
    const go = (summary) => this.player.seek(summary);
    this.events = new Events(byId('events'), {go, when: (summary) => this.when(summary)});
    this.inspector = new Inspector(byId('inspector'), {go, select: (id, type) => this.select(this.find(id, type))});
    this.#restore(restore());
    this.#listen();
  }

  start() {
    this.feed.connect();
    let before = performance.now();
    const turn = (now) => {
      this.player.advance((now - before) / 1e3);
      before = now;
      if (this.#dirty) this.#draw();
      if (now - this.#slow.at > SLOW_MS) this.#slowly(now);
      requestAnimationFrame(turn);
    };
    requestAnimationFrame(turn);
    setInterval(() => this.banner.update(), SLOW_MS);  // also where nothing is drawn
  }

  #listen() {
    new ResizeObserver(() => this.#resize()).observe(this.canvas);
    this.player.addEventListener('frame', () => this.#newFrame());
    this.player.addEventListener('mode', () => this.#showMode());
    this.feed.addEventListener('connection', () => this.banner.update());
    const at = ([x, y]) => this.camera.unproject(x, y);
    new Pointer(this.canvas, {
      pan: (dx, dy) => this.#moved(() => this.camera.pan(dx, dy)),
      zoom: (factor, pixel) => this.#moved(() => this.camera.zoom(factor, pixel)),
      hover: (pixel) => this.#hover(pixel),
      click: (pixel) => (this.measuring ? this.#moved(() => this.measuring.push(at(pixel))) : this.select(this.pick(pixel))),
    });
    this.actions = this.#actions();
    listen(this.actions);
    document.addEventListener('click', ({target}) => this.actions[target.closest?.('[data-do]')?.dataset.do]?.());
    byId('speed').onchange = ({target}) => (this.player.speed = Number(target.value));
    byId('find').onsubmit = (event) => {
      event.preventDefault();
      this.#find(Number(byId('findId').value));
    };
    matchMedia('(prefers-color-scheme: dark)').onchange = () => this.theme === 'auto' && this.#setTheme('auto');
  }

  #actions() {
    const {player, camera} = this, moved = (move) => () => this.#moved(move);
    const mode = (name) => moved(() => (camera.mode = name));
    return {
      heading: mode('heading'), north: mode('north'), free: mode('free'), reset: moved(() => camera.reset()),
      zoomIn: moved(() => camera.zoom(1.25)), zoomOut: moved(() => camera.zoom(0.8)),
      up: moved(() => camera.pan(0, PAN)), down: moved(() => camera.pan(0, -PAN)),
      left: moved(() => camera.pan(PAN, 0)), right: moved(() => camera.pan(-PAN, 0)),
      play: () => player.toggle(), live: () => player.toLive(), begin: () => player.seek(this.feed.first),
      back: () => player.step(-1), forward: () => player.step(1), step: (frames) => player.step(frames),
      skip: (seconds) => player.summary && player.seekTime(player.summary.time_s + seconds),
      previous: () => this.#cycle(-1), next: () => this.#cycle(1),
      escape: () => (this.measuring ? this.#measure(null) : this.select(null)),
      find: () => byId('findId').focus(), layer: (i) => this.layers.toggle(this.painter.palette.layers[i].name),
      measure: () => this.#measure(this.measuring ? null : []),
      link: async () => this.#toast(await copyLink(this.state(true))),
      png: () => downloadPng(this.canvas), svg: () => downloadSvg(camera, (pen) => this.#paint(pen)),
      theme: () => this.#setTheme(this.painter.dark ? 'light' : 'dark'), help: () => byId('help').showModal(),
    };
  }

  // What is seen.

  #newFrame() {
    const {frame, summary} = this.player;
    this.elements = this.truth.length
      ? [...frame.elements, ...this.truth].sort((a, b) => this.order.get(a.layer) - this.order.get(b.layer)) : frame.elements;
    this.memory.add(frame, summary);
    const seen = this.selected && this.elements.find(({key}) => key === this.selected.key);
    if (seen) this.selected = seen;
    this.selectedSeen = Boolean(seen);
    this.camera.follow(frame.pose);
    this.#dirty = true;
  }

  #paint(pen) {
    const {painter, camera, elements, layers} = this;
    painter.draw(pen, camera, elements, layers.shown);
    if (this.hovered && this.hovered.key !== this.selected?.key) painter.highlight(pen, camera, this.hovered, false);
    if (this.selected && this.selectedSeen) painter.highlight(pen, camera, this.selected, true);
    if (this.measuring) painter.measure(pen, camera, this.measuring);
    painter.scaleBar(pen, camera);
    painter.north(pen, camera);
  }

  #draw() {
    this.#dirty = false;
    const begin = performance.now(), pen = this.canvas.getContext('2d'), ratio = this.ratio;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.#paint(pen);
    const ms = performance.now() - begin;
    ++this.drawn.frames;
    this.drawn.ms = this.drawn.ms ? 0.95 * this.drawn.ms + 0.05 * ms : ms;
    this.drawn.worst_ms = Math.max(this.drawn.worst_ms, ms);
    document.body.dataset.number = this.player.summary?.index ?? '';
  }

  #slowly(now) {
    const {drawn, feed, player} = this, slow = this.#slow;
    drawn.rate = 0.5 * drawn.rate + (0.5 * (drawn.frames - slow.frames) * 1e3) / (now - slow.at);
    this.#slow = {at: now, frames: drawn.frames};
    this.timeline.draw();
    this.events.update(feed);
    if (feed.first) this.memory.forget(feed.first.index);
    this.#inspect();
    if (player.frame?.status && byId('service').closest('details').open) showService(byId('service'), player.frame.status);
    byId('rate').textContent = `${drawn.rate.toFixed(0)} fps${feed.lost ? `, ${feed.lost} lost` : ''}`;
    byId('rate').classList.toggle('losing', feed.lost > 0);
    byId('clock').textContent = player.summary ? this.when(player.summary, true) : '';
  }

  /** Of a recording, time since its begin; live, the time of day. */
  when(summary, exactly = false) {
    if (!this.info.live) return `${(summary.time_s - this.feed.first.time_s).toFixed(exactly ? 2 : 1)} s`;
    return new Date(summary.time_s * 1e3).toLocaleTimeString('en-GB', {hour: '2-digit', minute: '2-digit', second: '2-digit', fractionalSecondDigits: exactly ? 2 : 1});
  }

  #resize() {
    const {canvas, camera} = this;
    this.ratio = devicePixelRatio || 1;
    camera.width = canvas.clientWidth;
    camera.height = canvas.clientHeight;
    canvas.width = Math.round(camera.width * this.ratio);
    canvas.height = Math.round(camera.height * this.ratio);
    this.#changed();
  }

  // What is chosen.

  pick([x, y]) { return pick(this.elements, this.layers.shown, this.camera.unproject(x, y), REACH / this.camera.scale); }

  find(id, type) {
    const fits = {lane: ({type: t}) => t === 'lane', boundary: ({layer}) => layer === 'boundaries'}[type] ?? (() => true);
    return pickable(this.elements, this.order).find((element) => element.id === id && fits(element)) ?? null;
  }

  select(element) {
    this.selected = element;
    this.selectedSeen = Boolean(element);
    this.#dirty = true;
    this.inspected = null;
    this.#inspect();
  }

  #find(id) {
    const found = this.find(id);
    if (!found) return this.#toast(`Nothing here has the id ${id}.`);
    this.select(found);
    const at = middle(found);
    if (at) this.#moved(() => this.camera.centre(...at));
  }

  #inspect() {
    const {selected, inspector, feed} = this;
    if (!selected) return this.inspected !== null || inspector.clear();
    const history = this.memory.history(selected, feed.summaries, feed.first).map((entry) => ({...entry, when: this.when(entry.summary)}));
    const content = JSON.stringify([selected.key, selected.status, selected.properties, this.selectedSeen, history.length]);
    if (content === this.inspected) return;
    this.inspected = content;
    inspector.show(selected, this.selectedSeen ? selected : null, history);
  }

  #cycle(by) {
    const all = pickable(this.elements, this.layers.shown).filter(({id}) => id !== undefined);
    const now = all.findIndex(({key}) => key === this.selected?.key);
    if (all.length) this.select(all[(Math.max(now, by > 0 ? -1 : 0) + by + all.length) % all.length]);
  }

  #hover(pixel) {
    this.hovered = pixel && !this.measuring ? this.pick(pixel) : null;
    const tip = byId('tip');
    tip.hidden = !this.hovered;
    if (this.hovered) {
      tip.textContent = [titleOf(this.hovered), this.hovered.status].filter(Boolean).join(', ');
      tip.style.left = `${Math.min(pixel[0] + 14, this.camera.width - 150)}px`;
      tip.style.top = `${Math.max(4, pixel[1] - 30)}px`;
    }
    this.#dirty = true;
  }

  #measure(points) {
    this.measuring = points;
    this.canvas.classList.toggle('measuring', Boolean(points));
    this.#changed();
  }

  #moved(move) {
    move();
    this.#changed();
  }

  /** Of the view: it is drawn anew, and remembered. */
  #changed() {
    if (this.player.frame) this.camera.follow(this.player.frame.pose);
    this.#dirty = true;
    this.#showMode();
    remember(this.state(false));
  }

  #showMode() {
    const pressed = {heading: this.camera.mode === 'heading', north: this.camera.mode === 'north', free: this.camera.mode === 'free',
      measure: Boolean(this.measuring), live: this.player.following};
    for (const [name, on] of Object.entries(pressed)) document.querySelector(`[data-do="${name}"]`).setAttribute('aria-pressed', on);
    byId('play').textContent = this.player.playing ? '❚❚' : '▶';
    byId('live').hidden = !this.info.live;
    document.body.dataset.mode = this.player.following ? 'live' : this.player.playing ? 'playing' : 'paused';
  }

  // What is remembered.

  state(linked) {
    const {camera, layers, player, selected} = this;
    const state = {mode: camera.mode, scale: camera.scale.toFixed(2), layers: [...layers.shown.keys()].join(), theme: this.theme};
    if (!linked) return state;
    if (camera.mode === 'free') Object.assign(state, {x: camera.x.toFixed(2), y: camera.y.toFixed(2), up: camera.up.toFixed(4)});
    if (!player.following && player.summary) state.t = player.summary.time_s;
    if (selected) state.select = selected.key;
    return state;
  }

  #restore({mode, scale, layers, theme, x, y, up, t, select}) {
    const {camera} = this;
    if (['heading', 'north'].includes(mode) || (mode === 'free' && x)) camera.mode = mode;
    for (const [key, value] of Object.entries({scale, x, y, up})) if (Number.isFinite(parseFloat(value))) camera[key] = parseFloat(value);
    camera.zoom(1);
    this.#setTheme(theme ?? 'auto');
    if (layers !== undefined) this.layers.set(layers.split(','));
    if (t) this.#goOnceKnown(Number(t));
    if (select) this.player.addEventListener('frame', () => this.select(this.elements.find(({key}) => key === select) ?? null), {once: true});
  }

  /** Live, only what came since the page was opened is known. */
  #goOnceKnown(time_s) {
    if (this.info.live) return;
    this.player.playing = false;
    const go = () => {
      if (!this.feed.complete && !(this.feed.last?.time_s >= time_s)) return;
      this.feed.removeEventListener('frame', go);
      this.player.seekTime(time_s);
    };
    this.feed.addEventListener('frame', go);
  }

  #setTheme(theme) {
    this.theme = theme;
    this.painter.dark = theme === 'auto' ? matchMedia('(prefers-color-scheme: dark)').matches : theme === 'dark';
    document.documentElement.dataset.theme = this.painter.dark ? 'dark' : 'light';
    this.layers.show();
    this.#dirty = true;
    remember(this.state(false));
  }

  #toast(text) {
    const toast = byId('toast');
    toast.textContent = text;
    toast.hidden = false;
    clearTimeout(this.toastTimer);
    this.toastTimer = setTimeout(() => (toast.hidden = true), 2500);
  }
}

const [info, palette, truth] = await Promise.all(['/info', '/palette', '/truth'].map(async (path) => (await fetch(path)).json()));
document.title = `laneloom: ${info.title}`;
byId('title').textContent = info.title;
window.laneloom = new App(info, palette, truth);
window.laneloom.start();
