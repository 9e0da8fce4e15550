/** What is set: read from the URL's fragment, and written to it. */

/** @typedef {import('./engine.js').Setting} Setting
 *  @typedef {{ length: number, spin: number, flight: number }} Rod
 *  @typedef {{ miss: number, late: number }} Wish [1]; [m], < 0 is any
 *  @typedef {{ setting: Setting, chosen: string[], most: number, phase: number, rod: Rod, wish: Wish }} State */

const numbers = /** @type {const} */ (['speed', 'step', 'radius', 'thickness', 'angle_deg', 'seed']);
/** Of the other numbers of a link; the library says what a rod may be. @type {Record<string, [number, number]>} */
const ranges = { shots: [1, 1e9], phase: [0, 1 - 1e-9], miss: [0, 1], late: [0, Infinity], length: [-Infinity, Infinity], spin: [-Infinity, Infinity],
  flight: [0, 999] };
/** Those that answer fastest, one of each kind. */
const at_first = ['end_of_step', 'substeps_2', 'substeps_8', 'centre_ray', 'conservative_advancement', 'closed_form'];

/** @param {import('./engine.js').Factor[]} factors @param {string[]} methods @returns {State} */
export function textbook(factors, methods) {
  const value = (/** @type {string} */ name) => factors.find((factor) => factor.name === name)?.value ?? 0;
  const rod = { length: value('length'), spin: value('spin'), flight: 0 };
  const setting = { speed: value('speed'), step: value('step'), radius: value('radius'), thickness: value('thickness'),
    angle_deg: value('angle_deg'), seed: 0 };
  return { setting, chosen: methods.filter((name) => at_first.includes(name)), most: 1e6, phase: 0.5, rod,
    wish: { miss: 0, late: -1 } };
}

/** Throws an Error that says what is wrong with it. @param {string} fragment @param {State} standard @param {string[]} methods @returns {State} */
export function read(fragment, standard, methods) {
  const state = { ...standard, setting: { ...standard.setting }, rod: { ...standard.rod }, wish: { ...standard.wish } };
  for (const [key, word] of new URLSearchParams(fragment.replace(/^#/, ''))) {
    if (key === 'methods') {
      state.chosen = word.split(',').filter((name) => name !== '');
      const unknown = state.chosen.find((name) => !methods.includes(name));
      if (unknown !== undefined) throw new Error(`there is no method "${unknown}"`);
      continue;
    }
    const number = word.trim() === '' ? NaN : Number(word);
    if (!Number.isFinite(number)) throw new Error(`${key} is "${word}", which is no number`);
    const name = numbers.find((known) => known === key), range = ranges[key];
    if (!name && !range) throw new Error(`it names "${key}", which is not known`);
    if (range && !(number >= range[0] && number <= range[1])) throw new Error(`${key} is ${word}, out of its range`);
    if (name) state.setting[name] = number;
    else if (key === 'shots') state.most = Math.round(number);
    else if (key === 'phase') state.phase = number;
    else if (key === 'miss' || key === 'late') state.wish[key] = number;
    else if (key === 'length' || key === 'spin') state.rod[key] = number;
    else state.rod.flight = Math.round(number);
  }
  return state;
}

/** What is as in the textbook of the rod and of what is wished is left out. @param {State} state @param {State} standard */
export function write({ setting, chosen, most, phase, rod, wish }, standard) {
  const words = numbers.map((name) => [name, String(setting[name])]);
  words.push(['methods', chosen.join(',')], ['shots', String(most)], ['phase', String(phase)]);
  for (const [now, then] of /** @type {[object, object][]} */ ([[rod, standard.rod], [wish, standard.wish]])) {
    for (const [key, value] of Object.entries(now)) if (value !== Object(then)[key]) words.push([key, String(value)]);
  }
  return '#' + words.map(([key, word]) => `${key}=${encodeURIComponent(word).replaceAll('%2C', ',')}`).join('&');
}
