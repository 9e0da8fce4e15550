/** The tables beside the pictures. */

import { markPicture, short } from './plot.js';

/** @typedef {import('./engine.js').Method & { i: number, chosen: boolean }} Row */

const percent = (/** @type {number} */ share) => (Number.isFinite(share) ? `${short(100 * share)} %` : '');
const meters = (/** @type {number} */ length) => (Number.isFinite(length) ? `${short(Math.max(0, length))} m` : '');

/** @param {HTMLTableElement} table @param {string[]} heads @param {(string | Node)[][]} rows the first cell of each names it */
function fill(table, heads, rows) {
  const cell = (/** @type {string} */ kind, /** @type {string | Node} */ content, scope = '') => {
    const made = document.createElement(kind);
    if (scope) made.setAttribute('scope', scope);
    made.append(content);
    return made;
  };
  const line = (/** @type {HTMLElement[]} */ cells) => {
    const made = document.createElement('tr');
    made.append(...cells);
    return made;
  };
  const head = document.createElement('thead'), body = document.createElement('tbody');
  head.append(line(heads.map((text) => cell('th', text, 'col'))));
  for (const [name, ...rest] of rows) body.append(line([cell('th', name, 'row'), ...rest.map((content) => cell('td', content))]));
  table.replaceChildren(head, body);
}

/** @param {Row | import('./engine.js').Method} method */
function named(method) {
  const made = document.createElement('span');
  made.append(markPicture(method), ` ${method.name}`);
  return made;
}

/** @param {HTMLTableElement} table @param {Row[]} methods @param {import('./engine.js').Tally[]} tallies
 *  @param {import('./engine.js').Theory[]} theories @param {(name: string) => void} toggle */
export function showCounts(table, methods, tallies, theories, toggle) {
  if (table.tBodies.length === 0) {
    const names = methods.map((method) => {
      const label = document.createElement('label'), box = document.createElement('input');
      box.type = 'checkbox';
      box.addEventListener('change', () => toggle(method.name));
      label.append(box, ' ', named(method));
      return label;
    });
    fill(table, ['Method', 'Shots', 'Tunneled', 'Share [95 %]', 'Theory', 'Mean lateness', 'Theory', 'Largest'],
      names.map((name) => [name, '', '', '', '', '', '', '']));
  }
  methods.forEach((method, i) => {
    const [name, ...cells] = [...table.tBodies[0].rows[i].cells], tally = tallies[i], theory = theories[i];
    const box = name.querySelector('input');
    if (box) box.checked = method.chosen;
    const counted = tally && tally.shots > 0;
    const said = [counted ? tally.shots.toLocaleString('en') : '0', counted ? tally.tunneled.toLocaleString('en') : '',
      counted ? `${percent(tally.share)} [${short(100 * tally.lower)}, ${short(100 * tally.upper)}]` : '', percent(theory.chance),
      counted ? meters(tally.late) : '', meters(theory.late), counted ? meters(tally.latest) : ''];
    cells.forEach((cell, k) => { if (cell.textContent !== said[k]) cell.textContent = said[k]; });
    table.tBodies[0].rows[i].dataset.counts = JSON.stringify(counted ? [tally.shots, tally.tunneled, tally.undecided] : [0, 0, 0]);
  });
}

/** @param {HTMLTableElement} table @param {(Row & { seen: number })[]} methods @param {import('./engine.js').Shot} shot */
export function showScene(table, methods, shot) {
  const said = (/** @type {number} */ seen) =>
    Number.isNaN(seen) ? 'never: the ball tunnels' : seen < 0 ? 'gives up' : `${meters(seen - shot.contact)} past first contact`;
  fill(table, ['Method', 'Sees the ball'], methods.map((method) => [named(method), said(method.seen)]));
}

/** @param {HTMLTableElement} table @param {(import('./engine.js').Raced & { method: import('./engine.js').Method })[]} raced */
export function showRace(table, raced) {
  fill(table, ['Method', 'Time a step [95 %]', 'Wrong verdicts of 4096', 'Error, 99th percentile', 'Largest error'],
    raced.map((one) => [named(one.method), `${short(one.ns)} ns [${short(one.lower)}, ${short(one.upper)}]`, String(one.wrong),
      meters(one.p99), meters(one.largest)]));
}

/** @param {HTMLTableElement} table @param {import('./engine.js').Method[]} methods @param {import('./engine.js').RodTally[]} tallies */
export function showRods(table, methods, tallies) {
  fill(table, ['Method', 'Flights', 'Tunneled', 'Share [95 %]', 'Theory', 'False hits'], methods.map((method, i) => {
    const tally = tallies[i];
    if (!tally || tally.shots === 0) return [named(method), '0', '', '', tally ? percent(tally.chance) : '', ''];
    return [named(method), tally.shots.toLocaleString('en'), tally.tunneled.toLocaleString('en'),
      `${percent(tally.share)} [${short(100 * tally.lower)}, ${short(100 * tally.upper)}]`, percent(tally.chance), tally.falseHits.toLocaleString('en')];
  }));
}
