// Sources of frames: the live stream with a ring of the last minutes, or a recording.
// A feed has `summaries` in the order of time, whose `index` counts up by one, and gives the frame of each.

import {ask} from './ask.js';

const RING_S = 300;
const RING_CHARACTERS = 120e6;
const RECONNECT_MS = 500;

class Feed extends EventTarget {
  summaries = [];

  get first() { return this.summaries[0]; }
  get last() { return this.summaries.at(-1); }

  at(index) { return this.summaries[index - (this.first?.index ?? 0)]; }

  /** The last summary that is not later than `time_s`; if all are later, the first one. */
  atTime(time_s) {
    let low = 0, high = this.summaries.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.summaries[middle].time_s <= time_s) low = middle; else high = middle;
    }
    return this.summaries[low];
  }

  tell(type) { this.dispatchEvent(new Event(type)); }
}

/** Events: frame (a new one is the last), connection. */
export class LiveFeed extends Feed {
  live = true;
  connected = false;
  lost = 0;          // frames that this tab was too slow for
  arrival_ms = null; // of the newest frame, by performance.now()
  #texts = new Map();
  #characters = 0;
  #next = 0;
  #number = null;      // of the last frame of this connection

  /** Learns what the server remembers, and then listens. */
  async connect() {
    if (!this.last) await this.#remember();
    const socket = new WebSocket(`ws://${location.host}/live`);
    socket.onopen = () => {
      this.connected = true;
      this.#number = null;
      this.tell('connection');
    };
    socket.onmessage = ({data}) => this.#add(data);
    socket.onclose = () => {
      this.connected = false;
      this.tell('connection');
      setTimeout(() => this.connect(), RECONNECT_MS);
    };
  }

  async #remember() {
    try {
      for (const summary of (await (await fetch('/recording?from=0')).json()).frames) this.summaries.push({...summary, index: this.#next++});
      this.arrival_ms = performance.now();
    } catch {  // the stream goes on without
    }
    if (this.last) this.tell('history');
  }

  /** A frame from before this page was opened is asked of the server, which may have forgotten it. */
  async frame(index) {
    const text = this.#texts.get(index);
    if (text) return JSON.parse(text);
    const {number, time_s} = this.at(index) ?? {};
    try {
      const answer = await fetch(`/frame?number=${number}`), frame = answer.ok ? await answer.json() : null;
      return frame?.time_s === time_s ? frame : null;  // else it is of another run of the server
    } catch {
      return null;
    }
  }

  #add(text) {
    const frame = JSON.parse(text);
    if (this.#number !== null) this.lost += Math.max(0, frame.number - this.#number - 1);
    // The first frame of a connection may be one that is known already.
    const known = this.last?.number === frame.number && this.last.time_s === frame.time_s;
    this.#number = frame.number;
    if (known && this.newest) return;
    if (known) {
      this.newest = frame;
      return this.tell('frame');
    }
    this.arrival_ms = performance.now();
    const {elements, status, ...summary} = frame;
    summary.index = this.#next++;
    // A frame that comes again because the service went has its old time, but times must ascend.
    if (summary.time_s <= this.last?.time_s) summary.time_s = this.last.time_s + 1e-3;
    this.summaries.push(summary);
    this.#texts.set(summary.index, text);
    this.#characters += text.length;
    this.#drop();
    this.newest = frame;
    this.tell('frame');
  }

  #drop() {
    while (this.summaries.length > 1 &&
           (this.last.time_s - this.first.time_s > RING_S || this.#characters > RING_CHARACTERS)) {
      const {index} = this.summaries.shift();
      this.#characters -= this.#texts.get(index)?.length ?? 0;
      this.#texts.delete(index);
    }
  }
}

const CACHED = 60;
const AHEAD = 6;
const POLL_MS = 300;

/** Events: frame (more are known), error. */
export class RecordedFeed extends Feed {
  live = false;
  connected = true;
  lost = 0;
  complete = false;
  #cache = new Map();  // of promises, by index, the latest used last

  /** Learns of the frames, which may still be loaded by the server. */
  async connect() {
    try {
      const answer = await ask(`/recording?from=${this.summaries.length}`);
      this.connected = true;
      if (answer.ok) this.#add(await answer.json());
      else await this.#end(answer);
    } catch {
      this.connected = false;
    }
    this.tell('frame');
    if (!this.complete) setTimeout(() => this.connect(), this.connected ? POLL_MS : RECONNECT_MS);
  }

  #add({frames, complete, error}) {
    for (const summary of frames) this.summaries.push({...summary, index: this.summaries.length});
    this.complete = complete;
    this.error = error;
  }

  /** The server shows another file by now. */
  async #end(answer) {
    this.complete = true;
    this.error = (await answer.text()).trim();
  }

  frame(index) {
    for (let i = index + 1; i <= Math.min(index + AHEAD, this.summaries.length - 1); ++i) this.#fetch(i);
    return this.#fetch(index);
  }

  #fetch(index) {
    const found = this.#cache.get(index) ??
      ask(`/frame?number=${index}`).then(async (answer) => {
        this.connected = true;
        if (answer.status === 410) await this.#end(answer);
        return answer.ok ? answer.json() : null;
      }).catch(() => {
        this.#cache.delete(index);
        this.connected = false;
        return null;
      });
    this.#cache.delete(index);
    this.#cache.set(index, found);
    if (this.#cache.size > CACHED) this.#cache.delete(this.#cache.keys().next().value);
    return found;
  }
}
