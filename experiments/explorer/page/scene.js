/** One shot from the side: the ball at each step, the volume it sweeps, the wall, and where each method sees it. */

import { markAt, svg } from './plot.js';

/** @typedef {import('./engine.js').Shot} Shot
 *  @typedef {{ onGrab: () => void, onPhase: (phase: number) => void, onSpeed: (factor: number) => void, onThickness: (half: number) => void }} Drags
 *    the factor is of the speed when it was grabbed */

const height = 260, steps_shown = 4;

/** @param {SVGElement} into @param {Drags} drags */
export function makeScene(into, drags) {
  /** @type {{ shot: Shot, phase: number, scale: number } | null} */
  let drawn = null;
  /** What is held, from where, in the picture as it was then: each move draws another, to another scale.
   *  @type {{ name: string, from: number, shot: Shot, phase: number, scale: number } | null} */
  let held = null;

  into.addEventListener('pointerdown', (event) => {
    const name = /** @type {Element} */ (event.target).closest('[data-held]')?.getAttribute('data-held');
    held = name && drawn ? { ...drawn, name, from: event.clientX } : null;
    if (!held) return;
    into.setPointerCapture(event.pointerId);
    drags.onGrab();
  });
  for (const end of ['pointerup', 'pointercancel']) into.addEventListener(end, () => { held = null; });
  into.addEventListener('pointermove', (event) => {
    if (!held) return;
    const { name, from, shot, phase, scale } = held, moved = (event.clientX - from) / scale; // [m]
    if (name === 'ball') {
      drags.onPhase((((phase - moved / shot.dx) % 1) + 1) % 1); // towards the wall is a smaller phase
    } else if (name === 'velocity') {
      drags.onSpeed(Math.max(0.05, 1 + moved / shot.dx));
    } else {
      drags.onThickness(Math.max(0, shot.half - moved));
    }
  });

  return {
    /** @param {Shot} shot @param {number} phase @param {number} at of the poses, a whole one or between two
     *  @param {{ name: string, color: string, mark: number, seen: number }[]} seen */
    draw(shot, phase, at, seen) {
      const width = Math.max(280, into.getBoundingClientRect().width), middle = height / 2 + 20;
      const length = Math.hypot(shot.dx, shot.dy);
      const back = Math.abs(shot.x) + 1.5 * shot.radius, front = Math.max(shot.half, shot.x + steps_shown * shot.dx) + 1.5 * shot.radius;
      const scale = Math.min(width / (back + front), (height / 2 - 34) / Math.max(shot.radius, shot.half, Math.abs(shot.dy) * 1.2));
      const originX = width / 2 + ((back - front) / 2) * scale;
      drawn = { shot, phase, scale };
      // at y = 0 where it touches
      const touch = shot.y + (shot.contact / length) * shot.dy;
      const px = (/** @type {number} */ x) => originX + x * scale, py = (/** @type {number} */ y) => middle - (y - touch) * scale;
      const on = (/** @type {number} */ path) => ({ x: px(shot.x + (path / length) * shot.dx), y: py(shot.y + (path / length) * shot.dy) });
      const r = Math.max(shot.radius * scale, 1), end = on(steps_shown * length), start = on(0);
      const thick = Math.max(2 * shot.half * scale, 2), parts = [];
      parts.push(svg('line', { x1: start.x, y1: start.y, x2: end.x, y2: end.y, class: 'swept', 'stroke-width': 2 * r }));
      parts.push(svg('rect', { x: px(0) - thick / 2, y: 0, width: thick, height, class: 'wall' }),
        svg('rect', { x: px(-shot.half) - 12, y: 0, width: 24, height, class: 'handle', 'data-held': 'wall' }));
      parts.push(svg('line', { x1: start.x, y1: start.y, x2: end.x, y2: end.y, class: 'ray' }));
      for (let step = 0; step <= steps_shown; ++step) {
        const { x, y } = on(step * length);
        parts.push(svg('circle', { cx: x, cy: y, r, class: step === 0 ? 'pose first' : 'pose' }));
      }
      const first = on(shot.contact);
      parts.push(svg('circle', { cx: first.x, cy: first.y, r, class: 'contact' }));
      const here = on(at * length), tip = on(length), turn = (-Math.atan2(shot.dy, shot.dx) * 180) / Math.PI;
      parts.push(svg('circle', { cx: here.x, cy: here.y, r, class: 'ball' }));
      parts.push(svg('circle', { cx: start.x, cy: start.y, r: Math.max(r, 14), class: 'handle', 'data-held': 'ball' }),
        svg('line', { x1: start.x, y1: start.y - r - 10, x2: tip.x, y2: tip.y - r - 10, class: 'arrow' }),
        svg('path', { d: 'M0 0l-9-5v10Z', transform: `translate(${tip.x} ${tip.y - r - 10}) rotate(${turn})`, class: 'tip' }),
        svg('circle', { cx: tip.x, cy: tip.y - r - 10, r: 14, class: 'handle', 'data-held': 'velocity' }));
      let row = 0;
      for (const { color, mark, seen: path } of seen) {
        if (!(path >= 0)) continue;
        parts.push(markAt({ color, mark }, on(path).x, 14 + 11 * (row++ % 4)));
      }
      into.setAttribute('viewBox', `0 0 ${width} ${height}`);
      into.setAttribute('height', String(height));
      into.replaceChildren(...parts);
    },
  };
}
