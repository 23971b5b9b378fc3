// Puts the page together.
import {ask} from './ask.js';
import {Banner} from './banner.js';
import {Camera} from './camera.js';
import {Painter} from './draw.js';
import {LiveFeed, RecordedFeed} from './feed.js';
import {listen} from './keys.js';
import {Events, Layers, showLegend, showService} from './panels.js';
import {listenForFiles} from './open.js';
import {Panes} from './panes.js';
import {pictureOf} from './picture.js';
import {Player} from './player.js';
import {Pointer} from './pointer.js';
import {Quality} from './quality.js';
import {Selection, absent} from './selection.js';
import {applyState, copyLink, downloadPng, downloadSvg, remember, restore, saveRecording, stateOf} from './share.js';
import {Timeline} from './timeline.js';

const PAN = 60;           // pixels a key moves the map
const OTHER = {light: '#c2410c', dark: '#ffa14a'};  // of a map that lies over another
const OVERLAID = new Set(['lanes', 'markings', 'boundaries', 'stoplines', 'linkages']);  // of it; the rest is the same
const SLOW_MS = 200;      // between updates of what need not be quick
const byId = (id) => document.getElementById(id);

class App {
  camera = new Camera();
  truth = [];
  measuring = null; // points
  drawn = {frames: 0, ms: 0, worst_ms: 0, rate: 0};
  #dirty = true;
  #slow = {at: 0, frames: 0};

  constructor(info, palette, truth) {
    this.info = info;
    this.order = new Map(palette.layers.map(({name}, i) => [name, i]));
    this.truth = truth;
    this.canvas = byId('map');
    this.panes = new Panes(info.names);
    byId('compare').hidden = !this.panes.several;
    this.painter = new Painter(palette);
    this.feed = info.live ? new LiveFeed() : new RecordedFeed();
    this.player = new Player(this.feed);
    this.banner = new Banner(this.feed, this.player);
    this.timeline = new Timeline(byId('timeline'), this.feed, this.player, info.names);
    this.layers = new Layers(byId('layers'), palette, this.painter, () => this.#changed());
    const go = (summary, lost) => this.#goTo(summary, lost);
    const when = (summary) => this.when(summary);
    this.events = new Events(byId('events'), {go, when, choice: byId('eventKinds')});
    this.quality = new Quality({table: byId('quality'), worst: byId('worst')}, {names: info.names, go, when});
    const {panes, layers, camera, feed, order} = this;
    this.selection = new Selection({panes, layers, camera, feed, order, go, when, isMoving: () => this.player.playing, changed: () => (this.#dirty = true)});
    this.#listen();
    applyState(this, restore());
  }

  get elements() { return this.panes.lists[0]; }

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
    this.player.addEventListener('mode', () => {
      this.#showMode();
      if (this.player.frame) this.selection.newFrame(this.player.frame, this.player.summary);
    });
    this.feed.addEventListener('connection', () => this.banner.update());
    const inColumn = (pixel) => this.panes.at(pixel, this.camera).pixel, at = (pixel) => this.camera.unproject(...inColumn(pixel));
    new Pointer(this.canvas, {
      pan: (dx, dy) => this.#moved(() => this.camera.pan(dx, dy)),
      zoom: (factor, pixel) => this.#moved(() => this.camera.zoom(factor, inColumn(pixel))),
      hover: (pixel) => this.selection.hover(this.measuring ? null : pixel),
      click: (pixel) => (this.measuring ? this.#moved(() => this.measuring.push(at(pixel))) : this.selection.select(this.selection.pick(pixel))),
    });
    this.actions = this.#actions();
    listen(this.actions);
    listenForFiles({most: this.info.max_file_bytes, veil: byId('drop'), input: byId('file'), toast: (text) => this.toast(text)});
    document.addEventListener('click', ({target}) => this.actions[target.closest?.('[data-do]')?.dataset.do]?.());
    byId('speed').onchange = ({target}) => (this.player.speed = Number(target.value));
    byId('find').onsubmit = (event) => {
      event.preventDefault();
      this.#find(Number(byId('findId').value));
    };
    matchMedia('(prefers-color-scheme: dark)').onchange = () => this.theme === 'auto' && this.setTheme('auto');
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
      previous: () => this.selection.cycle(-1), next: () => this.selection.cycle(1),
      escape: () => (this.measuring ? this.#measure(null) : this.selection.select(null)),
      find: () => byId('findId').focus(), layer: (i) => this.layers.toggle(this.painter.palette.layers[i].name),
      measure: () => this.#measure(this.measuring ? null : []),
      compare: () => this.#compare(),
      open: () => byId('file').click(),
      save: async () => this.info.live && this.toast(await saveRecording()),
      link: async () => this.toast(await copyLink(stateOf(this, true))),
      png: () => downloadPng(this.#picture()), svg: () => downloadSvg(this.canvas, (pen) => this.#paint(pen)),
      theme: () => this.setTheme(this.painter.dark ? 'light' : 'dark'), help: () => byId('help').showModal(),
    };
  }

  /** Goes to a moment, and stays there. `lost` is the own lane that was lost there: it tells why. */
  #goTo(summary, lost) {
    this.player.pause();
    this.player.seek(summary);
    if (lost) this.selection.select(this.selection.find(lost, 'lane') ?? absent('lane', lost));
  }

  // Drawing.

  #newFrame() {
    const {frame, summary} = this.player;
    this.panes.set([frame, ...(frame.others ?? [])].map(({elements}) => (this.truth.length
      ? [...elements, ...this.truth].sort((a, b) => this.order.get(a.layer) - this.order.get(b.layer)) : elements)));
    this.selection.newFrame(frame, summary);
    const range = frame.elements.find(({layer}) => layer === 'range');
    if (range) this.camera.setRange(range.shapes[0].line, frame.pose);
    this.camera.follow(frame.pose);
    this.#dirty = true;
  }

  #picture() {
    const {canvas, painter, camera, info, player: {summary}} = this, scale = `1 m is ${(2 * camera.scale).toFixed(1)} pixels`;
    const caption = [`laneloom: ${info.title}`, ...info.names, summary && this.when(summary, true), summary?.state, scale].filter(Boolean).join('   ');
    return pictureOf({width: canvas.clientWidth, height: canvas.clientHeight, painter, caption, paint: (pen) => this.#paint(pen)});
  }

  #paint(pen) {
    const {painter, camera, layers, panes} = this, tint = painter.dark ? OTHER.dark : OTHER.light;
    panes.paint(pen, camera, (lists, column) => {
      painter.ground(pen, camera);
      lists.forEach((elements, i) => {
        painter.tint = i ? tint : null;
        painter.draw(pen, camera, i ? elements.filter(({layer}) => OVERLAID.has(layer)) : elements, layers.shown);
      });
      painter.tint = null;
      this.#mark(pen, (element) => panes.over || (element.pane ?? 0) === column);
      painter.names(pen, camera, panes.over ? panes.names : panes.names.slice(column, column + 1), tint);
    }, () => painter.edge(pen, camera));
  }

  /** Draws the marks over the map in one column. `has` tells whether an element is in the column. */
  #mark(pen, has) {
    const {painter, camera} = this;
    this.selection.paint(pen, painter, has);
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
    this.quality.update(feed, player.summary);
    this.selection.tell();
    if (player.frame?.status && byId('service').closest('details').open) showService(byId('service'), player.frame.status);
    byId('rate').textContent = `${drawn.rate.toFixed(0)} fps${feed.lost ? `, ${feed.lost} lost` : ''}`;
    byId('rate').classList.toggle('losing', feed.lost > 0);
    byId('clock').textContent = player.summary ? this.when(player.summary, true) : '';
  }

  /** The time as a text: since the begin of a recording, or the time of day of a live frame. */
  when(summary, exactly = false) {
    if (!this.info.live) return `${(summary.time_s - this.feed.first.time_s).toFixed(exactly ? 2 : 1)} s`;
    return new Date(summary.time_s * 1e3).toLocaleTimeString('en-GB', {hour: '2-digit', minute: '2-digit', second: '2-digit', fractionalSecondDigits: exactly ? 2 : 1});
  }

  #resize() {
    const {canvas, camera} = this;
    this.ratio = devicePixelRatio || 1;
    camera.width = canvas.clientWidth / this.panes.columns;
    camera.height = canvas.clientHeight;
    canvas.width = Math.round(canvas.clientWidth * this.ratio);
    canvas.height = Math.round(camera.height * this.ratio);
    this.#changed();
  }

  #find(id) {
    const at = this.selection.selectById(id);
    if (at) this.#moved(() => this.camera.centre(...at));
    else this.toast(`Nothing here has the id ${id}.`);
  }

  /** Switches between maps side by side and maps over one another. */
  #compare() {
    this.panes.over = this.panes.several && !this.panes.over;
    this.selection.hover(null);
    this.#resize();
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

  /** The view has changed: draws it anew and remembers it. */
  #changed() {
    if (this.player.frame) this.camera.follow(this.player.frame.pose);
    this.#dirty = true;
    this.#showMode();
    remember(stateOf(this, false));
  }

  #showMode() {
    const pressed = {heading: this.camera.mode === 'heading', north: this.camera.mode === 'north', free: this.camera.mode === 'free',
      measure: Boolean(this.measuring), compare: this.panes.over, live: this.player.following};
    for (const [name, on] of Object.entries(pressed)) document.querySelector(`[data-do="${name}"]`).setAttribute('aria-pressed', on);
    byId('play').textContent = this.player.playing ? '❚❚' : '▶';
    byId('live').hidden = byId('save').hidden = !this.info.live;
    document.body.dataset.mode = this.player.following ? 'live' : this.player.playing ? 'playing' : 'paused';
  }

  setTheme(theme) {
    this.theme = theme;
    this.painter.dark = theme === 'auto' ? matchMedia('(prefers-color-scheme: dark)').matches : theme === 'dark';
    document.documentElement.dataset.theme = this.painter.dark ? 'dark' : 'light';
    this.layers.show();
    showLegend(byId('legend'), this.painter);
    this.#dirty = true;
    remember(stateOf(this, false));
  }

  toast(text) {
    const toast = byId('toast');
    toast.textContent = text;
    toast.hidden = false;
    clearTimeout(this.toastTimer);
    this.toastTimer = setTimeout(() => (toast.hidden = true), Math.max(2500, 60 * text.length));  // as long as it takes to read
  }
}

const answers = await Promise.all(['/info', '/palette', '/truth'].map(ask));
if (answers.every(({ok}) => ok)) {
  const [info, palette, truth] = await Promise.all(answers.map((answer) => answer.json()));
  document.title = `laneloom: ${info.title}`;
  byId('title').textContent = info.title;
  window.laneloom = new App(info, palette, truth);
  window.laneloom.start();
} else {
  byId('reasons').textContent = (await answers[0].text()).trim();
}
