// NVIDIA PhysX 5, as physx-js-webidl builds it: https://github.com/NVIDIA-Omniverse/PhysX. In float.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';

const at = createRequire(import.meta.url).resolve('physx-js-webidl');

export const name = 'PhysX';
export const modes = ['discrete', 'swept', 'speculative'];
export const casts = ['sweep', 'sweep_precise'];

let px, physics, material, dispatcher;

export async function start() {
  // built for browsers, it looks where it is: for as long as it loads there is a window and no process
  const { process } = globalThis, { default: load } = await import(at);
  const wasmBinary = await readFile(at.replace(/mjs$/, 'wasm'));
  globalThis.window = globalThis;
  globalThis.process = undefined;
  try {
    px = await load({ wasmBinary });
  } finally {
    globalThis.process = process;
  }
  const all = px.PxTopLevelFunctions.prototype, number = px.PHYSICS_VERSION;
  const foundation = all.CreateFoundation(number, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
  physics = all.CreatePhysics(number, foundation, new px.PxTolerancesScale());
  dispatcher = all.DefaultCpuDispatcherCreate(0);
  material = physics.createMaterial(0, 0, 1);
}

function with3([x, y, z], use) {
  const v = new px.PxVec3(x, y, z), result = use(v);
  px.destroy(v);
  return result;
}

function geometryOf(shape) {
  if (shape.sphere !== undefined) return new px.PxSphereGeometry(shape.sphere);
  if (shape.box) return new px.PxBoxGeometry(...shape.box);
  if (shape.capsule) return new px.PxCapsuleGeometry(shape.capsule[1], shape.capsule[0]); // along x: turned below
  throw new Error('meshes of PhysX are not built here');
}

function pose(place, shape) {
  const [x, y, z, w] = shape.turn ?? [0, 0, 0, 1], half = Math.SQRT1_2;
  const turn = shape.capsule ? new px.PxQuat((x + y) * half, (y - x) * half, (w + z) * half, (w - z) * half)
    : new px.PxQuat(x, y, z, w);
  return with3(place, (p) => {
    const made = new px.PxTransform(p, turn);
    px.destroy(turn);
    return made;
  });
}

/// Contacts as they come, and by sweeping if asked.
function detecting(sweeps) {
  const shader = new px.PassThroughFilterShaderImpl(), { PxPairFlagEnum: flag } = px;
  shader.filterShader = () => {
    shader.outputPairFlags = flag.eCONTACT_DEFAULT | (sweeps ? flag.eDETECT_CCD_CONTACT : 0);
    return 0;
  };
  return shader;
}

export function world(mode, { step, fixed, moving }) {
  const scale = physics.getTolerancesScale(), desc = new px.PxSceneDesc(scale), shader = detecting(mode === 'swept');
  with3([0, 0, 0], (v) => { desc.gravity = v; });
  desc.cpuDispatcher = dispatcher;
  desc.bounceThresholdVelocity = 1e-3; // below it nothing bounces: 0.2 times the speed scale as it comes
  if (mode === 'swept') desc.flags.raise(px.PxSceneFlagEnum.eENABLE_CCD);
  px.PxTopLevelFunctions.prototype.setupPassThroughFilterShader(desc, shader);
  const it = physics.createScene(desc), bodies = [];
  px.destroy(desc);
  const add = (shape, place, make) => {
    const where = pose(place, shape), geometry = geometryOf(shape), body = make(where);
    const form = physics.createShape(geometry, material, true);
    body.attachShape(form);
    form.release();
    px.destroy(where);
    px.destroy(geometry);
    bodies.push(body);
    return body;
  };
  for (const shape of fixed) it.addActor(add(shape, shape.at, (where) => physics.createRigidStatic(where)));
  let placed = [];
  return {
    place(states) {
      placed = moving.map((shape, i) => {
        const body = add(shape, states[i].slice(0, 3), (where) => physics.createRigidDynamic(where));
        px.PxRigidBodyExt.prototype.updateMassAndInertia(body, 1);
        body.setLinearDamping(0);
        body.setAngularDamping(0);
        body.setMaxLinearVelocity(1e6);
        body.setMaxAngularVelocity(1e6);
        body.setSleepThreshold(0);
        const { PxRigidBodyFlagEnum: flag } = px;
        if (mode === 'swept') body.setRigidBodyFlag(flag.eENABLE_CCD, true);
        if (mode === 'speculative') body.setRigidBodyFlag(flag.eENABLE_SPECULATIVE_CCD, true);
        it.addActor(body);
        with3(states[i].slice(3, 6), (v) => body.setLinearVelocity(v));
        with3([...states[i].slice(6, 9), 0, 0, 0], (v) => body.setAngularVelocity(v));
        return body;
      });
    },
    advance() {
      it.simulate(step);
      it.fetchResults(true);
    },
    states() {
      return placed.map((body) => [body.getGlobalPose().p, body.getLinearVelocity(), body.getAngularVelocity()]
        .flatMap((v) => [v.x, v.y, v.z]));
    },
    free() {
      for (const body of bodies) body.release();
      it.release();
      px.destroy(shader);
    },
  };
}

/// PxGeometryQuery.sweep, of one pair; `precise`: with PxHitFlag::ePRECISE_SWEEP.
export function cast(which, a, b) {
  const length = Math.hypot(...a.by), { PxHitFlagEnum: flag } = px;
  const made = [geometryOf(a), pose(a.at, a), geometryOf(b), pose(b.at, b)];
  const along = new px.PxVec3(...a.by.map((v) => v / length)), hit = new px.PxSweepHit();
  const flags = new px.PxHitFlags(flag.eDEFAULT | (which === 'sweep_precise' ? flag.ePRECISE_SWEEP : 0));
  return {
    ask: () => px.PxGeometryQuery.prototype.sweep(along, length, ...made, hit, flags) ? hit.distance / length : null,
    free() { for (const object of [...made, along, hit, flags]) px.destroy(object); },
  };
}
