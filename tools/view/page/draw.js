// Draws elements with anything that has the strokes of a CanvasRenderingContext2D: a canvas, or svg.js.

/** The corners of the head of an arrow that points by an angle, clockwise from the right. */
export function headOf(tip, size, angle = 0) {
  const cos = Math.cos(angle), sin = Math.sin(angle);
  const at = (back, side) => [tip[0] - size * (back * cos + side * sin), tip[1] - size * (back * sin - side * cos)];
  return [tip, at(1, 0.45), at(0.7, 0), at(1, -0.45)];
}

export class Painter {
  constructor(palette) {
    this.palette = palette;
    this.dark = false;
    this.tint = null;  // a colour in place of all others: then lines are drawn, and no areas
  }

  colour(style) {
    return this.tint ?? (this.dark ? style.dark : style.light);
  }

  theme() {
    return this.palette[this.dark ? 'dark' : 'light'];
  }

  ground(pen, camera) {
    pen.fillStyle = this.theme().ground;
    pen.fillRect(0, 0, camera.width, camera.height);
  }

  /** Draws those elements whose layer is shown. They must be in the order of painting. */
  draw(pen, camera, elements, shown) {
    for (const element of elements) {
      const layer = shown.get(element.layer);
      if (layer) for (const shape of element.shapes) this.shape(pen, camera, shape, layer.overlay);
    }
    pen.globalAlpha = 1;
  }

  shape(pen, camera, shape, overlay) {
    const style = this.palette.styles[shape.style];
    const colour = this.colour(style);
    pen.globalAlpha = shape.opacity ?? 1;
    if (shape.line) this.line(pen, camera, shape.line, {colour, width: style.width * overlay, dash: style.dash});
    else if (shape.area) this.tint ?? this.area(pen, camera, shape.area, colour);
    else if (shape.arrow) this.head(pen, camera, shape.arrow, {colour, size: style.head});
    else this.write(pen, shape.text, camera.project(shape.at[0], shape.at[1]), {colour, size: style.text});
  }

  /** `flat` is [x, y, x, y, …]. */
  trace(pen, camera, flat) {
    pen.beginPath();
    for (let i = 0; i < flat.length; i += 2) {
      const [x, y] = camera.project(flat[i], flat[i + 1]);
      i ? pen.lineTo(x, y) : pen.moveTo(x, y);
    }
  }

  area(pen, camera, flat, colour) {
    this.trace(pen, camera, flat);
    pen.closePath();
    pen.fillStyle = colour;
    pen.fill();
  }

  line(pen, camera, flat, {colour, width, dash = []}) {
    this.trace(pen, camera, flat);
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.lineJoin = 'round';
    pen.setLineDash(dash);
    pen.stroke();
    if (dash.length) pen.setLineDash([]);
  }

  head(pen, camera, [x, y, direction], {colour, size}) {
    this.polygon(pen, headOf(camera.project(x, y), size, camera.angle(direction)), colour);
  }

  /** Fills a polygon whose corners are pixels. */
  polygon(pen, corners, colour) {
    pen.beginPath();
    corners.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.closePath();
    pen.fillStyle = colour;
    pen.fill();
  }

  /** Writes a text with a seam in the colour of the ground, so that it can be read on anything. */
  write(pen, text, [x, y], {size = 12, colour = this.theme().text, align = 'center'} = {}) {
    pen.font = `${size}px system-ui, "DejaVu Sans", sans-serif`;
    pen.textAlign = align;
    pen.lineWidth = 3;
    pen.strokeStyle = this.theme().ground;
    pen.strokeText(text, x, y);
    pen.fillStyle = colour;
    pen.fillText(text, x, y);
  }

  /** Outlines an element: strongly if it is selected, weakly if it is under the pointer. */
  highlight(pen, camera, element, strong) {
    const colour = this.dark ? '#ffd54a' : '#e08a00';
    pen.globalAlpha = strong ? 0.85 : 0.5;
    for (const {line, area} of element.shapes) {
      if (area) this.line(pen, camera, [...area, area[0], area[1]], {colour, width: strong ? 3 : 2});
      else if (line && element.type !== 'lane') this.line(pen, camera, line, {colour, width: strong ? 7 : 5});
    }
    pen.globalAlpha = 1;
  }

  scaleBar(pen, camera) {
    const metres = [0.5, 1, 2, 5, 10, 20, 50, 100, 200].find((m) => m * camera.scale >= 70) ?? 500;
    const x = 14, y = camera.height - 14, end = x + metres * camera.scale;
    pen.beginPath();
    [[x, y - 6], [x, y], [end, y], [end, y - 6]].forEach(([px, py], i) => (i ? pen.lineTo(px, py) : pen.moveTo(px, py)));
    pen.strokeStyle = this.theme().text;
    pen.lineWidth = 1.5;
    pen.stroke();
    this.write(pen, `${metres} m`, [(x + end) / 2, y - 8]);
  }

  /** Writes the name of a column, or those of all maps that lie over one another. */
  names(pen, camera, names, tint) {
    names.forEach((name, i) => this.write(pen, name, [camera.width / 2, 20 + 17 * i], {size: 13, colour: i ? tint : undefined}));
  }

  /** Draws the left edge of a column. */
  edge(pen, camera) {
    pen.fillStyle = this.theme().faint;
    pen.fillRect(0, 0, 1, camera.height);
  }

  north(pen, camera) {
    const at = [camera.width - 40, 40], angle = camera.up - Math.PI / 2;
    const to = (length, turn) => [at[0] + length * Math.sin(angle + turn), at[1] - length * Math.cos(angle + turn)];
    this.polygon(pen, [to(15, 0), to(10, 2.6), to(4, Math.PI), to(10, -2.6)], this.theme().text);
    this.write(pen, 'N', to(25, 0), {size: 11});
  }

  /** Draws a line through points of the map frame, with its length so far at each point. */
  measure(pen, camera, points) {
    if (!points.length) return;
    const colour = this.dark ? '#7db0ff' : '#1f5fd0';
    this.line(pen, camera, points.flat(), {colour, width: 2});
    let sum = 0;
    points.forEach(([x, y], i) => {
      const [px, py] = camera.project(x, y);
      pen.fillStyle = colour;
      pen.fillRect(px - 3, py - 3, 6, 6);
      if (!i) return;
      sum += Math.hypot(x - points[i - 1][0], y - points[i - 1][1]);
      this.write(pen, `${sum.toFixed(2)} m`, [px, py - 10], {colour, size: 13});
    });
  }
}
