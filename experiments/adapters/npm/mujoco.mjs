// MuJoCo: https://mujoco.org. In double. Its contacts are springs, solved implicitly; it has no continuous detection.
import initialize from '@mujoco/mujoco';

export const name = 'MuJoCo';
export const modes = ['default', 'elastic'];

let mujoco;

export async function start() {
  mujoco = await initialize();
}

const list = (numbers) => numbers.join(' ');

function geom(shape) {
  if (shape.sphere !== undefined) return `<geom type="sphere" size="${shape.sphere}"/>`;
  if (shape.box) return `<geom type="box" size="${list(shape.box)}"/>`;
  if (shape.capsule) return `<geom type="capsule" size="${shape.capsule[1]} ${shape.capsule[0]}" euler="90 0 0"/>`;
  throw new Error('meshes of MuJoCo are convex hulls, which a flat one is not');
}

let kept = {}; // compiling a model takes longer than a shot

function modelOf(mode, setting) {
  if (kept.setting === setting && kept.mode === mode) return kept;
  kept.data?.delete();
  kept.model?.delete();
  const { step, fixed, moving } = setting;
  const contact = mode === 'elastic' ? `solref="${-((Math.PI / (2 * step)) ** 2)} 0" solimp="0.99 0.99 0.001"` : '';
  const bodies = [
    ...fixed.map((shape) => `<body pos="${list(shape.at)}">${geom(shape)}</body>`),
    ...moving.map((shape) => `<body><freejoint/>${geom(shape)}</body>`),
  ].join('');
  const model = mujoco.MjModel.from_xml_string(`<mujoco><option timestep="${step}" gravity="0 0 0"/><size memory="10M"/>
    <default><geom density="1" condim="1" ${contact}/></default><worldbody>${bodies}</worldbody></mujoco>`);
  kept = { mode, setting, model, data: new mujoco.MjData(model) };
  return kept;
}

export function world(mode, setting) {
  const { model, data } = modelOf(mode, setting);
  return {
    place(states) {
      mujoco.mj_resetData(model, data);
      states.forEach((state, i) => {
        data.qpos.set(state.slice(0, 3), 7 * i);
        data.qvel.set(state.slice(3, 9), 6 * i); // a turning velocity is in the body's axes, which are the world's to begin with
      });
    },
    advance() { mujoco.mj_step(model, data); },
    states() { return setting.moving.map((_, i) => [...data.qpos.slice(7 * i, 7 * i + 3), ...data.qvel.slice(6 * i, 6 * i + 6)]); },
    free() {},
  };
}
