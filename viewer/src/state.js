// What a reader has chosen in a viewer, as one short text: for a link, and for a saved page.

import { PHASE } from "./card.js";
import { CAMERAS } from "./stage.js";

const MARK = "wb"; // so that other fragments of an address, such as a heading's, are left alone

const digits = (values, count = 4) => Array.from(values, (value) => Number(value.toPrecision(count))).join(",");

function numbers(text, count) {
  const found = (text ?? "").split(",").map(Number);
  return text && found.length === count && found.every(Number.isFinite) ? found : undefined;
}

// Menus and boxes of the viewer's bars; each is named after its label.
function controls(viewer) {
  return [...viewer.root.querySelectorAll("[data-choice]")].map((control) => {
    const isBox = control.type === "checkbox";
    const normal = isBox
      ? String(control.defaultChecked)
      : [...control.options].find((option) => option.defaultSelected)?.value;
    return {
      control,
      isBox,
      name: control.dataset.choice,
      normal,
      value: isBox ? String(control.checked) : control.value,
    };
  });
}

// Where the camera is, in semi-spans from the point that it looks at.
function eyeOf({ camera, controls, span }) {
  return camera.position.clone().sub(controls.target).divideScalar(span).toArray();
}

export function stateOf(viewer) {
  const { stage, plots } = viewer;
  const state = new URLSearchParams({ [MARK]: "1", phase: digits([viewer.phase], 6), camera: stage.view });
  state.set("eye", digits(eyeOf(stage), 5));
  for (const { name, value, normal } of controls(viewer)) if (value !== normal) state.set(`set.${name}`, value);
  if (JSON.stringify(plots.choices) !== JSON.stringify(plots.first)) {
    state.set("plots", plots.choices.map(({ ys, x }) => `${ys.join(".")}~${x}`).join("*"));
  }
  if (viewer.pushes.name) state.set("push", viewer.pushes.name);
  if (plots.range[0] > 0 || plots.range[1] < plots.last) state.set("zoom", digits(plots.range, 6));
  return state.toString().replaceAll("%2C", ",").replaceAll("%7E", "~");
}

// Menus, boxes and camera, for something that changes them for a while; `setView` puts them back. Not among them is how
// fast the flight is shown, which belongs to the animal.
export function viewOf(viewer) {
  const { stage, rates } = viewer;
  const kept = controls(viewer).filter(({ control }) => !rates.contains(control));
  const choices = new Map(kept.map(({ name, value }) => [name, value]));
  return { choices, camera: stage.view, eye: eyeOf(stage) };
}

export function setView(viewer, { choices, camera, eye }) {
  for (const one of controls(viewer)) if (choices.has(one.name)) setControl(one, choices.get(one.name));
  viewer.setCamera(camera);
  viewer.setEye(eye);
}

function setControl({ control, isBox, value, normal }, wanted = normal) {
  if (wanted === undefined || wanted === value) return;
  if (isBox) control.checked = wanted === "true";
  else if ([...control.options].some((option) => option.value === wanted)) control.value = wanted;
  else return;
  control.dispatchEvent(new Event("change"));
}

// Show a state; what it lacks is as at the start, what this viewer does not know is passed over.
export function restore(viewer, text) {
  const state = new URLSearchParams(text);
  if (state.get(MARK) !== "1") return;
  viewer.pushes.open(state.get("push") ?? "");
  viewer.pause();
  for (const one of controls(viewer)) setControl(one, state.get(`set.${one.name}`) ?? undefined);
  const plots = state
    .get("plots")
    ?.split("*")
    .map((each) => {
      const [ys, x] = each.split("~");
      return { ys: ys.split("."), x: x ?? PHASE };
    });
  viewer.plots.choose(plots ?? viewer.plots.first);
  const { last } = viewer.plots;
  const [from, to] = numbers(state.get("zoom"), 2) ?? [0, last];
  viewer.plots.zoom(from >= 0 && from < to && to <= last ? [from, to] : [0, last]);
  const camera = state.get("camera");
  if (Object.hasOwn(CAMERAS, camera ?? "")) viewer.setCamera(camera);
  viewer.setEye(numbers(state.get("eye"), 3));
  viewer.set(numbers(state.get("phase"), 1)?.[0] ?? 0);
}
