// Havok Physics, as Babylon.js has it: https://www.babylonjs.com. In float.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import initialize from '@babylonjs/havok';

const at = createRequire(import.meta.url).resolve('@babylonjs/havok');

export const name = 'Havok';
export const modes = ['default'];
export const casts = ['shape_cast'];

let hk;

export async function start() {
  // it would fetch its .wasm: it gets the bytes
  const lib = new URL('../esm/', `file://${at}`);
  hk = await initialize({ wasmBinary: await readFile(new URL('HavokPhysics.wasm', lib)) });
}

const turn = [0, 0, 0, 1];
const ok = ([result, value]) => {
  if (result !== hk.Result.RESULT_OK) throw new Error(`Havok answers ${result.value ?? result}`);
  return value;
};

function meshOf({ points, triangles }) {
  const copy = (values, To) => {
    const bytes = hk._malloc(4 * values.length);
    new To(hk.HEAPU8.buffer, bytes, values.length).set(values);
    return bytes;
  };
  const corners = copy(points.flat(), Float32Array), faces = copy(triangles.flat(), Int32Array);
  const mesh = ok(hk.HP_Shape_CreateMesh(corners, points.length, faces, triangles.length));
  hk._free(corners);
  hk._free(faces);
  return mesh;
}

function shapeOf(shape) {
  const made = shape.sphere !== undefined ? ok(hk.HP_Shape_CreateSphere([0, 0, 0], shape.sphere))
    : shape.box ? ok(hk.HP_Shape_CreateBox([0, 0, 0], turn, shape.box.map((half) => 2 * half)))
    : shape.capsule ? ok(hk.HP_Shape_CreateCapsule([0, -shape.capsule[0], 0], [0, shape.capsule[0], 0], shape.capsule[1]))
    : meshOf(shape.mesh);
  hk.HP_Shape_SetMaterial(made, [0, 0, 1, hk.MaterialCombine.MINIMUM, hk.MaterialCombine.MAXIMUM]);
  hk.HP_Shape_SetDensity(made, 1);
  return made;
}

export function world(mode, { step, fixed, moving }) {
  const it = ok(hk.HP_World_Create()), held = [];
  hk.HP_World_SetGravity(it, [0, 0, 0]);
  hk.HP_World_SetIdealStepTime(it, step);
  hk.HP_World_SetSpeedLimit(it, 1e6, 1e6);
  const add = (shape, place, motion) => {
    const body = ok(hk.HP_Body_Create()), form = shapeOf(shape);
    held.push({ body, form });
    hk.HP_Body_SetShape(body, form);
    hk.HP_Body_SetMotionType(body, motion);
    if (motion === hk.MotionType.DYNAMIC) hk.HP_Body_SetMassProperties(body, ok(hk.HP_Shape_BuildMassProperties(form)));
    hk.HP_Body_SetLinearDamping(body, 0);
    hk.HP_Body_SetAngularDamping(body, 0);
    hk.HP_Body_SetActivationControl(body, hk.ActivationControl.ALWAYS_ACTIVE);
    hk.HP_Body_SetQTransform(body, [place, turn]);
    hk.HP_World_AddBody(it, body, false);
    return body;
  };
  for (const shape of fixed) add(shape, shape.at, hk.MotionType.STATIC);
  let placed = [];
  return {
    place(states) {
      placed = moving.map((shape, i) => {
        const body = add(shape, states[i].slice(0, 3), hk.MotionType.DYNAMIC);
        hk.HP_Body_SetLinearVelocity(body, states[i].slice(3, 6));
        hk.HP_Body_SetAngularVelocity(body, [...states[i].slice(6, 9), 0, 0, 0].slice(0, 3));
        return body;
      });
    },
    advance() { hk.HP_World_Step(it, step); },
    states() {
      return placed.map((body) => [...ok(hk.HP_Body_GetPosition(body)), ...ok(hk.HP_Body_GetLinearVelocity(body)),
        ...ok(hk.HP_Body_GetAngularVelocity(body))]);
    },
    free() {
      for (const { body, form } of held) {
        hk.HP_World_RemoveBody(it, body);
        hk.HP_Body_Release(body);
        hk.HP_Shape_Release(form);
      }
      hk.HP_World_Release(it);
    },
  };
}

/// HP_World_ShapeCastWithCollector, in a world of `b` alone.
export function cast(_, a, b) {
  const it = ok(hk.HP_World_Create()), body = ok(hk.HP_Body_Create()), form = shapeOf(b), moving = shapeOf(a);
  hk.HP_Body_SetShape(body, form);
  hk.HP_Body_SetMotionType(body, hk.MotionType.STATIC);
  hk.HP_Body_SetQTransform(body, [b.at, b.turn]);
  hk.HP_World_AddBody(it, body, false);
  const collector = ok(hk.HP_QueryCollector_Create(1)), to = a.at.map((v, k) => v + a.by[k]);
  return {
    ask() {
      hk.HP_World_ShapeCastWithCollector(it, collector, [moving, a.turn, a.at, to, false, [0n]]);
      const [, hits] = hk.HP_QueryCollector_GetNumHits(collector);
      return hits > 0 ? ok(hk.HP_QueryCollector_GetShapeCastResult(collector, 0))[0] : null;
    },
    free() {
      hk.HP_QueryCollector_Release(collector);
      hk.HP_World_RemoveBody(it, body);
      hk.HP_Body_Release(body);
      hk.HP_Shape_Release(form);
      hk.HP_Shape_Release(moving);
      hk.HP_World_Release(it);
    },
  };
}
