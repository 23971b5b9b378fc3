// Mouse, pen and fingers on the map: pan, zoom, hover, click, measure.

const CLICK = 6;  // pixels that a click may move

export class Pointer {
  #down = new Map();  // pointers, by id
  #start = null;

  /** `on` has pan(dx, dy), zoom(factor, [x, y]), hover([x, y] or null), and click([x, y]). */
  constructor(canvas, on) {
    this.on = on;
    canvas.addEventListener('pointerdown', (event) => this.#press(canvas, event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', (event) => this.#release(event));
    canvas.addEventListener('pointercancel', ({pointerId}) => this.#down.delete(pointerId));
    canvas.addEventListener('pointerleave', () => on.hover(null));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      on.zoom(Math.exp(-event.deltaY * 0.0015), [event.offsetX, event.offsetY]);
    }, {passive: false});
  }

  #press(canvas, event) {
    canvas.setPointerCapture(event.pointerId);
    this.#down.set(event.pointerId, [event.offsetX, event.offsetY]);
    this.#start = this.#down.size === 1 ? {at: [event.offsetX, event.offsetY], moved: false} : null;
  }

  #move(event) {
    const at = [event.offsetX, event.offsetY], before = this.#down.get(event.pointerId);
    if (!before) return this.on.hover(at);
    if (this.#down.size === 2) this.#pinch(event.pointerId, before, at);
    else if (this.#start) this.#drag(before, at);
    this.#down.set(event.pointerId, at);
  }

  #drag(before, at) {
    const {start} = {start: this.#start};
    start.moved ||= Math.hypot(at[0] - start.at[0], at[1] - start.at[1]) > CLICK;
    if (start.moved) this.on.pan(at[0] - before[0], at[1] - before[1]);
  }

  #pinch(id, before, at) {
    const [, other] = [...this.#down].find(([key]) => key !== id);
    const distance = (point) => Math.max(10, Math.hypot(point[0] - other[0], point[1] - other[1]));
    this.on.zoom(distance(at) / distance(before), [(at[0] + other[0]) / 2, (at[1] + other[1]) / 2]);
  }

  #release(event) {
    this.#down.delete(event.pointerId);
    if (this.#start && !this.#start.moved) this.on.click([event.offsetX, event.offsetY]);
    this.#start = null;
  }
}
