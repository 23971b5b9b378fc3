// The figures of a map's quality: their curves on the timeline, their table, and the worst moments.

const OUTAGE_S = 0.5;  // without a map of ten a second
const WORST = 8, APART_S = 2, WARM_UP_S = 2;

const own = (summary, map) => summary.quality?.[map];
const later = (summary, map, key) => own(summary, map)?.later?.[key];

/** `at(summary, map)` is the value; `time(summary, map)` its time, where that is not the summary's. `bad` says which way is worse. */
export const FIGURES = [
  {key: 'jump', title: 'jump at 10 m', unit: 'm', floor: 0.3, bad: 1, at: (s, map) => own(s, map)?.jump_m},
  {key: 'lanes', title: 'lanes', unit: '', floor: 4, at: (s, map) => own(s, map)?.lanes},
  {key: 'unsteady', title: 'unsteady lanes', unit: '', floor: 3, bad: 1, at: (s, map) => own(s, map)?.unsteady},
  {key: 'error', title: 'lateral error', unit: 'm', floor: 0.2, bad: 1, at: (s, map) => own(s, map)?.error_m},
  {key: 'recall', title: 'recall', unit: '', floor: 1, bad: -1, at: (s, map) => own(s, map)?.recall},
  {key: 'laterError', title: 'error, later seen', unit: 'm', floor: 0.2, bad: 1, instead: 'error',
    at: (s, map) => later(s, map, 'error_m'), time: (s, map) => later(s, map, 'time_s')},
  {key: 'laterRecall', title: 'recall, later seen', unit: '', floor: 1, bad: -1, instead: 'recall',
    at: (s, map) => later(s, map, 'recall'), time: (s, map) => later(s, map, 'time_s')},
  {key: 'tick', title: 'tick', unit: 'ms', floor: 5, bad: 1, at: (s, map) => (map ? undefined : s.tick_max_ms)},
  {key: 'latency', title: 'latency', unit: 'ms', floor: 5, bad: 1, at: (s, map) => (map ? undefined : s.latency_ms)},
];

export const known = (value) => value !== undefined && value !== null;

export function digits(value, unit = '') {
  if (!known(value)) return '–';
  const size = Math.abs(value), text = Number.isInteger(value) ? String(value) : value.toFixed(size < 0.995 ? 2 : size < 9.95 ? 1 : 0);
  return unit ? `${text} ${unit}` : text;
}

/** Whether no map came for too long after a summary: `next` is the one after it. */
export const isOutage = (summary, next, longest_s) => summary.alive === false || Boolean(summary.repeated) || next.time_s - summary.time_s > longest_s;

/** The longest time between two maps that is no outage: the maps of a file may come less often than those of a service. */
export function longestGap(summaries) {
  const steps = summaries.slice(0, 60).map(({time_s}, i, all) => (i ? time_s - all[i - 1].time_s : 0)).slice(1).sort((a, b) => a - b);
  return Math.max(OUTAGE_S, 3 * (steps[steps.length >> 1] ?? 0));
}

/** The sums of a figure over all summaries, by map. It takes each summary once, as long as the ring loses none. */
class Account {
  #next = 0;
  sums = new Map();

  update(feed, maps) {
    if (feed.first && feed.first.index > 0 && this.#next <= feed.first.index) this.#next = feed.first.index;
    for (; feed.last && this.#next <= feed.last.index; ++this.#next) this.#add(feed.at(this.#next), maps);
  }

  #add(summary, maps) {
    for (let map = 0; map < maps; ++map) {
      for (const {key, at} of FIGURES) this.#put(`${key}${map}`, at(summary, map));
      const quality = own(summary, map);
      if (quality) this.#put(`own${map}`, quality.own_lane ? 100 : 0);
    }
  }

  #put(key, value) {
    if (!known(value)) return;
    const {sum, count} = this.sums.get(key) ?? {sum: 0, count: 0};
    this.sums.set(key, {sum: sum + value, count: count + 1});
  }

  mean(key, map) {
    const found = this.sums.get(`${key}${map}`);
    return found && found.sum / found.count;
  }
}

function row(cells, tag = 'td') {
  const line = document.createElement('tr');
  line.append(...cells.map((text, i) => Object.assign(document.createElement(i ? tag : 'th'), {textContent: text})));
  return line;
}

/** The table of the figures, and the list of worst moments. A click goes there. */
export class Quality {
  #account = new Account();
  #worstOf = '';

  constructor({table, worst}, {names, go, when}) {
    Object.assign(this, {table, worst, go, when});
    this.names = names.filter((name) => name !== 'truth').map((name) => name.split('/').at(-1));
    this.maps = Math.max(1, this.names.length);
  }

  update(feed, summary) {
    this.#account.update(feed, this.maps);
    this.#fillTable(summary);
    const state = `${feed.summaries.length}/${feed.first?.index}`;
    if (state === this.#worstOf || (feed.live && performance.now() - (this.at_ms ?? -Infinity) < 2000)) return;
    this.#worstOf = state;
    this.at_ms = performance.now();
    this.#fillWorst(feed);
  }

  #fillTable(summary) {
    const two = this.maps > 1, rows = [row(['', ...(two ? [...this.names, 'difference'] : ['now', 'mean'])], 'th')];
    const put = (title, unit, now, key) => {
      const means = Array.from({length: this.maps}, (_, map) => this.#account.mean(key, map));
      if (!known(means[0])) return;
      const difference = known(means[1]) ? `${means[1] > means[0] ? '+' : ''}${digits(means[1] - means[0], unit)}` : '–';
      rows.push(row([title, ...(two ? [...means.map((mean) => digits(mean, unit)), difference] : [now, digits(means[0], unit)])]));
    };
    const quality = summary && own(summary, 0);
    put('own lane', '%', quality?.own_lane ? `id ${quality.own_lane}` : 'none', 'own');
    for (const {key, title, unit, at, instead} of FIGURES)
      if (!instead || !known(this.#account.mean(instead, 0))) put(title, unit, summary ? digits(at(summary, 0), unit) : '–', key);
    this.table.replaceChildren(...rows);
  }

  #fillWorst(feed) {
    this.worst.replaceChildren(...worstMoments(feed, this.names.length ? this.names : ['map']).map(({summary, text, lost}) => {
      const button = document.createElement('button'), time = document.createElement('time'), item = document.createElement('li');
      time.textContent = this.when(summary);
      button.append(time, this.maps > 1 ? text : text.replace(/^.*?: /, ''));
      button.onclick = () => this.go(summary, lost);
      item.append(button);
      return item;
    }));
  }
}

/** The longest times without an own lane. `lost` is the lane before; of the first map alone, since reasons are. */
function lostLanes(feed, map, name) {
  const found = [];
  let begin = null, lost = null;
  feed.summaries.forEach((summary, i) => {
    const quality = own(summary, map);
    if (!quality) return;
    const ends = Boolean(quality.own_lane) || i === feed.summaries.length - 1;
    if (!quality.own_lane) begin ??= summary;
    if (begin && ends) {
      const lasted_s = summary.time_s - begin.time_s;
      found.push({summary: begin, badness: 1 + lasted_s, lost: map ? null : lost, text: `${name}: no own lane for ${lasted_s.toFixed(1)} s`});
      begin = null;
    }
    if (quality.own_lane) lost = quality.own_lane;
  });
  return found;
}

/** The moments at which the map was worst: [{summary, badness, text}], the worst first. Moments of one figure are some time apart. */
export function worstMoments(feed, names) {
  const all = [], warm_s = feed.first?.index === 0 ? feed.first.time_s + WARM_UP_S : 0;
  const has = new Set(FIGURES.filter(({at}) => feed.summaries.some((summary) => known(at(summary, 0)))).map(({key}) => key));
  names.forEach((name, map) => {
    all.push(...lostLanes(feed, map, name).filter(({summary}) => summary.time_s >= warm_s).sort((a, b) => b.badness - a.badness).slice(0, 4));
    for (const {key, title, unit, floor, bad, at, time, instead} of FIGURES) {
      if (!bad || key === 'unsteady' || has.has(instead)) continue;
      const values = feed.summaries.flatMap((summary) => {
        const value = at(summary, map);
        if (!known(value)) return [];
        return [{summary: time ? feed.atTime(time(summary, map)) : summary, badness: bad > 0 ? value / floor : (1 - value) * 1.5, text: `${name}: ${title} ${digits(value, unit)}`}];
      }).filter(({badness, summary}) => badness > 0.75 && summary.time_s >= warm_s).sort((a, b) => b.badness - a.badness);
      const chosen = [];
      for (const value of values) {
        if (chosen.length === 3) break;
        if (chosen.every(({summary}) => Math.abs(summary.time_s - value.summary.time_s) > APART_S)) chosen.push(value);
      }
      all.push(...chosen);
    }
  });
  return all.sort((a, b) => b.badness - a.badness).slice(0, WORST);
}
