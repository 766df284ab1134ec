// Frames of a recording: the viewer's picture, painted with the texts that the page lays over it.

const SOFT_EDGE = 3; // pixels

// The words that stand in an element, with the boxes of the page that they fill.
function words(element) {
  const found = [];
  const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  while (walker.nextNode()) {
    const { currentNode: node } = walker;
    for (const { 0: word, index } of node.textContent.matchAll(/\S+/g)) {
      range.setStart(node, index);
      range.setEnd(node, index + word.length);
      const box = range.getBoundingClientRect();
      if (box.width) found.push([word, box]);
    }
  }
  return found;
}

// A canvas of a width in pixels, on which the viewer's picture is painted with its texts.
export class Film {
  constructor(viewer, width) {
    this.viewer = viewer;
    const { clientWidth, clientHeight } = viewer.picture;
    this.ratio = width / clientWidth;
    this.canvas = document.createElement("canvas");
    this.canvas.width = width;
    this.canvas.height = 2 * Math.round((0.5 * width * clientHeight) / clientWidth); // videos want even numbers
    this.pen = this.canvas.getContext("2d", { willReadFrequently: true });
    this.before = { phase: viewer.phase, playing: viewer.playing };
    viewer.pause();
    const { renderer, camera } = viewer.stage;
    renderer.setPixelRatio(1);
    renderer.setSize(width, this.canvas.height, false);
    camera.aspect = width / this.canvas.height;
    camera.updateProjectionMatrix();
  }

  paint(phase) {
    const { viewer, pen, canvas } = this;
    const { stage } = viewer;
    viewer.set(phase);
    stage.render(); // at once: the drawing is gone after this task
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.fillStyle = getComputedStyle(viewer.root).backgroundColor;
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(viewer.canvas, 0, 0, canvas.width, canvas.height);
    this.write();
  }

  // The texts and legends that the page lays over the picture, in the same corners, and the phase.
  write() {
    const { viewer, pen, canvas } = this;
    const { color, backgroundColor } = getComputedStyle(viewer.root);
    pen.fillStyle = pen.strokeStyle = color;
    pen.shadowColor = backgroundColor; // as in the page, a soft edge makes texts legible over the picture
    pen.shadowBlur = SOFT_EDGE;
    this.writePart(viewer.warning, 0, 0);
    if (viewer.heading.clientHeight) this.writePart(viewer.heading, 0, 0);
    else this.writeHeading();
    this.writePart(viewer.legend, 0, 1);
    this.writePart(viewer.measures.element, 1, 1);
    pen.font = `${13 * this.enlarged}px system-ui, sans-serif`;
    pen.textBaseline = "middle";
    pen.textAlign = "center";
    pen.fillText(viewer.readout.textContent, 0.5 * canvas.width, canvas.height - 18 * this.enlarged);
    pen.textAlign = "left";
    pen.shadowBlur = 0;
  }

  // Texts are not made smaller than three quarters: they would be illegible.
  get enlarged() {
    return Math.max(this.ratio, 0.75);
  }

  // One part, which keeps its distance to a corner of the picture: `right` and `foot` are 0 or 1.
  writePart(part, right, foot) {
    const { viewer, pen, canvas, enlarged } = this;
    const frame = viewer.picture.getBoundingClientRect();
    const corner = [right ? frame.right : frame.left, foot ? frame.bottom : frame.top];
    const place = (box) => [
      right * canvas.width + (box.left - corner[0]) * enlarged,
      foot * canvas.height + (box.top - corner[1]) * enlarged,
      box.width * enlarged,
      box.height * enlarged,
    ];
    for (const scale of part.querySelectorAll(".wb-gradient")) {
      const [left, top, width, height] = place(scale.getBoundingClientRect());
      const colours = pen.createLinearGradient(left, 0, left + width, 0);
      const stops = getComputedStyle(scale).backgroundImage.match(/rgba?\([^)]*\)/g);
      stops.forEach((stop, nth) => colours.addColorStop(nth / (stops.length - 1), stop));
      pen.fillStyle = colours;
      pen.fillRect(left, top, width, height);
      pen.fillStyle = pen.strokeStyle;
    }
    const { color, backgroundColor, fontSize } = getComputedStyle(part);
    const hasGround = part.clientHeight && !/, 0\)|transparent/.test(backgroundColor);
    if (hasGround) {
      const box = place(part.getBoundingClientRect());
      pen.shadowBlur = 0;
      pen.fillStyle = backgroundColor;
      pen.beginPath();
      pen.roundRect(...box, 0.5 * box[3]);
      pen.fill();
    }
    pen.fillStyle = color;
    for (const bar of part.querySelectorAll(".wb-bar-line"))
      this.bracket(place(bar.getBoundingClientRect()), bar.clientWidth);
    for (const [word, box] of words(part)) {
      const [left, top, , height] = place(box);
      pen.font = `${parseFloat(fontSize) * enlarged}px system-ui, sans-serif`;
      pen.textBaseline = "middle";
      pen.fillText(word, left, top + 0.5 * height);
    }
    pen.fillStyle = pen.strokeStyle;
    pen.shadowBlur = SOFT_EDGE;
  }

  // Whose flight it is, where the page says that outside the picture: a recording leaves the page.
  writeHeading() {
    const { viewer, pen, canvas, enlarged } = this;
    const { warning, heading } = viewer;
    const [margin, line] = [12 * enlarged, 19 * enlarged];
    let top = (warning.offsetTop + warning.offsetHeight + 8) * enlarged;
    pen.font = `${14 * enlarged}px system-ui, sans-serif`;
    pen.textBaseline = "top";
    for (const { textContent } of heading.querySelectorAll("p")) {
      for (const text of this.wrapped(textContent, canvas.width - 2 * margin)) {
        pen.fillText(text, margin, top);
        top += line;
      }
    }
  }

  // A text in lines that are at most so wide, in the pen's font.
  wrapped(text, width) {
    const lines = [];
    for (const word of text.split(" ")) {
      const longer = lines.length ? `${lines.at(-1)} ${word}` : word;
      if (lines.length && this.pen.measureText(longer).width <= width) lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    return lines;
  }

  // The scale of the arrows, which the picture makes smaller even where its texts are not.
  bracket([left, top, width, height], pixels) {
    const { pen, enlarged } = this;
    if (!width) return;
    const start = left + width - pixels * this.ratio;
    pen.lineWidth = 2 * enlarged;
    pen.beginPath();
    pen.moveTo(start, top);
    pen.lineTo(start, top + height);
    pen.lineTo(left + width, top + height);
    pen.lineTo(left + width, top);
    pen.stroke();
  }

  // Put the viewer back as it was.
  end() {
    if (!this.viewer.root.isConnected) return;
    this.viewer.resize();
    this.viewer.set(this.before.phase);
    if (this.before.playing) this.viewer.play();
  }
}
