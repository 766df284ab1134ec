// Both wings of an animal as one sees them: feathers, membrane or film over the frame that the strips give.

import { Color, Group } from "three";
import { feathers } from "./feathers.js";
import { film } from "./film.js";
import { membrane } from "./membrane.js";
import { steps, surface } from "./paint.js";
import { Planform } from "./planform.js";
import { CASTS } from "./shadow.js";
import { WingFrame } from "./wing_frame.js";
import { Sheet, WingSkin } from "./wing_skin.js";

const COVERS = { feathers, membrane, film };
// Light passes through a bat's membrane and a robot's film.
const CLEAR = { feathers: 1, membrane: 0.93, film: 0.62 };
const FADED = 0.28; // of the skin where the strips are shown

export class Wings {
  constructor(flight, opacity) {
    const { cover } = flight.shape;
    this.frame = new WingFrame(flight.strips);
    this.planform = new Planform(flight.shape, flight.semi_span);
    this.group = new Group();
    const { sheet, bones, held, hollow } = COVERS[cover](this.planform);
    this.skins = [[sheet, CLEAR[cover]], [bones, 1]]
      .filter(([part]) => part)
      .map(([part, clear]) => ({ skin: new WingSkin(part, surface(clear * opacity)), opacity: clear * opacity }));
    for (const { skin } of this.skins) {
      this.group.add(...skin.meshes);
    }
    if (opacity === 1) this.addShadow(held, hollow);
  }

  // What casts the shadow is the outline alone: far fewer faces, and nobody sees feathers in a soft shadow.
  addShadow(held, hollow) {
    const sheet = new Sheet();
    const black = new Color(0);
    sheet.grid(
      steps(0, 1, 33).map((eta) => {
        const edges = [-this.planform.edge(eta, held, hollow).behind, this.planform.ahead(eta)];
        return edges.map((ahead) => sheet.add(eta, ahead, 0, 0, black));
      }),
    );
    this.shade = new WingSkin(sheet, surface(1));
    for (const mesh of this.shade.meshes) mesh.layers.set(CASTS);
    this.group.add(...this.shade.meshes);
  }

  // `corners`: of the left wing's strips about the body's centre of mass; `pitch`: of the body, which holds the seams.
  show(corners, pitch) {
    this.frame.set(corners);
    for (const { skin } of this.skins) skin.show(this.frame, pitch);
    this.shade?.show(this.frame, pitch);
  }

  // Fade the skin, so that the strips are seen through it.
  fade(faded) {
    if (faded === this.faded) return;
    this.faded = faded;
    for (const { skin, opacity } of this.skins) {
      for (const { material } of skin.meshes) {
        material.opacity = faded ? FADED * opacity : opacity;
        material.transparent = material.opacity < 1;
        material.depthWrite = !faded && opacity > 0.5;
        material.needsUpdate = true;
      }
    }
  }
}
