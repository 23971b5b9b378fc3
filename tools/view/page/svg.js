// The strokes of a canvas that draw.js uses, written down as SVG.
const escape = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const round = (value) => Math.round(value * 100) / 100;

export class SvgPen {
  globalAlpha = 1;
  #parts = [];
  #path = [];
  #dashes = [];
  #open = [];  // groups since each save()
  #clips = 0;

  constructor(width, height) {
    this.width = width;
    this.height = height;
  }

  beginPath() { this.#path = []; }
  moveTo(x, y) { this.#path.push(`M${round(x)} ${round(y)}`); }
  lineTo(x, y) { this.#path.push(`L${round(x)} ${round(y)}`); }
  closePath() { this.#path.push('Z'); }
  rect(x, y, width, height) { this.#path.push(`M${x} ${y}h${width}v${height}h${-width}Z`); }
  save() { this.#open.push(0); }
  translate(x, y) { this.#group(`transform="translate(${round(x)} ${round(y)})"`); }

  clip() {
    const id = `clip${++this.#clips}`;
    this.#parts.push(`<clipPath id="${id}"><path d="${this.#path.join('')}"/></clipPath>`);
    this.#group(`clip-path="url(#${id})"`);
  }

  restore() { this.#parts.push('</g>'.repeat(this.#open.pop())); }
  setLineDash(dashes) { this.#dashes = dashes; }

  stroke() {
    const dashes = this.#dashes.length ? ` stroke-dasharray="${this.#dashes.join(' ')}"` : '';
    this.#add(`<path d="${this.#path.join('')}" fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}" stroke-linejoin="round"${dashes}`);
  }

  fill() { this.#add(`<path d="${this.#path.join('')}" fill="${this.fillStyle}"`); }

  fillRect(x, y, width, height) {
    this.#add(`<rect x="${round(x)}" y="${round(y)}" width="${width}" height="${height}" fill="${this.fillStyle}"`);
  }

  fillText(text, x, y) { this.#text(text, x, y, `fill="${this.fillStyle}"`); }

  strokeText(text, x, y) {
    this.#text(text, x, y, `fill="none" stroke="${this.strokeStyle}" stroke-width="${this.lineWidth}"`);
  }

  #text(text, x, y, paint) {
    const anchor = {center: 'middle', left: 'start', right: 'end'}[this.textAlign];
    this.#parts.push(`<text x="${round(x)}" y="${round(y)}" font-size="${parseFloat(this.font)}" font-family="sans-serif" text-anchor="${anchor}" opacity="${this.globalAlpha}" ${paint}>${escape(text)}</text>`);
  }

  #group(attribute) {
    this.#parts.push(`<g ${attribute}>`);
    ++this.#open[this.#open.length - 1];
  }

  #add(open) { this.#parts.push(`${open} opacity="${this.globalAlpha}"/>`); }

  text() {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" viewBox="0 0 ${this.width} ${this.height}">\n${this.#parts.join('\n')}\n</svg>\n`;
  }
}
