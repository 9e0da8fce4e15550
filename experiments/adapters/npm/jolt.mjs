// Jolt Physics: https://github.com/jrouwe/JoltPhysics. In float.
import initialize from 'jolt-physics';

export const name = 'Jolt';
export const modes = ['discrete', 'linear_cast'];
export const casts = ['cast_shape', 'cast_shape_back_faces'];

const still = 0, moves = 1; // layers: what moves meets all, what is still does not meet itself
let Jolt, upright, layer;

export async function start() {
  Jolt = await initialize();
  upright = new Jolt.Quat(0, 0, 0, 1);
  layer = [still, moves].map((number) => new Jolt.BroadPhaseLayer(number));
}

const vec3 = ([x, y, z]) => new Jolt.Vec3(x, y, z);

/// What `use` returns of a vector that lasts as long as that: what is made here is not collected.
function with3(values, use) {
  const vector = vec3(values), result = use(vector);
  Jolt.destroy(vector);
  return result;
}

/// Whoever asks releases it.
function shapeOf(shape) {
  const kept = (made) => {
    made.AddRef();
    return made;
  };
  if (shape.sphere !== undefined) return kept(new Jolt.SphereShape(shape.sphere));
  if (shape.box) return with3(shape.box, (half) => kept(new Jolt.BoxShape(half, Math.min(0.05, ...shape.box))));
  if (shape.capsule) return kept(new Jolt.CapsuleShape(...shape.capsule));
  const triangles = new Jolt.TriangleList(), points = shape.mesh.points.map(vec3);
  for (const corners of shape.mesh.triangles) {
    const triangle = new Jolt.Triangle(...corners.map((k) => points[k]));
    triangles.push_back(triangle);
    Jolt.destroy(triangle);
  }
  const made = new Jolt.MeshShapeSettings(triangles), result = made.Create(), mesh = kept(result.Get());
  result.Clear();
  for (const object of [made, triangles, ...points]) Jolt.destroy(object);
  return mesh;
}

function settings() {
  const all = new Jolt.JoltSettings();
  const pairs = new Jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(still, moves);
  pairs.EnableCollision(moves, moves);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(2, 2);
  for (const object of [still, moves]) layers.MapObjectToBroadPhaseLayer(object, layer[object]);
  all.mObjectLayerPairFilter = pairs;
  all.mBroadPhaseLayerInterface = layers;
  all.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
  return all;
}

export function world(mode, { step, fixed, moving }) {
  const all = settings();
  const it = new Jolt.JoltInterface(all);
  Jolt.destroy(all);
  const system = it.GetPhysicsSystem(), bodies = system.GetBodyInterface();
  with3([0, 0, 0], (none) => system.SetGravity(none));
  const how = system.GetPhysicsSettings();
  how.mMinVelocityForRestitution = 0; // what is slower sticks; 1 m/s as it comes
  system.SetPhysicsSettings(how);
  const add = (shape, at, motion, where, more) => {
    const form = shapeOf(shape);
    const made = with3(at, (place) => new Jolt.BodyCreationSettings(form, place, upright, motion, where));
    made.mRestitution = 1;
    made.mFriction = made.mLinearDamping = made.mAngularDamping = 0;
    made.mAllowSleeping = false;
    made.mMaxLinearVelocity = 1e6; // 500 m/s as it comes
    made.mMaxAngularVelocity = 1e6;
    more?.(made);
    const body = bodies.CreateBody(made);
    bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    Jolt.destroy(made);
    form.Release();
    return body;
  };
  for (const shape of fixed) add(shape, shape.at, Jolt.EMotionType_Static, still);
  let placed = [];
  return {
    place(states) {
      placed = moving.map((shape, i) => add(shape, states[i].slice(0, 3), Jolt.EMotionType_Dynamic, moves, (made) => {
        with3(states[i].slice(3, 6), (v) => { made.mLinearVelocity = v; });
        with3([...states[i].slice(6, 9), 0, 0, 0], (w) => { made.mAngularVelocity = w; });
        if (mode === 'linear_cast') made.mMotionQuality = Jolt.EMotionQuality_LinearCast;
      }));
    },
    advance() { it.Step(step, 1); },
    states() {
      return placed.map((body) => [body.GetCenterOfMassPosition(), body.GetLinearVelocity(), body.GetAngularVelocity()]
        .flatMap((v) => [v.GetX(), v.GetY(), v.GetZ()]));
    },
    free() { Jolt.destroy(it); },
  };
}

let any; // without an interface nothing knows which shapes meet how

/// TransformedShape.CastShape, of one pair; `back_faces`: with hits whose normal seems to look ahead, which are left out as it comes.
export function cast(which, a, b) {
  any ??= new Jolt.JoltInterface(settings());
  const made = [], keep = (object) => { made.push(object); return object; };
  const place = ({ turn, at }) => [keep(new Jolt.Quat(...turn)), keep(new Jolt.RVec3(...at))];
  const moving = shapeOf(a), fixed = shapeOf(b);
  const [turn, at] = place(b), target = keep(new Jolt.TransformedShape());
  target.mShape = fixed;
  target.mShapePositionCOM = at;
  target.mShapeRotation = turn;
  target.SetShapeScale(keep(vec3([1, 1, 1])));
  const from = Jolt.RMat44.prototype.sRotationTranslation(...place(a));
  const ray = keep(new Jolt.RShapeCast(moving, keep(vec3([1, 1, 1])), from, keep(vec3(a.by))));
  const how = keep(new Jolt.ShapeCastSettings()), base = keep(new Jolt.RVec3(0, 0, 0));
  if (which === 'cast_shape_back_faces') how.mBackFaceModeConvex = Jolt.EBackFaceMode_CollideWithBackFaces;
  const closest = keep(new Jolt.CastShapeClosestHitCollisionCollector()), all = keep(new Jolt.ShapeFilter());
  return {
    ask() {
      target.CastShape(ray, how, base, closest, all);
      return closest.HadHit() ? closest.mHit.mFraction : null;
    },
    free() {
      for (const object of made.reverse()) Jolt.destroy(object);
      moving.Release();
      fixed.Release();
    },
  };
}
