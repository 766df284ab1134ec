// The viewer's doors: `mount` for a page, `default.render` for notebooks, and scenes that stand in the page itself.

import { Viewer } from "./viewer.js";

export function mount(element, scene, options = {}) {
  return new Viewer(element, scene, options);
}

export default {
  render({ model, el }) {
    const viewer = mount(el, JSON.parse(model.get("scene")));
    model.on("change:scene", () => viewer.replace(JSON.parse(model.get("scene"))));
    return () => viewer.destroy();
  },
};

for (const script of document.querySelectorAll("script[data-wingbeat-scene]")) {
  const address = (state) => `${location.href.split("#")[0]}#${state}`;
  const viewer = mount(script.parentElement, JSON.parse(script.textContent), { share: { address, script } });
  const show = () => viewer.restore(location.hash.slice(1));
  viewer.restore(script.dataset.state ?? "");
  show();
  window.addEventListener("hashchange", show);
}
