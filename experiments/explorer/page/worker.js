/** Fires shots beside the page, so that it stays quick. */

import { startEngine } from './engine.js';

/**
 * @typedef {{ module?: WebAssembly.Module, setting?: import('./engine.js').Setting, chosen?: number[], most?: number, running?: boolean,
 *   race?: boolean, miss?: number, late?: number }} Order
 * @typedef {{ tallies?: import('./engine.js').Tally[], perSecond?: number, raced?: import('./engine.js').Raced[], advice?: string,
 *   of?: import('./engine.js').Setting }} Report
 */

const slice = 6, between = 100; // [ms] a method at a time; reports

export async function serve() {
  /** @type {import('./engine.js').Engine | null} */
  let engine = null;
  /** @type {Required<Pick<Order, 'chosen' | 'most' | 'running'>>} */
  const now = { chosen: [], most: Infinity, running: false };
  /** @type {import('./engine.js').Setting | undefined} */
  let setting;
  let firing = false, batch = /** @type {number[]} */ ([]);
  const report = (/** @type {Report} */ said) => { postMessage({ ...said, of: setting }); };

  /** Fires at one method for a slice. @param {import('./engine.js').Engine} at @param {number} method */
  const fire = (at, method) => {
    const left = now.most - at.tally(method).shots;
    if (left <= 0) return 0;
    const count = Math.max(1, Math.min(left, batch[method] ?? 64)), start = performance.now();
    at.fire(method, count);
    const spent = Math.max(performance.now() - start, 0.05);
    batch[method] = Math.min(Math.round(count * Math.min(4, slice / spent)), 1 << 20);
    return count;
  };
  const tallies = (/** @type {import('./engine.js').Engine} */ at) => at.methods.map((_, i) => at.tally(i));

  const work = async () => {
    if (firing || !engine) return;
    firing = true;
    let last = performance.now(), shots = 0;
    while (now.running) {
      const fired = now.chosen.reduce((sum, method) => sum + fire(/** @type {any} */ (engine), method), 0);
      shots += fired;
      const spent = performance.now() - last;
      if (spent > between || fired === 0) {
        report({ tallies: tallies(engine), perSecond: (shots / Math.max(spent, 1)) * 1000 });
        last = performance.now();
        shots = 0;
        if (fired === 0) break;
      }
      await new Promise((next) => { setTimeout(next, 0); }); // orders come in between
    }
    firing = false;
  };

  const failed = (/** @type {unknown} */ error) => { setTimeout(() => { throw error; }, 0); }; // where the page hears of it
  const obey = async (/** @type {Order} */ order) => {
    if (order.module) engine = await startEngine(order.module);
    if (!engine) return;
    if (order.setting) {
      setting = order.setting;
      engine.set(setting);
      batch = [];
      report({ tallies: tallies(engine), perSecond: 0 });
    }
    now.chosen = order.chosen ?? now.chosen;
    now.most = order.most ?? now.most;
    now.running = order.running ?? now.running;
    if (order.race) report({ raced: engine.race() });
    if (order.miss !== undefined) report({ advice: engine.advice(order.miss, order.late ?? -1) });
    work().catch(failed);
  };
  let obeyed = Promise.resolve(); // one order after the other, though the first waits for the library
  onmessage = ({ data }) => { obeyed = obeyed.then(() => obey(data)).catch(failed); };
}
