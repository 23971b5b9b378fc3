// Shows the state of the map, and makes a stream that stands still look so.

const STALE_MS = 450;  // without a frame, where ten a second should come
const byId = (id) => document.getElementById(id);

export class Banner {
  constructor(feed, player) {
    Object.assign(this, {feed, player});
  }

  /** To be called often, because a map grows old also when nothing comes. */
  update() {
    const {state, reasons, frozen} = this.#judge();
    document.body.dataset.state = state;
    document.body.classList.toggle('frozen', frozen);
    byId('veil').hidden = !frozen;
    this.#put('state', state === 'NONE' ? '…' : state);
    this.#put('reasons', reasons);
    this.#put('behind', this.#behind());
  }

  #judge() {
    const {feed, player} = this, {summary, following} = player;
    if (!feed.connected) return {state: 'STALE', reasons: 'no connection to laneloom view; trying again', frozen: feed.live};
    if (feed.error) return {state: feed.last ? 'NONE' : 'STALE', reasons: feed.error, frozen: false};
    if (!summary) return {state: 'NONE', reasons: feed.live ? 'no map was heard yet' : 'loading', frozen: false};
    const told = (summary.reasons ?? []).join(', ').replaceAll('_', ' ');
    if (!following) return {state: summary.state ?? 'RECORDED', reasons: told, frozen: false};
    const silence_ms = performance.now() - feed.arrival_ms;
    if (summary.alive === false) return {state: 'STALE', reasons: `the service is gone or hangs, for ${(silence_ms / 1e3).toFixed(1)} s`, frozen: true};
    if (silence_ms > STALE_MS) return {state: 'STALE', reasons: `no map for ${(silence_ms / 1e3).toFixed(1)} s`, frozen: true};
    return {state: summary.state ?? 'NONE', reasons: told, frozen: summary.state === 'STALE'};
  }

  #behind() {
    const {feed, player} = this;
    if (!feed.live || player.following || !player.summary) return '';
    return `${player.playing ? 'behind' : 'paused'} ${(feed.last.time_s - player.summary.time_s).toFixed(1)} s`;
  }

  /** Leaves a node alone if its text stays the same, because screen readers read out every change. */
  #put(id, text) {
    const node = byId(id);
    if (node.textContent !== text) node.textContent = text;
  }
}
