/** The page: what is set, the worker that fires, and what is shown. */

import { makeControls } from './controls.js';
import { startEngine } from './engine.js';
import { byId, draw, short, typed } from './plot.js';
import { makeScene } from './scene.js';
import { makeRod } from './rod.js';
import { read, textbook, write } from './state.js';
import { showCounts, showRace, showScene } from './tables.js';
import { serve } from './worker.js';

/** @typedef {import('./worker.js').Order} Order
 *  @typedef {import('./worker.js').Report} Report */

const still = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

async function library() {
  const bytes = Uint8Array.from(atob(byId('library').textContent.trim()), (letter) => letter.charCodeAt(0));
  const whole = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return WebAssembly.compile(await new Response(whole).arrayBuffer());
}

/** @param {string} code of the page: a worker is given the same */
async function page(code) {
  const module = await library(), engine = await startEngine(module), names = engine.methods.map((method) => method.name);
  const worker = new Worker(URL.createObjectURL(new Blob([code, '\nstart();'], { type: 'text/javascript' })));
  const order = (/** @type {Order} */ words) => worker.postMessage(words);
  const standard = textbook([...engine.factors, ...engine.rod.factors], names);
  let state = standard, grabbed = standard.setting, running = true, at = 0, frame = 0, spoken = 0, perSecond = 0, stopped = '';
  let later = 0, timing = true, racing = false, again = false; // of the times
  /** @type {import('./engine.js').Tally[]} */
  let tallies = [];
  /** @type {import('./engine.js').Raced[]} */
  let raced = [];

  const complain = (/** @type {string} */ why) => { byId('complaint').textContent = [stopped, why].filter((text) => text !== '').join(' '); };
  const methods = () => engine.methods.map((method, i) => ({ ...method, i, chosen: state.chosen.includes(method.name) }));
  const chosen = () => methods().filter((method) => method.chosen);

  const ratios = () => {
    const ratio = engine.stepRatio();
    return { ratio, from: Math.min(0.1, ratio / 3), to: Math.max(100, ratio * 3) };
  };

  function showShots() {
    const { ratio, from, to } = ratios(), count = 161;
    const x = Array.from({ length: count }, (_, i) => from * (to / from) ** (i / (count - 1)));
    const series = chosen().map((method) => {
      const tally = tallies[method.i], line = engine.curve(method.i, from, to, count).map((y, i) => /** @type {[number, number]} */ ([x[i], y]));
      const points = tally?.shots > 0 ? [/** @type {[number, number, number, number]} */ ([ratio, tally.share, tally.lower, tally.upper])] : [];
      return { label: method.name, color: method.color, mark: method.mark, line, points };
    });
    draw(byId('chance'), { label: 'step ratio: v h cos(a) / (w + 2 r) [1]', from, to, log: true }, { label: 'share that tunnels [1]', from: 0, to: 1 }, series);
    const theories = engine.methods.map((_, i) => engine.theory(i));
    showCounts(byId('counts'), methods(), tallies, theories, toggle);
    const late = chosen().filter(({ i }) => Number.isFinite(tallies[i]?.late));
    const most = Math.max(1e-12, ...late.map(({ i }) => Math.max(tallies[i].latest, theories[i].latest || 0))) * 1.15;
    draw(byId('lateness'), { label: 'mean lateness [m]', from: 0, to: most }, { label: 'largest [m]', from: 0, to: most },
      late.map((method) => ({ label: method.name, color: method.color, mark: method.mark,
        points: [[Math.max(0, tallies[method.i].late), Math.max(0, tallies[method.i].latest)]] })), 220);
  }

  function speak() {
    const shots = tallies.reduce((sum, tally) => sum + tally.shots, 0), now = performance.now();
    byId('status').dataset.shots = String(shots);
    const done = chosen().every(({ i }) => tallies[i]?.shots >= state.most);
    if (now - spoken < 1000 && running && !done) return;
    spoken = now;
    byId('status').textContent = state.chosen.length === 0 ? 'No method is chosen.' : `${shots.toLocaleString('en')} shots` +
      (done ? '; all are fired.' : running ? `, ${short(perSecond / 1e6)} million a second.` : '; paused.');
  }

  function showShot() {
    const shot = engine.shot(state.phase), all = methods().map((method) => ({ ...method, seen: shot.seen[method.i] }));
    scene.draw(shot, state.phase, at, all.filter((method) => method.chosen));
    byId('phase').value = String(state.phase);
    byId('phase-slider').value = String(Math.round(state.phase * 1000));
    const passed = all.filter((method) => method.chosen && Number.isNaN(method.seen)).map((method) => method.name);
    byId('scene-said').textContent = `The ball first touches ${short(shot.contact / Math.hypot(shot.dx, shot.dy))} steps after its first pose. ` +
      (passed.length > 0 ? `It passes unseen by ${passed.join(', ')}.` : 'Every chosen method sees it.');
    showScene(byId('scene-table'), all, shot);
  }

  function showTimes() {
    const points = raced.map((one, i) => ({ ...one, method: engine.methods[i] })), least = 1e-17;
    const times = points.map((one) => one.ns);
    draw(byId('race'), { label: 'error of the time, 99th percentile [m]', from: least, to: 10, log: true },
      { label: 'time a step [ns]', from: Math.max(1, Math.min(10, ...times) / 1.5), to: Math.max(1000, ...times) * 1.5, log: true },
      points.map((one) => ({ label: one.method.name, color: one.method.color, mark: one.method.mark,
        points: Number.isFinite(one.p99) ? [[Math.max(one.p99, least), one.ns, one.lower, one.upper]] : [] })));
    showRace(byId('race-table'), points);
  }

  const ask = () => {
    if (raced.length > 0 && !timing) order(state.wish);
  };

  /** What times depend on. @param {import('./engine.js').Setting | undefined} of */
  const timed = (of) => JSON.stringify({ ...of, seed: 0 });

  /** Times the methods at these conditions, unless they change again before. @param {number} wait [ms] */
  const measure = (wait) => {
    timing = true;
    byId('advice').textContent = 'The methods are being timed at these conditions.';
    clearTimeout(later);
    later = setTimeout(() => {
      again = racing; // the one that is being run is of what was set before
      if (!racing) order({ race: true });
      racing = true;
    }, wait);
  };

  function wish() {
    const late = byId('late').value.trim(), wanted = { miss: typed('miss') / 100, late: late === '' ? -1 : Number(late) };
    const fine = wanted.miss >= 0 && wanted.miss <= 1 && (late === '' || (wanted.late >= 0 && Number.isFinite(wanted.late)));
    complain(fine ? '' : 'What is wished: a share from 0 to 100 %, and a length of 0 m or more, or none');
    if (fine) state = { ...state, wish: wanted };
    showWish();
    link();
    ask();
  }
  const showWish = () => {
    byId('miss').value = String(Number((100 * state.wish.miss).toPrecision(12)));
    byId('late').value = state.wish.late < 0 ? '' : String(state.wish.late);
  };

  /** Everything starts anew, if that can be fired at all. @param {Partial<typeof state>} what */
  function change(what) {
    const next = { ...state, ...what }, why = engine.set(next.setting);
    complain(why);
    if (why === '') {
      const is_other = timed(next.setting) !== timed(state.setting) || raced.length === 0;
      state = next;
      tallies = [];
      order({ setting: state.setting, chosen: chosen().map(({ i }) => i), most: state.most, running });
      rod.change(state.setting, state.rod);
      if (is_other) measure(1000);
    }
    show();
  }

  function show() {
    const { speed, step, radius, thickness, angle_deg, seed } = state.setting;
    settings.show({ speed, rate: 1 / step, radius, thickness, angle_deg });
    byId('seed').value = String(seed);
    byId('most').value = String(state.most);
    showWish();
    showShot();
    showShots();
    speak();
    link();
  }

  const link = () => {
    try {
      history.replaceState(null, '', write(state, standard));
    } catch {
      location.hash = write(state, standard); // where a file may not
    }
  };

  const toggle = (/** @type {string} */ name) => {
    const now = state.chosen.includes(name) ? state.chosen.filter((one) => one !== name) : names.filter((one) => one === name || state.chosen.includes(one));
    state = { ...state, chosen: now };
    order({ chosen: chosen().map(({ i }) => i), running });
    show();
  };

  const run = (/** @type {boolean} */ now) => {
    running = now;
    byId('run').textContent = now ? 'Pause' : 'Go on';
    order({ running });
    rod.go();
    speak();
  };

  const phase = (/** @type {number} */ to) => {
    const fine = to >= 0 && to < 1;
    complain(fine ? '' : 'phase: a number >= 0 and < 1');
    if (fine) state = { ...state, phase: Number(to.toFixed(3)) % 1 };
    showShot();
    link();
  };
  const walk = (/** @type {number} */ to) => {
    cancelAnimationFrame(frame); // whatever plays
    at = Math.min(4, Math.max(0, to));
    showShot();
  };
  function play() {
    walk(still() ? Math.floor(at) + 1 : at + 0.02);
    if (at < 4 && !still()) frame = requestAnimationFrame(play);
  }

  const settings = makeControls(byId('controls'), (key, value) => {
    const fine = key !== 'rate' || (value >= 0.001 && Number.isFinite(value));
    if (fine) return change({ setting: { ...state.setting, ...(key === 'rate' ? { step: 1 / value } : { [key]: value }) } });
    complain('steps a second: a number >= 0.001 [1/s]');
    return show();
  });
  const scene = makeScene(byId('scene'), {
    onGrab: () => { grabbed = state.setting; },
    onPhase: phase,
    onSpeed: (factor) => change({ setting: { ...state.setting, speed: Number((grabbed.speed * factor).toPrecision(3)) } }),
    onThickness: (half) => change({ setting: { ...state.setting, thickness: Number((2 * half).toPrecision(3)) } }),
  });

  const rod = makeRod(engine.rod, () => running, (now) => {
    state = { ...state, rod: now };
    link();
  });
  function stopAfter() {
    const shots = typed('most'), fine = Number.isInteger(shots) && shots >= 1 && shots <= 1e9;
    change(fine ? { most: shots } : {});
    if (!fine) complain('shots a method: a whole number from 1 to 1,000,000,000');
  }

  /** @param {string} id @param {string} event @param {() => void} then */
  const on = (id, event, then) => byId(id).addEventListener(event, then);
  on('back', 'click', () => change({ setting: standard.setting }));
  on('run', 'click', () => run(!running));
  on('again', 'click', () => change({}));
  on('phase', 'change', () => phase(typed('phase')));
  on('phase-slider', 'input', () => phase(Number(byId('phase-slider').value) / 1000));
  on('before', 'click', () => walk(Math.ceil(at) - 1));
  on('after', 'click', () => walk(Math.floor(at) + 1));
  on('play', 'click', () => { at = at >= 4 ? 0 : at; play(); });
  on('most', 'change', stopAfter);
  on('seed', 'change', () => change({ setting: { ...state.setting, seed: typed('seed') } }));
  on('measure', 'click', () => measure(0));
  on('miss', 'change', wish);
  on('late', 'change', wish);
  const copy = async (/** @type {string} */ text, /** @type {string} */ what) => {
    byId('copied').dataset.text = text;
    try {
      await navigator.clipboard.writeText(text);
      byId('copied').textContent = `${what} is copied.`;
    } catch {
      byId('copied').textContent = `${what}, to copy by hand: ${text}`;
    }
  };
  on('copy-toml', 'click', () => void copy(engine.toml(state.wish.miss, state.wish.late), 'The configuration'));
  on('copy-citation', 'click', () => void copy(JSON.parse(byId('citation').textContent), 'The citation'));
  on('copy-link', 'click', () => void copy(location.href.replace(/#.*$/, '') + write(state, standard), 'The link'));

  worker.onmessage = ({ data }) => {
    const said = /** @type {Report} */ (data);
    if (said.raced) {
      racing = false;
      if (again) measure(0);
    }
    if (timed(said.of) !== timed(state.setting)) return; // of what was set before
    if (said.raced && !again) {
      raced = said.raced;
      timing = false;
      showTimes();
      ask();
    }
    if (said.advice !== undefined && !timing) byId('advice').textContent = said.advice;
    if (said.tallies && JSON.stringify(said.of) === JSON.stringify(state.setting)) {
      tallies = said.tallies;
      perSecond = said.perSecond ?? 0;
      showShots();
      speak();
    }
  };
  worker.onerror = (event) => {
    stopped = `What fires the shots has stopped (${event.message}); load the page again.`;
    complain('');
  };

  const follow = () => {
    try {
      const wanted = read(location.hash, standard, names), why = engine.set(wanted.setting);
      if (why !== '') throw new Error(why);
      change(wanted);
    } catch (error) {
      change(standard);
      complain(`The link cannot be followed, so this is the textbook's bullet: ${/** @type {Error} */ (error).message}`);
    }
  };
  addEventListener('hashchange', () => { if (location.hash !== write(state, standard)) follow(); });
  addEventListener('resize', () => { showShot(); showShots(); rod.show(); if (raced.length > 0) showTimes(); });
  order({ module });
  follow();
  measure(0);
  document.body.dataset.ready = 'yes';
}

/** On the page with its code; in a worker, without. @param {string} [code] */
export function start(code) {
  if (code === undefined) {
    void serve();
  } else {
    page(code).catch((error) => {
      byId('complaint').textContent = `This page needs WebAssembly and a browser of the last years: ${error.message}`;
    });
  }
}
