// The projection of the map frame onto the screen.
const DEFAULT_SCALE = 13;  // pixels per metre, before the map's range is known
const AROUND_M = 2;        // around the range

export class Camera {
  mode = 'heading';
  scale = DEFAULT_SCALE;
  fitted = true;     // to the range, until somebody zooms
  #range = {rear: -5, front: 30, side: 15};
  x = 0;
  y = 0;
  up = Math.PI / 2;  // direction of the map frame that is up on the screen
  width = 1;
  height = 1;

  /** Follows the vehicle, as the mode wants. */
  follow([x, y, yaw]) {
    if (this.mode === 'free') return;
    this.up = this.mode === 'heading' ? yaw : Math.PI / 2;
    this.#fit();
    const {front, rear} = this.#range, ahead = this.mode === 'heading' ? (front + rear) / 2 : 0;
    this.x = x + ahead * Math.cos(this.up);
    this.y = y + ahead * Math.sin(this.up);
  }

  /** Learns the map's range from its box (flat: front left, front right, rear right, …) and the vehicle's pose. */
  setRange(box, [x, y, yaw]) {
    const body = (i) => {
      const dx = box[i] - x, dy = box[i + 1] - y;
      return [dx * Math.cos(yaw) + dy * Math.sin(yaw), dy * Math.cos(yaw) - dx * Math.sin(yaw)];
    };
    const [front, side] = body(0), [rear] = body(4);
    if (front > rear && side > 0) this.#range = {front, rear, side};
  }

  /** Chooses the scale at which the whole range is seen. */
  #fit() {
    if (!this.fitted) return;
    const {front, rear, side} = this.#range, furthest = 2 * Math.hypot(Math.max(front, -rear), side);
    const [across, along] = this.mode === 'heading' ? [2 * side, front - rear] : [furthest, furthest];
    this.scale = Math.max(0.5, Math.min(this.width / (across + 2 * AROUND_M), this.height / (along + 2 * AROUND_M)));
  }

  project(x, y) {
    const dx = x - this.x, dy = y - this.y, cos = Math.cos(this.up), sin = Math.sin(this.up);
    return [this.width / 2 + this.scale * (dx * sin - dy * cos), this.height / 2 - this.scale * (dx * cos + dy * sin)];
  }

  unproject(px, py) {
    const right = (px - this.width / 2) / this.scale, ahead = (this.height / 2 - py) / this.scale;
    const cos = Math.cos(this.up), sin = Math.sin(this.up);
    return [this.x + right * sin + ahead * cos, this.y - right * cos + ahead * sin];
  }

  /** The angle on the screen (clockwise from the right) of a direction in the map frame. */
  angle(direction) {
    return this.up - direction - Math.PI / 2;
  }

  /** Moves the map by pixels. The camera follows the vehicle no longer. */
  pan(dx, dy) {
    this.mode = 'free';
    const [x, y] = this.unproject(this.width / 2 - dx, this.height / 2 - dy);
    this.x = x;
    this.y = y;
  }

  /** Zooms about a pixel: the point of the map there stays there. */
  zoom(factor, [px, py] = [this.width / 2, this.height / 2]) {
    if (factor !== 1) this.fitted = false;
    const [x, y] = this.unproject(px, py);
    this.scale = Math.min(200, Math.max(0.5, this.scale * factor));
    const [nx, ny] = this.unproject(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  reset() {
    this.mode = 'heading';
    this.fitted = true;
  }

  centre(x, y) {
    this.mode = 'free';
    this.x = x;
    this.y = y;
  }
}
