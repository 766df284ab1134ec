// The explorer's doors. Built as a classic script, because a page that opens from disk may load no module; `import()` of
// the same file works as well. Both set `globalThis.wingbeatExplorer`.

import { Face } from "./explorer/face.js";
import { Folder } from "./explorer/folder.js";
import { Viewer } from "./viewer.js";

let folder;

globalThis.wingbeatExplorer = {
  // Build the explorer in an element of a page.
  explore: (element, options = {}) => new Face(element, options),
  // Build a viewer alone.
  mount: (element, scene, options = {}) => new Viewer(element, scene, options),
  // The static explorer: `open` is called by the catalogue of a folder, `hold` by each of its data files, and
  // `holdPushes` by those with flights through gusts.
  open: (catalogue) => (folder = new Folder(document.querySelector("main"), catalogue)),
  hold: (animal, model, lattice) => folder.hold(animal, model, lattice),
  holdPushes: (animal, model, pushes) => folder.holdPushes(animal, model, pushes),
};
