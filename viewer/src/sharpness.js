// How sharp the picture is. Without a graphics card every pixel costs, and smooth edges cost twice as much: there the
// picture is coarse while it moves, and sharp once it stands.

const [MOVING, STILL] = [1, 2]; // pixels drawn for each pixel of the page, along each side
const REST = 300; // ms without a new picture, after which it stands
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

// Whether the browser draws in three dimensions without a graphics card.
export function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const about = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = about ? gl.getParameter(about.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}

export class Sharpness {
  // `redraw()`: draw the picture again at once, unless something has moved since; return whether it was drawn.
  constructor(renderer, inSoftware, redraw) {
    Object.assign(this, { renderer, inSoftware, redraw });
  }

  // The picture has another size.
  fit() {
    this.set(this.inSoftware ? MOVING : Math.min(window.devicePixelRatio, 2));
  }

  // The picture is about to be drawn, because something moved.
  moves() {
    if (!this.inSoftware) return;
    this.set(MOVING);
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      this.set(STILL);
      if (!this.redraw()) this.set(MOVING);
    }, REST);
  }

  set(ratio) {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  dispose() {
    clearTimeout(this.rest);
  }
}
