// Box2D version 3, in the plane: https://box2d.org. In float. What moves in y and z moves in y.
import initialize from 'box2d3-wasm';

export const name = 'Box2D 3';
export const modes = ['discrete', 'continuous', 'bullet'];
export const casts = ['cast_shape'];

let b2;

export async function start() { b2 = await initialize(); }

const plane = ([x, y, z]) => ({ x, y: Math.sign(y || z) * Math.hypot(y, z) });

function addShape(body, shape) {
  const def = b2.b2DefaultShapeDef();
  def.density = 1;
  def.material.restitution = 1;
  def.material.friction = 0;
  if (shape.sphere !== undefined) {
    const circle = new b2.b2Circle();
    circle.radius = shape.sphere;
    b2.b2CreateCircleShape(body, def, circle);
  } else if (shape.box) {
    b2.b2CreatePolygonShape(body, def, b2.b2MakeBox(shape.box[0], shape.box[1]));
  } else if (shape.capsule) {
    const capsule = new b2.b2Capsule();
    capsule.center1.Set(0, -shape.capsule[0]);
    capsule.center2.Set(0, shape.capsule[0]);
    capsule.radius = shape.capsule[1];
    b2.b2CreateCapsuleShape(body, def, capsule);
  } else {
    throw new Error('Box2D has no meshes');
  }
}

export function world(mode, { step, fixed, moving }) {
  const def = b2.b2DefaultWorldDef();
  def.gravity.Set(0, 0);
  def.restitutionThreshold = 0;
  def.maximumLinearSpeed = 1e6; // 400 m/s as it comes
  def.enableContinuous = mode !== 'discrete';
  def.enableSleep = false;
  const it = b2.b2CreateWorld(def);
  const add = (shape, at, type, more) => {
    const made = b2.b2DefaultBodyDef();
    const { x, y } = plane(at);
    made.type = type;
    made.position.Set(x, y);
    more?.(made);
    const body = b2.b2CreateBody(it, made);
    addShape(body, shape);
    return body;
  };
  for (const shape of fixed) add(shape, shape.at, b2.b2BodyType.b2_staticBody);
  let placed = [];
  return {
    place(states) {
      placed = moving.map((shape, i) => add(shape, states[i], b2.b2BodyType.b2_dynamicBody, (made) => {
        const { x, y } = plane(states[i].slice(3));
        made.linearVelocity.Set(x, y);
        made.angularVelocity = states[i][8] ?? 0;
        made.isBullet = mode === 'bullet';
      }));
    },
    advance() { b2.b2World_Step(it, step, 4); },
    states() {
      return placed.map((body) => {
        const p = b2.b2Body_GetPosition(body), v = b2.b2Body_GetLinearVelocity(body);
        return [p.x, p.y, 0, v.x, v.y, 0, 0, 0, b2.b2Body_GetAngularVelocity(body)];
      });
    },
    free() { b2.b2DestroyWorld(it); },
  };
}

/// b2World_CastShape of a circle, in a world of `b` alone; the package has neither b2ShapeCast nor b2TimeOfImpact.
export function cast(_, a, b) {
  const it = b2.b2CreateWorld(b2.b2DefaultWorldDef()), def = b2.b2DefaultBodyDef();
  def.position.Set(b.at[0], b.at[1]);
  addShape(b2.b2CreateBody(it, def), b);
  const from = new b2.b2Vec2(a.at[0], a.at[1]), by = new b2.b2Vec2(a.by[0], a.by[1]);
  const circle = b2.b2MakeProxy(from, 1, a.sphere), filter = b2.b2DefaultQueryFilter();
  return {
    ask() {
      let first = null;
      b2.b2World_CastShape(it, circle, by, filter, (found) => (first = found.fraction));
      return first;
    },
    free() { b2.b2DestroyWorld(it); },
  };
}
