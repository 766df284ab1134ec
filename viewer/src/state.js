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

export function stateOf(viewer) {
  const { stage, plots } = viewer;
  const state = new URLSearchParams({ [MARK]: "1", phase: digits([viewer.phase], 6), camera: stage.view });
  state.set(
    "eye",
    digits(stage.camera.position.clone().sub(stage.controls.target).divideScalar(stage.span).toArray(), 5),
  );
  for (const { name, value, normal } of controls(viewer)) if (value !== normal) state.set(`set.${name}`, value);
  if (JSON.stringify(plots.choices) !== JSON.stringify(plots.first)) {
    state.set("plots", plots.choices.map(({ ys, x }) => `${ys.join(".")}~${x}`).join("*"));
  }
  if (plots.range[0] > 0 || plots.range[1] < plots.last) state.set("zoom", digits(plots.range, 6));
  return state.toString().replaceAll("%2C", ",").replaceAll("%7E", "~");
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
