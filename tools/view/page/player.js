// Chooses the frame that is shown: follows the live end, stands still, or plays through the ring or the recording.

/** Events: frame (another one is shown: `frame`, with its `summary`), mode. */
export class Player extends EventTarget {
  frame = null;
  summary = null;
  playing = true;
  speed = 1;
  #time_s = 0;
  #wanted = null;
  #loading = false;

  constructor(feed) {
    super();
    this.feed = feed;
    this.following = feed.live;
    feed.addEventListener('frame', () => this.#arrived());
  }

  get atEnd() { return this.summary === this.feed.last; }

  #arrived() {
    if (!this.feed.last) return;
    if (this.following) return this.feed.newest && this.#show(this.feed.newest, this.feed.last);
    if (!this.summary && this.#wanted === null) this.#want(this.feed.first);
    else if (this.summary && this.summary.index < this.feed.first.index) this.#want(this.feed.first);
    this.dispatchEvent(new Event('mode'));
  }

  #show(frame, summary) {
    this.frame = frame;
    this.summary = summary;
    this.#time_s = summary.time_s;
    this.dispatchEvent(new Event('frame'));
  }

  /** Loads a frame and shows it. If several are wanted while one is loading, only the last of them is loaded next. */
  async #want(summary) {
    this.#wanted = summary;
    this.#time_s = summary.time_s;
    if (this.#loading) return;
    this.#loading = true;
    while (this.#wanted) {
      const wanted = this.#wanted;
      const frame = await this.feed.frame(wanted.index);
      if (this.#wanted === wanted) this.#wanted = null;
      if (frame && !this.following) {
        const time_s = this.#time_s;
        this.#show(frame, wanted);
        if (this.playing) this.#time_s = time_s;
      }
    }
    this.#loading = false;
  }

  /** To be called often; `elapsed_s` since the last time. */
  advance(elapsed_s) {
    if (!this.playing || this.following || !this.summary || this.#loading) return;
    this.#time_s = Math.min(this.#time_s + elapsed_s * this.speed, this.feed.last.time_s);
    const next = this.feed.atTime(this.#time_s);
    if (next !== this.summary) this.#want(next);
    else if (this.atEnd) this.feed.live ? this.toLive() : this.pause();
  }

  pause() { this.#mode(false, false); }

  play() {
    if (this.atEnd && this.feed.live) return this.toLive();
    if (this.atEnd) this.#want(this.feed.first);
    this.#mode(true, false);
  }

  toggle() { this.playing ? this.pause() : this.play(); }

  toLive() {
    if (!this.feed.live) return this.seek(this.feed.last);
    this.#wanted = null;
    this.#mode(true, true);
    this.#arrived();
  }

  /** Goes to a frame. A live view pauses there; a recording plays on. */
  seek(summary) {
    if (!summary) return;
    this.#mode(this.playing && !this.feed.live, false);
    this.#want(summary);
  }

  seekTime(time_s) { if (this.feed.last) this.seek(this.feed.atTime(time_s)); }

  step(frames) {
    if (!this.summary) return;
    const {first, last} = this.feed;
    this.#mode(false, false);
    this.#want(this.feed.at(Math.min(last.index, Math.max(first.index, (this.#wanted ?? this.summary).index + frames))));
  }

  #mode(playing, following) {
    this.playing = playing;
    this.following = following;
    this.dispatchEvent(new Event('mode'));
  }
}
