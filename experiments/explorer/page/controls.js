/** Sliders with a number beside each. */

/**
 * @typedef {{ key: 'speed' | 'rate' | 'radius' | 'thickness' | 'angle_deg', label: string, unit: string, from: number, to: number,
 *   log: boolean }} Control
 */

/** What a slider reaches; what is typed may go further. @type {Control[]} */
export const controls = [
  { key: 'speed', label: 'Speed', unit: 'm/s', from: 0.5, to: 2000, log: true },
  { key: 'rate', label: 'Steps a second', unit: '1/s', from: 1, to: 10000, log: true },
  { key: 'radius', label: 'Radius of the ball', unit: 'm', from: 0.0005, to: 1, log: true },
  { key: 'thickness', label: 'Thickness of the wall', unit: 'm', from: 0.0001, to: 1, log: true },
  { key: 'angle_deg', label: 'Angle from the normal', unit: 'deg', from: 0, to: 85, log: false },
];

const slots = 400; // of a slider

/** @param {Control} c @param {number} value */
function toSlot({ from, to, log }, value) {
  const share = log ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from);
  return Math.round(slots * Math.min(1, Math.max(0, Number.isNaN(share) ? 0 : share)));
}

/** @param {Control} c @param {number} slot */
function fromSlot({ from, to, log }, slot) {
  return Number((log ? from * (to / from) ** (slot / slots) : from + ((to - from) * slot) / slots).toPrecision(3));
}

/** @param {HTMLElement} into @param {(key: Control['key'], value: number) => void} changed */
export function makeControls(into, changed) {
  const made = controls.map((control) => {
    const row = document.createElement('div'), id = `set-${control.key}`;
    row.className = 'control';
    row.innerHTML = `<label for="${id}">${control.label} <span class="unit">[${control.unit}]</span></label>
      <input id="${id}" type="number" step="any" inputmode="decimal">
      <input id="${id}-slider" type="range" min="0" max="${slots}" aria-label="${control.label}">`;
    into.append(row);
    const [number, slider] = /** @type {HTMLInputElement[]} */ ([...row.querySelectorAll('input')]);
    slider.addEventListener('input', () => changed(control.key, fromSlot(control, Number(slider.value))));
    number.addEventListener('change', () => changed(control.key, number.value.trim() === '' ? NaN : Number(number.value)));
    return { control, number, slider };
  });
  return {
    /** @param {Record<Control['key'], number>} values */
    show(values) {
      for (const { control, number, slider } of made) {
        const value = values[control.key];
        number.value = String(Number(value.toPrecision(6)));
        slider.value = String(toSlot(control, value));
        slider.setAttribute('aria-valuetext', `${number.value} ${control.unit}`);
      }
    },
  };
}
