// Finds the element under a point of the map frame. Coordinates of shapes are flat: [x, y, x, y, …].

function distanceToSegment(px, py, ax, ay, bx, by) {
  const dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
  const share = squared ? Math.min(1, Math.max(0, ((px - ax) * dx + (py - ay) * dy) / squared)) : 0;
  return Math.hypot(px - ax - share * dx, py - ay - share * dy);
}

function distanceToLine([x, y], flat) {
  let least = Infinity;
  for (let i = 2; i < flat.length; i += 2)
    least = Math.min(least, distanceToSegment(x, y, flat[i - 2], flat[i - 1], flat[i], flat[i + 1]));
  return least;
}

function contains(flat, [x, y]) {
  let inside = false;
  for (let i = 0, j = flat.length - 2; i < flat.length; j = i, i += 2)
    if (flat[i + 1] > y !== flat[j + 1] > y &&
        x < ((flat[j] - flat[i]) * (y - flat[i + 1])) / (flat[j + 1] - flat[i + 1]) + flat[i])
      inside = !inside;
  return inside;
}

const UNPICKED = new Set(['vehicle', 'range', 'field_of_view', 'occlusions', 'ids', 'uncertainty']);

export const pickable = (elements, shown) => elements.filter(({layer}) => shown.has(layer) && !UNPICKED.has(layer));

/** The element of the nearest line within reach, else of the topmost area around the point, else null. Lanes are areas. */
export function pick(elements, shown, point, reach_m) {
  let best = null, least = reach_m;
  const candidates = pickable(elements, shown);
  for (const element of candidates) {
    if (element.type === 'lane') continue;
    for (const {line} of element.shapes) {
      const distance = line ? distanceToLine(point, line) : Infinity;
      if (distance < least) [best, least] = [element, distance];
    }
  }
  return best ?? candidates.findLast(({shapes}) => shapes.some(({area}) => area && contains(area, point))) ?? null;
}

/** A point on an element, for bringing it into view. */
export function middle(element) {
  for (const {line, area} of [...element.shapes].sort((a) => (a.line ? -1 : 1))) {
    const flat = line ?? area;
    if (!flat) continue;
    const i = Math.floor(flat.length / 4) * 2;
    return [flat[i], flat[i + 1]];
  }
  return null;
}
