/** The library, compiled to WebAssembly: ../explorer.hpp says what each function does. */

/**
 * @typedef {{ name: string, color: string, mark: number }} Method
 * @typedef {{ name: string, unit: string, lower: number, upper: number, value: number }} Factor
 * @typedef {{ speed: number, step: number, radius: number, thickness: number, angle_deg: number, seed: number }} Setting
 * @typedef {{ shots: number, tunneled: number, undecided: number, share: number, lower: number, upper: number, late: number,
 *   latest: number }} Tally
 * @typedef {{ chance: number, late: number, latest: number }} Theory
 * @typedef {{ x: number, y: number, dx: number, dy: number, half: number, radius: number, contact: number, seen: number[] }} Shot
 * @typedef {{ ns: number, lower: number, upper: number, wrong: number, p99: number, largest: number }} Raced
 * @typedef {{ shots: number, tunneled: number, undecided: number, falseHits: number, share: number, lower: number, upper: number,
 *   chance: number, late: number }} RodTally
 * @typedef {{ halfLength: number, radius: number, half: number, x: number, dx: number, angle: number, spin: number, contact: number,
 *   steps: number, seen: number[] }} RodShot
 */

/** All that the module asks of its host is the time, and where to end. @param {() => WebAssembly.Memory} memory */
function host(memory) {
  const clock = (/** @type {number} */ _id, /** @type {bigint} */ _precision, /** @type {number} */ at) => {
    new DataView(memory().buffer).setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
    return 0;
  };
  const ends = () => { throw new Error('the library has stopped'); };
  const nothing = () => 0;
  return { clock_time_get: clock, proc_exit: ends, fd_write: nothing, fd_close: nothing, fd_seek: nothing, environ_get: nothing,
    environ_sizes_get: (/** @type {number} */ count, /** @type {number} */ size) => {
      const view = new DataView(memory().buffer);
      view.setUint32(count, 0, true);
      view.setUint32(size, 0, true);
      return 0;
    } };
}

/** @param {WebAssembly.Module} module */
export async function startEngine(module) {
  /** @type {any} */
  let c = null;
  const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: host(() => c.memory) });
  c = instance.exports;
  c._initialize();
  const numbers = (/** @type {number} */ count) => [...new Float64Array(c.memory.buffer, c.explorer_numbers(), count)];
  const text = (/** @type {number} */ at) => {
    const bytes = new Uint8Array(c.memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  };
  const rodNumbers = (/** @type {number} */ count) => [...new Float64Array(c.memory.buffer, c.explorer_rod_numbers(), count)];
  /** @type {{ methods: Method[], factors: Factor[] }} */
  const rodOffer = JSON.parse(text(c.explorer_rod_describe()));
  const rod = {
    ...rodOffer,
    /** Why not, or an empty text. @param {Setting} s @param {number} length @param {number} spin */
    set: (s, length, spin) => text(c.explorer_rod_set(s.speed, s.step, s.radius, s.thickness, length, spin, s.seed)),
    /** The step ratio, and the degrees a step. */
    cell: () => rodNumbers(c.explorer_rod_cell()),
    fire: (/** @type {number} */ method, /** @type {number} */ count) => { c.explorer_rod_fire(method, count); },
    /** @param {number} method @returns {RodTally} */
    tally(method) {
      const [shots, tunneled, undecided, falseHits, share, lower, upper, chance, late] = rodNumbers(c.explorer_rod_tally(method));
      return { shots, tunneled, undecided, falseHits, share, lower, upper, chance, late };
    },
    /** @param {number} method @param {number} from @param {number} to @param {number} count */
    curve(method, from, to, count) {
      const [ratio, ...chances] = rodNumbers(c.explorer_rod_curve(method, from, to, count));
      return { ratio, chances };
    },
    /** @param {number} flight @returns {RodShot} */
    shot(flight) {
      const [halfLength, radius, half, x, dx, angle, spin, contact, steps, ...seen] = rodNumbers(c.explorer_rod_shot(flight));
      return { halfLength, radius, half, x, dx, angle, spin, contact, steps, seen };
    },
  };
  /** @type {{ methods: Method[], factors: Factor[] }} */
  const offer = JSON.parse(text(c.explorer_describe()));
  return {
    ...offer,
    rod,
    /** Why not, or an empty text. @param {Setting} s */
    set: (s) => text(c.explorer_set(s.speed, s.step, s.radius, s.thickness, s.angle_deg, s.seed)),
    fire: (/** @type {number} */ method, /** @type {number} */ count) => { c.explorer_fire(method, count); },
    /** @param {number} method @returns {Tally} */
    tally(method) {
      const [shots, tunneled, undecided, share, lower, upper, late, latest] = numbers(c.explorer_tally(method));
      return { shots, tunneled, undecided, share, lower, upper, late, latest };
    },
    /** @param {number} method @returns {Theory} */
    theory(method) {
      const [chance, late, latest] = numbers(c.explorer_theory(method));
      return { chance, late, latest };
    },
    stepRatio: () => /** @type {number} */ (c.explorer_step_ratio()),
    /** @param {number} method @param {number} from @param {number} to @param {number} count */
    curve: (method, from, to, count) => numbers(c.explorer_curve(method, from, to, count)),
    /** @param {number} phase @returns {Shot} */
    shot(phase) {
      const [x, y, dx, dy, half, radius, contact, ...seen] = numbers(c.explorer_shot(phase));
      return { x, y, dx, dy, half, radius, contact, seen };
    },
    /** @returns {Raced[]} */
    race() {
      const all = numbers(c.explorer_race()), raced = [];
      for (let i = 0; i < all.length; i += 6) {
        const [ns, lower, upper, wrong, p99, largest] = all.slice(i, i + 6);
        raced.push({ ns, lower, upper, wrong, p99, largest });
      }
      return raced;
    },
    /** @param {number} miss @param {number} late */
    advice: (miss, late) => text(c.explorer_advice(miss, late)),
    /** @param {number} miss @param {number} late */
    toml: (miss, late) => text(c.explorer_toml(miss, late)),
  };
}

/** @typedef {Awaited<ReturnType<typeof startEngine>>} Engine */
