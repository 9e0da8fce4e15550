/** What is set: read from the URL's fragment, and written to it. */

/** @typedef {import('./engine.js').Setting} Setting
 *  @typedef {{ setting: Setting, chosen: string[], most: number, phase: number }} State */

const numbers = /** @type {const} */ (['speed', 'step', 'radius', 'thickness', 'angle_deg', 'seed']);
/** Those that answer fastest, one of each kind. */
const at_first = ['end_of_step', 'substeps_2', 'substeps_8', 'centre_ray', 'conservative_advancement', 'closed_form'];

/** @param {import('./engine.js').Factor[]} factors @param {string[]} methods @returns {State} */
export function textbook(factors, methods) {
  const value = (/** @type {string} */ name) => factors.find((factor) => factor.name === name)?.value ?? 0;
  const setting = { speed: value('speed'), step: value('step'), radius: value('radius'), thickness: value('thickness'),
    angle_deg: value('angle_deg'), seed: 0 };
  return { setting, chosen: methods.filter((name) => at_first.includes(name)), most: 1e6, phase: 0.5 };
}

/** Throws an Error that says what is wrong with it. @param {string} fragment @param {State} standard @param {string[]} methods @returns {State} */
export function read(fragment, standard, methods) {
  const state = { ...standard, setting: { ...standard.setting } };
  for (const [key, word] of new URLSearchParams(fragment.replace(/^#/, ''))) {
    if (key === 'methods') {
      state.chosen = word.split(',').filter((name) => name !== '');
      const unknown = state.chosen.find((name) => !methods.includes(name));
      if (unknown !== undefined) throw new Error(`there is no method "${unknown}"`);
      continue;
    }
    const number = word.trim() === '' ? NaN : Number(word);
    if (!Number.isFinite(number)) throw new Error(`${key} is "${word}", which is no number`);
    const name = numbers.find((known) => known === key);
    if (name) {
      state.setting[name] = number;
    } else if (key === 'shots' && number >= 1 && number <= 1e9) {
      state.most = Math.round(number);
    } else if (key === 'phase' && number >= 0 && number < 1) {
      state.phase = number;
    } else {
      throw new Error(key === 'shots' || key === 'phase' ? `${key} is ${word}, out of its range` : `it names "${key}", which is not known`);
    }
  }
  return state;
}

/** @param {State} state */
export function write({ setting, chosen, most, phase }) {
  const words = numbers.map((name) => [name, String(setting[name])]);
  words.push(['methods', chosen.join(',')], ['shots', String(most)], ['phase', String(phase)]);
  return '#' + words.map(([key, word]) => `${key}=${encodeURIComponent(word).replaceAll('%2C', ',')}`).join('&');
}
