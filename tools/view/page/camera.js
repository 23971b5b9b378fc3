// The projection of the map frame onto the screen.
const DEFAULT_SCALE = 13;  // pixels per metre
const AHEAD = 0.72;        // how far down the screen the vehicle is, heading up

export class Camera {
  mode = 'heading';
  scale = DEFAULT_SCALE;
  x = 0;
  y = 0;
  up = Math.PI / 2;  // direction of the map frame that is up on the screen
  width = 1;
  height = 1;

  /** Follows the vehicle, as the mode wants. */
  follow([x, y, yaw]) {
    if (this.mode === 'free') return;
    this.up = this.mode === 'heading' ? yaw : Math.PI / 2;
    const ahead = this.mode === 'heading' ? (AHEAD - 0.5) * this.height / this.scale : 0;
    this.x = x + ahead * Math.cos(this.up);
    this.y = y + ahead * Math.sin(this.up);
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
    const [x, y] = this.unproject(px, py);
    this.scale = Math.min(200, Math.max(0.5, this.scale * factor));
    const [nx, ny] = this.unproject(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  reset() {
    this.mode = 'heading';
    this.scale = DEFAULT_SCALE;
  }

  centre(x, y) {
    this.mode = 'free';
    this.x = x;
    this.y = y;
  }
}
