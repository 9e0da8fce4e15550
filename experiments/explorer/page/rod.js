/** A rod that flies at the same wall and spins: its poses, and how often it passes. */

import { byId, draw, markAt, short, svg, typed } from './plot.js';
import { showRods } from './tables.js';

/** @typedef {import('./engine.js').Setting} Setting
 *  @typedef {Awaited<ReturnType<typeof import('./engine.js').startEngine>>['rod']} Library */

const rodsWanted = 20000, rodHeight = 240, rodSlice = 12; // flights a method; [ms] of them at once

/** The rod in a few steps around its first contact. @param {SVGElement} into @param {import('./engine.js').RodShot} shot
 *  @param {{ color: string, mark: number, seen: number }[]} seen */
function drawFlight(into, shot, seen) {
  const width = Math.max(280, into.getBoundingClientRect().width), from = Math.max(0, Math.floor(shot.contact) - 1), to = from + 3;
  const reach = shot.halfLength + shot.radius, at = (/** @type {number} */ steps) => shot.x + steps * shot.dx;
  const back = Math.abs(Math.min(at(from), -shot.half)) + reach, front = Math.max(at(to), shot.half) + reach;
  const scale = Math.min(width / (back + front), (rodHeight - 44) / (2 * reach)), middle = rodHeight / 2 + 12;
  const px = (/** @type {number} */ x) => width / 2 + ((back - front) / 2 + x) * scale;
  const thick = Math.max(2 * shot.half * scale, 2), round = Math.max(2 * shot.radius * scale, 2), parts = [];
  parts.push(svg('rect', { x: px(0) - thick / 2, y: 0, width: thick, height: rodHeight, class: 'wall' }),
    svg('line', { x1: px(at(from)), y1: middle, x2: px(at(to)), y2: middle, class: 'ray' }));
  const rod = (/** @type {number} */ steps, /** @type {string} */ kind) => {
    const angle = shot.angle + shot.spin * steps, dx = Math.cos(angle) * shot.halfLength * scale, dy = Math.sin(angle) * shot.halfLength * scale;
    return svg('line', { x1: px(at(steps)) - dx, y1: middle + dy, x2: px(at(steps)) + dx, y2: middle - dy, class: kind, 'stroke-width': round });
  };
  for (let k = 1; k < 12 * (to - from); ++k) parts.push(rod(from + k / 12, 'rod between'));
  for (let k = from; k <= to; ++k) parts.push(rod(k, 'rod pose'));
  parts.push(rod(shot.contact, 'rod contact'));
  let row = 0;
  for (const { color, mark, seen: steps } of seen) {
    if (steps >= from && steps <= to) parts.push(markAt({ color, mark }, px(at(steps)), 12 + 11 * (row++ % 2)));
  }
  into.setAttribute('viewBox', `0 0 ${width} ${rodHeight}`);
  into.setAttribute('height', String(rodHeight));
  into.replaceChildren(...parts);
}

/** @param {Library} library @param {() => boolean} running @param {(rod: import('./state.js').Rod) => void} said hears what is set */
export function makeRod(library, running, said) {
  let length = 0, spin = 0, flight = 0, possible = false, waiting = false, batch = /** @type {number[]} */ ([]);
  /** @type {Setting | null} */
  let setting = null;

  const tallies = () => library.methods.map((_, i) => library.tally(i));

  function showFlight() {
    if (!possible) return;
    const shot = library.shot(flight), all = library.methods.map((method, i) => ({ ...method, seen: shot.seen[i] }));
    drawFlight(byId('rod-scene'), shot, all);
    const passed = all.filter((method) => Number.isNaN(method.seen)).map((method) => method.name);
    byId('rod-said').textContent = `Flight ${flight + 1}: the rod turns by ${short((shot.spin * 180) / Math.PI)} degrees a step and first touches ` +
      `${short(shot.contact)} steps after its start. ` + (passed.length > 0 ? `It passes unseen by ${passed.join(', ')}.` : 'Every method sees it.');
  }

  function showCounts() {
    const counted = possible ? tallies() : [], count = 121;
    showRods(byId('rod-counts'), library.methods, counted);
    if (!possible) return;
    const cell = library.cell(), from = Math.min(0.1, cell[0] / 3), to = Math.max(20, cell[0] * 3);
    byId('rod-counts').dataset.cell = JSON.stringify(cell);
    const x = Array.from({ length: count }, (_, i) => from * (to / from) ** (i / (count - 1)));
    const series = library.methods.map((method, i) => {
      const { ratio, chances } = library.curve(i, from, to, count), { shots, share, lower, upper } = counted[i];
      const points = shots > 0 ? [/** @type {[number, number, number, number]} */ ([ratio, share, lower, upper])] : [];
      return { label: method.name, color: method.color, mark: method.mark, points, line: chances.map((y, k) => /** @type {[number, number]} */ ([x[k], y])) };
    });
    draw(byId('rod-chance'), { label: 'step over wall and rod: v h / (w + length) [1]', from, to, log: true },
      { label: 'share that tunnels [1]', from: 0, to: 1 }, series, 260);
  }

  /** A batch of the method with the fewest flights; the rest another time. */
  function work() {
    waiting = false;
    if (!possible || !running()) return;
    const all = tallies(), least = all.reduce((best, tally, i) => (tally.shots < all[best].shots ? i : best), 0);
    if (all[least].shots >= rodsWanted) return showCounts();
    const count = Math.min(batch[least] ?? 4, rodsWanted - all[least].shots), start = performance.now();
    library.fire(least, count);
    batch[least] = Math.max(1, Math.round(count * Math.min(4, rodSlice / Math.max(performance.now() - start, 0.5))));
    if (least === all.length - 1) showCounts();
    go();
  }
  function go() {
    if (waiting) return;
    waiting = true;
    setTimeout(work, 20);
  }

  function show() {
    byId('rod-length').value = String(length);
    byId('rod-spin').value = String(spin);
    byId('rod-spin-slider').value = String(Math.round(100 * Math.log10(Math.min(1e4, Math.max(1, spin)))));
    showFlight();
    showCounts();
  }

  function set() {
    if (!setting) return;
    const why = library.set(setting, length, spin);
    byId('rod-complaint').textContent = why;
    possible = why === '';
    batch = [];
    if (!possible) for (const id of ['rod-scene', 'rod-said', 'rod-chance']) byId(id).replaceChildren();
    show();
    go();
  }

  /** @param {Partial<import('./state.js').Rod>} what */
  function choose(what) {
    ({ length, spin, flight } = { length, spin, flight, ...what });
    if (what.flight === undefined) set();
    else showFlight();
    if (possible) said({ length, spin, flight });
  }

  const on = (/** @type {string} */ id, /** @type {string} */ event, /** @type {() => void} */ then) => byId(id).addEventListener(event, then);
  on('rod-length', 'change', () => choose({ length: typed('rod-length') }));
  on('rod-spin', 'change', () => choose({ spin: typed('rod-spin') }));
  on('rod-spin-slider', 'input', () => choose({ spin: Number((10 ** (Number(byId('rod-spin-slider').value) / 100)).toPrecision(3)) }));
  on('rod-next', 'click', () => choose({ flight: (flight + 1) % 1000 }));

  return {
    /** The conditions are others: all flights are forgotten. @param {Setting} now @param {import('./state.js').Rod} rod */
    change(now, rod) {
      setting = now;
      ({ length, spin, flight } = rod);
      set();
    },
    go,
    show,
  };
}
