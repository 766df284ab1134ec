// The explorer's doors, `globalThis.wingbeatExplorer`. The script needs the viewer's before it, and both are classic
// scripts, because a page that opens from disk may load no module.

import { Face } from "./explorer/face.js";
import { Folder } from "./explorer/folder.js";
import { mount } from "./explorer/shared.js";

let folder;

globalThis.wingbeatExplorer = {
  // Build the explorer in an element of a page.
  explore: (element, options = {}) => new Face(element, options),
  // Build a viewer alone.
  mount,
  // The static explorer: `open` is called by the catalogue of a folder, `hold` by each of its data files, and
  // `holdPushes` by those with flights through gusts.
  open: (catalogue) => (folder = new Folder(document.querySelector("main"), catalogue)),
  hold: (name, lattice) => folder.hold(name, lattice),
  holdPushes: (name, pushes) => folder.holdPushes(name, pushes),
};
