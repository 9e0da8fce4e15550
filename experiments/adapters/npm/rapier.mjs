// Rapier: https://rapier.rs. In float.
import RAPIER from '@dimforge/rapier3d-compat';

export const name = 'Rapier';
// As it comes it already sweeps what is fast against what is fixed, once a step, though no body asks for it: World.maxCcdSubsteps is 1.
export const modes = ['discrete', 'default', 'ccd', 'soft_ccd'];
export const casts = ['cast_shape'];

export async function start() {
  const quiet = console.warn;
  console.warn = () => {}; // of its own loader, about how it is called
  await RAPIER.init();
  console.warn = quiet;
}

function collider(shape) {
  const { ColliderDesc } = RAPIER;
  const desc = shape.sphere !== undefined ? ColliderDesc.ball(shape.sphere)
    : shape.box ? ColliderDesc.cuboid(...shape.box)
    : shape.capsule ? ColliderDesc.capsule(...shape.capsule)
    : ColliderDesc.trimesh(new Float32Array(shape.mesh.points.flat()), new Uint32Array(shape.mesh.triangles.flat()));
  return desc.setRestitution(1).setRestitutionCombineRule(RAPIER.CoefficientCombineRule.Max).setFriction(0)
    .setFrictionCombineRule(RAPIER.CoefficientCombineRule.Min);
}

const xyz = ([x, y, z]) => ({ x, y, z });

export function world(mode, { step, fixed, moving }) {
  const it = new RAPIER.World({ x: 0, y: 0, z: 0 });
  it.timestep = step;
  if (mode === 'discrete' || mode === 'soft_ccd') it.maxCcdSubsteps = 0;
  for (const shape of fixed) {
    it.createCollider(collider(shape), it.createRigidBody(RAPIER.RigidBodyDesc.fixed().setTranslation(...shape.at)));
  }
  const bodies = [];
  return {
    place(states) {
      moving.forEach((shape, i) => {
        const [x, y, z, vx, vy, vz, wx = 0, wy = 0, wz = 0] = states[i];
        const desc = RAPIER.RigidBodyDesc.dynamic().setTranslation(x, y, z).setLinvel(vx, vy, vz)
          .setAngvel({ x: wx, y: wy, z: wz }).setCanSleep(false).setCcdEnabled(mode === 'ccd');
        if (mode === 'soft_ccd') desc.setSoftCcdPrediction(Math.hypot(vx, vy, vz) * step);
        bodies.push(it.createRigidBody(desc));
        it.createCollider(collider(shape), bodies[i]);
      });
    },
    advance() { it.step(); },
    states() {
      return bodies.map((body) => {
        const p = body.translation(), v = body.linvel(), w = body.angvel();
        return [p.x, p.y, p.z, v.x, v.y, v.z, w.x, w.y, w.z];
      });
    },
    free() { it.free(); },
  };
}

/// Shape.castShape, of one pair.
export function cast(_, a, b) {
  const { Ball, Cuboid, Capsule } = RAPIER, still = xyz([0, 0, 0]);
  const form = (shape) => shape.sphere !== undefined ? new Ball(shape.sphere)
    : shape.box ? new Cuboid(...shape.box) : new Capsule(...shape.capsule);
  const place = ({ at, turn: [x, y, z, w] }) => [xyz(at), { x, y, z, w }];
  const moving = form(a), fixed = form(b), from = place(a), to = place(b), by = xyz(a.by);
  return {
    ask: () => moving.castShape(...from, by, fixed, ...to, still, 0, 1, true)?.time_of_impact ?? null,
    free() {},
  };
}
