// The viewer's doors: `mount` for a page, `default.render` for notebooks, and scenes that stand in the page itself.
// The bundle is a classic script that sets `globalThis.wingbeatViewer`; its last line makes an ES module of it. The
// explorer's bundle takes from it what both need.

import { draw, make } from "./elements.js";
import { Flight } from "./flight.js";
import { setView, viewOf } from "./state.js";
import { Viewer } from "./viewer.js";
import { capital, short, ticks } from "./writing.js";

const mount = (element, scene, options = {}) => new Viewer(element, scene, options);

function render({ model, el }) {
  const viewer = mount(el, JSON.parse(model.get("scene")));
  model.on("change:scene", () => viewer.replace(JSON.parse(model.get("scene"))));
  return () => viewer.destroy();
}

globalThis.wingbeatViewer = { mount, render, Viewer, Flight, setView, viewOf, make, draw, capital, short, ticks };

for (const script of document.querySelectorAll("script[data-wingbeat-scene]")) {
  const address = (state) => `${location.href.split("#")[0]}#${state}`;
  const viewer = mount(script.parentElement, JSON.parse(script.textContent), { share: { address, script } });
  const show = () => viewer.restore(location.hash.slice(1));
  viewer.restore(script.dataset.state ?? "");
  show();
  window.addEventListener("hashchange", show);
}
