/** Drawings in SVG: elements, marks of methods, and a picture with axes. */

/** @typedef {{ label: string, color: string, mark?: number, line?: [number, number][], points?: [number, number, number?, number?][] }} Series
 *  a point is x, y and the two ends of its interval along y
 *  @typedef {{ label: string, from: number, to: number, log?: boolean }} Axis */

/** @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);

/** The number in a field; NaN where it is empty or none. @param {string} id */
export const typed = (id) => (byId(id).value.trim() === '' ? NaN : Number(byId(id).value));

/** @param {string} name @param {Record<string, string | number>} attributes @param {(SVGElement | string)[]} children */
export function svg(name, attributes, ...children) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...children);
  return made;
}

/** By gnuplot's numbers, as in the figures: a path around (0, 0), 5 pixels wide either way. @type {Record<number, string>} */
const marks = {
  1: 'M-5 0H5M0-5V5', 2: 'M-4-4 4 4M-4 4 4-4', 4: 'M-4-4H4V4H-4Z', 6: 'M-4.5 0A4.5 4.5 0 1 0 4.5 0A4.5 4.5 0 1 0-4.5 0Z',
  3: 'M-5 0H5M0-5V5M-4-4 4 4M-4 4 4-4', 8: 'M0-5 5 4H-5Z', 10: 'M0 5 5-4H-5Z', 12: 'M0-5.5 5.5 0 0 5.5-5.5 0Z',
};

/** @param {{ color: string, mark?: number }} look @param {number} x @param {number} y */
export function markAt({ color, mark = 6 }, x, y) {
  return svg('path', { d: marks[mark] ?? marks[6], transform: `translate(${x} ${y})`, fill: 'none', stroke: color, 'stroke-width': 2 });
}

/** A small picture of a mark, for a table. @param {{ color: string, mark?: number }} look */
export function markPicture(look) {
  return svg('svg', { viewBox: '-8 -8 16 16', width: 16, height: 16, 'aria-hidden': 'true', class: 'mark' }, markAt(look, 0, 0));
}

/** @param {number} value */
export function short(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e-3 && size < 1e5 ? String(Number(value.toPrecision(3))) : value.toExponential(2).replace(/\.?0*e\+?/, 'e');
}

/** Powers of ten, or round numbers; about as many as have room. @param {Axis} axis @param {number} pixels */
function ticsOf({ from, to, log }, pixels) {
  const most = Math.max(2, Math.floor(pixels / 55));
  const tics = [];
  if (log) {
    const low = Math.ceil(Math.log10(from) - 1e-9), high = Math.floor(Math.log10(to) + 1e-9), every = Math.ceil((high - low + 1) / most);
    for (let power = low; power <= high; power += every) tics.push(10 ** power);
    return tics;
  }
  const rough = (to - from) / Math.min(most, 6), power = 10 ** Math.floor(Math.log10(rough)), step = ([1, 2, 5].find((f) => f * power >= rough) ?? 10) * power;
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to * (1 + 1e-9); ++i) tics.push(i * step);
  return tics;
}

/** Draws into `into`, which is as wide as it is; the table beside it says the same in numbers.
 *  @param {SVGElement} into @param {Axis} x @param {Axis} y @param {Series[]} series @param {number} [height] */
export function draw(into, x, y, series, height = 300) {
  const width = Math.max(280, into.getBoundingClientRect().width), left = 62, right = width - 18, top = 10, bottom = height - 44;
  const share = (/** @type {Axis} */ { from, to, log }, /** @type {number} */ v) =>
    log ? Math.log(v / from) / Math.log(to / from) : (v - from) / (to - from);
  const inside = (/** @type {number} */ s) => Math.min(1.02, Math.max(-0.02, s));
  const px = (/** @type {number} */ v) => left + (right - left) * inside(share(x, v));
  const py = (/** @type {number} */ v) => bottom - (bottom - top) * inside(share(y, v));
  const parts = [svg('rect', { x: left, y: top, width: right - left, height: bottom - top, class: 'frame' })];
  for (const tic of ticsOf(x, right - left)) {
    parts.push(svg('path', { d: `M${px(tic)} ${top}V${bottom}`, class: 'grid' }), svg('text', { x: px(tic), y: bottom + 16, class: 'tic middle' }, short(tic)));
  }
  for (const tic of ticsOf(y, (bottom - top) * 1.5)) {
    parts.push(svg('path', { d: `M${left} ${py(tic)}H${right}`, class: 'grid' }), svg('text', { x: left - 6, y: py(tic) + 4, class: 'tic end' }, short(tic)));
  }
  parts.push(svg('text', { x: (left + right) / 2, y: height - 8, class: 'axis middle' }, x.label),
    svg('text', { transform: `translate(14 ${(top + bottom) / 2}) rotate(-90)`, class: 'axis middle' }, y.label));
  for (const { line, color } of series) {
    if (!line) continue;
    const known = line.filter(([, v]) => Number.isFinite(v));
    parts.push(svg('polyline', { points: known.map(([a, b]) => `${px(a)},${py(b)}`).join(' '), class: 'curve', stroke: color }));
  }
  for (const one of series) {
    for (const [a, b, low, high] of one.points ?? []) {
      if (low !== undefined && high !== undefined) parts.push(svg('path', { d: `M${px(a)} ${py(low)}V${py(high)}`, stroke: one.color, 'stroke-width': 2 }));
      parts.push(markAt(one, px(a), py(b)));
    }
  }
  into.setAttribute('viewBox', `0 0 ${width} ${height}`);
  into.setAttribute('height', String(height));
  into.replaceChildren(...parts);
}
