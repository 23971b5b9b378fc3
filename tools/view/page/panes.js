// One map, or several of one drive to compare: side by side or laid over one another. They move together.

export class Panes {
  over = false;

  /** `names`: of the maps that are compared; empty if there is one map alone. `lists`: the elements of each map. */
  constructor(names = []) {
    this.names = names;
    this.lists = Array.from({length: Math.max(1, names.length)}, () => []);
  }

  get several() { return this.lists.length > 1; }

  /** The number of columns side by side. */
  get columns() { return this.over ? 1 : this.lists.length; }

  set(lists) {
    this.lists = lists;
    lists.forEach((elements, pane) => pane && elements.forEach((element) => (element.pane = pane)));
  }

  /** The same element in the present frame. */
  find({key, pane = 0}) { return this.lists[pane]?.find((element) => element.key === key); }

  /** The elements in the column of a pixel, and the place of the pixel within the column. */
  at([x, y], {width}) {
    const column = Math.min(this.columns - 1, Math.max(0, Math.floor(x / width)));
    return {elements: this.over ? this.lists.flat() : this.lists[column], pixel: [x - column * width, y]};
  }

  /** Calls `draw(lists, first)` for each column, with the pen moved and confined to it, and `edge()` after all but the first. */
  paint(pen, {width, height}, draw, edge) {
    if (this.columns === 1) return draw(this.lists, 0);
    this.lists.forEach((elements, column) => {
      pen.save();
      pen.translate(column * width, 0);
      pen.beginPath();
      pen.rect(0, 0, width, height);
      pen.clip();
      draw([elements], column);
      if (column) edge();
      pen.restore();
    });
  }
}
