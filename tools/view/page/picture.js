// Pictures of what is seen, for papers and reports: at twice the size, with a caption and a legend.

import {headOf} from './draw.js';

const FACTOR = 2, PADDING = 14, LINE = 18, COLUMN = 150;

/** A stroke, an area or an arrow in the colours of a style, from `at` on, 26 pixels long. */
function sample(pen, painter, name, [x, y]) {
  const style = painter.palette.styles[name], colour = painter.colour(style);
  pen.fillStyle = pen.strokeStyle = colour;
  pen.setLineDash(style.dash ?? []);
  pen.lineWidth = style.width ?? 10;
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x + 26, y);
  if (style.width || !style.head) pen.stroke();
  pen.setLineDash([]);
  if (style.head) painter.polygon(pen, headOf([x + (style.width ? 26 : 20), y], style.head), colour);
}

/** The view with a caption below it. `paint(pen)` paints the view, which is `width` by `height` pixels. */
export function pictureOf({width, height, painter, caption, paint}) {
  const {legend} = painter.palette, columns = Math.max(1, Math.floor((width - 2 * PADDING) / COLUMN));
  const below = 2 * PADDING + LINE * (1 + Math.ceil(legend.length / columns));
  const canvas = Object.assign(document.createElement('canvas'), {width: width * FACTOR, height: (height + below) * FACTOR});
  const pen = canvas.getContext('2d'), theme = painter.theme();
  pen.scale(FACTOR, FACTOR);
  pen.fillStyle = theme.ground;
  pen.fillRect(0, 0, width, height + below);
  paint(pen);
  pen.font = '13px system-ui, "DejaVu Sans", sans-serif';
  pen.textAlign = 'left';
  pen.fillStyle = theme.text;
  pen.fillText(caption, PADDING, height + PADDING + 8, width - 2 * PADDING);
  pen.font = '11px system-ui, "DejaVu Sans", sans-serif';
  legend.forEach(({style, title}, i) => {
    const at = [PADDING + COLUMN * (i % columns), height + PADDING + 8 + LINE * (1 + Math.floor(i / columns))];
    sample(pen, painter, style, [at[0], at[1] - 4]);
    pen.fillStyle = theme.text;
    pen.fillText(title, at[0] + 32, at[1]);
  });
  return canvas;
}
