// The viewer's controls: cameras, player, and what is drawn. Each sets one choice of the viewer and draws again.

import { ARROWS } from "./colours.js";
import { make } from "./elements.js";
import { CAMERAS } from "./stage.js";

export const RATES = [
  [1, "real time"],
  [0.25, "1/4 speed"],
  [0.1, "1/10 speed"],
  [0.03, "1/30 speed"],
];
export const TINTS = {
  alpha: { label: "effective angle of attack", unit: "deg", scale: 180 / Math.PI, most: Math.PI / 3 },
  strip_lift: { label: "lift of a strip", unit: "N", scale: 1, most: Infinity },
};
export const FORCES = { lift: "lift", drag: "drag", force: "resultant" };
const AIR = { trails: "trails", ground: "ground", wake: "wake (a sketch, not computed)" };
const THEMES = [["system", "as system"], ["light", "light"], ["dark", "dark"]];
const PAIRS = [["ghost", "second as ghost"], ["beside", "side by side"]];

const bar = (...parts) => make("div", { class: "wb-bar" }, ...parts);
const slug = (label) => label.toLowerCase().replace(/\W+/g, "-");

// Give the viewer its controls; return the bars above the picture, of the player, and below.
export function addControls(viewer) {
  return { above: bar(cameras(viewer)), player: player(viewer), below: looks(viewer) };
}

function cameras(viewer) {
  viewer.cameras = Object.keys(CAMERAS).map((name, nth) => {
    const title = `${name} view (${nth + 1})`;
    return make("button", { type: "button", "aria-pressed": "false", title, onclick: () => viewer.setCamera(name) }, name);
  });
  return make("div", { class: "wb-group", role: "group", "aria-label": "Camera" }, ...viewer.cameras);
}

function player(viewer) {
  const act = () => (viewer.playing ? viewer.pause() : viewer.play());
  const label = "Play (space)";
  viewer.playButton = make("button", { type: "button", "aria-label": label, title: label, onclick: act }, "▶");
  viewer.scrubber = make("input", {
    type: "range",
    min: 0,
    step: "any",
    "aria-label": "Phase of the beat",
    oninput: () => {
      viewer.pause();
      viewer.set(Number(viewer.scrubber.value));
    },
  });
  viewer.readout = make("output", { class: "wb-readout" });
  viewer.rates = choice(viewer, "Speed", RATES, viewer.rate, (value) => (viewer.rate = Number(value)));
  const found = bar(viewer.playButton, viewer.scrubber, viewer.readout, viewer.rates);
  found.classList.add("wb-player");
  return found;
}

function looks(viewer) {
  const { look } = viewer;
  const again = () => viewer.set(viewer.phase);
  const tints = [["off", "off"], ...Object.entries(TINTS).map(([name, { label }]) => [name, label])];
  const strips = choice(viewer, "Strips", tints, "off", (value) => {
    look.strips = value !== "off";
    if (look.strips) look.colour = value;
    viewer.scaleTint();
    again();
  });
  viewer.forces = Object.entries(FORCES).map(([name, label]) =>
    toggle(label, look.arrows.has(name), ARROWS[name], (on) => {
      look.arrows[on ? "add" : "delete"](name);
      again();
    }),
  );
  const air = Object.entries(AIR).map(([name, label]) =>
    toggle(label, look[name], null, (on) => {
      look[name] = on;
      viewer.measure();
      again();
    }),
  );
  viewer.wakeToggle = air.at(-1);
  viewer.pairing = choice(viewer, "Two flights", PAIRS, viewer.ghost ? "ghost" : "beside", (value) => {
    viewer.ghost = value === "ghost";
    viewer.arrange();
  });
  viewer.theme = choice(viewer, "Theme", THEMES, "system", (value) => viewer.setTheme(value));
  const groups = [set("Forces", viewer.forces), set("Air", air)];
  return bar(strips, ...groups, viewer.pairing, viewer.theme, viewer.share.element);
}

// Fold all but picture and player; the page that holds the viewer has a theme for itself and the viewer.
export function fold(viewer) {
  const bars = viewer.root.querySelectorAll(".wb-bar:not(.wb-player, .wb-push)");
  const summary = make("summary", {}, "Views, forces and plots");
  viewer.theme.remove();
  viewer.pairing.remove(); // so has it for two flights
  viewer.rates.querySelector("label").textContent = "Playback"; // the page's speed is that of the flight
  viewer.root.dataset.compact = "";
  viewer.folded = make("details", { class: "wb-folded", ontoggle: () => viewer.unfold() }, summary, ...bars, viewer.side);
  viewer.root.append(viewer.folded);
}

const set = (label, toggles) => make("fieldset", { class: "wb-group" }, make("legend", {}, label), ...toggles);

function choice(viewer, label, options, chosen, act) {
  const id = `${viewer.id}-${label.replace(/\W/g, "")}`;
  const select = make("select", { id, "data-choice": slug(label), onchange: () => act(select.value) });
  for (const [value, text] of options) select.append(make("option", { value, selected: value === chosen }, text));
  return make("span", { class: "wb-choice" }, make("label", { for: id }, label), select);
}

function toggle(label, on, colour, act) {
  const about = { type: "checkbox", checked: on, "data-choice": slug(label) };
  const box = make("input", { ...about, onchange: () => act(box.checked) });
  const style = `background:${colour}`;
  const swatch = colour ? [make("span", { class: "wb-swatch", style, "aria-hidden": "true" })] : [];
  return make("label", { class: "wb-toggle" }, box, ...swatch, label);
}
