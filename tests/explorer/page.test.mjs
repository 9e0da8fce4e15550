// The page of `thinwall explore` in a real browser, from the disk, with the network cut. THINWALL_PROGRAM is the program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { AxeBuilder } from '@axe-core/playwright';
import { chromium } from 'playwright-core';

const program = process.env.THINWALL_PROGRAM, folder = mkdtempSync(join(tmpdir(), 'thinwall-page-'));
const pictures = process.env.THINWALL_PICTURES ?? join(folder, 'pictures'), file = join(folder, 'explore.html');
const run = (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8' });
let browser;

before(async () => {
  run('explore', '--out', file, '--no-open');
  mkdirSync(pictures, { recursive: true });
  browser = await chromium.launch({ executablePath: process.env.THINWALL_BROWSER ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--disable-background-networking', '--disable-component-update', '--disable-sync'] });
});
after(() => browser?.close());

/** An open page, which must ask for nothing and complain of nothing; `done()` checks that and closes it. */
async function open(fragment = '', options = {}) {
  const context = await browser.newContext({ offline: true, viewport: { width: 1400, height: 900 }, ...options });
  const page = await context.newPage(), wrong = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) wrong.push(message.text()); });
  page.on('pageerror', (error) => wrong.push(String(error)));
  page.on('request', (request) => { if (!/^(file|blob|data):/.test(request.url())) wrong.push(`asks for ${request.url()}`); });
  await page.goto(`file://${file}${fragment}`);
  await page.waitForSelector('body[data-ready]');
  const done = async () => {
    await context.close();
    assert.deepEqual(wrong, []);
  };
  return { page, done };
}

const value = (page, id) => page.inputValue(`#${id}`);
const rows = (page) => page.$$eval('#counts tbody tr', (all) => all.map((row) => ({
  name: row.cells[0].innerText.trim(), chosen: row.querySelector('input').checked, counts: JSON.parse(row.dataset.counts) })));
const allFired = (page) => page.waitForFunction(() => document.getElementById('status').textContent.includes('all are fired'), null, { timeout: 60000 });
const toml = async (page) => {
  await page.click('#copy-toml');
  return page.getAttribute('#copied', 'data-text');
};

test('it is one file of at most 2 MB', () => {
  assert.ok(statSync(file).size < 2e6);
  assert.doesNotMatch(readFileSync(file, 'utf8'), /(src|href)="(?!#|data:)/);
});

test('it shows a picture of every part, and counts', async () => {
  const { page, done } = await open();
  await page.waitForFunction(() => Number(document.getElementById('status').dataset.shots) > 1e6);
  await page.waitForFunction(() => document.getElementById('advice').textContent.startsWith('Use '), null, { timeout: 60000 });
  for (const id of ['scene', 'chance', 'lateness', 'race']) assert.ok((await page.$$(`#${id} path`)).length > 5, id);
  const share = (await rows(page)).find((row) => row.name === 'end_of_step').counts;
  assert.ok(Math.abs(share[1] / share[0] - 0.7) < 0.005, String(share)); // of the textbook's bullet
  await done();
});

const settings = ['speed=10&step=0.016666666666666666&radius=0.02&thickness=0.01&angle_deg=0&seed=0',
  'speed=37.5&step=0.01&radius=0.03&thickness=0.002&angle_deg=33&seed=7', 'speed=250&step=0.002&radius=0&thickness=0.05&angle_deg=71.3&seed=123456789'];
for (const [i, setting] of settings.entries()) {
  test(`it counts what the program counts: ${setting}`, async () => {
    const { page, done } = await open(`#${setting}&shots=3000`);
    for (const row of await rows(page)) if (!row.chosen) await page.getByLabel(row.name, { exact: true }).check();
    await page.waitForFunction(() => [...document.querySelectorAll('#counts tbody tr')].every((row) => JSON.parse(row.dataset.counts)[0] === 3000),
      null, { timeout: 60000 });
    await allFired(page);
    const mine = (await rows(page)).map(({ name, counts }) => [name, ...counts].join(','));
    const config = join(folder, `page-${i}.toml`), out = join(folder, `result-${i}`);
    writeFileSync(config, await toml(page));
    run('run', config, '--seed', /seed=(\d+)/.exec(setting)[1], '--trials', '3000', '--out', out);
    const [head, ...lines] = readFileSync(join(out, 'data', 'cells.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
    const at = (name) => head.indexOf(name), speed = /speed=([\d.]+)/.exec(setting)[1];
    const same = lines.filter((line) => line[at('speed')] === speed && mine.some((row) => row.startsWith(`${line[at('method')]},`)));
    const theirs = same.map((line) => ['method', 'shots', 'tunneled', 'undecided'].map((name) => line[at(name)]).join(','));
    assert.deepEqual(mine.toSorted(), [...new Set(theirs)].toSorted());
    await done();
  });
}

test('it fires a million shots and pauses', async () => {
  const { page, done } = await open('#methods=closed_form,end_of_step&shots=1000000000');
  await page.waitForFunction(() => Number(document.getElementById('status').dataset.shots) > 1e6);
  await page.click('#run');
  await page.waitForTimeout(300);
  const before_rest = await rows(page);
  await page.waitForTimeout(500);
  assert.deepEqual(await rows(page), before_rest);
  assert.match(await page.innerText('#status'), /paused/);
  await page.click('#run');
  await page.waitForFunction((shots) => Number(document.getElementById('status').dataset.shots) > shots, before_rest[0].counts[0] * 1.1);
  await done();
});

test('every slider moves by the keyboard, and what it sets changes', async () => {
  const { page, done } = await open();
  for (const id of ['set-speed', 'set-rate', 'set-radius', 'set-thickness', 'set-angle_deg', 'phase']) {
    const was = await value(page, id), hash = await page.evaluate(() => location.hash);
    await page.focus(`#${id}-slider`);
    await page.keyboard.press('ArrowRight');
    assert.notEqual(await value(page, id), was, id);
    assert.notEqual(await page.evaluate(() => location.hash), hash, id);
  }
  await page.fill('#set-speed', '12.5');
  await page.keyboard.press('Tab');
  assert.match(await page.evaluate(() => location.hash), /speed=12\.5&/);
  await page.fill('#set-speed', '-1');
  await page.keyboard.press('Tab');
  assert.match(await page.innerText('#complaint'), /^speed: a number > 0/);
  assert.equal(await value(page, 'set-speed'), '12.5'); // what was there still is
  await done();
});

test('the ball, its velocity and the wall can be dragged', async () => {
  const { page, done } = await open();
  const grab = async (held, ...to) => {
    await page.locator('#scene').scrollIntoViewIfNeeded();
    const box = await page.locator(`[data-held=${held}]`).boundingBox(), x = box.x + box.width / 2, y = box.y + Math.min(box.height / 2, 200);
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (const by of to) await page.mouse.move(x + by, y, { steps: 8 });
    await page.mouse.up();
  };
  for (const [held, id, by] of [['ball', 'phase', 30], ['velocity', 'set-speed', 40], ['wall', 'set-thickness', -20]]) {
    const was = Number(await value(page, id));
    await grab(held, by);
    const now = Number(await value(page, id));
    assert.notEqual(now, was, held);
    assert.ok(id === 'phase' || (now > was && now < 20 * was), `${held}: ${was} to ${now}`); // as far as the pointer, not farther by the event
    await page.click('#back');
    const from = Number(await value(page, id));
    await grab(held, by, 0);
    assert.ok(Math.abs(Number(await value(page, id)) - from) <= 0.002 * from, `${held}: there and back`);
  }
  await done();
});

test('a link leads back to the same state, and a broken one to the textbook with a word of why', async () => {
  const fragment = '#speed=20&step=0.01&radius=0.05&thickness=0.1&angle_deg=45&seed=3&methods=closed_form,bisection&shots=500&phase=0.25';
  const { page, done } = await open(fragment);
  assert.equal(await page.evaluate(() => location.hash), fragment);
  await page.reload();
  await page.waitForSelector('body[data-ready]');
  assert.equal(await page.evaluate(() => location.hash), fragment);
  assert.deepEqual((await rows(page)).filter((row) => row.chosen).map((row) => row.name), ['bisection', 'closed_form']);
  await done();
  const rod = await open('#speed=20&length=0.3&spin=70&flight=2&miss=0.2&late=0.01');
  assert.deepEqual([await value(rod.page, 'rod-length'), await value(rod.page, 'rod-spin'), await value(rod.page, 'miss'), await value(rod.page, 'late')],
    ['0.3', '70', '20', '0.01']);
  assert.match(await rod.page.innerText('#rod-said'), /^Flight 3:/);
  assert.match(await rod.page.evaluate(() => location.hash), /&length=0\.3&spin=70&flight=2&miss=0\.2&late=0\.01$/);
  assert.match(await toml(rod.page), /Wanted: at most 20 % of the shots tunnel, and none is seen more than 0\.01 m/);
  await rod.page.evaluate(() => { location.hash = '#speed=fast'; });
  await rod.page.waitForFunction(() => document.getElementById('complaint').textContent !== '');
  await rod.page.evaluate(() => { location.hash = '#speed=30'; });
  await rod.page.waitForFunction(() => document.getElementById('complaint').textContent === '');
  await rod.done();
  for (const [broken, why] of [['#speed=fast', /"fast", which is no number/], ['#speed=-1', /speed: a number > 0/], ['#sped=1', /"sped", which is not known/],
    ['#methods=magic', /no method "magic"/], ['#radius=0&thickness=0', /a point is never in a wall/], ['#%%%', /not known|no number/], ['#shots=0', /out of its range/],
    ['#speed=1e300', /speed/], ['#phase=1', /phase is 1/]]) {
    const one = await open(broken);
    assert.match(await one.page.innerText('#complaint'), why, broken);
    assert.equal(await value(one.page, 'set-speed'), '10', broken);
    await one.done();
  }
});

test('what is typed and cannot be is named, and what was there stays', async () => {
  const { page, done } = await open();
  for (const [id, text, was, why] of [['most', '', '1000000', /^shots a method/], ['seed', '', '0', /^seed: a whole/], ['phase', '1.5', '0.5', /^phase/],
    ['miss', '150', '0', /^What is wished/], ['late', '-3', '', /^What is wished/], ['set-rate', '0', '60', /^steps a second/]]) {
    await page.fill(`#${id}`, text);
    await page.keyboard.press('Tab');
    assert.match(await page.innerText('#complaint'), why, id);
    assert.equal(await value(page, id), was, id);
  }
  await done();
});

test('it advises for the conditions that are set', async () => {
  const { page, done } = await open();
  const advised = () => page.waitForFunction(() => document.getElementById('advice').textContent.startsWith('Use '), null, { timeout: 60000 });
  await advised();
  const error = () => page.$eval('#race-table tbody tr', (row) => row.cells[3].textContent);
  const before_change = await error();
  await page.fill('#set-speed', '200');
  await page.keyboard.press('Tab');
  assert.match(await page.innerText('#advice'), /being timed/);
  await advised();
  assert.notEqual(await error(), before_change);
  await done();
});

/** Orders that come while the library starts wait for it: some browsers deliver them then. And what fails is heard of. */
test('a worker whose library is slow to start obeys every order', async () => {
  const packed = /id="library">([^<]*)</.exec(readFileSync(file, 'utf8'))[1], module = await WebAssembly.compile(gunzipSync(Buffer.from(packed, 'base64')));
  const instantiate = WebAssembly.instantiate, later = globalThis.setTimeout, reports = [];
  globalThis.onmessage = null;
  globalThis.postMessage = (said) => reports.push(said);
  WebAssembly.instantiate = async (...words) => {
    await new Promise((next) => { setTimeout(next, 50); });
    return instantiate(...words);
  };
  const { serve } = await import('../../experiments/explorer/page/worker.js');
  await serve();
  const setting = { speed: 10, step: 0.01, radius: 0.02, thickness: 0.01, angle_deg: 0, seed: 0 };
  for (const data of [{ module }, { setting, chosen: [0], most: 1000, running: true }, { race: true }, { miss: 0, late: -1 }]) globalThis.onmessage({ data });
  const told = () => reports.some((said) => said.raced) && reports.some((said) => said.advice) && reports.some((said) => said.tallies?.[0].shots === 1000);
  for (let tries = 0; tries < 3000 && !told(); ++tries) await new Promise((next) => { later(next, 20); });
  assert.ok(told());
  const thrown = new Promise((resolve) => {
    globalThis.setTimeout = (then, wait) => later(() => { try { then(); } catch (error) { resolve(error); } }, wait);
  });
  globalThis.onmessage({ data: { chosen: [99], running: true } }); // there are not so many methods
  assert.ok(await thrown);
  globalThis.setTimeout = later;
  WebAssembly.instantiate = instantiate;
});

test('rods that spin pass as theory has it, and are counted as the program counts them', async () => {
  const { page, done } = await open('#speed=37.5&step=0.01&radius=0.03&thickness=0.002&seed=7');
  await page.fill('#rod-length', '0.25');
  await page.keyboard.press('Tab');
  await page.fill('#rod-spin', '70');
  await page.keyboard.press('Tab');
  const cells = () => page.$$eval('#rod-counts tbody tr', (all) => all.map((row) => [...row.cells].map((cell) => cell.innerText.trim())));
  await page.waitForFunction(() => [...document.querySelectorAll('#rod-counts tbody tr')].every((row) => row.cells[1].innerText === '20,000'), null,
    { timeout: 180000 });
  const all = await cells(), numbers = (text) => text.replaceAll(',', '').match(/-?[\d.]+(e-?\d+)?/g).map(Number);
  for (const [name, , , share, theory] of all) {
    if (theory === '') continue;
    const [, low, high] = numbers(share), width = (high - low) / 2;
    assert.ok(numbers(theory)[0] >= low - width && numbers(theory)[0] <= high + width, `${name}: ${share}, theory ${theory}`);
  }
  const config = join(folder, 'rods.toml'), out = join(folder, 'rods'), [ratio, spin] = await page.evaluate(() => JSON.parse(document.getElementById('rod-counts').dataset.cell));
  writeFileSync(config, `experiment = "spinning_rod"\nhalf_length = 0.095\nradius = 0.03\nthickness = 0.002\ntilt_deg = [90]\n` +
    `spin_deg = [${spin}]\nstep_ratio = [${ratio}]\npost_radius = 0.01\npost_distance = 0.09\npost_spin_deg = [10]\nsubsteps = [2, 8]\n`);
  run('run', config, '--seed', '7', '--trials', '20000', '--out', out);
  const [head, ...lines] = readFileSync(join(out, 'data', 'flights.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  const at = (name) => head.indexOf(name), theirs = lines.map((line) => `${line[at('method')]}: ${Number(line[at('tunneled')])}`);
  const mine = all.filter(([name]) => theirs.some((line) => line.startsWith(`${name}: `))).map(([name, , tunneled]) => `${name}: ${numbers(tunneled)[0]}`);
  assert.ok(mine.length >= 4);
  for (const line of mine) assert.ok(theirs.includes(line), line);
  const said = await page.innerText('#rod-said');
  await page.click('#rod-next');
  assert.notEqual(await page.innerText('#rod-said'), said);
  await page.fill('#rod-length', '-1');
  await page.keyboard.press('Tab');
  assert.match(await page.innerText('#rod-complaint'), /^length: a number > 0/);
  assert.equal(await page.innerText('#rod-said'), ''); // of the rod before
  await done();
});

test('it cites, and links to what is set', async () => {
  const { page, done } = await open('#speed=20');
  await page.click('#copy-citation');
  assert.equal(await page.getAttribute('#copied', 'data-text'), run('cite'));
  await page.click('#copy-link');
  assert.match(await page.getAttribute('#copied', 'data-text'), /explore\.html#speed=20&step=/);
  await done();
});

for (const colorScheme of ['light', 'dark']) {
  test(`nothing stands in anybody's way, ${colorScheme}`, async () => {
    for (const width of [320, 768, 1400]) {
      const { page, done } = await open('#shots=20000', { viewport: { width, height: 800 }, colorScheme, reducedMotion: 'reduce' });
      await allFired(page);
      await page.waitForFunction(() => document.getElementById('advice').textContent !== '', null, { timeout: 60000 });
      await page.$$eval('details', (all) => all.forEach((one) => { one.open = true; }));
      const { violations } = await new AxeBuilder({ page }).analyze();
      assert.deepEqual(violations.map((one) => [one.id, one.nodes.map((node) => node.html)]), []);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `wider than ${width} px`);
      await page.screenshot({ path: join(pictures, `${colorScheme}-${width}.png`), fullPage: true });
      await done();
    }
  });
}
