// One engine, asked and answering in lines of JSON: `node serve.mjs NAME` loads NAME.mjs, which exports
//
//   name                  what people call it
//   modes                 their names; ../npm.cpp says to people what each sets
//   start()               loads the engine; may be async
//   world(mode, setting)  a world of nothing but `setting`, the same object for all shots of a question, which has
//     step                [s]
//     fixed, moving       shapes: { sphere: r } | { box: [hx, hy, hz] } | { capsule: [half, r] } (along y) | { mesh: { points, triangles } },
//                         a fixed one with its place, `at`; all of restitution 1, no friction, no damping, no gravity, density 1
//     place(states)       puts the moving bodies there, each [x, y, z, vx, vy, vz, wx, wy, wz]; forgets what was before
//     advance()           one step
//     states()            as they were given, where the bodies are
//     free()              of everything it holds
//   casts                 the names of its shape casts, where the package has any
//   cast(name, a, b)      `a`, as a fixed shape with its rotation, `turn` (a quaternion), flies by `by` relative to `b`:
//     ask()               when it meets `b`, as a fraction of `by`, or null
//     free()
//
// A line asks { id, mode, step, steps, fixed, moving, shots: [states of each moving body] } and is answered by { id, flights, seconds }:
// the bodies at the end of each step, shot by shot, and what stepping took. { id, cast, pairs: [[a, b]] } is answered by
// { id, times, seconds, call_seconds }: what asking took, and what as many calls take that ask of two balls that fly apart, far
// away, which is the call alone. What cannot be done is answered by { id, error }.
import { createInterface } from 'node:readline';

const say = (answer) => process.stdout.write(JSON.stringify(answer) + '\n');
const engine = await import(`./${process.argv[2]}.mjs`);
await engine.start();
say({ name: engine.name, modes: engine.modes, casts: engine.casts ?? [] });

function fire({ mode, step, steps, fixed, moving, shots }) {
  if (!engine.modes.includes(mode)) throw new Error(`${engine.name} has no mode "${mode}"`);
  const setting = { step, fixed, moving };
  let seconds = 0;
  const flights = shots.map((states) => {
    const world = engine.world(mode, setting);
    world.place(states);
    const flight = [];
    for (let i = 0; i < steps; ++i) {
      const start = process.hrtime.bigint();
      world.advance();
      seconds += Number(process.hrtime.bigint() - start) * 1e-9;
      flight.push(world.states());
    }
    world.free();
    return flight;
  });
  return { flights, seconds };
}

function ball(x, by) { return { sphere: 0.1, at: [x, 0, 0], turn: [0, 0, 0, 1], by: [by, 0, 0] }; }

function castAll({ cast: name, pairs }) {
  if (!engine.casts?.includes(name)) throw new Error(`${engine.name} has no cast "${name}"`);
  const timed = (all) => {
    let spent = 0n;
    const times = all.map(([a, b]) => {
      const one = engine.cast(name, a, b), start = process.hrtime.bigint(), time = one.ask();
      spent += process.hrtime.bigint() - start;
      one.free();
      return time;
    });
    return [times, Number(spent) * 1e-9];
  };
  const [times, seconds] = timed(pairs);
  const far = Array.from({ length: 300 }, () => [ball(10, 1), ball(0, 0)]), [, few] = timed(far);
  return { times, seconds, call_seconds: (few * pairs.length) / far.length };
}

for await (const line of createInterface({ input: process.stdin })) {
  let id = null;
  try {
    const question = JSON.parse(line);
    id = question.id;
    say({ id, ...(question.cast ? castAll(question) : fire(question)) });
  } catch (error) {
    say({ id, error: String(error?.message ?? error) });
  }
}
